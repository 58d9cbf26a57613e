package io.natator;

import io.natator.checkpoint.RunWriter;
import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.evolution.EvolutionListener;
import io.natator.process.Evaluator;
import io.natator.process.SceneInfo;
import io.natator.process.SimulatorLocator;
import io.natator.process.TimeLimit;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import io.natator.run.EvolutionRun;
import java.nio.file.Path;

/**
 * Natator for programs that embed it: what the command line does, as calls. Holds nothing between calls.
 *
 * <pre>{@code
 * Natator natator = new Natator(Natator.onThisMachine());
 * EvolutionSettings settings = natator.settings("thesis/creature-1").withSize(24, 8).withSeed(7);
 * EvolutionRun.Outcome outcome = natator.evolve(settings, Path.of("runs/one"));
 * System.out.println(outcome.state().best().result().distance());
 * }</pre>
 *
 * <p>Bad input is an {@link io.natator.base.InvalidInputException}, a request that the simulator refuses a
 * {@link io.natator.protocol.RequestRejectedException}, a run most of whose evaluations fail an
 * {@link io.natator.evolution.EvolutionFailedException}; each says in one line what is wrong. All methods throw
 * {@link InterruptedException} or {@link io.natator.evolution.EvolutionStoppedException} if the calling thread is
 * interrupted; a run can then be continued.
 */
public final class Natator {

    private final ExecutionSettings execution;

    /**
     * Natator on these processors or this GPU.
     *
     * @param execution its time limit may be null, to be derived from each scene's cost
     */
    public Natator(ExecutionSettings execution) {
        this.execution = execution;
    }

    /**
     * All processors, with processes kept alive and without a cache of evaluations; the simulator where
     * {@link SimulatorLocator} finds it.
     *
     * @throws io.natator.base.InvalidInputException if it finds none of this version
     */
    public static ExecutionSettings onThisMachine() throws InterruptedException {
        return ExecutionSettings.of(SimulatorLocator.locate(null));
    }

    /**
     * The thesis' settings for a scene, on this Natator's backend.
     *
     * @param scene name, for example {@code thesis/creature-1}, or absolute path of a scene file
     */
    public EvolutionSettings settings(String scene) throws InterruptedException {
        EncodingKind encoding = EncodingKind.usualFor(scene);
        int actuators = SceneInfo.toEvolve(scene, encoding, null, execution.simulator()).actuators();
        return EvolutionSettings.of(scene, encoding, actuators).withBackend(execution.backend());
    }

    /** Simulates one gait. A crash or hang is a result with status failed. */
    public SimulationResult evaluate(SimulationRequest request) throws InterruptedException {
        ExecutionSettings limited = execution.timeout() != null ? execution : execution.withTimeout(TimeLimit.of(
                SceneInfo.of(request.scene(), request.overrides(), execution.simulator()), request.duration()));
        try (Evaluator evaluator = Evaluator.open(limited)) {
            return evaluator.evaluate(request);
        }
    }

    /**
     * Evolves a gait.
     *
     * @param directory the run folder, new or empty
     * @param listeners told of the course
     */
    public EvolutionRun.Outcome evolve(EvolutionSettings settings, Path directory, EvolutionListener... listeners)
            throws InterruptedException {
        return run(RunWriter.create(directory, settings), listeners);
    }

    /**
     * Continues an interrupted run, with the outcome of an uninterrupted one.
     *
     * @param directory its run folder
     * @param listeners told of the course from there on
     */
    public EvolutionRun.Outcome resume(Path directory, EvolutionListener... listeners) throws InterruptedException {
        return run(RunWriter.open(directory), listeners);
    }

    private EvolutionRun.Outcome run(RunWriter folder, EvolutionListener... listeners) throws InterruptedException {
        try (folder) {
            ExecutionSettings limited = EvolutionRun.withTimeLimit(
                    execution.withBackend(folder.settings().budget().backend()), folder.settings());
            try (Evaluator evaluator = EvolutionRun.open(limited)) {
                return new EvolutionRun(folder).run(limited, evaluator, listeners);
            }
        }
    }
}
