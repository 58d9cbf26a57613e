package io.natator.checkpoint;

import io.natator.base.InvalidInputException;
import io.natator.body.Genome;
import io.natator.config.Backend;
import io.natator.config.EvolutionSettings;
import io.natator.config.FileErrors;
import io.natator.config.Json;
import io.natator.config.OptimizerKind;
import io.natator.evolution.EvaluationRecord;
import io.natator.evolution.EvolutionFailedException;
import io.natator.evolution.EvolutionListener;
import io.natator.evolution.EvolutionState;
import io.natator.evolution.GenerationSummary;
import io.natator.evolution.RecordedEvaluations;
import io.natator.file.AtomicFile;
import io.natator.file.JsonLines;
import io.natator.file.OutputFolder;
import io.natator.protocol.SimulationResult;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.stream.Collectors;
import java.util.stream.Stream;

/**
 * The folder of one run. Everything that an evolution needs to continue is in it at every moment: {@code config.json}
 * from the start, {@code checkpoint.json} after each generation, {@code evaluations.jsonl} after each simulation.
 * {@code generations.csv} and {@code best.json} follow from the checkpoint. All of these are the same for the same
 * settings and simulator; {@code environment.json} and {@code timings.csv} say where and how fast it ran.
 */
public final class RunWriter implements EvolutionListener, AutoCloseable {

    static final String CONFIG = "config.json";
    static final String CHECKPOINT = "checkpoint.json";
    static final String BEST = "best.json";
    static final String SAVINGS = "savings.json";
    static final String VACUUM = "vacuum.jsonl";
    static final String CONTROLS = "check.json";
    static final String CONVERGENCE = "converge.json";
    static final String CONVERGENCE_RUNS = "converge.jsonl";
    static final String ENVIRONMENT = "environment.json";
    static final String EVALUATIONS = "evaluations.jsonl";
    private static final String GENERATIONS = "generations.csv";
    private static final String TIMINGS = "timings.csv";
    /** All that a run writes; the settings, by which a folder is known as that of a run, are last. */
    private static final List<String> FILES = List.of(CHECKPOINT, BEST, SAVINGS, VACUUM, CONTROLS, CONVERGENCE,
            CONVERGENCE_RUNS, ENVIRONMENT, EVALUATIONS, GENERATIONS, TIMINGS, CompactRun.WHOLE,
            RunDigests.LINES, RunDigests.WHOLE, CONFIG, ".");

    private final Path directory;
    private EvolutionSettings settings;
    private final Genome genome;
    private final EvolutionState checkpoint;
    private final JsonLines<EvaluationRecord> log;
    /** How many evaluations are not in the log any more. */
    private final long dropped;
    private final RunDigests digests;
    private final GenerationTimes timings;

    private RunWriter(Path directory, EvolutionSettings settings) {
        this.directory = directory;
        this.settings = settings;
        this.genome = settings.problem().genome();
        this.log = JsonLines.locked(directory.resolve(EVALUATIONS), EvaluationRecord.class);
        try {
            CompactRun.Last last = CompactRun.last(directory, log.rows());
            this.checkpoint = last.state();
            this.dropped = last.dropped();
            this.digests = new RunDigests(directory);
        } catch (InvalidInputException e) {
            log.close();
            throw e;
        }
        this.timings = new GenerationTimes(directory.resolve(TIMINGS));
    }

    /**
     * Makes the folder of a new run.
     *
     * @throws InvalidInputException if there is something in it already, or it cannot be made
     */
    public static RunWriter create(Path directory, EvolutionSettings settings) {
        try {
            OutputFolder.make(directory);
            AtomicFile.deleteUnfinished(directory.resolve(CONFIG));  // of a kill before the file was whole
        } catch (IOException e) {
            throw OutputFolder.cannotBeMade(directory, e);
        }
        refuseOccupied(directory);
        try {
            AtomicFile.write(directory.resolve(CONFIG), Json.document(settings));
        } catch (UncheckedIOException e) {
            throw new InvalidInputException("output folder " + directory + " cannot be used: " + e.getMessage(), e);
        }
        return new RunWriter(directory, settings);
    }

