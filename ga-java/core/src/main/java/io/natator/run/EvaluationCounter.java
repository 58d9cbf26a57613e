package io.natator.run;

import io.natator.base.InvalidInputException;
import io.natator.checkpoint.EvaluationStatistics;
import io.natator.checkpoint.RunReader;
import io.natator.checkpoint.RunWriter;
import io.natator.evolution.EvaluationRecord;
import io.natator.evolution.EvolutionListener;
import io.natator.evolution.EvolutionState;
import io.natator.evolution.GenerationSummary;
import io.natator.protocol.SimulationResult;
import java.util.function.LongSupplier;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/** Counts what a run does not have to simulate, and writes it into its folder after each generation. */
final class EvaluationCounter implements EvolutionListener {

    private static final Logger LOG = LoggerFactory.getLogger(EvaluationCounter.class);

    private static final double NANOSECONDS = 1e9;

    private final RunWriter folder;
    private final double duration;
    private final LongSupplier found;
    private final long foundBefore;
    private long evaluations;
    private long refused;
    private long stoppedEarly;
    /** Nanoseconds, so that sums of parts of a run are those of the whole. */
    private long saved;
    /** Whether it is known what to count on from. */
    private final boolean known;

    /**
     * Counts on from the folder's checkpoint.
     *
     * @param duration of a simulation that nothing ends early, in seconds
     * @param found    results from the cache since this run began or was continued
     */
    EvaluationCounter(RunWriter folder, double duration, LongSupplier found) {
        this.folder = folder;
        this.duration = duration;
        this.found = found;
        EvaluationStatistics before = statistics(folder);
        this.foundBefore = before == null ? 0 : before.fromCache();
        long first = folder.recorded().first();
        this.known = first == 0 || before != null;
        if (first > 0 && known) {
            takeOver(before);
            first = evaluations;
        }
        if (folder.checkpoint() != null) {
            folder.recorded().between(first, folder.checkpoint().evaluations()).forEach(this::evaluated);
        }
    }

    /** What cannot be counted anew, since the evaluations were dropped. */
    private void takeOver(EvaluationStatistics before) {
        evaluations = before.evaluations();
        refused = before.refused();
        stoppedEarly = before.stoppedEarly();
        saved = Math.round((before.wholeSeconds() - before.simulatedSeconds()) * NANOSECONDS);
    }

    /** Statistics of the run so far; a damaged file costs only the number of results from the cache. */
    private static EvaluationStatistics statistics(RunWriter folder) {
        try {
            return RunReader.statistics(folder.directory());
        } catch (InvalidInputException e) {
            LOG.warn(folder.recorded().first() == 0 ? "{}; counted anew, without the results that came from the cache"
                    : "{}; not counted any more, since the first evaluations are gone", e.getMessage());
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
            saved += Math.round((duration - result.simulatedOf(duration)) * NANOSECONDS);
        }
    }

    @Override
    public void generationFinished(EvolutionState state) {
        long unchanged = state.history().stream().mapToLong(GenerationSummary::unchanged).sum();
        long whole = (evaluations - refused) * Math.round(duration * NANOSECONDS);
        if (known) {
            folder.write(new EvaluationStatistics(evaluations, unchanged, foundBefore + found.getAsLong(), stoppedEarly,
                    (whole - saved) / NANOSECONDS, whole / NANOSECONDS, refused));
        }
    }
}
