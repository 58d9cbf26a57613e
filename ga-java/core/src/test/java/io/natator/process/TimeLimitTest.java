package io.natator.process;

import static org.assertj.core.api.Assertions.assertThat;

import org.junit.jupiter.api.Test;

class TimeLimitTest {

    private static final SceneInfo THESIS = new SceneInfo("thesis/creature-1", 2, 5915, 4.0, 1.0 / 60, 4, 4, 1.2, null,
            null);

    /** An evaluation of the thesis takes a second or two; the limit is to be far from that, and below an hour. */
    @Test
    void isGenerous() {
        assertThat(TimeLimit.of(THESIS, null).toSeconds()).isBetween(60L, 300L);
        assertThat(TimeLimit.of(THESIS, 0.01).toSeconds()).isBetween(20L, 60L);
    }

    @Test
    void growsWithTheScenesCost() {
        long thesis = TimeLimit.of(THESIS, null).toSeconds();
        SceneInfo large = new SceneInfo("large", 2, 64 * 5915, 4.0, 1.0 / 60, 8, 8, 1.2, null, null);

        assertThat(TimeLimit.of(large, null).toSeconds()).isGreaterThan(64 * thesis);
        assertThat(TimeLimit.of(THESIS, 40.0).toSeconds()).isGreaterThan(7 * thesis);
    }
}
