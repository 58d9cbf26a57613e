package io.natator.kinematics;

/**
 * How real fish swim: z(x, t) = a(x) sin(k x − 2π f t) (thesis eq. 2.12), with x from the head on. All lengths are
 * relative to the body length L; the thesis' 0.1 exp(x − 1), which is not, is taken as 0.1 L exp(x/L − 1).
 */
public enum FishMode {
    /** The whole body waves, as an eel's. */
    ANGUILLIFORM("anguilliform", 9.8) {
        @Override
        double relativeAmplitude(double share, double frequency) {
            return 0.1 * Math.exp(share - 1);
        }
    },
    /** The rear half waves, as a mackerel's. */
    CARANGIFORM("carangiform", 7.0) {
        @Override
        double relativeAmplitude(double share, double frequency) {
            return frequency * (0.004 - 0.02 * share + 0.04 * share * share);
        }
    },
    /** Little but the tail fin waves, as a tuna's. */
    THUNNIFORM("thunniform", 5.7) {
        @Override
        double relativeAmplitude(double share, double frequency) {
            return 0.02 - 0.12 * share + 0.2 * share * share;
        }
    };

    private final String label;
    private final double waveNumber;

    FishMode(String label, double waveNumber) {
        this.label = label;
        this.waveNumber = waveNumber;
    }

    /** Its name in tables and pictures. */
    public String label() {
        return label;
    }

    abstract double relativeAmplitude(double share, double frequency);

    /**
     * a(x), the envelope.
     *
     * @param x         distance from the head, 0 to {@code length}
     * @param length    of the body, above 0
     * @param frequency of the beat, in 1/s; scales the carangiform amplitude
     * @return a length
     */
    public double amplitude(double x, double length, double frequency) {
        return length * relativeAmplitude(x / length, frequency);
    }

    /** z(x, t): the sideways place of the spine; parameters as in {@link #amplitude}, time in seconds. */
    public double lateral(double x, double time, double length, double frequency) {
        return amplitude(x, length, frequency)
                * Math.sin(waveNumber * x / length - 2 * Math.PI * frequency * time);
    }
}
