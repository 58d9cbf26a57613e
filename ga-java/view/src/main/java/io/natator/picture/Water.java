package io.natator.picture;

import java.util.Arrays;

/**
 * Water as one clear block: how much of it lies before each pixel's background and before its body takes light away, red
 * first; its front, smoothed, reflects some of the sky.
 */
final class Water {

    /** How far a particle is blurred, in spacings. */
    private static final double REACH = 1.1;
    /** Of the discs that make up its outline, and of the spheres of its front, in spacings. */
    private static final double OUTLINE = 0.85;
    /** Part of the smoothed discs' cover at which the outline is, so that it runs about half a spacing beyond particles. */
    private static final double EDGE = 0.68;
    private static final double FRONT = 0.85;
    /** Lost in the thickest water, in powers of e: red, green, blue. */
    private static final double[] ABSORBED = {1.05, 0.36, 0.13};
    /** Of that, what the swimmer loses: it is what the picture is about. */
    private static final double OF_SWIMMER = 0.45;
    /** Added to the thickness everywhere, in parts of the largest, so that an edge is seen. */
    private static final double THINNEST = 0.1;
    private static final float[] SCATTERED = Colours.linear(0x8f, 0xc4, 0xe6);
    private static final double SCATTERING = 0.22;
    private static final float[] SKY = Colours.linear(0xf2, 0xf9, 0xff);
    private static final double REFLECTION = 0.4;
    private static final double RELIEF = 0.1;
    private static final double THICKEST = 0.97;
    private static final double LEAST_SHARE = 0.25;

    private final int width;
    private final int height;
    private final double spacing;
    private final double upInPicture;
    private final double upToViewer;
    private final float[] body;
    private final float[] whole;
    private final float[] beforeBody;
    private final float[] outline;
    private final float[] front;
    private final float[] frontWeight;

    /**
     * Water without any particle yet.
     *
     * @param from    where it is seen from
     * @param body    depth of the body in each pixel, minus infinity where there is none
     * @param spacing of the particles at rest, pixels
     */
    Water(int width, int height, From from, float[] body, double spacing) {
        upInPicture = from.axis(1)[1];
        upToViewer = from.axis(2)[1];
        this.width = width;
        this.height = height;
        this.body = body;
        this.spacing = spacing;
        whole = new float[width * height];
        beforeBody = new float[width * height];
        outline = new float[width * height];
        front = new float[width * height];
        frontWeight = new float[width * height];
    }

    /** One more particle, by its place in pixels. */
    void add(double x, double y, double depth) {
        double reach = REACH * spacing;
        double disc = OUTLINE * spacing;
        double sphere = FRONT * spacing;
        double amount = spacing * spacing * spacing * 3 / (Math.PI * reach * reach);
        int bottom = (int) Math.min(height - 1, Math.floor(y + reach));
        int right = (int) Math.min(width - 1, Math.floor(x + reach));
        for (int row = (int) Math.max(0, Math.ceil(y - reach)); row <= bottom; row++) {
            for (int column = (int) Math.max(0, Math.ceil(x - reach)); column <= right; column++) {
                double squared = (column - x) * (column - x) + (row - y) * (row - y);
                double near = 1 - squared / (reach * reach);
                if (near <= 0) {
                    continue;
                }
                int at = row * width + column;
                float part = (float) (amount * near * near);
                whole[at] += part;
                if (depth > body[at]) {
                    beforeBody[at] += part;
                }
                if (squared < (disc + 1) * (disc + 1)) {
                    outline[at] = (float) Math.max(outline[at], Math.min(1, disc + 0.5 - Math.sqrt(squared)));
                }
                if (squared < sphere * sphere) {
                    float surface = (float) (depth + Math.sqrt(sphere * sphere - squared));
                    front[at] = frontWeight[at] > 0 ? Math.max(front[at], surface) : surface;
                    frontWeight[at] = 1;
                }
            }
        }
    }

