package io.natator.study.cluster;

/**
 * What is assumed of a cluster. Times in seconds.
 *
 * @param perPart        of the driver for each part of a generation, one after another: a task of Spark
 * @param perEvaluation  of the driver for each evaluation: request, result and log
 * @param latency        from the driver to an executor and back
 * @param perGeneration  of the driver between two generations: breeding, logs, the checkpoint
 * @param failuresPerHour of an executor; its part is lost with it
 * @param restart        until a failed executor is back
 * @param slowShare      share of executors that are slow
 * @param slowFactor     how many times as long evaluations take there
 * @param speculation    whether what takes three times the median, and 10 s, after nine tenths of a generation, is begun
 *                       a second time on an idle executor; the first to end counts
 */
public record Assumptions(double perPart, double perEvaluation, double latency, double perGeneration, double failuresPerHour, double restart,
        double slowShare, double slowFactor, boolean speculation) {

    /** Nothing takes time but evaluations, and nothing fails. */
    public static final Assumptions IDEAL = new Assumptions(0, 0, 0, 0, 0, 0, 0, 1, false);

    /** With other times of the driver for parts and evaluations. */
    public Assumptions withDriver(double newPerPart, double newPerEvaluation) {
        return new Assumptions(newPerPart, newPerEvaluation, latency, perGeneration, failuresPerHour, restart, slowShare, slowFactor, speculation);
    }

    /** With executors that are otherwise slow. */
    public Assumptions withSlowFactor(double factor) {
        return new Assumptions(perPart, perEvaluation, latency, perGeneration, failuresPerHour, restart, slowShare, factor, speculation);
    }

    /** With or without second tries of what is slow. */
    public Assumptions withSpeculation(boolean on) {
        return new Assumptions(perPart, perEvaluation, latency, perGeneration, failuresPerHour, restart, slowShare, slowFactor, on);
    }
}
