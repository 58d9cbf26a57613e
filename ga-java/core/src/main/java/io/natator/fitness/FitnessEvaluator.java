package io.natator.fitness;

import io.natator.base.InvalidInputException;
import io.natator.config.EvolutionSettings;
import io.natator.config.FitnessKind;
import io.natator.config.Json;
import io.natator.config.Objective;
import io.natator.config.OptimizerKind;
import io.natator.config.Problem;
import io.natator.config.WeightedObjective;
import io.natator.process.Evaluator;
import io.natator.process.SceneInfo;
import io.natator.protocol.Effort;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Consumer;
import java.util.function.ToDoubleFunction;

/**
 * Tells of each result what a run asks for beside the distance: what it is worth by the run's objectives, the drift in vacuum where that
 * is taken off, and what the swim took. What the simulator does not measure in a scene it refuses with the first result.
 *
 * <p>The drift is that of the same gait in the same time, and only of what swims forwards: else there is no distance to take it off. What
 * is unstable in vacuum is unstable.
 */
public final class FitnessEvaluator implements Evaluator {

    /** Yaw and roll of a run that did not come to its end: no other can have turned more. */
    private static final double MIN_STRAIGHT = -2 * Math.PI;
    /** Its work, more than that of one that did. */
    private static final double MIN_WORK = -1e6;

    private final Evaluator evaluator;
    private final List<WeightedObjective> objectives;
    private final boolean isNet;
    private final OptimizerKind optimizer;
    private final ToDoubleFunction<SimulationRequest> bodyLength;

    /**
     * Wraps an evaluator, which is closed with this one.
     *
     * @param problem    that says what is rewarded
     * @param optimizer  that needs the effort of swims, for messages; or null
     * @param bodyLength of a request's creature in scene units; null for results that do not tell the effort
     */
    FitnessEvaluator(Evaluator evaluator, Problem problem, OptimizerKind optimizer,
            ToDoubleFunction<SimulationRequest> bodyLength) {
        this.evaluator = evaluator;
        this.optimizer = optimizer;
        this.objectives = problem.objectives() == null ? List.of() : problem.objectives();
        this.isNet = problem.objectives() == null ? problem.fitness() == FitnessKind.NET
                : objectives.stream().anyMatch(one -> one.objective() == Objective.NET);
        this.bodyLength = bodyLength;
    }

    /** An evaluator whose results are worth what a run rewards; the given one, if that is the distance or the scene's goals. */
    public static Evaluator of(Evaluator evaluator, Problem problem) {
        return problem.objectives() == null && problem.fitness() == FitnessKind.DISTANCE ? evaluator
                : new FitnessEvaluator(evaluator, problem, null, null);
    }

    /**
     * An evaluator whose results are worth what a run rewards, with their effort where the optimizer needs it.
     *
     * @throws InvalidInputException if the scene has goals, and the run would have another fitness; or if the optimizer asks for a
     *                               body's length, and that is not known
     */
    public static Evaluator of(Evaluator evaluator, EvolutionSettings settings, SceneInfo scene) {
        Problem problem = settings.problem();
        if (problem.fitness() == FitnessKind.NET && scene.goals() != null && !scene.goals().isEmpty()) {
            throw new InvalidInputException("--fitness net is for scenes without goals, and " + problem.scene()
                    + " has some, which are its fitness; expected --objectives net, alone or together with goals");
        }
        OptimizerKind optimizer = settings.search().optimizer();
        if (!optimizer.mapsKinds() && !optimizer.isOutside()) {
            return of(evaluator, problem);
        }
        if (problem.evolve() != null) {
            return new FitnessEvaluator(evaluator, problem, optimizer,
                    request -> problem.bodyLength(request.overrides()));
        }
        if (scene.bodyLength() == null || !(scene.bodyLength() > 0)) {
            if (optimizer.isOutside()) {
                return of(evaluator, problem);
            }
            throw new InvalidInputException(
                    "optimizer " + Json.name(optimizer) + ": the body's length is " + scene.bodyLength()
                            + "; expected a simulator that tells it, and a scene with a body");
        }
        return new FitnessEvaluator(evaluator, problem, optimizer, request -> scene.bodyLength());
    }

