package io.natator.checkpoint;

import io.natator.config.Backend;
import io.natator.config.EvolutionSettings;
import io.natator.config.InvalidInputException;
import io.natator.config.Json;
import io.natator.config.Migration;
import io.natator.evolution.EvolutionState;
import io.natator.evolution.Individual;
import io.natator.evolution.Surest;
import io.natator.file.AtomicFile;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.stream.IntStream;

/**
 * Several evolutions of the same creature that exchange gaits: a folder with {@code islands.json}, and in it the run folder of
 * each, {@code island-1} and so on.
 *
 * @param directory the folder
 * @param plan      what they have in common
 */
public record Archipelago(Path directory, Plan plan) {

    private static final String PLAN = "islands.json";

    /**
     * Content of {@code islands.json}: all that determines the outcome.
     *
     * @param settings of the first island, as a run by itself; the others have the seeds after its own
     * @param islands  how many, from 2
     * @param every    generations from one exchange to the next, from 1
     * @param migrants gaits that go from each island to the next one each time; 0 for islands that know nothing of each other
     */
    public record Plan(EvolutionSettings settings, int islands, int every, int migrants) {

        /**
         * Checks the ranges.
         *
         * @throws InvalidInputException naming what is out of range
         */
        public Plan {
            Migration.checkIslands(islands);
            long greatest = Long.MAX_VALUE - (islands - 1);
            if (settings.seed() > greatest) {
                throw new InvalidInputException("seed is " + settings.seed() + "; expected at most " + greatest + ", as " + islands
                        + " islands have it and the seeds after it");
            }
            if (migrants < 0) {
                throw new InvalidInputException("migrants are " + migrants + "; expected a whole number from 0");
            }
            if (migrants > 0) {
                if (every >= settings.generations()) {
                    throw new InvalidInputException("generations between exchanges are " + every + "; expected fewer than the run's "
                            + settings.generations() + ", or no migrants");
                }
                settings.withMigration(new Migration(islands, 1, every, migrants));  // refused if it cannot be
            }
        }

        /** Those of an island, numbered from 1. Without migrants it is a run like any other of its seed. */
        public EvolutionSettings settings(int island) {
            return settings.withSeed(settings.seed() + island - 1)
                    .withMigration(migrants == 0 ? null : new Migration(islands, island, every, migrants));
        }
    }

    /**
     * Makes the folder of a new archipelago; the islands' are made when they are begun.
     *
     * @throws InvalidInputException if there is something in it already, or it cannot be made
     */
    public static Archipelago create(Path directory, Plan plan) {
        RunFolder.make(directory, PLAN, plan);
        return new Archipelago(directory, plan);
    }

    /** Removes the folders of islands that have recorded no evaluation, and that of all if there is no other. */
    public void deleteUnlessBegun() {
        folders().forEach(RunFolder::deleteUnlessBegun);
        if (folders().isEmpty()) {
            RunFolder.delete(directory, List.of(PLAN, "."));
        }
    }

    /** Whether there is one in this folder. */
    public static boolean exists(Path directory) {
        return Files.isRegularFile(directory.resolve(PLAN));
    }

    /**
     * The one in a folder.
     *
     * @throws InvalidInputException if there is none
     */
    public static Archipelago in(Path directory) {
        return new Archipelago(directory, Json.read(directory.resolve(PLAN), Plan.class, "islands"));
    }

    /** The run folder of an island, numbered from 1. */
    public Path folder(int island) {
        return directory.resolve("island-" + island);
    }

    /** All run folders that there are. */
    public List<Path> folders() {
        return IntStream.rangeClosed(1, plan.islands()).mapToObj(this::folder).filter(StoredRun::exists).toList();
    }

    /** The same archipelago on another backend, once that is written. */
    public Archipelago withBackend(Backend backend) {
        return with(plan.settings.withBackend(backend));
    }

    /** The same archipelago of so many generations, which are no fewer than before, once that is written. */
    public Archipelago withGenerations(int generations) {
        return with(plan.settings.withGenerations(generations));
    }

    private Archipelago with(EvolutionSettings settings) {
        return new Archipelago(directory, new Plan(settings, plan.islands, plan.every, plan.migrants));
    }

    /** Writes what the islands have in common. */
    public void write() {
        AtomicFile.write(directory.resolve(PLAN), Json.document(plan));
    }

    /**
     * Number of the island with the best gait as yet, judged as each island judges its own; the first of equals. The first
     * that has begun if none has a gait, -1 if none has begun.
     */
    public int winner() {
        int first = -1;
        List<Integer> numbers = new ArrayList<>();
        List<Individual> bests = new ArrayList<>();
        for (int i = 1; i <= plan.islands; i++) {
            if (StoredRun.exists(folder(i))) {
                first = first < 0 ? i : first;
                EvolutionState state = StoredRun.state(folder(i));
                if (state != null && state.best() != null) {
                    numbers.add(i);
                    bests.add(state.best());
                }
            }
        }
        return bests.isEmpty() ? first : numbers.get(best(bests));
    }

    private int best(List<Individual> bests) {
        if (plan.settings.starts() > 1) {
            return Surest.of(bests.stream().map(Individual::estimate).toList());
        }
        int best = 0;
        for (int i = 1; i < bests.size(); i++) {
            best = bests.get(i).score() > bests.get(best).score() ? i : best;
        }
        return best;
    }

    /**
     * The run folder that a folder stands for: of an archipelago that of its winner, else itself.
     *
     * @throws InvalidInputException if no island has begun
     */
    public static Path run(Path directory) {
        if (!exists(directory)) {
            return directory;
        }
        Archipelago archipelago = in(directory);
        int winner = archipelago.winner();
        if (winner < 0) {
            throw new InvalidInputException("no island of " + directory + " has begun; continue by natator resume");
        }
        return archipelago.folder(winner);
    }

    /**
     * What is stored of the run that a folder stands for, of an archipelago of its winner.
     *
     * @throws InvalidInputException if no island has begun, it is no run folder, or a file in it is damaged
     */
    public static StoredRun stored(Path directory) {
        return StoredRun.in(run(directory));
    }

    /**
     * A line for each island of which something is lost, as {@link StoredRun#damage} says.
     *
     * @throws InvalidInputException if a file of one is damaged so that it cannot be read
     */
    public List<String> damages() {
        List<String> damages = new ArrayList<>();
        for (int i = 1; i <= plan.islands(); i++) {
            Path folder = folder(i);
            if (StoredRun.exists(folder)) {
                Optional.ofNullable(StoredRun.in(folder).damage()).ifPresent(damages::add);
            } else if (Files.exists(folder.resolve(RunFolder.CHECKPOINT))) {
                damages.add(folder + " is damaged: it has no " + RunFolder.CONFIG);
            }
        }
        return damages;
    }

    /** The run folders that folders stand for: of an archipelago those of all its islands, the winner's first. */
    public static List<Path> runs(List<Path> directories) {
        List<Path> runs = new ArrayList<>();
        for (Path directory : directories) {
            Path first = run(directory);
            runs.add(first);
            if (exists(directory)) {
                in(directory).folders().stream().filter(one -> !one.equals(first)).forEach(runs::add);
            }
        }
        return runs;
    }
}
