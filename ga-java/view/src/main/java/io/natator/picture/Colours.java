package io.natator.picture;

/** Colours in linear light, red, green, blue from 0 to 1, in which they may be mixed. */
final class Colours {

    private Colours() {
    }

    /** Of sRGB values from 0 to 255. */
    static float[] linear(int red, int green, int blue) {
        return new float[] {linear(red), linear(green), linear(blue)};
    }

    static float linear(int value) {
        double share = value / 255.0;
        return (float) (share <= 0.04045 ? share / 12.92 : Math.pow((share + 0.055) / 1.055, 2.4));
    }

    /** The sRGB value from 0 to 255. */
    static int srgb(double linear) {
        double share = Math.min(1, Math.max(0, linear));
        return (int) Math.round(255 * (share <= 0.0031308 ? 12.92 * share : 1.055 * Math.pow(share, 1 / 2.4) - 0.055));
    }

    /** A mixture: `share` of the second. */
    static float[] mixed(float[] one, float[] other, double share) {
        float[] mixed = new float[one.length];
        for (int channel = 0; channel < one.length; channel++) {
            mixed[channel] = (float) (one[channel] + share * (other[channel] - one[channel]));
        }
        return mixed;
    }
}
