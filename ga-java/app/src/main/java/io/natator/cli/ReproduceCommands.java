package io.natator.cli;

import io.natator.file.ShellWord;
import io.natator.study.thesis.EvolutionPlan;
import io.natator.study.thesis.Water;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.function.Function;
import java.util.stream.Collectors;
import java.util.stream.Stream;
import picocli.CommandLine.Model.CommandSpec;

/** The commands that the page of {@code natator reproduce} shows. */
final class ReproduceCommands {

    private static final List<String> WITHOUT_OUTCOME = List.of("--stop-after", "--simulator-path",
            "--simulator-command", "--master", "--workers", "--timeout", "--phase", "--runs-at-once", "--compact", "--device",
            "--sample", "--sample-seed");
    /** Options that a page has as they came to be, not as they were given. */
    private static final List<String> FOUND = List.of("--water", "--seeds", "--generations", "--output-dir");

    private final CommandSpec spec;
    private final Path directory;

    /**
     * Those of a study.
     *
     * @param spec      the command that was given
     * @param directory of the study
     */
    ReproduceCommands(CommandSpec spec, Path directory) {
        this.spec = spec;
        this.directory = directory;
    }

    /**
     * What makes all that the page is of: where waters have not as many evolutions, or creatures not as many generations,
     * one line for each such extent and one for the page.
     */
    String of(EvolutionPlan plan) {
        String rest = rest(FOUND);
        Map<Water, EvolutionPlan.Extent> extents = plan.extents();
        Map<Water, Map<Integer, List<Integer>>> creaturesOf = extents.keySet().stream()
                .collect(Collectors.toMap(Function.identity(), plan::creaturesByGenerations));
        boolean same = creaturesOf.values().stream().allMatch(byGenerations -> byGenerations.size() == 1);
        if (same && Set.copyOf(extents.values()).size() == 1) {
            Water first = extents.keySet().iterator().next();
            return command(extents.size() == Water.values().length ? "" : water(first), extents.get(first), rest);
        }
        return extents.entrySet().stream().flatMap(one -> commands(creaturesOf.get(one.getKey()), one.getKey(), one.getValue()))
                .collect(Collectors.joining("\n")) + "\n" + CommandText.of(spec, " --phase report" + rest);
    }

    private Stream<String> commands(Map<Integer, List<Integer>> creaturesByGenerations, Water water, EvolutionPlan.Extent extent) {
        if (creaturesByGenerations.size() == 1) {
            return Stream.of(command(water(water), extent, rest(FOUND)));
        }
        String rest = rest(Stream.concat(FOUND.stream(), Stream.of("--creature")).toList());
        return creaturesByGenerations.entrySet().stream().map(one -> command(water(water) + " --creature "
                + one.getValue().stream().map(String::valueOf).collect(Collectors.joining(",")),
                new EvolutionPlan.Extent(extent.seeds(), one.getKey()), rest));
    }

    /** The options that were given, without those that the page has otherwise. */
    private String rest(List<String> found) {
        return CommandText.options(spec, Stream.concat(WITHOUT_OUTCOME.stream(), found.stream()).toList())
                + " --output-dir " + ShellWord.of(directory);
    }

    private static String water(Water water) {
        return " --water " + water.label();
    }

    private String command(String water, EvolutionPlan.Extent extent, String rest) {
        return CommandText.of(spec, water + " --seeds " + extent.seeds() + " --generations " + extent.generations() + rest);
    }
}
