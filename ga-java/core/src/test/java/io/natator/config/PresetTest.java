package io.natator.config;

import static org.assertj.core.api.Assertions.assertThat;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

class PresetTest {

    @ParameterizedTest
    @CsvSource({"QUICK, 2, pool/creature-2", "THESIS, 2, thesis/creature-2", "THESIS, creature-2, thesis/creature-2",
            "QUICK, loach, plane/loach", "QUICK, eel, pool/eel", "THESIS, eel, open-water/eel", "QUICK, ray, pool/ray"})
    void aCreatureHasASceneInEachPreset(Preset preset, String creature, String scene) {
        assertThat(preset.sceneOf(creature)).isEqualTo(scene);
    }

    @ParameterizedTest
    @ValueSource(strings = {"0", "5", "12", "", "../eel", "Eel", "eel.json", "-eel"})
    void isNoCreature(String word) {
        assertThat(Preset.isCreature(word)).isFalse();
    }

    @Test
    void numbersAndNamesAreCreatures() {
        assertThat(Preset.isCreature("4")).isTrue();
        assertThat(Preset.isCreature("eel")).isTrue();
    }
}
