package io.natator.config;

import io.natator.base.InvalidInputException;

/** What a number that the user gives may be; far above all use, so that a slip of the keyboard is refused at once. */
public final class Limits {

    /** Evaluations, or runs, at the same time. */
    public static final int AT_ONCE = 1024;
    /** Chromosomes of a generation. */
    public static final int POPULATION = 100_000;
    /** Actuators of a creature. */
    public static final int ACTUATORS = 100_000;
    /** Runs of a gait, each from a start of its own. */
    public static final int STARTS = 1000;
    /** Seeds, or repetitions, of a study. */
    public static final int REPETITIONS = 10_000;
    /** A simulated time, in seconds, as the native program has it. */
    public static final double DURATION = 1e6;
    /** A line of a file, in bytes; a request may have as many. */
    public static final int LINE_BYTES = 16 << 20;
    /** A file that is read as a whole, unpacked, in bytes. */
    public static final int FILE_BYTES = 1 << 30;
    /** A time by the clock, three years in seconds. */
    public static final double SECONDS = 1e8;

    private Limits() {
    }

    /**
     * Checks a whole number.
     *
     * @param name as the user knows it
     * @throws InvalidInputException if it is below 1 or above the limit
     */
    public static void checkCount(String name, long value, long most) {
        if (value < 1 || value > most) {
            throw new InvalidInputException(name + " is " + value + "; expected a whole number from 1 to " + most);
        }
    }

    /**
     * Checks a number of starts of which a scatter is told.
     *
     * @throws InvalidInputException if it is not from 2 to {@link #STARTS}
     */
    public static void checkSeveralStarts(String name, int value) {
        if (value < 2 || value > STARTS) {
            throw new InvalidInputException(name + " is " + value + "; expected a whole number from 2 to " + STARTS);
        }
    }

    /**
     * Checks a simulated time.
     *
     * @throws InvalidInputException if it is not above 0, or beyond {@link #DURATION}
     */
    public static void checkDuration(String name, double value) {
        if (!(value > 0 && value <= DURATION)) {
            throw new InvalidInputException(
                    name + " is " + value + "; expected a number of seconds above 0, up to " + (long) DURATION);
        }
    }

    /**
     * Checks a time by the clock.
     *
     * @throws InvalidInputException if it is not above 0, or beyond {@link #SECONDS}
     */
    public static void checkSeconds(String name, double value) {
        if (!(value > 0 && value <= SECONDS)) {
            throw new InvalidInputException(name + " is " + value + "; expected a number of seconds above 0"
                    + (value > SECONDS ? ", up to " + (long) SECONDS : ""));
        }
    }

    /** Refuses a setting that is not as expected. */
    static void require(boolean valid, String name, Object value, String expected) {
        if (!valid) {
            throw new InvalidInputException(name + " is " + value + "; expected " + expected);
        }
    }
}
