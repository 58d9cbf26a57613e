package io.natator.view;

import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.body.Genome;
import io.natator.body.Swimmer;
import io.natator.checkpoint.RunReader;
import io.natator.config.EvolutionSettings;
import io.natator.config.Objective;
import io.natator.encoding.Gait;
import io.natator.evolution.Individual;
import io.natator.protocol.SimulationResult;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Set;

/**
 * The gaits of a run with several objectives.
 *
 * @param goals  what its objectives are, as they are read: work, not less work
 * @param points each gait of the last generation once; the front first, the best by the first objective first
 */
record FrontResponse(List<Goal> goals, List<Point> points) {

    /**
     * An objective.
     *
     * @param name   of what is measured
     * @param unit   of that
     * @param isLess whether less of it is better
     */
    record Goal(String name, String unit, boolean isLess) {

        static Goal of(Objective objective) {
            return switch (objective) {
                case DISTANCE -> new Goal("distance", "length", false);
                case NET -> new Goal("distance less drift in vacuum", "length", false);
                case FORWARD -> new Goal("way along its heading", "length", false);
                case STRAIGHT -> new Goal("yaw and roll", "rad", true);
                case WORK -> new Goal("work of the muscles", "mass · length²/s²", true);
                case EFFICIENCY -> new Goal("distance by work", "s²/(mass · length)", false);
                case GOALS -> new Goal("score by the scene's goals", "", false);
            };
        }
    }

    /**
     * A gait.
     *
     * @param values by the goals
     * @param isBest whether no other is better in all
     * @param runs   that they are means of
     * @param overrides that give the run's scene this body too, as in {@link RunResponse.Best}
     */
    record Point(List<Double> values, boolean isBest, int runs, Gait gait, ObjectNode overrides) {
    }

    /** The front of a run; null with a single objective, or while nothing is measured. */
    static FrontResponse of(RunReader run) {
        List<Individual> front = run.front();
        if (front.isEmpty()) {
            return null;
        }
        List<Goal> goals = run.settings().problem().objectives().stream().map(one -> Goal.of(one.objective())).toList();
        Genome genome = run.settings().problem().genome();
        List<Point> points = new ArrayList<>();
        Set<List<Double>> known = new HashSet<>();
        for (Individual one : front) {
            known.add(one.genes());
            points.add(point(one, true, goals, run.settings(), genome));
        }
        for (Individual one : run.state().population()) {
            if (one.result().status() == SimulationResult.Status.OK && known.add(one.genes())) {
                points.add(point(one, false, goals, run.settings(), genome));
            }
        }
        return new FrontResponse(goals, points);
    }

    private static Point point(Individual one, boolean isBest, List<Goal> goals, EvolutionSettings settings,
            Genome genome) {
        List<Double> values = new ArrayList<>();
        for (int i = 0; i < goals.size(); i++) {
            values.add(goals.get(i).isLess() ? 0.0 - one.objectives().get(i) : one.objectives().get(i));
        }
        Swimmer swimmer = genome.decode(one.genes());
        return new Point(values, isBest, one.runs(), swimmer.gait(), RunResponse.overrides(settings, swimmer));
    }
}