    /**
     * Lays the water over a picture.
     *
     * @param behind  what is behind all of it, linear red, green, blue of each pixel; takes the result
     * @param swimmer {@link Spheres#shaded()}
     * @param inside  which part of each pixel is between the walls
     */
    void over(float[] behind, float[] swimmer, float[] inside) {
        makeOutline(inside);
        evenOut();
        double thickest = thickest();
        float[] sky = new float[whole.length];
        float[] relief = new float[whole.length];
        light(sky, relief);
        for (int at = 0; at < whole.length; at++) {
            double shown = outline[at];
            double all = shown * (THINNEST + whole[at] / thickest);
            double some = shown * OF_SWIMMER * Math.min(beforeBody[at], whole[at]) / thickest;
            double reflected = shown * REFLECTION * sky[at];
            double lit = 1 + RELIEF * relief[at] * shown;
            float covered = swimmer[4 * at + 3];
            for (int channel = 0; channel < 3; channel++) {
                double background = through(behind[3 * at + channel], 1, all, channel) * lit;
                double animal = through(swimmer[4 * at + channel], covered, some, channel);
                double seen = (1 - covered) * background + animal;
                behind[3 * at + channel] = (float) (seen + reflected * (SKY[channel] - seen));
            }
        }
    }

    /** Light of some pixel's part that has come through so much water, with what the water adds to it. */
    private static double through(double light, double covered, double thickness, int channel) {
        double left = Math.exp(-ABSORBED[channel] * thickness);
        double veil = SCATTERING * (1 - Math.exp(-thickness));
        return light * left * (1 - veil) + covered * veil * SCATTERED[channel];
    }

    /** A smooth line around the discs, without pinholes, within the walls. */
    private void makeOutline(float[] inside) {
        int reach = (int) Math.max(1, Math.round(0.3 * spacing));
        Smoothing.smooth(outline, width, height, reach, 2);
        double sharp = 0.9 * spacing;
        for (int row = 0; row < height; row++) {
            for (int column = 0; column < width; column++) {
                int at = row * width + column;
                boolean cut = row < 2 * reach || column < 2 * reach || row >= height - 2 * reach || column >= width - 2 * reach;
                double cover = cut && outline[at] > 0.2 ? 1 : (outline[at] - EDGE) * sharp + 0.5;
                outline[at] = (float) (inside[at] * Math.min(1, Math.max(0, cover)));
            }
        }
    }

    /** Takes the grain out of the thickness, and the fading towards the outline, where half of each blur finds no water. */
    private void evenOut() {
        int reach = (int) Math.max(1, Math.round(0.6 * spacing));
        float[] share = outline.clone();
        Smoothing.smooth(share, width, height, (int) Math.max(1, Math.round(0.45 * spacing)), 2);
        Smoothing.smooth(share, width, height, reach, 2);
        for (float[] thickness : new float[][] {whole, beforeBody}) {
            Smoothing.smooth(thickness, width, height, reach, 2);
            for (int at = 0; at < thickness.length; at++) {
                thickness[at] /= (float) Math.max(LEAST_SHARE, share[at]);
            }
        }
    }

    /** Nearly the largest thickness, pixels. */
    private double thickest() {
        float[] some = new float[whole.length];
        int count = 0;
        for (int at = 0; at < whole.length; at++) {
            if (outline[at] > 0) {
                some[count++] = whole[at];
            }
        }
        Arrays.sort(some, 0, count);
        return count == 0 ? 1 : Math.max(some[(int) (THICKEST * (count - 1))], spacing);
    }

    /** How much sky the smoothed front shows, which looks up and is seen at a low angle; and how far it is turned to the light. */
    private void light(float[] sky, float[] relief) {
        int reach = (int) Math.max(1, Math.round(0.6 * spacing));
        float[] weight = frontWeight.clone();
        Smoothing.smooth(front, width, height, reach, 3);
        Smoothing.smooth(weight, width, height, reach, 3);
        for (int at = 0; at < front.length; at++) {
            front[at] = weight[at] > 0 ? front[at] / weight[at] : 0;
        }
        for (int row = 1; row + 1 < height; row++) {
            for (int column = 1; column + 1 < width; column++) {
                int at = row * width + column;
                if (frontWeight[at] <= 0) {
                    continue;
                }
                double nx = -(front[at + 1] - front[at - 1]) / 2;
                double ny = (front[at + width] - front[at - width]) / 2;
                double length = Math.sqrt(nx * nx + ny * ny + 1);
                double up = (ny * upInPicture + upToViewer) / length;
                sky[at] = (float) (Math.max(0, up) * (1 - 1 / length));
                relief[at] = (float) ((ny - nx) / length);
            }
        }
    }
}
