package io.natator.process;

import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import java.util.concurrent.Callable;

/** Evaluates in this process, several at a time, by whatever a test calls a simulation. */
public final class FakePool extends WorkerPool {

    private final Simulation simulation;

    /** One evaluation. */
    @FunctionalInterface
    public interface Simulation {
        /** What comes of it. */
        SimulationResult evaluate(SimulationRequest request) throws InterruptedException;
    }

    /** With so many threads. */
    public FakePool(Simulation simulation, int count) {
        super(count);
        this.simulation = simulation;
    }

    @Override
    Callable<SimulationResult> evaluation(SimulationRequest request) {
        return () -> simulation.evaluate(request);
    }
}