    /**
     * Looks whether the folder of a new run can be made; makes nothing.
     *
     * @throws InvalidInputException as {@link #create}
     */
    public static void check(Path directory) {
        OutputFolder.check(directory);
        refuseOccupied(directory);
    }

    private static void refuseOccupied(Path directory) {
        boolean isRun = Files.exists(directory.resolve(CHECKPOINT)) || Files.exists(directory.resolve(EVALUATIONS));
        if (isRun && !Files.exists(directory.resolve(CONFIG))) {
            throw new InvalidInputException(directory + " is damaged: it has no " + CONFIG);
        }
        try {
            if (isOccupied(directory)) {
                throw new InvalidInputException("output folder " + directory + " is not empty; choose another by "
                        + "--output-dir, or continue the run in it by natator resume");
            }
        } catch (IOException e) {
            throw OutputFolder.cannotBeMade(directory, e);
        }
    }

    /** Removes what a run wrote, and its folder unless there is something else in it. Can be done again after a kill. */
    public static void delete(Path directory) {
        try {
            for (String name : FILES) {
                Path file = directory.resolve(name).normalize();
                if (!Files.isDirectory(file) || !isOccupied(file)) {
                    Files.deleteIfExists(file);
                }
            }
        } catch (IOException e) {
            throw new UncheckedIOException("cannot remove " + AtomicFile.reason(directory, e), e);
        }
    }

    /** Removes the folder of a run that has recorded no evaluation. */
    public static void deleteUnlessBegun(Path directory) {
        try {
            Path log = directory.resolve(EVALUATIONS);
            if (!Files.exists(directory.resolve(CHECKPOINT)) && (!Files.exists(log) || Files.size(log) == 0)) {
                delete(directory);
            }
        } catch (IOException e) {
            throw new UncheckedIOException("cannot read " + AtomicFile.reason(directory, e), e);
        }
    }

    /** Refuses a folder, a pipe, or the like, in place of a file that a run writes. */
    static void checkRegular(Path directory) {
        FILES.stream().filter(name -> !name.equals("."))
                .forEach(name -> FileErrors.checkRegular(directory.resolve(name)));
    }

    /** Whether there is anything at this path but an empty folder. */
    public static boolean isOccupied(Path directory) throws IOException {
        if (!Files.isDirectory(directory)) {
            return Files.exists(directory);
        }
        try (Stream<Path> files = Files.list(directory)) {
            return files.findAny().isPresent();
        }
    }

    /**
     * Opens the folder of an earlier run to continue it.
     *
     * @throws InvalidInputException if it is not one, is damaged, or is in use; or if its settings are not those that it was begun with
     */
    public static RunWriter open(Path directory) {
        RunWriter folder = new RunWriter(directory, RunReader.settings(directory));
        folder.refuse(RunDamage.editedSettings(directory, folder.settings));
        folder.refuse(folder.checkpoint != null && folder.checkpoint.population().isEmpty()
                ? directory + " has no population any more, which it would go on from: it lacks " + CompactRun.WHOLE
                : RunDamage.lostEvaluations(directory, folder.checkpoint, folder.recorded().end()));
        folder.refuse(RunDamage.misplacedEvaluation(directory, folder.recorded()));
        folder.refuse(RunDamage.genes(directory, folder.genome, folder.checkpoint));
        folder.refuse(RunDigests.damage(directory));
        try {
            folder.digests.check(folder.log.size());
        } catch (InvalidInputException e) {
            folder.refuse(e.getMessage());
        }
        folder.dropFailures();
        return folder;
    }

    /**
     * Closes the folder if something is wrong with it.
     *
     * @param wrong what, in one line; null if nothing is
     * @throws InvalidInputException that says so
     */
    public void refuse(String wrong) {
        if (wrong != null) {
            close();
            throw new InvalidInputException(wrong);
        }
    }

