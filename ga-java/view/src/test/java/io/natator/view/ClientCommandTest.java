package io.natator.view;

import static org.assertj.core.api.Assertions.assertThatCode;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.natator.base.InvalidInputException;
import java.util.Set;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

/** A page reads no file of the user's but those that the server was started with, whatever part of a scene names it. */
class ClientCommandTest {

    private static final Set<String> FILES = Set.of("/home/u/fish.json", "/home/u/rock.obj");

    private static void check(String overrides) {
        ClientCommand.read("{\"do\":\"overrides\",\"overrides\":" + overrides + "}").check(FILES);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', value = {
            "{\"creature\":{\"name\":\"/etc/x.json\"}}|overrides.creature.name: expected a named creature",
            "{\"companions\":[{\"creature\":{\"name\":\"eel\"}},{\"creature\":{\"name\":\"../x.json\"}}]}"
                    + "|overrides.companions[1].creature.name: expected a named creature",
            "{\"creature\":{\"mesh\":{\"file\":\"/etc/x.obj\"}}}|overrides.creature.mesh.file: expected a bundled mesh",
            "{\"companions\":[{\"creature\":{\"mesh\":{\"file\":\"../x.stl\"}}}]}|overrides.companions[0].creature.mesh.file: expected a bundled mesh",
            "{\"obstacles\":[{\"shape\":\"mesh\",\"file\":\"/etc/x.obj\"}]}|overrides.obstacles[0].file: expected a bundled mesh",
            "{\"obstacles\":[{\"file\":\"..\"}]}|overrides.obstacles[0].file: expected a bundled mesh",
            "{\"base\":\"/etc/x.json\"}|overrides.base: expected a named one"})
    void filesOfTheUserAreRefusedWhereverTheyAreNamed(String overrides, String message) {
        assertThatThrownBy(() -> check(overrides)).isInstanceOf(InvalidInputException.class)
                .hasMessageStartingWith(message);
    }

    @ParameterizedTest
    @ValueSource(strings = {"3", "null", "true", "[]", "[\"pool/eel\"]", "{}", "\"\"", "\"-h\"", "\"--help\"",
            "\"a\\u0000\"", "\"../x\"", "\"a b\"", "\"/etc/passwd.json\""})
    void aSceneIsAName(String scene) {
        for (String what : new String[] {"start", "scene"}) {
            assertThatThrownBy(
                    () -> ClientCommand.read("{\"do\":\"" + what + "\",\"scene\":" + scene + "}").check(FILES))
                    .isInstanceOf(InvalidInputException.class).hasMessageStartingWith("scene: expected a named scene");
        }
    }

    @Test
    void namedOnesAndThoseOfTheServersCommandLineMayBeUsed() {
        assertThatCode(() -> check(
                "{\"creature\":{\"name\":\"/home/u/fish.json\"},\"companions\":[{\"creature\":{\"name\":\"eel\"}},"
                        + "{\"creature\":{\"mesh\":{\"file\":\"ray.obj\"}}}],\"obstacles\":[{\"shape\":\"mesh\",\"file\":\"/home/u/rock.obj\"}]}"))
                .doesNotThrowAnyException();
    }
}
