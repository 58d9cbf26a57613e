package io.natator.body;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.config.Json;
import io.natator.encoding.GeneRange;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.random.RandomGenerator;

/** Bundled bodies, and genes of others. */
public final class Bodies {

    private Bodies() {
    }

    /** By its name: eel, tadpole or tuna. */
    public static ProfileBody bundled(String name) {
        return ProfileBody.of(creature(name));
    }

    static JsonNode creature(String name) {
        return Json.read(Path.of("../../sim-native/creatures", name + ".json"), JsonNode.class, "creature");
    }

    /** Genes within their ranges; at their bounds more often than by chance, since mistakes sit there. */
    public static List<Double> random(List<GeneRange> ranges, RandomGenerator random) {
        List<Double> genes = new ArrayList<>();
        for (GeneRange range : ranges) {
            int choice = random.nextInt(4);
            double inside = Math.min(range.lower() + random.nextDouble() * range.width(), range.upper());
            genes.add(choice == 0 ? range.lower() : choice == 1 ? range.upper() : inside);
        }
        return genes;
    }
}
