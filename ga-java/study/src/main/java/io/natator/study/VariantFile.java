package io.natator.study;

import com.fasterxml.jackson.annotation.JsonProperty;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.config.InvalidInputException;
import io.natator.config.Json;
import io.natator.encoding.Gait;
import java.nio.file.Path;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.regex.Pattern;
import java.util.regex.PatternSyntaxException;

/**
 * The list of variants as data.
 *
 * @param about           what the file is
 * @param measurements    path of {@code variants.csv}, relative to the file
 * @param commonOverrides JSON Merge Patch on every scene, before the variant's own
 * @param gaits           the gaits by name
 * @param variants        what to compare
 */
record VariantFile(String about, @JsonProperty(required = true) String measurements,
        @JsonProperty(required = true) ObjectNode commonOverrides, @JsonProperty(required = true) Map<String, Gait> gaits,
        @JsonProperty(required = true) List<Entry> variants) {

    /**
     * One variant.
     *
     * @param name      unique
     * @param about     what differs from the scene as the thesis states it
     * @param flexRuns  regular expression that the whole names of the Flex runs match
     * @param scene     named scene
     * @param gait      name of a gait
     * @param overrides JSON Merge Patch on the scene
     */
    record Entry(@JsonProperty(required = true) String name, @JsonProperty(required = true) String about,
            @JsonProperty(required = true) String flexRuns, @JsonProperty(required = true) String scene,
            @JsonProperty(required = true) String gait, @JsonProperty(required = true) ObjectNode overrides) {
    }

    /**
     * Reads the variants together with the measurements that they name.
     *
     * @throws InvalidInputException naming what is wrong
     */
    static List<Variant> read(Path path) {
        VariantFile file = Json.read(path, VariantFile.class, "variants file");
        List<FlexRun> runs = FlexRun.readAll(path.resolveSibling(file.measurements));
        Set<String> names = new HashSet<>();
        return file.variants.stream().map(entry -> {
            if (!names.add(entry.name)) {
                throw new InvalidInputException("variants file " + path + ": two variants are named " + entry.name);
            }
            return file.resolve(entry, runs, path);
        }).toList();
    }

    private Variant resolve(Entry entry, List<FlexRun> runs, Path path) {
        String place = "variants file " + path + ", variant " + entry.name + ": ";
        Gait gait = gaits.get(entry.gait);
        if (gait == null) {
            throw new InvalidInputException(place + "gait is " + entry.gait + "; expected one of " + gaits.keySet());
        }
        Pattern pattern;
        try {
            pattern = Pattern.compile(entry.flexRuns);
        } catch (PatternSyntaxException e) {
            throw new InvalidInputException(place + "flexRuns is " + entry.flexRuns + "; expected a regular expression",
                    e);
        }
        List<FlexRun> matching = runs.stream().filter(run -> pattern.matcher(run.name()).matches()).toList();
        if (matching.isEmpty()) {
            throw new InvalidInputException(place + "flexRuns is " + entry.flexRuns + "; no measured run has such a name");
        }
        return new Variant(entry.name, entry.about, entry.scene, gait, composed(commonOverrides, entry.overrides),
                matching);
    }

    /** The merge patch that does what {@code first} and then {@code second} do. */
    private static ObjectNode composed(ObjectNode first, ObjectNode second) {
        ObjectNode result = first.deepCopy();
        second.properties().forEach(field -> {
            JsonNode before = result.get(field.getKey());
            boolean nested = before instanceof ObjectNode && field.getValue() instanceof ObjectNode;
            result.set(field.getKey(),
                    nested ? composed((ObjectNode) before, (ObjectNode) field.getValue()) : field.getValue());
        });
        return result;
    }
}
