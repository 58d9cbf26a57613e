package io.natator.flow;

import java.util.ArrayList;
import java.util.List;

/**
 * Velocity of the fluid in a plane through the swimmer, on a grid of cells: in each the mean of the particles within
 * {@link #REACH} of its centre, in a layer as thick as {@link #LAYER} to either side of the swimmer's centre, weighted by
 * (1 − r/REACH)².
 *
 * @param view     the plane
 * @param time     in seconds
 * @param origin   centre of the first cell in the plane's axes, scene units
 * @param velocity [column][row][2] in the plane's axes, scene units per second; null where there is no fluid
 * @param body     the swimmer's particles in the plane's axes
 */
public record FlowField(SlicePlane view, double time, double[] origin, double[][][] velocity, double[][] body) {

    /** Size of a cell, scene units: the spacing of the fluid in the thesis. */
    public static final double CELL = 0.09;
    /** In the plane, scene units. */
    static final double REACH = 0.15;
    /** Out of the plane, scene units. */
    static final double LAYER = 0.15;

    /** The field of a moment. */
    public static FlowField of(Snapshot snapshot, SlicePlane view) {
        int first = view.first();
        int second = view.second();
        double middle = snapshot.body().stream().mapToDouble(one -> one.position()[view.depth()]).average().orElse(0);
        List<Snapshot.Particle> near = snapshot.fluid().stream()
                .filter(one -> Math.abs(one.position()[view.depth()] - middle) <= LAYER).toList();
        double[] low = {least(near, first), least(near, second)};
        int columns = 1 + (int) Math.round((-least(near, first, -1) - low[0]) / CELL);
        int rows = 1 + (int) Math.round((-least(near, second, -1) - low[1]) / CELL);
        double[][][] sum = new double[columns][rows][3];
        int reach = (int) Math.ceil(REACH / CELL);
        for (Snapshot.Particle particle : near) {
            double a = particle.position()[first];
            double b = particle.position()[second];
            int column = (int) Math.round((a - low[0]) / CELL);
            int row = (int) Math.round((b - low[1]) / CELL);
            for (int i = Math.max(0, column - reach); i <= Math.min(columns - 1, column + reach); i++) {
                for (int k = Math.max(0, row - reach); k <= Math.min(rows - 1, row + reach); k++) {
                    double distance = Math.hypot(a - low[0] - i * CELL, b - low[1] - k * CELL);
                    if (distance < REACH) {
                        double weight = (1 - distance / REACH) * (1 - distance / REACH);
                        sum[i][k][0] += weight * particle.velocity()[first];
                        sum[i][k][1] += weight * particle.velocity()[second];
                        sum[i][k][2] += weight;
                    }
                }
            }
        }
        double[][][] velocity = new double[columns][rows][];
        for (int i = 0; i < columns; i++) {
            for (int k = 0; k < rows; k++) {
                double weight = sum[i][k][2];
                velocity[i][k] = weight > 0 ? new double[] {sum[i][k][0] / weight, sum[i][k][1] / weight} : null;
            }
        }
        return new FlowField(view, snapshot.time(), low, velocity, places(snapshot.body(), view));
    }

    private static double least(List<Snapshot.Particle> particles, int axis) {
        return least(particles, axis, 1);
    }

    private static double least(List<Snapshot.Particle> particles, int axis, int sign) {
        return particles.stream().mapToDouble(one -> sign * one.position()[axis]).min().orElse(0);
    }

    private static double[][] places(List<Snapshot.Particle> particles, SlicePlane view) {
        List<double[]> places = new ArrayList<>();
        particles.forEach(one -> places.add(new double[] {one.position()[view.first()], one.position()[view.second()]}));
        return places.toArray(double[][]::new);
    }

    /** Cells along the first axis. */
    public int columns() {
        return velocity.length;
    }

    /** Cells along the second axis. */
    public int rows() {
        return velocity[0].length;
    }

    /**
     * Vorticity about the axis that points at the viewer, positive against the clock as the picture is seen, in 1/s, by
     * central differences (one-sided at the edge); NaN where a neighbour that it takes is missing.
     */
    public double vorticity(int column, int row) {
        double ofSecond = slope(at(column + 1, row), at(column - 1, row), at(column, row), 1);
        double ofFirst = slope(at(column, row + 1), at(column, row - 1), at(column, row), 0);
        double counterclockwise = ofSecond - ofFirst;
        return view == SlicePlane.ABOVE ? -counterclockwise : counterclockwise;
    }

    private double[] at(int column, int row) {
        return column < 0 || row < 0 || column >= columns() || row >= rows() ? null : velocity[column][row];
    }

    private static double slope(double[] after, double[] before, double[] here, int component) {
        if (here == null || after == null && before == null) {
            return Double.NaN;
        }
        double[] to = after == null ? here : after;
        double[] from = before == null ? here : before;
        return (to[component] - from[component]) / (CELL * (after == null || before == null ? 1 : 2));
    }
}
