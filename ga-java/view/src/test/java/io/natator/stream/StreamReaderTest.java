package io.natator.stream;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.config.Json;
import java.io.ByteArrayInputStream;
import java.io.IOException;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.util.Arrays;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class StreamReaderTest {

    private static final int FLOATS = 10 * StreamBytes.PARTICLES + StreamBytes.ACTUATORS;

    private static StreamReader reader(StreamBytes stream) {
        return new StreamReader(new ByteArrayInputStream(stream.toBytes()));
    }

    private static StreamBytes begun() {
        return new StreamBytes().json("SCEN", StreamBytes.scene());
    }

    private static void assertThatAllOfItThrows(StreamBytes stream, String message) {
        StreamReader reader = reader(stream);
        assertThatThrownBy(() -> {
            while (reader.next() != null) {
                // Up to the fault.
            }
        }).isInstanceOf(StreamException.class).hasMessage(message).message().doesNotContain("\n");
    }

    @Test
    void aSceneKeepsWhatItWasSaid() throws IOException {
        StreamMessage.Scene message = (StreamMessage.Scene) reader(begun()).next();

        StreamScene scene = message.scene();
        assertThat(Json.parse(message.json(), ObjectNode.class)).isEqualTo(StreamBytes.scene());
        assertThat(scene.scene()).isEqualTo("test/pool");
        assertThat(scene.overrides()).isNull();
        assertThat(scene.gait().get("frequency").asDouble()).isEqualTo(1);
        assertThat(scene.fields()).containsExactly(StreamField.values());
        assertThat(scene.mass()).containsExactly(2.0, 2.0, 1.0, 1.0, 1.0, 1.0, 1.0, null);
        assertThat(scene.firstFluid()).isZero();
        assertThat(scene.fluidCount()).isEqualTo(4);
        assertThat(scene.frameBytes()).isEqualTo(72 + 4 * FLOATS);
    }

    @Test
    void everyNumberOfAFrameIsInItsPlace() throws IOException {
        StreamReader reader = reader(begun().frame(1, 5));
        reader.next();

        StreamMessage.Frame message = (StreamMessage.Frame) reader.next();
        StreamFrame frame = message.decode();

        assertThat(frame.frame()).isEqualTo(5);
        assertThat(frame.time()).isEqualTo(0.0625);
        assertThat(frame.distance()).isEqualTo(-0.25);
        assertThat(frame.centreVelocity()).containsExactly(0.125f, 0.25f, 0.375f);
        assertThat(List.of(frame.linearMomentum(), frame.angularMomentum(), frame.meanDensityError(),
                frame.maxDensityError())).containsExactly(0.5f, 0.625f, 0.75f, 0.875f);
        assertThat(frame.activation()).containsExactly(5000.5f);
        assertThat(frame.position()).hasSize(24).startsWith(5001.5f).endsWith(5024.5f);
        assertThat(frame.density()).hasSize(8).startsWith(5049.5f).endsWith(5056.5f);
        assertThat(message.body()).isEqualTo(ByteBuffer.wrap(StreamBytes.frameBody(1, 5, FLOATS)));
        assertThat(message.body().isReadOnly()).isTrue();
        assertThat(message.body().order()).isEqualTo(ByteOrder.LITTLE_ENDIAN);
        assertThat(reader.next()).isNull();
    }

    @Test
    void aFrameHoldsTheFieldsOfItsScene() throws IOException {
        ObjectNode scene = StreamBytes.scene();
        scene.putArray("fields").add("position").add("density");
        StreamReader reader = reader(new StreamBytes().json("SCEN", scene)
                .message("FRAM", StreamBytes.frameBody(1, 0, 4 * StreamBytes.PARTICLES + StreamBytes.ACTUATORS)));
        reader.next();

        StreamFrame frame = ((StreamMessage.Frame) reader.next()).decode();

        assertThat(frame.position()).hasSize(24);
        assertThat(frame.density()).hasSize(8).endsWith(32.5f);
    }

    @Test
    void answersAndStopsAreRead() throws IOException {
        StreamReader reader = reader(new StreamBytes().json("ANSW", "{\"id\":7,\"ok\":true}")
                .json("ANSW", "{\"id\":null,\"error\":\"gait.frequency: too high\"}")
                .json("STOP", "{\"reason\":\"unstable\",\"particle\":7}").json("STOP", "{\"reason\":\"until\"}"));

        StreamMessage.Answer good = (StreamMessage.Answer) reader.next();
        assertThat(good.ok()).isTrue();
        assertThat(good.id().asInt()).isEqualTo(7);
        StreamMessage.Answer bad = (StreamMessage.Answer) reader.next();
        assertThat(bad.ok()).isFalse();
        assertThat(bad.error()).isEqualTo("gait.frequency: too high");
        assertThat(bad.id().isNull()).isTrue();
        StreamMessage.Stop unstable = (StreamMessage.Stop) reader.next();
        assertThat(unstable.isEnd()).isFalse();
        assertThat(unstable.json()).isEqualTo("{\"reason\":\"unstable\",\"particle\":7}");
        assertThat(((StreamMessage.Stop) reader.next()).isEnd()).isTrue();
        assertThat(reader.next()).isNull();
    }

    /** Of 3 by 1 by 2 cells. */
    @Test
    void waterIsReadWhole() throws IOException {
        byte[] body = ByteBuffer.allocate(64 + 16 * 6).order(ByteOrder.LITTLE_ENDIAN).putInt(8, 3).putInt(12, 1)
                .putInt(16, 2).putFloat(64, 0.5f).array();
        StreamMessage.Water water = (StreamMessage.Water) reader(new StreamBytes().message("WATR", body)).next();

        assertThat(water.body()).isEqualTo(ByteBuffer.wrap(body));
        assertThat(water.body().isReadOnly()).isTrue();
        assertThat(water.body().order()).isEqualTo(ByteOrder.LITTLE_ENDIAN);
        byte[] pressed = ByteBuffer.allocate(64 + 20 * 6).order(ByteOrder.LITTLE_ENDIAN).put(body).putInt(20, 1)
                .array();
        assertThat(reader(new StreamBytes().message("WATR", pressed)).next()).isInstanceOf(StreamMessage.Water.class);
        assertThatAllOfItThrows(new StreamBytes().message("WATR", new byte[60]),
                "WATR of 60 bytes; expected 64 to 268435456");
        body[8] = 4;
        assertThatAllOfItThrows(new StreamBytes().message("WATR", body),
                "WATR of 160 bytes; expected 192 for its cells");
        body[11] = (byte) 0xff;
        assertThatAllOfItThrows(new StreamBytes().message("WATR", body),
                "WATR of 160 bytes; expected 136902082752 for its cells");
    }

    @Test
    void aNewSceneChangesTheSizeOfFrames() throws IOException {
        ObjectNode second = StreamBytes.scene().put("number", 2);
        second.putArray("fields").add("position");
        StreamReader reader = reader(begun().frame(1, 0).json("SCEN", second)
                .message("FRAM", StreamBytes.frameBody(2, 1, 3 * StreamBytes.PARTICLES + StreamBytes.ACTUATORS)));
        for (int i = 0; i < 3; i++) {
            reader.next();
        }
        assertThat(((StreamMessage.Frame) reader.next()).scene().number()).isEqualTo(2);
    }

    /** Wherever a stream is cut, what was whole before is read, and the cut is told. */
    @Test
    void aStreamCutAnywhereIsToldOf() throws IOException {
        byte[] whole = begun().frame(1, 0).json("STOP", "{\"reason\":\"until\"}").toBytes();
        int ends = 0;
        for (int length = 0; length < whole.length; length++) {
            StreamReader reader = new StreamReader(new ByteArrayInputStream(Arrays.copyOf(whole, length)));
            try {
                while (reader.next() != null) {
                    // Up to the cut.
                }
                ends++;
            } catch (StreamException e) {
                assertThat(e).hasMessageStartingWith("stream ended ");
            }
        }
        assertThat(ends).as("cuts between messages").isEqualTo(3);
    }

    @Test
    void aCutIsToldWithItsPlace() {
        assertThatAllOfItThrows(begun().raw((byte) 'F', (byte) 'R'),
                "stream ended 2 bytes into the 8-byte head of a message");
        assertThatAllOfItThrows(begun().raw(new byte[] {'A', 'N', 'S', 'W', 8, 0, 0, 0, '{'}),
                "stream ended after 1 of the 8 bytes of a ANSW");
    }

    @Test
    void otherLettersAreToldOf() {
        assertThatAllOfItThrows(begun().message("\u0001RAM", new byte[4]),
                "message begins with \"?RAM\"; expected SCEN, FRAM, WATR, ANSW or STOP");
    }

    @Test
    void lengthsOutsideTheProtocolAreRefusedUnread() {
        assertThatAllOfItThrows(new StreamBytes().raw(new byte[] {'S', 'C', 'E', 'N', -4, -1, -1, -1}),
                "SCEN of 4294967292 bytes; expected a multiple of 4 up to 268435456");
        assertThatAllOfItThrows(new StreamBytes().message("STOP", new byte[3]),
                "STOP of 3 bytes; expected a multiple of 4 up to 268435456");
        assertThatAllOfItThrows(begun().message("FRAM", StreamBytes.frameBody(1, 0, FLOATS + 1)),
                "FRAM of 400 bytes; expected 396 for 8 particles and 1 actuator");
    }

    @Test
    void framesWithoutTheirSceneAreToldOf() {
        assertThatAllOfItThrows(new StreamBytes().frame(1, 0), "FRAM before the first SCEN");
        assertThatAllOfItThrows(begun().frame(2, 0), "FRAM of scene 2 after SCEN 1");
    }

    @Test
    void aSceneThatGoesOnTellsOnlyWhatHasChanged() throws IOException {
        StreamReader reader = reader(
                begun().json("SCEN", "{\"number\":2,\"restarted\":false,\"timeStep\":9}").frame(2, 1));

        StreamScene first = ((StreamMessage.Scene) reader.next()).scene();
        StreamMessage.Scene second = (StreamMessage.Scene) reader.next();

        assertThat(second.scene().timeStep()).isEqualTo(9);
        assertThat(second.scene().mass()).isEqualTo(first.mass());
        assertThat(second.json()).isEqualTo("{\"number\":2,\"restarted\":false,\"timeStep\":9}");
        assertThat(((StreamMessage.Frame) reader.next()).decode().frame()).isOne();
    }

    @Test
    void aSceneThatStartsAnewOwesNothingToTheOneBefore() {
        ObjectNode other = StreamBytes.scene();
        other.remove("mass");
        StreamReader reader = reader(begun().json("SCEN", other));

        assertThatThrownBy(() -> {
            reader.next();
            reader.next();
        }).isInstanceOf(StreamException.class).hasMessageContaining("mass");
    }

    @Test
    void textThatIsNoAnswerIsToldOf() {
        assertThatAllOfItThrows(new StreamBytes().json("ANSW", "[7]"), "ANSW: expected a JSON object, found \"[7]\"");
        assertThatAllOfItThrows(new StreamBytes().json("ANSW", "{}"),
                "ANSW: expected either ok or an error, found \"{}\"");
        assertThatAllOfItThrows(new StreamBytes().json("STOP", "{}"), "STOP: expected a reason, found \"{}\"");
        assertThatThrownBy(() -> reader(new StreamBytes().json("STOP", "{\"reason\":")).next())
                .isInstanceOf(StreamException.class).hasMessageStartingWith("STOP: ").message().doesNotContain("\n");
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {
            "protocol|1|protocol is 1; expected 2",
            "timeStep|0|timeStep is 0.0; expected seconds above 0",
            "particles|-1|particles is -1; expected 0 to 10000000",
            "particles|9|mass has 8 numbers; expected 9",
            "mass|null|mass has 0 numbers; expected 8",
            "fields|[\"density\",\"position\"]|fields are [DENSITY, POSITION]; expected some of position, velocity, density, force in this order",
            "fluid|[5,4]|fluid is [5, 4]; expected [first, count] of at most 8 particles",
            "fluid|[2147483647,2147483647]|fluid is [2147483647, 2147483647]; expected [first, count] of at most 8 particles"})
    void aSceneThatContradictsItselfIsToldOf(String key, String value, String message) throws IOException {
        ObjectNode scene = StreamBytes.scene();
        scene.set(key, Json.parse("[" + value + "]", JsonNode.class).get(0));

        assertThatAllOfItThrows(new StreamBytes().json("SCEN", scene), "SCEN: " + message);
    }

    @Test
    void aSceneThatLacksAKeyIsToldOf() {
        ObjectNode scene = StreamBytes.scene();
        scene.remove("particles");

        assertThatThrownBy(() -> reader(new StreamBytes().json("SCEN", scene)).next())
                .isInstanceOf(StreamException.class).hasMessageContaining("particles").message().doesNotContain("\n");
    }
}
