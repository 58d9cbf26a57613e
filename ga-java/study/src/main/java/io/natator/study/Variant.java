package io.natator.study;

import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.encoding.Gait;
import java.util.List;

/**
 * A scene, a gait and settings of which NVIDIA Flex was measured too.
 *
 * @param name      of this variant, unique
 * @param about     what differs from the scene as the thesis states it
 * @param scene     named scene that the overrides change
 * @param overrides JSON Merge Patch on the scene
 * @param flexRuns  equal runs of Flex, at least one
 */
record Variant(String name, String about, String scene, Gait gait, ObjectNode overrides, List<FlexRun> flexRuns) {

    /** Whether the body swims in fluid, not in vacuum. */
    boolean inFluid() {
        return flexRuns.get(0).inFluid();
    }
}
