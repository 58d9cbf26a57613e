package io.natator.study.thesis;

import io.natator.config.Backend;
import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.InvalidInputException;
import io.natator.config.Judge;
import io.natator.config.Limits;
import io.natator.run.PlannedRun;
import io.natator.simulator.SceneInfo;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;

/**
 * The evolutions of the study: each creature in each water with each seed, with the thesis' operators. Each
 * has a run folder {@code runs/creature-N/WATER/seed-S} of its own.
 */
public final class EvolutionPlan {

    private final List<EvolvedRun> runs = new ArrayList<>();

    /**
     * How large the evolutions are; what is null is as {@link Water} has it.
     *
     * @param population  chromosomes, at least 2 (thesis: 150)
     * @param generations after the random one (thesis: 100)
     * @param starts      runs of each new gait (thesis: 1)
     * @param duration    simulated seconds of a run (thesis: 4)
     */
    public record Size(Integer population, Integer generations, Integer starts, Double duration) {

        private EvolutionSettings of(EvolutionSettings settings, Water water) {
            Water.Evolving usual = water.evolving();
            return settings.withSize(population != null ? population : usual.population(),
                            generations != null ? generations : usual.generations())
                    .withStarts(starts != null ? starts : usual.starts(), Judge.MEAN)
                    .withScene(water.scheme(), duration != null ? duration : usual.duration(), usual.overrides());
        }
    }

    /**
     * What is to be evolved, seed by seed, so that what is finished early is of all creatures.
     *
     * @param creatures of the thesis, 1 to 4
     * @param waters    at least one
     * @param seeds     evolutions of each with seeds 1, 2, …; at least 1
     * @param backend   what the simulator computes on
     * @param simulator the native program, which knows the scenes
     * @param directory of the study
     * @throws InvalidInputException if one of them is out of range
     * @throws InterruptedException  if the calling thread is interrupted
     */
    public EvolutionPlan(List<Integer> creatures, List<Water> waters, int seeds, Size size, Backend backend,
            Path simulator, Path directory) throws InterruptedException {
        Limits.checkCount("--seeds", seeds, Limits.REPETITIONS);
        for (int seed = 1; seed <= seeds; seed++) {
            for (Water water : waters) {
                for (int creature : creatures) {
                    EvolutionSettings settings = size.of(settings(creature, water, simulator), water).withBackend(backend);
                    Path folder = directory.resolve("runs").resolve("creature-" + creature).resolve(water.label())
                            .resolve("seed-" + seed);
                    runs.add(new EvolvedRun(creature, water, seed, new PlannedRun(settings.withSeed(seed), folder)));
                }
            }
        }
    }

    private static EvolutionSettings settings(int creature, Water water, Path simulator) throws InterruptedException {
        String scene = water.scene(creature);
        EncodingKind encoding = EncodingKind.usualFor(scene);
        return EvolutionSettings.of(scene, encoding, SceneInfo.toEvolve(scene, encoding, null, simulator).actuators());
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
