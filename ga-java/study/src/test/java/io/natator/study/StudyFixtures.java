package io.natator.study;

import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.config.Json;
import io.natator.encoding.Gait;
import java.util.Arrays;
import java.util.List;
import java.util.Map;

/** Small variants with made-up measurements. */
final class StudyFixtures {

    private StudyFixtures() {
    }

    static FlexRun flexRun(String name, String medium, double speed) {
        return new FlexRun(Map.of("name", name, "medium", medium, "v_0_2", "" + speed / 2, "v_0_4", "" + speed));
    }

    /** A variant in fluid that Flex swam at the given speeds over 4 s, and half as fast over 2 s. */
    static Variant variant(String name, String overrides, double... speeds) {
        List<FlexRun> runs = Arrays.stream(speeds).mapToObj(speed -> flexRun(name, "fluid", speed)).toList();
        return new Variant(name, "about " + name, "scene", new Gait(1, List.of(0.5, 0.1), List.of(0.0, 0.25)),
                object(overrides), runs);
    }

    static ObjectNode object(String json) {
        try {
            return Json.parse(json, ObjectNode.class);
        } catch (JsonProcessingException e) {
            throw new IllegalArgumentException(e);
        }
    }
}
