package io.natator.kinematics;

import io.natator.config.InvalidInputException;
import io.natator.file.CsvReader;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;

/**
 * All particles of a body over time, as {@code natator-sim run --trajectory FILE --particles} writes them.
 *
 * @param times     in seconds, one per frame; the first is the settled start
 * @param particles [frame][particle][x, y, z] in scene units; by slices from the head on
 */
public record BodyPath(double[] times, double[][][] particles) {

    private static final List<String> COLUMNS = List.of("frame", "time", "particle", "x", "y", "z");

    /**
     * Reads the file.
     *
     * @throws InvalidInputException naming the line that is wrong
     */
    public static BodyPath read(Path file) {
        List<Double> times = new ArrayList<>();
        List<double[][]> frames = new ArrayList<>();
        List<double[]> frame = new ArrayList<>();
        try (CsvReader table = new CsvReader(file, COLUMNS)) {
            while (table.next()) {
                if (table.number("frame") == times.size()) {
                    addFrame(frames, frame);
                    times.add(table.number("time"));
                }
                frame.add(new double[] {table.number("x"), table.number("y"), table.number("z")});
            }
        }
        addFrame(frames, frame);
        return new BodyPath(times.stream().mapToDouble(Double::doubleValue).toArray(),
                frames.toArray(double[][][]::new));
    }

    private static void addFrame(List<double[][]> frames, List<double[]> frame) {
        if (!frame.isEmpty()) {
            frames.add(frame.toArray(double[][]::new));
            frame.clear();
        }
    }

    /** The centres of the slices: particles that have the same x, to half the spacing, in the settled start. */
    public SpinePath spine() {
        double[][] start = particles[0];
        double span = start[0][0] - start[start.length - 1][0];
        List<Integer> ends = new ArrayList<>();
        double tolerance = span / start.length;
        for (int i = 1; i < start.length; i++) {
            if (Math.abs(start[i][0] - start[i - 1][0]) > tolerance) {
                ends.add(i);
            }
        }
        ends.add(start.length);
        double[][][] centres = new double[times.length][ends.size()][3];
        for (int frame = 0; frame < times.length; frame++) {
            int first = 0;
            for (int slice = 0; slice < ends.size(); slice++) {
                for (int axis = 0; axis < 3; axis++) {
                    centres[frame][slice][axis] = mean(particles[frame], first, ends.get(slice), axis);
                }
                first = ends.get(slice);
            }
        }
        return new SpinePath(times, centres);
    }

    /** Mean place of all particles in a frame. */
    public double[] centre(int frame) {
        double[][] all = particles[frame];
        return new double[] {mean(all, 0, all.length, 0), mean(all, 0, all.length, 1), mean(all, 0, all.length, 2)};
    }

    private static double mean(double[][] places, int from, int to, int axis) {
        double sum = 0;
        for (int i = from; i < to; i++) {
            sum += places[i][axis];
        }
        return sum / (to - from);
    }
}
