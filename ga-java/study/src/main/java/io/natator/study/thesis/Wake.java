package io.natator.study.thesis;

import io.natator.flow.FlowField;
import java.util.Arrays;

/**
 * How much the water turns about a swimmer that faces +x: the mean magnitude of vorticity in three places, in 1/s.
 *
 * @param head   within {@link #NEAR} body lengths of its foremost point
 * @param tail   likewise of its rearmost
 * @param behind from half a body length to a whole one behind the rearmost; NaN without water there
 */
record Wake(double head, double tail, double behind) {

    private static final double NEAR = 0.25;

    /** In a field seen from above. */
    static Wake of(FlowField field) {
        double rear = Arrays.stream(field.body()).mapToDouble(place -> place[0]).min().orElse(0);
        double front = Arrays.stream(field.body()).mapToDouble(place -> place[0]).max().orElse(0);
        double length = front - rear;
        double side = Arrays.stream(field.body()).mapToDouble(place -> place[1]).average().orElse(0);
        return new Wake(mean(field, front - NEAR * length, front + NEAR * length, side, length),
                mean(field, rear - NEAR * length, rear + NEAR * length, side, length),
                mean(field, rear - length, rear - length / 2, side, length));
    }

    private static double mean(FlowField field, double from, double to, double side, double length) {
        double sum = 0;
        int count = 0;
        for (int i = 0; i < field.columns(); i++) {
            for (int k = 0; k < field.rows(); k++) {
                double x = field.origin()[0] + i * FlowField.CELL;
                double z = field.origin()[1] + k * FlowField.CELL;
                double vorticity = field.vorticity(i, k);
                if (x >= from && x <= to && Math.abs(z - side) <= NEAR * length && !Double.isNaN(vorticity)) {
                    sum += Math.abs(vorticity);
                    count++;
                }
            }
        }
        return count == 0 ? Double.NaN : sum / count;
    }
}
