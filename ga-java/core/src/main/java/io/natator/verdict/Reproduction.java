package io.natator.verdict;

import io.natator.base.Numbers;
import io.natator.checkpoint.BestGait;
import io.natator.checkpoint.Program;
import io.natator.checkpoint.SceneDigest;
import io.natator.config.Backend;
import io.natator.protocol.SimulationResult;
import java.nio.file.Path;

/** Whether a program of today repeats what a run folder has stored of its best gait. */
public final class Reproduction {

    private static final int DIGITS = 4;
    private static final double EXACT = 1e-12;

    private final Path run;
    private final BestGait stored;
    private final Path simulator;
    private final Backend backend;
    private final int device;

    /**
     * A comparison yet to be made.
     *
     * @param run       the folder
     * @param stored    its best gait
     * @param simulator the native program of today
     * @param backend   what it computes on
     * @param device    number of the GPU
     */
    public Reproduction(Path run, BestGait stored, Path simulator, Backend backend, int device) {
        this.run = run;
        this.stored = stored;
        this.simulator = simulator;
        this.backend = backend;
        this.device = device;
    }

    /** The frame at which the stored run ended: where a longer one is to be compared; -1 if it had no end to compare. */
    public long lastFrame() {
        SimulationResult result = stored.result();
        return stored.isFromOwnStart() && result.status() == SimulationResult.Status.OK && result.frames() != null
                ? result.frames() : -1;
    }

    /**
     * What to say of a result, by the hash of the last state.
     *
     * @return one line, or null if today's program repeats the stored result
     */
    public String difference(SimulationResult today) throws InterruptedException {
        if (!stored.isFromOwnStart() || today.status() != SimulationResult.Status.OK
                || today.hash().equals(stored.result().hash())) {
            return null;
        }
        return line(today.distance());
    }

    /**
     * What to say of a result of which only the distance at {@link #lastFrame()} is known.
     *
     * @param error that the distance may have by its rounding, in scene units
     */
    public String difference(double today, double error) throws InterruptedException {
        return Math.abs(today - stored.distance()) <= EXACT + error ? null : line(today);
    }

    private String line(double today) throws InterruptedException {
        if (SceneDigest.isChanged(run, simulator)) {
            return told(today, "the scene was changed after the run was begun");
        }
        Program then = Program.of(run);
        String reason = then == null ? "" : then.differenceTo(Program.at(simulator, backend, device));
        return told(today, then == null ? "the folder does not say which program made it"
                : reason.isEmpty() ? "the same program: no reason is known" : reason);
    }

    private String told(double today, String reason) {
        return run + ": stored " + Numbers.fixed(stored.distance(), DIGITS) + ", today's program "
                + Numbers.fixed(today, DIGITS) + " (" + reason + ")";
    }
}
