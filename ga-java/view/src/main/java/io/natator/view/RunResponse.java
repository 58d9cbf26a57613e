package io.natator.view;

import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.base.MergePatch;
import io.natator.body.Genome;
import io.natator.body.Swimmer;
import io.natator.checkpoint.GaitScore;
import io.natator.checkpoint.RunReader;
import io.natator.config.EvolutionSettings;
import io.natator.config.OptimizerKind;
import io.natator.encoding.Gait;
import io.natator.evolution.EvaluationRecord;
import io.natator.evolution.GenerationSummary;
import io.natator.protocol.SimulationResult;
import io.natator.verdict.Verdict;
import io.natator.verdict.WinnerFacts;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

/**
 * What the page is told of a run folder. Fitness as the run has it; distances in scene units.
 *
 * @param id          its place on the command line, from 0
 * @param name        of the folder
 * @param scene       name or path
 * @param overrides   JSON Merge Patch that makes it the scene that the run swam in
 * @param optimizer   what searched
 * @param seed        of all random choices
 * @param generations those that are finished
 * @param bests       the best gait of each generation that the folder still knows it of
 * @param verdict     on the best gait of all, or null if there is none yet
 * @param facts       of the best gait of all, in words, by what they are about; the verdict is the first
 * @param map         the best gait of every kind, or null if the run looked for no kinds
 * @param front       gaits by several objectives, or null if it has one
 * @param bodies      of the scene and of some generations, or null if it evolves gaits alone
 */
record RunResponse(int id, String name, String scene, ObjectNode overrides, OptimizerKind optimizer, long seed,
        List<Generation> generations, List<Best> bests, Verdict verdict, Map<String, String> facts,
        MapResponse map, FrontResponse front, List<BodyOutline> bodies) {

    /**
     * A generation.
     *
     * @param generation  0 is the random one
     * @param evaluations newly simulated
     * @param best        greatest distance
     * @param mean        mean distance
     * @param bestEver    greatest distance up to here
     */
    record Generation(int generation, int evaluations, double best, double mean, double bestEver) {
    }

    /**
     * The best gait of a generation and its distance.
     *
     * @param overrides that give the run's scene this body too; null where the scene's own swims
     */
    record Best(int generation, double fitness, Gait gait, ObjectNode overrides) {

        static Best of(Generation generation, double fitness, EvolutionSettings settings, Swimmer swimmer) {
            return new Best(generation.generation, fitness, swimmer.gait(), RunResponse.overrides(settings, swimmer));
        }
    }

    /**
     * Reads a run folder as it is now; a run may be under way in it.
     *
     * @throws io.natator.base.InvalidInputException if a file in it is damaged
     */
    static RunResponse of(int id, RunReader run) {
        EvolutionSettings settings = run.settings();
        List<Generation> generations = generations(run);
        List<Best> bests = bests(run, generations);
        return new RunResponse(id, name(run.directory()), settings.problem().scene(), overrides(settings),
                settings.search().optimizer(),
                settings.search().seed(), generations, bests, run.best() == null ? null : Verdict.of(run.best()),
                run.best() == null ? Map.of() : WinnerFacts.of(run.directory(), run.best()), MapResponse.of(run),
                FrontResponse.of(run), BodyOutline.of(run, bests));
    }

    /** What the page calls a run: its folder, without where that is. */
    static String name(Path directory) {
        return directory.toAbsolutePath().normalize().getFileName().toString();
    }

    /** A run's changes to its scene and its scheme as one patch, or null if there is neither. */
    static ObjectNode overrides(EvolutionSettings settings) {
        return InitialScene.patch(settings.problem().overrides(), settings.problem().scheme());
    }

    /** The patch with a swimmer's body; null where that is the scene's own. */
    static ObjectNode overrides(EvolutionSettings settings, Swimmer swimmer) {
        return swimmer.body() == null ? null
                : InitialScene.patch(MergePatch.both(settings.problem().overrides(), swimmer.body()),
                        settings.problem().scheme());
    }

    private static List<Generation> generations(RunReader run) {
        List<Generation> generations = new ArrayList<>();
        double bestEver = Double.NEGATIVE_INFINITY;
        for (GenerationSummary one : run.state() == null ? List.<GenerationSummary>of() : run.state().history()) {
            bestEver = Math.max(bestEver, one.best());
            generations.add(new Generation(one.generation(), one.evaluations(), one.best(), one.mean(), bestEver));
        }
        return generations;
    }

    /** With several starts, the gait that was the best so far at each generation's end. */
    private static List<Best> champions(RunReader run, List<Generation> generations) {
        Map<Integer, GaitScore> bests = run.bestsByGeneration();
        return generations.stream().filter(one -> bests.containsKey(one.generation())).map(one -> {
            GaitScore best = bests.get(one.generation());
            return Best.of(one, best.score(), run.settings(), best.swimmer());
        }).toList();
    }

    /**
     * The best of a generation may be older than it; it is found by its distance, which has all its digits. A folder that
     * was made compact knows only the best of all.
     */
    private static List<Best> bests(RunReader run, List<Generation> generations) {
        if (run.settings().search().starts() > 1) {
            return champions(run, generations);
        }
        Map<Double, EvaluationRecord> swims = new HashMap<>();
        run.evaluations().stream().filter(one -> one.result().status() == SimulationResult.Status.OK)
                .forEach(one -> swims.putIfAbsent(one.result().score(), one));
        Genome genome = run.settings().problem().genome();
        List<Best> bests = new ArrayList<>();
        for (Generation generation : generations) {
            EvaluationRecord swim = swims.get(generation.best());
            if (run.best() != null && run.best().result().score() == generation.best()) {
                bests.add(Best.of(generation, generation.best(), run.settings(), run.best().swimmer()));
            } else if (swim != null) {
                bests.add(Best.of(generation, generation.best(), run.settings(),
                        new Swimmer(swim.gait(), genome.body(swim.genes()))));
            }
        }
        return bests;
    }
}
