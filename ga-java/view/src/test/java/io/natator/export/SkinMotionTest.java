package io.natator.export;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.config.Json;
import io.natator.stream.StreamBytes;
import io.natator.stream.StreamException;
import io.natator.stream.StreamMessage;
import io.natator.stream.StreamReader;
import io.natator.stream.StreamScene;
import java.io.ByteArrayInputStream;
import java.io.IOException;
import org.junit.jupiter.api.Test;

class SkinMotionTest {

    /** Two clusters of four particles each, corners of tetrahedra, and three vertices: of one, between both, of the other. */
    private static final String SKIN = """
            {"file":"fish.obj","vertices":[[2,0,0],[0,0.5,0],[-2,0,1]],"triangles":[[0,1,2]],"cluster":[0,0,1],
             "share":[1,0.25,1],"rest":[[1,0,0],[2,0,0],[1,1,0],[1,0,1],[-1,0,0],[-2,0,0],[-1,1,0],[-1,0,1]]}""";

    private static StreamScene scene(String skin) throws IOException {
        ObjectNode scene = StreamBytes.scene();
        scene.set("body", Json.parse("[0,1,2,3,4,5,6,7]", JsonNode.class));
        scene.set("clusters", Json.parse("[[0,1,2,3],[4,5,6,7]]", JsonNode.class));
        scene.set("skin", Json.parse(skin, JsonNode.class));
        return ((StreamMessage.Scene) new StreamReader(new ByteArrayInputStream(
                new StreamBytes().json("SCEN", scene).toBytes())).next()).scene();
    }

    @Test
    void vertexesFollowTheRigidMotionOfTheirClusters() throws IOException {
        StreamScene scene = scene(SKIN);
        float[] position = new float[24];
        for (int i = 0; i < 8; i++) {
            double[] rest = scene.skin().rest().get(i);
            boolean front = i < 4;  // moved up by 3; the rear turned by a right angle about z, x to y, and moved by 5 along x
            position[3 * i] = (float) (front ? rest[0] : -rest[1] + 5);
            position[3 * i + 1] = (float) (front ? rest[1] + 3 : rest[0]);
            position[3 * i + 2] = (float) rest[2];
        }

        float[] places = new SkinMotion(scene).places(position);

        assertThat(places).usingComparatorWithPrecision(1e-5f).containsExactly(2f, 3f, 0f,
                0.75f * 4.5f, 0.25f * 3.5f, 0f, 5f, -2f, 1f);
    }

    @Test
    void aSkinThatDoesNotFitItsBodyIsRefused() {
        for (String[] change : new String[][] {{"[[0,1,2]]", "[[0,1,3]]"}, {"\"cluster\":[0,0,1]", "\"cluster\":[0,0,2]"},
            {"\"share\":[1,0.25,1]", "\"share\":[1,0.25]"}, {"\"share\":[1,0.25,1]", "\"share\":[1,0.25,0.5]"},
            {"[-1,0,1]]}", "[-1,0]]}"}, {",[-1,0,1]]}", "]}"}}) {
            String skin = SKIN.replace(change[0], change[1]);
            assertThat(skin).isNotEqualTo(SKIN);
            assertThatThrownBy(() -> scene(skin)).isInstanceOf(StreamException.class).hasMessageContaining("skin");
        }
    }
}
