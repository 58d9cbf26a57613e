package io.natator.picture;

/** Means over squares, repeated: near enough to a Gaussian. */
final class Smoothing {

    private Smoothing() {
    }

    /**
     * Replaces each value by the mean around it; beyond the edges are zeros.
     *
     * @param reach pixels to each side
     * @param times how often
     */
    static void smooth(float[] values, int width, int height, int reach, int times) {
        float[] line = new float[Math.max(width, height)];
        for (int i = 0; i < times; i++) {
            for (int row = 0; row < height; row++) {
                along(values, row * width, 1, width, reach, line);
            }
            for (int column = 0; column < width; column++) {
                along(values, column, width, height, reach, line);
            }
        }
    }

    private static void along(float[] values, int start, int step, int count, int reach, float[] line) {
        double sum = 0;
        for (int i = 0; i < Math.min(reach, count); i++) {
            sum += values[start + i * step];
        }
        for (int i = 0; i < count; i++) {
            if (i + reach < count) {
                sum += values[start + (i + reach) * step];
            }
            if (i - reach - 1 >= 0) {
                sum -= values[start + (i - reach - 1) * step];
            }
            line[i] = (float) (sum / (2 * reach + 1));
        }
        for (int i = 0; i < count; i++) {
            values[start + i * step] = line[i];
        }
    }
}
