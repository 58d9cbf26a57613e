package io.natator.cli;

import io.natator.base.InvalidInputException;
import io.natator.checkpoint.BestGait;
import io.natator.checkpoint.StoredRun;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.process.Evaluator;
import io.natator.protocol.RequestRejectedException;
import io.natator.protocol.SimulationRequest;
import io.natator.run.EvolutionRun;
import io.natator.verdict.Reproduction;
import java.io.PrintWriter;
import java.nio.file.Path;

/** Repeats a run's best gait while something else goes on, and says so if it comes out otherwise than stored. */
final class BackgroundCheck implements AutoCloseable {

    private final Path run;
    private final Path simulator;
    private final PrintWriter err;
    private final Thread thread = new Thread(this::check, "stored-gait");

    /** Starts, if the run has a best gait. */
    BackgroundCheck(Path run, Path simulator, PrintWriter err) {
        this.run = run;
        this.simulator = simulator;
        this.err = err;
        thread.setDaemon(true);
        thread.start();
    }

    private void check() {
        try {
            String difference = difference();
            if (difference != null) {
                err.println(difference);
                err.flush();
            }
        } catch (InvalidInputException | RequestRejectedException e) {
            err.println(run + ": its best gait cannot be repeated: " + e.getMessage());
            err.flush();
        } catch (InterruptedException e) {
            // No longer wanted.
        }
    }

    private String difference() throws InterruptedException {
        EvolutionSettings settings = StoredRun.settings(run);
        BestGait best = StoredRun.best(run);
        if (best == null) {
            return null;
        }
        ExecutionSettings execution = EvolutionRun.withTimeLimit(new ExecutionSettings(simulator, 1, null), settings);
        try (Evaluator evaluator = Evaluator.open(execution)) {
            return new Reproduction(run, best, simulator, execution.backend(), execution.device())
                    .difference(evaluator.evaluate(SimulationRequest.of(0, settings, best.swimmer())));
        }
    }

    /** Gives it up if it is still under way. */
    @Override
    public void close() {
        thread.interrupt();
    }
}
