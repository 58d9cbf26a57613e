package io.natator.body;

/** How many particles of a cubic lattice the simulator puts into a cross-section. All lengths are in spacings. */
final class CrossSection {

    /** Fewest spacings that count as two particles across. */
    static final double MIN_EXTENT = 1.5;
    /** Spacings by which a particle may lie outside. */
    private static final double ROUNDING = 1e-9;

    private CrossSection() {
    }

    /** Particles inside an ellipse of at least {@value #MIN_EXTENT} each way. */
    static int ellipse(double height, double width) {
        double area = Math.PI / 4 * height * width;
        boolean oddRows = isOdd(height);
        boolean[] columns = {isOdd(width), false};  // even ones only where odd ones do not fit
        for (boolean oddColumns : columns) {
            int one = particles(height, width, oddRows, oddColumns);
            int other = particles(height, width, !oddRows, oddColumns);
            if (one > 0 || other > 0) {
                return one > 0 && (other == 0 || Math.abs(other - area) >= Math.abs(one - area) - ROUNDING) ? one
                        : other;
            }
        }
        return 0;
    }

    /** Particles of a rectangle, as a fin has it. */
    static int plate(double height, double thickness) {
        return Math.max(1, (int) Math.round(height)) * Math.max(1, (int) Math.round(thickness));
    }

    private static boolean isOdd(double extent) {
        return Math.round(extent) % 2 != 0;
    }

    /** Particles of an ellipse with an odd or even number of rows and columns; 0 if it has fewer than two each way. */
    private static int particles(double height, double width, boolean oddRows, boolean oddColumns) {
        int rows = within(height / 2, oddRows);
        int filled = 0;
        int widest = 0;
        int sum = 0;
        for (int row = 0; row < rows; row++) {
            double y = (2 * row - (rows - 1)) / height;
            int count = within(width / 2 * Math.sqrt(Math.max(0, 1 - y * y)), oddColumns);
            filled += count > 0 ? 1 : 0;
            widest = Math.max(widest, count);
            sum += count;
        }
        return filled < 2 || widest < 2 ? 0 : sum;
    }

    /** Places at distances 0, 1, 2, … (odd) or 1/2, 3/2, … (even) from the middle, up to {@code half}. */
    private static int within(double half, boolean odd) {
        return odd ? 2 * (int) Math.floor(half + ROUNDING) + 1 : 2 * (int) Math.floor(half + 0.5 + ROUNDING);
    }
}
