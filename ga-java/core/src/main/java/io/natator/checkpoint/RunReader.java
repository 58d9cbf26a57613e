package io.natator.checkpoint;

import com.fasterxml.jackson.annotation.JsonIgnoreProperties;
import com.fasterxml.jackson.databind.JsonNode;
import io.natator.base.InvalidInputException;
import io.natator.base.Numbers;
import io.natator.config.EvolutionSettings;
import io.natator.config.FileErrors;
import io.natator.config.Json;
import io.natator.evolution.EliteMap;
import io.natator.evolution.EvaluationRecord;
import io.natator.evolution.EvolutionState;
import io.natator.evolution.Individual;
import io.natator.evolution.ParetoRanking;
import io.natator.evolution.RecordedEvaluations;
import io.natator.file.JsonLines;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Objects;
import java.util.Set;
import java.util.SortedMap;
import java.util.TreeMap;
import java.util.concurrent.ConcurrentHashMap;
import java.util.stream.Stream;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * What a run folder holds, to be looked at while another process may be adding to it.
 *
 * @param directory   the folder
 * @param settings    of the run
 * @param state       after the last finished generation, or null
 * @param best        the best gait so far, or null
 * @param recorded    its evaluations, without the first of them where it was made small
 * @param statistics  what it did not have to simulate, or null if that was not recorded
 * @param vacuum      best gaits that were run in vacuum
 */
