package io.natator.protocol;

/**
 * What a swim took, as measured up to its stop. These are totals, so that those of several runs can be added.
 *
 * @param beats    periods of the gait
 * @param lengths  body lengths along x, signed
 * @param distance the same in scene units, signed
 * @param work     of the muscles, in mass times length squared by seconds squared
 */
public record Effort(double beats, double lengths, double distance, double work) {

    /** With those of other runs of the same gait. */
    public Effort plus(Effort more) {
        return new Effort(beats + more.beats, lengths + more.lengths, distance + more.distance, work + more.work);
    }

    /** Beats for each body length of its way, forwards or backwards; infinite at rest. */
    public double beatsPerLength() {
        return beats / Math.abs(lengths);
    }

    /** Work by way, forwards or backwards, in mass times length by seconds squared; infinite or undefined at rest. */
    public double costOfTransport() {
        return work / Math.abs(distance);
    }
}
