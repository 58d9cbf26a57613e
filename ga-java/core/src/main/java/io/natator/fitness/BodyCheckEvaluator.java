package io.natator.fitness;

import io.natator.base.Numbers;
import io.natator.config.EvolutionSettings;
import io.natator.process.Evaluator;
import io.natator.process.SceneInfo;
import io.natator.process.SceneMemory;
import io.natator.protocol.RefusedSceneException;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Consumer;

/**
 * Refuses invalid bodies before they cost a simulation: those that the simulator does not take, and those with more or
 * fewer particles, or actuators, than the scene's own body.
 */
public final class BodyCheckEvaluator implements Evaluator {

    /** Share of the particles that may be too many or too few: what is held is the volume. */
    private static final double HELD = 0.02;
    /** The fault of a valid body. */
    private static final String NOTHING = "";

    private final Evaluator evaluator;
    private final Path simulator;
    private final SceneInfo scene;
    /** What is wrong with bodies. */
    private final SceneMemory<String> faults = new SceneMemory<>();

    /**
     * Wraps an evaluator, which is closed with this one.
     *
     * @param settings  of the run whose bodies these are
     * @param simulator the native program
     */
    public BodyCheckEvaluator(Evaluator evaluator, EvolutionSettings settings, Path simulator)
            throws InterruptedException {
        this.evaluator = evaluator;
        this.simulator = simulator;
        this.scene = SceneInfo.of(settings.problem().scene(), settings.problem().overrides(), simulator);
    }

    @Override
    public void evaluateAll(List<SimulationRequest> requests, Consumer<SimulationResult> whenDone)
            throws InterruptedException {
        List<SimulationRequest> sound = new ArrayList<>();
        for (SimulationRequest request : requests) {
            String fault = faults.of(request.scene(), request.overrides(), () -> fault(request));
            if (fault.equals(NOTHING)) {
                sound.add(request);
            } else {
                whenDone.accept(SimulationResult.refused(request.id(), fault));
            }
        }
        evaluator.evaluateAll(sound, whenDone);
    }

    private String fault(SimulationRequest request) throws InterruptedException {
        SceneInfo body;
        try {
            body = SceneInfo.of(request.scene(), request.overrides(), simulator);
        } catch (RefusedSceneException e) {
            return e.getMessage();
        }
        if (body.actuators() != scene.actuators()) {
            return "body has " + Numbers.count(body.actuators(), "actuator") + "; expected the " + scene.actuators()
                    + " of the scene's";
        }
        if (body.bodyParticles() != null
                && Math.abs(body.bodyParticles() - scene.bodyParticles()) > HELD * scene.bodyParticles()) {
            return "body has " + Numbers.count(body.bodyParticles(), "particle") + "; expected the "
                    + scene.bodyParticles() + " of the scene's, within " + Math.round(100 * HELD) + " %";
        }
        return NOTHING;
    }

    @Override
    public void close() {
        evaluator.close();
    }
}