public record RunReader(Path directory, EvolutionSettings settings, EvolutionState state, BestGait best,
        RecordedEvaluations recorded, EvaluationStatistics statistics, List<VacuumRecord> vacuum) {

    private static final Logger LOG = LoggerFactory.getLogger(RunReader.class);
    /** Warnings already given: a page reads damaged files again and again. */
    private static final Set<String> WARNINGS = ConcurrentHashMap.newKeySet();

    /** Copies the list. */
    public RunReader {
        vacuum = List.copyOf(vacuum);
    }

    /**
     * Reads a folder.
     *
     * @throws InvalidInputException if it is not that of a run, or a file in it is damaged
     */
    public static RunReader in(Path directory) {
        EvolutionSettings settings = settings(directory);
        EvolutionState state = state(directory);
        return new RunReader(directory, settings, state, best(directory, settings, state), recorded(directory),
                readable(directory, RunWriter.SAVINGS, EvaluationStatistics.class), vacuumRecords(directory));
    }

    private static void warn(String warning) {
        if (WARNINGS.add(warning)) {
            LOG.warn(warning);
        }
    }

    /** All evaluations, in the order of their ids; none of a run that was made small, also if it has gone on since. */
    public List<EvaluationRecord> evaluations() {
        return recorded.first() == 0 ? recorded.rows() : List.of();
    }

    /**
     * What of the run is lost though nobody trimmed it, stands where it should not or was edited, in one line; null if nothing is.
     * It was trimmed where there is no population either; {@link CompactRun}.
     */
    public String damage() {
        boolean compact = state != null && state.population().isEmpty() && recorded.rows().isEmpty();
        return Stream.of(RunDamage.editedSettings(directory, settings),
                compact ? null : RunDamage.lostEvaluations(directory, state, recorded.end()),
                RunDamage.misplacedEvaluation(directory, recorded)).filter(Objects::nonNull).findFirst().orElse(null);
    }

    /**
     * Refuses a run whose settings were edited or whose scene was changed since it computed: what its winner does by them is nothing
     * that it was chosen for.
     *
     * @param simulator the native program
     * @throws InvalidInputException that says what was changed
     */
    public void checkUnchanged(Path simulator) throws InterruptedException {
        String edited = RunDamage.editedSettings(directory, settings);
        if (edited != null) {
            throw new InvalidInputException(edited);
        }
        SceneDigest.check(directory, settings, simulator);
    }

    /**
     * The best gait so far, of a command that needs one.
     *
     * @throws InvalidInputException if there is none
     */
    public BestGait requiredBest() {
        if (best == null) {
            throw new InvalidInputException(whyNoBest());
        }
        return best;
    }

    /** Why there is no best gait, and what helps, in one line; null if there is one. */
    public String whyNoBest() {
        if (best != null) {
            return null;
        }
        return state == null || !state.isLastOf(settings)
                ? directory + " has no best gait yet; finish it by natator resume"
                : directory + " has no best gait: of its " + Numbers.count(state.evaluations(), "evaluation")
                        + " none was measured, "
                        + "all were unstable, refused or failed; evolve anew, where they were unstable with more solver.substeps in --overrides";
    }

    /**
     * The settings of the run in a folder.
     *
     * @throws InvalidInputException if it is not that of a run, if the settings are damaged, or any file of it is no regular one
     */
    public static EvolutionSettings settings(Path directory) {
        RunWriter.checkRegular(directory);
        if (Files.isDirectory(directory) && !Files.isExecutable(directory)) {
            throw new InvalidInputException(directory + " cannot be read: permission denied");
        }
        if (!exists(directory)) {
            throw new InvalidInputException(directory + " is not a run folder: it has no " + RunWriter.CONFIG);
        }
        return Json.read(directory.resolve(RunWriter.CONFIG), EvolutionSettings.class, "settings");
    }

    /** Scene and settings that the run was begun with; null if it has not begun, or {@code environment.json} is damaged. */
    static Origin origin(Path directory) {
        return readable(directory, RunWriter.ENVIRONMENT, Origin.class);
    }

    /** What {@code environment.json} tells of the experiment; null where it does not. */
    @JsonIgnoreProperties(ignoreUnknown = true)
    record Origin(String sceneSha256, EvolutionSettings settings) {
    }

    private static <T> T optional(Path directory, String name, Class<T> type) {
        Path file = directory.resolve(name);
        FileErrors.checkRegular(file);
        return Files.exists(file) ? Json.read(file, type, name.replace(".json", "")) : null;
    }

    /** What a file holds that a run can be shown without; null if it is not there, or is damaged, of which it is warned. */
    static <T> T readable(Path directory, String name, Class<T> type) {
        try {
            return optional(directory, name, type);
        } catch (InvalidInputException e) {
            warn(e.getMessage() + "; shown without it");
            return null;
        }
    }

    /** Whether there is a run in this folder. */
    public static boolean exists(Path directory) {
        return Files.isRegularFile(directory.resolve(RunWriter.CONFIG));
    }

    /**
     * Whether the run in this folder, if there is one, has come to its end and its results are written.
     *
     * @throws InvalidInputException if a file of it is damaged
     */
    public static boolean isFinished(Path directory) {
        if (!exists(directory)) {
            return false;
        }
        EvolutionState state = optional(directory, RunWriter.CHECKPOINT, EvolutionState.class);
        if (state == null || !state.isLastOf(settings(directory))) {
            return false;
        }
        BestGait best = best(directory);
        return state.best() == null || best != null && best.vacuum() != null;
    }

    /** The evaluations of the run in a folder; of one that was made small, those since. */
    public static RecordedEvaluations recorded(Path directory) {
        List<EvaluationRecord> rows = JsonLines.read(directory.resolve(RunWriter.EVALUATIONS), EvaluationRecord.class);
        return new RecordedEvaluations(CompactRun.dropped(directory, rows), rows);
    }

    /** The state after the last finished generation of the run in a folder, or null. */
    public static EvolutionState state(Path directory) {
        return optional(directory, RunWriter.CHECKPOINT, EvolutionState.class);
    }

    /** The best gait so far of the run in a folder, or null. */
    public static BestGait best(Path directory) {
        return best(directory, settings(directory), state(directory));
    }

    /** The best gait as written; else as the checkpoint gives it, without its run in vacuum. */
    private static BestGait best(Path directory, EvolutionSettings settings, EvolutionState state) {
        try {
            BestGait written = optional(directory, RunWriter.BEST, BestGait.class);
            if (written != null) {
                return written;
            }
        } catch (InvalidInputException e) {
            warn(e.getMessage() + "; taken from " + RunWriter.CHECKPOINT + " instead");
        }
        if (state == null || state.best() == null) {
            return null;
        }
        String damage = RunDamage.genes(directory, settings.problem().genome(), state);
        if (damage != null) {
            throw new InvalidInputException(damage);
        }
        return BestGait.of(settings.problem().scene(), state.best(),
                settings.problem().genome().decode(state.best().genes()));
    }

    /** What the run in a folder did not have to simulate; null if that was not recorded. */
    public static EvaluationStatistics statistics(Path directory) {
        return optional(directory, RunWriter.SAVINGS, EvaluationStatistics.class);
    }

    /** The best gaits of the run in a folder that were run in vacuum; none if that was not asked for. */
    public static List<VacuumRecord> vacuumRecords(Path directory) {
        return JsonLines.read(directory.resolve(RunWriter.VACUUM), VacuumRecord.class);
    }

    /** A JSON file of its folder as it stands; null if it is not there. */
    public JsonNode document(String name) {
        return optional(directory, name, JsonNode.class);
    }

    /** The best gait of all generations up to this one, the earliest of equals; null if none is recorded. */
    public GaitScore bestUntil(int generation) {
        GaitRanking gaits = new GaitRanking(settings);
        evaluations().stream().filter(one -> one.generation() <= generation).forEach(gaits::add);
        return gaits.best();
    }

    /**
     * The front of a run with several objectives: the individuals that no other is better than in all of them, the best by the first
     * objective first; else none.
     */
    public List<Individual> front() {
        boolean several = settings.search().optimizer().takesSeveralObjectives() && state != null;
        return several ? ParetoRanking.front(state.population(), settings.problem().genome().genes()) : List.of();
    }

    /**
     * The best gait of each kind that MAP-Elites found; null of another optimizer, and of a run whose gaits have no effort to
     * tell their kinds by.
     */
    public EliteMap elites() {
        boolean isMapped = settings.search().optimizer().mapsKinds() && state != null
                && state.population().stream().anyMatch(one -> one.effort() != null);
        return isMapped ? new EliteMap(state.population()) : null;
    }

    /** The best gait up to each generation that any is recorded of, the earliest generation first. */
    public SortedMap<Integer, GaitScore> bestsByGeneration() {
        List<EvaluationRecord> all = evaluations();
        GaitRanking gaits = new GaitRanking(settings);
        SortedMap<Integer, GaitScore> bests = new TreeMap<>();
        for (int i = 0; i < all.size(); i++) {
            int generation = all.get(i).generation();
            gaits.add(all.get(i));
            boolean isLast = i + 1 == all.size() || all.get(i + 1).generation() != generation;
            if (isLast && gaits.best() != null) {
                bests.put(generation, gaits.best());
            }
        }
        return bests;
    }

    /** All gaits, the best first. */
    public List<GaitScore> gaits() {
        return GaitRanking.ranked(settings, evaluations());
    }

    /** What the best is worth after each evaluation; NaN before there is one. */
    public double[] bestWorth() {
        double[] best = new double[evaluations().size()];
        Arrays.fill(best, Double.NaN);
        leaders().forEach(one -> Arrays.fill(best, one.evaluation(), best.length, one.worth()));
        return best;
    }

    /** The leading gait after each evaluation at which it changed. */
    public List<Leader> leaders() {
        List<EvaluationRecord> all = evaluations();
        GaitRanking gaits = new GaitRanking(settings);
        List<Leader> leaders = new ArrayList<>();
        GaitScore before = null;
        double simulated = 0;
        for (int i = 0; i < all.size(); i++) {
            gaits.add(all.get(i));
            if (statistics != null) {
                simulated += all.get(i).result().simulatedOf(statistics.duration());
            }
            GaitScore best = gaits.best();
            if (best != null && !best.equals(before)) {
                leaders.add(new Leader(i, statistics == null ? null : simulated, best.genes(), best.score()));
                before = best;
            }
        }
        return leaders;
    }
}