    /**
     * A generation that was stopped since most of it failed is not to fail again by its record once the cause is gone:
     * it is simulated anew from its first failure.
     */
    private void dropFailures() {
        List<EvaluationRecord> all = log.rows();
        int first = checkpoint == null ? 0 : (int) (checkpoint.evaluations() - dropped);
        int failed = 0;
        int firstFailed = -1;
        for (int i = first; i < all.size(); i++) {
            if (all.get(i).result().status() == SimulationResult.Status.FAILED) {
                failed++;
                firstFailed = firstFailed < 0 ? i : firstFailed;
            }
        }
        if (EvolutionFailedException.isDue(failed, all.size() - first)) {
            log.dropFrom(firstFailed);
            digests.check(firstFailed);
        }
    }

    /** The run folder. */
    public Path directory() {
        return directory;
    }

    /** The settings of the run. */
    public EvolutionSettings settings() {
        return settings;
    }

    /** From here on the run computes on another backend. */
    public void changeBackend(Backend backend) {
        settings = settings.withBackend(backend);
        AtomicFile.write(directory.resolve(CONFIG), Json.document(settings));
    }

    /**
     * From here on the run has so many generations, at least those that are done.
     *
     * @throws InvalidInputException if it was made small and lacks what it would go on from; the folder is closed then
     */
    public void changeGenerations(int generations) {
        OptimizerKind optimizer = settings.search().optimizer();
        if (dropped > 0 && optimizer.needsAllEvaluations()) {
            refuse(directory + " has not all of its evaluations any more, which " + Json.name(optimizer)
                    + " would go on from");
        }
        settings = settings.withGenerations(generations);
        AtomicFile.write(directory.resolve(CONFIG), Json.document(settings));
    }

    /** The state after the last generation that was finished when the folder was opened; null if there was none. */
    public EvolutionState checkpoint() {
        return checkpoint;
    }

    /** Simulations that were recorded when the folder was opened. */
    public RecordedEvaluations recorded() {
        return new RecordedEvaluations(dropped, log.rows());
    }

    /** Writes where and how the run is carried out. */
    public void write(Environment environment) {
        AtomicFile.write(directory.resolve(ENVIRONMENT), Json.document(environment));
    }

    /** Writes what the run did not have to simulate. */
    public void write(EvaluationStatistics statistics) {
        digests.write(SAVINGS, Json.document(statistics));
    }

    /** Writes the best gaits that were run in vacuum, in the order in which they were found. */
    public void write(List<VacuumRecord> records) {
        digests.write(VACUUM, records.stream().map(Json::line).collect(Collectors.joining("\n", "", "\n")));
    }

    @Override
    public void generationStarted(int generation, int simulations) {
        timings.start();
    }

    @Override
    public void evaluated(EvaluationRecord evaluation) {
        if (evaluation.result().id() >= dropped + log.size()) {
            digests.expectEvaluation(Json.line(evaluation));
            log.append(evaluation);
        }
    }

    /** Writes the checkpoint before what follows from it: if the run is killed right after, the rest can be made from it. */
    @Override
    public void generationFinished(EvolutionState state) {
        log.force();
        digests.write(CHECKPOINT, Json.document(state));
        writeResults(state);
        timings.append(state);
    }

    /**
     * Writes what follows from a state.
     *
     * @return the best gait, or null if there is none
     */
    public BestGait writeResults(EvolutionState state) {
        writeTable(state);
        if (state.best() == null) {
            return null;
        }
        BestGait best = BestGait.of(settings.problem().scene(), state.best(), genome.decode(state.best().genes()));
        write(best);
        return best;
    }

    /** Writes every generation's figures. */
    public void writeTable(EvolutionState state) {
        AtomicFile.write(directory.resolve(GENERATIONS), GenerationSummary.csv(state.history()));
    }

    /** Writes the best gait. */
    public void write(BestGait best) {
        digests.write(BEST, Json.document(best));
    }

    @Override
    public void close() {
        digests.close();
        log.close();
    }
}