    @Override
    public void evaluateAll(List<SimulationRequest> requests, Consumer<SimulationResult> whenDone)
            throws InterruptedException {
        Map<Long, SimulationRequest> asked = new HashMap<>();
        requests.forEach(request -> asked.put(request.id(), request));
        Map<Long, SimulationResult> inWater = new HashMap<>();
        List<SimulationRequest> inVacuum = new ArrayList<>();
        evaluator.evaluateAll(requests, result -> {
            if (isNet && result.distanceOrZero() > 0) {
                inWater.put(result.id(), result);
                inVacuum.add(asked.get(result.id()).inVacuum(result.simulated()));
            } else {
                whenDone.accept(judge(result, asked.get(result.id())));
            }
        });
        if (!inVacuum.isEmpty()) {
            evaluator.evaluateAll(inVacuum,
                    vacuum -> whenDone.accept(judge(net(inWater.get(vacuum.id()), vacuum), asked.get(vacuum.id()))));
        }
    }

    private static SimulationResult net(SimulationResult water, SimulationResult vacuum) {
        if (vacuum.status() == SimulationResult.Status.OK) {
            return water.withVacuumDrift(vacuum.distance());
        }
        if (vacuum.status() == SimulationResult.Status.UNSTABLE) {
            // No drift is known to take off, so the distance is worth nothing.
            return vacuum.withId(water.id()).withError("in vacuum: " + vacuum.whyUnstable());
        }
        return SimulationResult.failed(water.id(), "in vacuum: " + vacuum.error());
    }

    private SimulationResult judge(SimulationResult result, SimulationRequest request) {
        SimulationResult worth = objectives.isEmpty() ? result : worth(result);
        return bodyLength == null || result.status() != SimulationResult.Status.OK ? worth
                : worth.withEffort(effort(result, request));
    }

    private SimulationResult worth(SimulationResult result) {
        List<Double> values = objectives.stream().map(one -> value(one.objective(), result)).toList();
        double together = 0;
        for (int i = 0; i < values.size(); i++) {
            Double weight = objectives.get(i).weight();
            together += weight == null ? 0 : weight * values.get(i);
        }
        // Without weights the first is what generations are told by.
        return result.withWorth(values, objectives.get(0).weight() == null ? values.get(0) : together);
    }

    private static double value(Objective objective, SimulationResult result) {
        if (result.status() != SimulationResult.Status.OK) {
            return objective == Objective.STRAIGHT ? MIN_STRAIGHT : objective == Objective.WORK ? MIN_WORK : 0;
        }
        return switch (objective) {
            case DISTANCE -> result.distance();
            case NET -> result.netDistance();
            case FORWARD -> known(result.course(), objective, result).forward();
            case STRAIGHT ->
                -Math.abs(known(result.course(), objective, result).yaw()) - Math.abs(result.course().roll());
            case WORK -> -known(result.work(), objective, result);
            case EFFICIENCY -> known(result.work(), objective, result) > 0 ? result.distance() / result.work() : 0;
            case GOALS -> goals(result);
        };
    }

    private static double goals(SimulationResult result) {
        if (result.goals() == null) {
            throw new InvalidInputException(
                    "objective goals: the scene has none; expected a scene with goals, such as goals/turn");
        }
        return result.goalScore();
    }

    private static <T> T known(T figure, Objective objective, SimulationResult result) {
        if (figure == null) {
            throw new InvalidInputException("objective " + Json.name(objective)
                    + ": this simulator does not measure it in scheme " + result.scheme());
        }
        return figure;
    }

    private Effort effort(SimulationResult result, SimulationRequest request) {
        if (result.work() == null && optimizer.isOutside()) {
            return null;
        }
        if (result.work() == null) {
            throw new InvalidInputException("optimizer " + Json.name(optimizer)
                    + ": this simulator does not measure the muscles' work in scheme " + result.scheme()
                    + ", by which kinds of gaits are told apart; expected --scheme conserving or lattice");
        }
        return new Effort(request.gait().frequency() * result.simulated(),
                result.distance() / bodyLength.applyAsDouble(request), result.distance(), result.work());
    }

    @Override
    public void close() {
        evaluator.close();
    }
}
