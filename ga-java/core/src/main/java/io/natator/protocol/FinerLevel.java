package io.natator.protocol;

import io.natator.base.InvalidInputException;
import java.util.Arrays;
import java.util.stream.Collectors;

/** The smaller steps by which {@code natator-sim converge} can run a swim. */
public enum FinerLevel {
    /** Twice the substeps. */
    HALF_STEP("time/2", "half the time step"),
    /** Four times the substeps. */
    QUARTER_STEP("time/4", "a quarter of the time step"),
    /** Eight times the particles. */
    HALF_SPACING("spacing/2", "half the spacing"),
    /** Twice the substeps and eight times the particles. */
    HALF_BOTH("both/2", "half of both");

    private final String label;
    private final String words;

    FinerLevel(String label, String words) {
        this.label = label;
        this.words = words;
    }

    /** The name that the simulator knows it by. */
    public String label() {
        return label;
    }

    /** What it is, for people. */
    public String words() {
        return words;
    }

    /**
     * That of a name.
     *
     * @throws InvalidInputException if there is none
     */
    public static FinerLevel of(String label) {
        return Arrays.stream(values()).filter(one -> one.label.equals(label)).findFirst()
                .orElseThrow(() -> new InvalidInputException(label + " is no level; expected one of "
                        + Arrays.stream(values()).map(FinerLevel::label).collect(Collectors.joining(", "))));
    }
}
