package io.natator.run;

import io.natator.checkpoint.EvaluationStatistics;
import io.natator.checkpoint.RunFolder;
import io.natator.checkpoint.StoredRun;
import io.natator.config.InvalidInputException;
import io.natator.evolution.EvaluationRecord;
import io.natator.evolution.EvolutionListener;
import io.natator.evolution.EvolutionState;
import io.natator.evolution.GenerationSummary;
import io.natator.simulator.SimulationResult;
import java.util.function.LongSupplier;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/** Counts what a run does not have to simulate, and writes it into its folder after each generation. */
final class EvaluationCounter implements EvolutionListener {

    private static final Logger LOG = LoggerFactory.getLogger(EvaluationCounter.class);

    private final RunFolder folder;
    private final double duration;
    private final LongSupplier found;
    private final long foundBefore;
    private long evaluations;
    private long refused;
    private long stoppedEarly;
    /** Seconds; exactly 0 if nothing ended early. */
    private double saved;

    /**
     * Counts on from the folder's checkpoint.
     *
     * @param duration of a simulation that nothing ends early, in seconds
     * @param found    results from the cache since this run began or was continued
     */
    EvaluationCounter(RunFolder folder, double duration, LongSupplier found) {
        this.folder = folder;
        this.duration = duration;
        this.found = found;
        EvaluationStatistics before = statistics(folder);
        this.foundBefore = before == null ? 0 : before.fromCache();
        if (folder.checkpoint() != null) {
            long first = folder.recorded().first();
            if (first > 0 && before != null) {
                takeOver(before);
                first = before.evaluations();
            }
            folder.recorded().between(first, folder.checkpoint().evaluations()).forEach(this::evaluated);
        }
    }

    /** What cannot be counted anew, since the evaluations were dropped. */
    private void takeOver(EvaluationStatistics before) {
        evaluations = before.evaluations();
        refused = before.evaluations() - before.simulations();
        stoppedEarly = before.stoppedEarly();
        saved = before.wholeSeconds() - before.simulatedSeconds();
    }

    /** Of the run so far; a damaged file of them costs only how many results came from the cache. */
    private static EvaluationStatistics statistics(RunFolder folder) {
        try {
            return StoredRun.statistics(folder.directory());
        } catch (InvalidInputException e) {
            LOG.warn("{}; counted anew, without the results that came from the cache", e.getMessage());
            return null;
        }
    }

    @Override
    public void evaluated(EvaluationRecord evaluation) {
        SimulationResult result = evaluation.result();
        evaluations++;
        if (result.status() == SimulationResult.Status.REFUSED) {
            refused++;
        }
        if (result.isStoppedEarly(duration)) {
            stoppedEarly++;
            saved += duration - result.simulatedOf(duration);
        }
    }

    @Override
    public void generationFinished(EvolutionState state) {
        long unchanged = state.history().stream().mapToLong(GenerationSummary::unchangedOrRest).sum();
        double whole = (evaluations - refused) * duration;
        folder.write(new EvaluationStatistics(evaluations, unchanged, foundBefore + found.getAsLong(), stoppedEarly,
                whole - saved, whole, refused));
    }
}
