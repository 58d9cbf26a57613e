package io.natator.study.thesis;

import io.natator.config.Backend;
import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.InvalidInputException;
import io.natator.config.Limits;
import io.natator.config.Scheme;
import io.natator.run.PlannedRun;
import io.natator.simulator.SceneInfo;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;

/**
 * The evolutions of the study: each creature in each scheme with each seed, with the thesis' operators and scene. Each
 * has a run folder {@code runs/creature-N/SCHEME/seed-S} of its own.
 */
public final class EvolutionPlan {

    private final List<EvolvedRun> runs = new ArrayList<>();

    /**
     * What is to be evolved.
     *
     * @param creatures   of the thesis, 1 to 4
     * @param schemes     at least one
     * @param seeds       evolutions of each with seeds 1, 2, …; at least 1
     * @param population  chromosomes, at least 2 (thesis: 150)
     * @param generations after the random one (thesis: 100)
     * @param duration    simulated seconds of an evaluation, or null for the scene's own (thesis: 4)
     * @param backend     what the simulator computes on
     * @param simulator   the native program, which knows the scenes
     * @param directory   of the study
     * @throws InvalidInputException if one of them is out of range
     * @throws InterruptedException  if the calling thread is interrupted
     */
    public EvolutionPlan(List<Integer> creatures, List<Scheme> schemes, int seeds, int population, int generations,
            Double duration, Backend backend, Path simulator, Path directory) throws InterruptedException {
        Limits.checkCount("--seeds", seeds, Limits.REPETITIONS);
        for (int creature : creatures) {
            String scene = ThesisData.scene(creature);
            int actuators = SceneInfo.toEvolve(scene, EncodingKind.usualFor(scene), null, simulator).actuators();
            EvolutionSettings settings = EvolutionSettings.of(scene, EncodingKind.usualFor(scene), actuators)
                    .withSize(population, generations).withBackend(backend);
            for (Scheme scheme : schemes) {
                for (int seed = 1; seed <= seeds; seed++) {
                    Path folder = directory.resolve("runs").resolve("creature-" + creature)
                            .resolve(scheme.name().toLowerCase(Locale.ROOT)).resolve("seed-" + seed);
                    runs.add(new EvolvedRun(creature, scheme, seed,
                            new PlannedRun(settings.withSeed(seed).withScene(scheme, duration, null), folder)));
                }
            }
        }
    }

    /** All runs, in the order in which they are begun. */
    public List<EvolvedRun> runs() {
        return List.copyOf(runs);
    }

    /** Those that have come to their end. */
    public List<EvolvedRun> finished() {
        return runs.stream().filter(run -> run.plan().isFinished()).toList();
    }
}
