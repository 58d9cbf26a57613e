package io.natator.flow;

import java.util.Arrays;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

/** How much of a body is in the water, by the level at which the water stands. */
public final class WaterLevel {

    /** Width of a column of water, in mean distances of its particles. */
    private static final double WIDTH = 2;

    private WaterLevel() {
    }

    /**
     * Share of the body's particles below the water's level, which is the median of the uppermost particles of all columns:
     * waves, and what was splashed, do not raise it.
     *
     * @return null without water or without a body
     */
    public static Double shareBelow(Snapshot snapshot) {
        if (snapshot.fluid().isEmpty() || snapshot.body().isEmpty()) {
            return null;
        }
        double level = level(snapshot.fluid());
        long below = snapshot.body().stream().filter(one -> one.position()[1] < level).count();
        return below / (double) snapshot.body().size();
    }

    private static double level(List<Snapshot.Particle> fluid) {
        double width = WIDTH * meanDistance(fluid);
        Map<List<Long>, Double> tops = new HashMap<>();
        for (Snapshot.Particle one : fluid) {
            List<Long> column = List.of((long) Math.floor(one.position()[0] / width),
                    (long) Math.floor(one.position()[2] / width));
            tops.merge(column, one.position()[1], Math::max);
        }
        double[] sorted = tops.values().stream().mapToDouble(Double::doubleValue).sorted().toArray();
        return sorted[sorted.length / 2];
    }

    /** Of particles that fill their box. */
    private static double meanDistance(List<Snapshot.Particle> fluid) {
        double volume = 1;
        for (int axis = 0; axis < 3; axis++) {
            int along = axis;
            double[] places = fluid.stream().mapToDouble(one -> one.position()[along]).toArray();
            volume *= Math.max(Arrays.stream(places).max().orElseThrow() - Arrays.stream(places).min().orElseThrow(), 1e-6);
        }
        return Math.cbrt(volume / fluid.size());
    }
}
