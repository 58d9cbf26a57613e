package io.natator.config;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.catchThrowableOfType;

import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.encoding.Gait;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class JsonErrorsTest {

    private static String reason(String json, Class<?> type) {
        return Json.reason(catchThrowableOfType(JsonProcessingException.class,
                () -> Json.parse(json.replace('\'', '"'), type)));
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', value = {
            "{'frequency':'fast'}|frequency: expected a number, not 'fast' (line 1, column 14)",
            "{'frequency':{}}|frequency: expected a number",
            "{'frequency':null}|frequency: expected a number",
            "{'amplitude':3}|amplitude: expected a list",
            "{'amplitude':['x']}|amplitude: expected a number, not 'x'",
            "{'frequency':'1'}|frequency: expected a number, not '1'",
            "{'frequency':true}|frequency: expected a number",
            "{'amplitude':['1']}|amplitude: expected a number, not '1'",
            "{'frequency':1,'amplitude':[1],'phase':[0],'speed':1}|speed: unknown key; expected some of ",
            "[]|expected an object",
            "``|found nothing; expected a JSON text",
            "{'frequency':1|ends too early; expected the rest of the JSON text",
            "{'frequency':|ends too early; expected the rest of the JSON text",
            "{'amplitude':[1,|amplitude: ends too early; expected the rest of the JSON text",
            "{'frequency':1,'amplitude':[1],'phase':[0]} {}|found another value after the first; expected one",
            "{'frequency':1 'phase':[0]}|Unexpected character ('\"' (code 34)): was expecting comma to separate Object entries",
            "{'frequency':NaN}|Non-standard token 'NaN' (line",
            "{'frequency':1e400}|frequency: found the number 1e400; expected one within 1.8e308",
            "{'amplitude':[-1e999]}|amplitude: found the number -1e999; expected one within 1.8e308",
            "{'frequency':1,'frequency':2}|Duplicate field 'frequency'"})
    void whatIsWrongIsSaidWithoutOurInnards(String json, String start) {
        assertThat(reason(json, Gait.class)).startsWith(start).contains("(line 1, column ")
                .doesNotContain("java.", "natator", "JsonToken", "Feature", "Source", "deserialize", "construct");
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', value = {
            "{'backend':'gpu'}|backend: expected one of cpu, cuda, auto, not 'gpu'",
            "{'population':1.5}|population: expected a whole number",
            "{'population':'40'}|population: expected a whole number, not '40'",
            "{'vacuumCheck':'true'}|vacuumCheck: expected true or false, not 'true'",
            "{'vacuumCheck':1}|vacuumCheck: expected true or false, not '1'",
            "{'backend':0}|backend: expected one of cpu, cuda, auto, not '0'",
            "{'scene':5}|scene: expected a text, not '5'",
            "{'vacuumCheck':'perhaps'}|vacuumCheck: expected true or false, not 'perhaps'",
            "{'scene':'x','encoding':'dense','actuators':2,'population':1,'generations':1,'seed':1,'operators':'stock',"
                    + "'gaussianDeviation':0.05}|population is 1; expected a whole number from 2 to 100000"})
    void settingsToo(String json, String start) {
        assertThat(reason(json, EvolutionSettings.class)).startsWith(start);
    }

    /** Of what was parsed before, Jackson knows no place. */
    @Test
    void aPlaceThatIsNotKnownIsLeftOut() {
        assertThat(Json.reason(catchThrowableOfType(JsonProcessingException.class,
                () -> Json.tree(Json.parse("{\"frequency\":1}", JsonNode.class), Gait.class))))
                .isEqualTo("amplitude is missing");
    }

    /** Notepad and PowerShell write one; the simulator skips it, too. */
    @Test
    void aFileMayBeginWithAByteOrderMark(@TempDir Path folder) throws IOException {
        Path file = Files.writeString(folder.resolve("gait.json"),
                "\ufeff{\"frequency\":1,\"amplitude\":[1],\"phase\":[0]}\r\n");
        assertThat(Json.read(file, Gait.class, "--gait").frequency()).isEqualTo(1);
    }

    @Test
    void noNumberIsInfinite() {
        assertThat(reason("{'duration':1e400}", JsonNode.class))
                .contains("found the number 1e400; expected one within 1.8e308 (line 1");
    }

    @ParameterizedTest
    @CsvSource({"[1]", "3"})
    void anObjectIsExpected(String json) {
        assertThat(reason(json, ObjectNode.class)).startsWith("expected an object");
    }
}
