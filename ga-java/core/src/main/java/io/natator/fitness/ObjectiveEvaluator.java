package io.natator.fitness;

import io.natator.base.InvalidInputException;
import io.natator.config.Objective;
import io.natator.config.WeightedObjective;
import io.natator.process.Evaluator;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import java.util.List;
import java.util.Locale;
import java.util.function.Consumer;

/** Tells what each result is worth by a run's objectives. */
public final class ObjectiveEvaluator implements Evaluator {

    /** Yaw and roll of a run that did not come to its end: no other can have turned more. */
    private static final double LEAST_STRAIGHT = -2 * Math.PI;
    /** Its work, more than that of one that did. */
    private static final double MOST_WORK = -1e6;

    private final Evaluator evaluator;
    private final List<WeightedObjective> objectives;

    /**
     * Wraps an evaluator, which is closed with this one.
     *
     * @param objectives at least one
     */
    public ObjectiveEvaluator(Evaluator evaluator, List<WeightedObjective> objectives) {
        this.evaluator = objectives.stream().anyMatch(one -> one.objective() == Objective.NET) ? new NetEvaluator(evaluator)
                : evaluator;
        this.objectives = objectives;
    }

    @Override
    public void evaluateAll(List<SimulationRequest> requests, Consumer<SimulationResult> whenDone)
            throws InterruptedException {
        evaluator.evaluateAll(requests, result -> whenDone.accept(worth(result)));
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
            return objective == Objective.STRAIGHT ? LEAST_STRAIGHT : objective == Objective.WORK ? MOST_WORK : 0;
        }
        return switch (objective) {
            case DISTANCE -> result.distance();
            case NET -> result.netDistance();
            case FORWARD -> known(result.course(), objective, result).forward();
            case STRAIGHT -> -Math.abs(known(result.course(), objective, result).yaw()) - Math.abs(result.course().roll());
            case WORK -> -known(result.work(), objective, result);
            case EFFICIENCY -> known(result.work(), objective, result) > 0 ? result.distance() / result.work() : 0;
            case GOALS -> goals(result);
        };
    }

    private static double goals(SimulationResult result) {
        if (result.goals() == null) {
            throw new InvalidInputException("objective goals: the scene has none; expected a scene with goals, such as goals/turn");
        }
        return result.goalScore();
    }

    private static <T> T known(T figure, Objective objective, SimulationResult result) {
        if (figure == null) {
            throw new InvalidInputException("objective " + objective.name().toLowerCase(Locale.ROOT)
                    + ": this simulator does not measure it in scheme " + result.scheme());
        }
        return figure;
    }

    @Override
    public void close() {
        evaluator.close();
    }
}
