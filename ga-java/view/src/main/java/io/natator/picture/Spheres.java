package io.natator.picture;

import java.util.Arrays;

/**
 * Spheres drawn with {@value #FINER} times the pixels each way: of every fine pixel the nearest sphere, shaded by its
 * normal and darkened in the gaps between spheres.
 */
final class Spheres {

    static final int FINER = 2;
    private static final int NONE = -1;
    /** From the upper left, before the picture. */
    private static final double[] LIGHT = unit(-0.45, 0.75, 0.62);
    private static final double[] HALFWAY = unit(LIGHT[0], LIGHT[1], LIGHT[2] + 1);
    private static final double AMBIENT = 0.42;
    private static final double GLOSS = 0.22;
    private static final double SHININESS = 28;
    /** Of a pixel as far behind its surroundings as a radius. */
    private static final double OCCLUSION = 0.85;

    private final int width;
    private final int height;
    private final float[] depth;
    private final int[] nearest;
    private final double[] x;
    private final double[] y;
    private final double[] radius;
    private final float[][] colour;
    private int count;

    /** A picture of so many pixels without any sphere yet, of which there will be so many at most. */
    Spheres(int width, int height, int most) {
        this.width = FINER * width;
        this.height = FINER * height;
        depth = new float[this.width * this.height];
        nearest = new int[depth.length];
        Arrays.fill(depth, Float.NEGATIVE_INFINITY);
        Arrays.fill(nearest, NONE);
        x = new double[most];
        y = new double[most];
        radius = new double[most];
        colour = new float[most][];
    }

    /** One more, of which all is in pixels; its colour is linear red, green, blue. */
    void add(double centreX, double centreY, double centreDepth, double size, float[] shade) {
        int number = count++;
        x[number] = centreX * FINER;
        y[number] = centreY * FINER;
        double r = size * FINER;
        radius[number] = r;
        colour[number] = shade;
        int top = (int) Math.max(0, Math.ceil(y[number] - r));
        int bottom = (int) Math.min(height - 1, Math.floor(y[number] + r));
        for (int row = top; row <= bottom; row++) {
            double dy = row - y[number];
            double half = Math.sqrt(Math.max(0, r * r - dy * dy));
            int end = (int) Math.min(width - 1, Math.floor(x[number] + half));
            for (int column = (int) Math.max(0, Math.ceil(x[number] - half)); column <= end; column++) {
                double dx = column - x[number];
                float front = (float) (centreDepth * FINER + Math.sqrt(Math.max(0, r * r - dx * dx - dy * dy)));
                int at = row * width + column;
                if (front > depth[at]) {
                    depth[at] = front;
                    nearest[at] = number;
                }
            }
        }
    }

    /** Depth of each pixel's nearest sphere; minus infinity where there is none. */
    float[] depths() {
        float[] coarse = new float[depth.length / (FINER * FINER)];
        Arrays.fill(coarse, Float.NEGATIVE_INFINITY);
        for (int row = 0; row < height; row++) {
            for (int column = 0; column < width; column++) {
                int at = row / FINER * (width / FINER) + column / FINER;
                coarse[at] = Math.max(coarse[at], depth[row * width + column] / FINER);
            }
        }
        return coarse;
    }

    /** Linear red, green, blue and coverage of each pixel, the colours times the coverage. */
    float[] shaded() {
        float[] pixels = new float[depth.length / (FINER * FINER) * 4];
        if (count == 0) {
            return pixels;
        }
        float[] surroundings = surroundings();
        float share = 1f / (FINER * FINER);
        for (int row = 0; row < height; row++) {
            for (int column = 0; column < width; column++) {
                int at = row * width + column;
                if (nearest[at] == NONE) {
                    continue;
                }
                int out = 4 * (row / FINER * (width / FINER) + column / FINER);
                int number = nearest[at];
                double hidden = Math.max(0, surroundings[at] - depth[at]) / radius[number];
                double open = 1 / (1 + OCCLUSION * hidden * 2);
                double nx = (column - x[number]) / radius[number];
                double ny = -(row - y[number]) / radius[number];
                double nz = Math.sqrt(Math.max(0, 1 - nx * nx - ny * ny));
                double facing = Math.max(0, nx * LIGHT[0] + ny * LIGHT[1] + nz * LIGHT[2]);
                double sky = 0.75 + 0.25 * ny;
                double light = (AMBIENT * sky + (1 - AMBIENT) * facing) * open * 1.25;
                double shine = GLOSS * open
                        * Math.pow(Math.max(0, nx * HALFWAY[0] + ny * HALFWAY[1] + nz * HALFWAY[2]), SHININESS);
                for (int channel = 0; channel < 3; channel++) {
                    pixels[out + channel] += share * (float) Math.min(1, light * colour[number][channel] + shine);
                }
                pixels[out + 3] += share;
            }
        }
        return pixels;
    }

    /** Mean depth of the spheres' surface about each pixel that has one. */
    private float[] surroundings() {
        double largest = 0;
        for (int i = 0; i < count; i++) {
            largest = Math.max(largest, radius[i]);
        }
        float[] mean = new float[depth.length];
        float[] weight = new float[depth.length];
        for (int at = 0; at < depth.length; at++) {
            if (nearest[at] != NONE) {
                mean[at] = depth[at];
                weight[at] = 1;
            }
        }
        int reach = (int) Math.max(1, Math.round(0.8 * largest));
        Smoothing.smooth(mean, width, height, reach, 2);
        Smoothing.smooth(weight, width, height, reach, 2);
        for (int at = 0; at < mean.length; at++) {
            mean[at] = weight[at] > 0 ? mean[at] / weight[at] : Float.NEGATIVE_INFINITY;
        }
        return mean;
    }

    private static double[] unit(double x, double y, double z) {
        double length = Math.sqrt(x * x + y * y + z * z);
        return new double[] {x / length, y / length, z / length};
    }
}
