package io.natator.study.thesis;

import io.natator.checkpoint.StoredRun;
import io.natator.config.Backend;
import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.FileErrors;
import io.natator.config.InvalidInputException;
import io.natator.config.Judge;
import io.natator.config.Limits;
import io.natator.run.PlannedRun;
import io.natator.simulator.SceneInfo;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.EnumMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.stream.Collectors;
import java.util.stream.Stream;

/**
 * The evolutions of the study: each creature in each water with each seed, with the thesis' operators. Each
 * has a run folder {@code runs/creature-N/WATER/seed-S} of its own.
 */
public final class EvolutionPlan {

    /** Evolutions of each creature in each water where the folder does not hold more. */
    public static final int USUAL_SEEDS = 3;

    private static final String RUNS = "runs";
    private static final String SEED = "seed-";

    private final List<EvolvedRun> runs = new ArrayList<>();

    /**
     * How large the evolutions are; what is null is as in those that were begun, or as {@link Water} has it.
     *
     * @param population  chromosomes, at least 2 (thesis: 150)
     * @param generations after the random one (thesis: 100)
     * @param starts      runs of each new gait (thesis: 1)
     * @param duration    simulated seconds of a run (thesis: 4)
     */
    public record Size(Integer population, Integer generations, Integer starts, Double duration) {

        private EvolutionSettings of(EvolutionSettings settings, Water water, Water.Evolving usual) {
            return settings.withSize(population != null ? population : usual.population(),
                            generations != null ? generations : usual.generations())
                    .withStarts(starts != null ? starts : usual.starts(), Judge.MEAN)
                    .withScene(water.scheme(), duration != null ? duration : usual.duration(), usual.overrides());
        }
    }

    /**
     * What is evolved in a water.
     *
     * @param seeds       evolutions of each creature
     * @param generations of each, as the first has them
     */
    public record Extent(long seeds, int generations) {
    }

    /**
     * What is to be evolved, seed by seed, so that what is finished early is of all creatures.
     *
     * @param creatures of the thesis, 1 to 4
     * @param waters    at least one
     * @param seeds     evolutions of each with seeds 1, 2, …; at least 1, or null for {@link #USUAL_SEEDS},
     *                  or in a water the largest seed that the folder holds finished of any of the creatures, if that is more
     * @param backend   what the simulator computes on
     * @param simulator the native program, which knows the scenes
     * @param directory of the study
     * @throws InvalidInputException if one of them is out of range
     * @throws InterruptedException  if the calling thread is interrupted
     */
    public EvolutionPlan(List<Integer> creatures, List<Water> waters, Integer seeds, Size size, Backend backend,
            Path simulator, Path directory) throws InterruptedException {
        if (seeds != null) {
            Limits.checkCount("--seeds", seeds, Limits.REPETITIONS);
        }
        Map<Water, Integer> counts = new EnumMap<>(Water.class);
        for (Water water : waters) {
            counts.put(water, seeds != null ? seeds : Math.max(USUAL_SEEDS, held(creatures, water, directory)));
        }
        int most = counts.values().stream().mapToInt(Integer::intValue).max().orElse(0);
        for (int seed = 1; seed <= most; seed++) {
            for (Water water : waters) {
                for (int creature : seed <= counts.get(water) ? creatures : List.<Integer>of()) {
                    Path folder = seeds(creature, water, directory).resolve(SEED + seed);
                    EvolutionSettings settings = size.of(settings(creature, water, simulator), water, evolving(folder, water, creature));
                    runs.add(new EvolvedRun(creature, water, seed,
                            new PlannedRun(settings.withBackend(backend).withSeed(seed), folder)));
                }
            }
        }
    }

    private static Path seeds(int creature, Water water, Path directory) {
        return directory.resolve(RUNS).resolve("creature-" + creature).resolve(water.label());
    }

    /** As in the evolution in a folder, else as in the first seed beside it, else as usual. */
    private static Water.Evolving evolving(Path folder, Water water, int creature) {
        return Stream.of(folder, folder.resolveSibling(SEED + 1)).filter(StoredRun::exists)
                .map(one -> Water.Evolving.of(StoredRun.settings(one))).findFirst().orElse(water.evolving(creature));
    }

    /** The largest seed of a finished evolution, of any of the creatures; 0 without one. */
    private static int held(List<Integer> creatures, Water water, Path directory) {
        return creatures.stream().mapToInt(creature -> held(seeds(creature, water, directory))).max().orElse(0);
    }

    private static int held(Path seeds) {
        if (!Files.isDirectory(seeds)) {
            return 0;
        }
        try (Stream<Path> all = Files.list(seeds)) {
            return all.filter(folder -> folder.getFileName().toString().matches(SEED + "[1-9]\\d{0,3}")).filter(StoredRun::isFinished)
                    .mapToInt(folder -> Integer.parseInt(folder.getFileName().toString().substring(SEED.length()))).max().orElse(0);
        } catch (IOException e) {
            throw new UncheckedIOException("cannot read " + seeds + ": " + FileErrors.reason(seeds, e), e);
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

    /** Whether any evolution in a study's folder, of whatever seed, is begun and has not come to its end. */
    public static boolean isAnyUnderWay(Path directory) {
        if (!Files.isDirectory(directory.resolve(RUNS))) {
            return false;
        }
        try (Stream<Path> all = Files.find(directory.resolve(RUNS), 3, (path, attributes) -> attributes.isDirectory()
                && path.getFileName().toString().startsWith(SEED))) {
            return all.anyMatch(run -> !StoredRun.isFinished(run));
        } catch (IOException e) {
            throw new UncheckedIOException("cannot read " + directory + ": " + FileErrors.reason(directory, e), e);
        }
    }

    /** Those of the seeds that are there: up to the largest that is finished in a water, or all where none is. */
    public List<EvolvedRun> begun() {
        Map<Water, Extent> extents = extents();
        return runs.stream().filter(run -> run.seed() <= extents.get(run.water()).seeds()).toList();
    }

    /** What each water has of what is finished; what is planned where nothing is. In the order in which they were asked for. */
    public Map<Water, Extent> extents() {
        Map<Water, Extent> extents = new LinkedHashMap<>();
        List<EvolvedRun> finished = finished();
        for (EvolvedRun run : runs) {
            extents.computeIfAbsent(run.water(), water -> extent(
                    finished.stream().anyMatch(one -> one.water() == water) ? finished : runs, water));
        }
        return extents;
    }

    /** Creatures by how many generations their first seed has in a water; those of which nothing is finished have as many as the water. */
    public Map<Integer, List<Integer>> creaturesByGenerations(Water water) {
        int usual = extents().get(water).generations();
        List<EvolvedRun> finished = finished().stream().filter(run -> run.water() == water).toList();
        return runs.stream().filter(run -> run.water() == water).map(EvolvedRun::creature).distinct()
                .collect(Collectors.groupingBy(creature -> finished.stream().filter(run -> run.creature() == creature).findFirst()
                        .map(run -> run.storedSettings().generations()).orElse(usual), LinkedHashMap::new, Collectors.toList()));
    }

    private static Extent extent(List<EvolvedRun> all, Water water) {
        List<EvolvedRun> there = all.stream().filter(run -> run.water() == water).toList();
        PlannedRun first = there.get(0).plan();
        return new Extent(there.stream().mapToLong(EvolvedRun::seed).max().orElseThrow(),
                (first.isFinished() ? StoredRun.settings(first.directory()) : first.settings()).generations());
    }
}
