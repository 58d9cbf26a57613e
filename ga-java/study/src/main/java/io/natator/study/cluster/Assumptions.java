package io.natator.study.cluster;

/**
 * What is assumed of a cluster. Times in seconds.
 *
 * @param perEvaluation  of the driver for each evaluation, one after another: request, task and result
 * @param latency        from the driver to an executor and back
 * @param perGeneration  of the driver between two generations: breeding, logs, the checkpoint
 * @param failuresPerHour of an executor; its evaluation is lost with it
 * @param restart        until a failed executor is back
 * @param slowShare      share of executors that are slow
 * @param slowFactor     how many times as long an evaluation takes there
 * @param speculation    whether what takes three times the median, and 10 s, after nine tenths of a generation, is begun
 *                       a second time on an idle executor; the first to end counts
 */
public record Assumptions(double perEvaluation, double latency, double perGeneration, double failuresPerHour, double restart,
        double slowShare, double slowFactor, boolean speculation) {

    /** Nothing takes time but evaluations, and nothing fails. */
    public static final Assumptions IDEAL = new Assumptions(0, 0, 0, 0, 0, 0, 1, false);

    /** With another time of the driver for each evaluation. */
    public Assumptions withPerEvaluation(double seconds) {
        return new Assumptions(seconds, latency, perGeneration, failuresPerHour, restart, slowShare, slowFactor, speculation);
    }

    /** With executors that are otherwise slow. */
    public Assumptions withSlowFactor(double factor) {
        return new Assumptions(perEvaluation, latency, perGeneration, failuresPerHour, restart, slowShare, factor, speculation);
    }

    /** With or without second tries of what is slow. */
    public Assumptions withSpeculation(boolean on) {
        return new Assumptions(perEvaluation, latency, perGeneration, failuresPerHour, restart, slowShare, slowFactor, on);
    }
}
