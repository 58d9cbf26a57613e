package io.natator.process;

import io.natator.protocol.RequestRejectedException;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;

/**
 * Carries out evaluations. Implementations take calls from several threads at once, and the result depends on nothing
 * but the request.
 */
public interface Simulator extends AutoCloseable {

    /**
     * Simulates one gait. What goes wrong in one evaluation alone (a crash, a hang, garbage) is not an exception but a
     * result with {@link SimulationResult.Status#FAILED}.
     *
     * @throws RequestRejectedException if the simulator says that the request itself is wrong, or cannot be started
     * @throws InterruptedException     if the calling thread is interrupted; the evaluation is then abandoned
     */
    SimulationResult evaluate(SimulationRequest request) throws InterruptedException;

    /** Ends evaluations that are still running and frees what they hold. */
    @Override
    void close();
}
