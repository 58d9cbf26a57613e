package io.natator.encoding;

import com.fasterxml.jackson.annotation.JsonInclude;
import io.natator.base.Numbers;
import java.util.Collections;
import java.util.List;
import java.util.Objects;

/**
 * How a creature moves its muscles (thesis 2.5, eq. 2.6): u(t) = sin(2π(f t + φ)) for each actuator. The JSON form is
 * the {@code gait} of {@code sim-native/protocol/request.schema.json}.
 *
 * @param frequency f in 1/s, one for all actuators; evolution stays within [0.5, 2]
 * @param amplitude a per actuator, the head's first, without unit; evolution stays within [0, 1]
 * @param phase     φ per actuator in the same order, in periods, within [0, 1]
 * @param power     p of thesis 4.2 within [0.5, 4], or null for the plain sine
 * @param offset    what drives the muscles beside the beat, per actuator, above 0 to the left; null for none
 */
@JsonInclude(JsonInclude.Include.NON_NULL)
public record Gait(double frequency, List<Double> amplitude, List<Double> phase, Double power, List<Double> offset) {

    /**
     * Copies the lists.
     *
     * @throws IllegalArgumentException if there are not as many phases as amplitudes, or offsets but not as many
     */
    public Gait {
        Objects.requireNonNull(amplitude, "amplitude");
        Objects.requireNonNull(phase, "phase");
        if (amplitude.size() != phase.size()) {
            throw new IllegalArgumentException("gait has " + Numbers.count(amplitude.size(), "amplitude") + " and "
                    + Numbers.count(phase.size(), "phase") + "; expected as many of both");
        }
        if (offset != null && offset.size() != amplitude.size()) {
            throw new IllegalArgumentException("gait has " + Numbers.count(amplitude.size(), "amplitude") + " and "
                    + Numbers.count(offset.size(), "offset") + "; expected as many of both, or no offsets");
        }
        offset = offset == null ? null : List.copyOf(offset);
        amplitude = List.copyOf(amplitude);
        phase = List.copyOf(phase);
    }

    /** A gait that follows the plain sine and goes straight on. */
    public Gait(double frequency, List<Double> amplitude, List<Double> phase) {
        this(frequency, amplitude, phase, null, null);
    }

    /** Muscles that do nothing. */
    public Gait resting() {
        return new Gait(frequency, Collections.nCopies(actuators(), 0.0), phase, power, null);
    }

    /**
     * Left and right exchanged: all muscles half a period later, which is the mirror image of a plain sine, and offsets to
     * the other side.
     */
    public Gait mirrored() {
        return new Gait(frequency, amplitude, phase.stream().map(one -> one < 0.5 ? one + 0.5 : one - 0.5).toList(),
                power, offset == null ? null : offset.stream().map(one -> -one).toList());
    }

    /** This gait with all actuators driven so far to one side beside their beat. */
    public Gait steered(double toOneSide) {
        return new Gait(frequency, amplitude, phase, power, Collections.nCopies(actuators(), toOneSide));
    }

    /** Number of actuators that this gait drives. */
    public int actuators() {
        return amplitude.size();
    }
}
