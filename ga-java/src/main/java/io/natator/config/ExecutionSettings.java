package io.natator.config;

import java.nio.file.Path;
import java.time.Duration;

/**
 * How an evolution is carried out; none of it changes the outcome.
 *
 * @param simulator the {@code natator-sim} program
 * @param workers   evaluations at the same time, at least 1
 * @param timeout   longest time for one attempt at an evaluation
 */
public record ExecutionSettings(Path simulator, int workers, Duration timeout) {

    /**
     * Checks the ranges.
     *
     * @throws InvalidInputException naming the setting that is out of range
     */
    public ExecutionSettings {
        if (workers < 1) {
            throw new InvalidInputException("workers is " + workers + "; expected a whole number from 1");
        }
        if (timeout.isNegative() || timeout.isZero()) {
            throw new InvalidInputException("timeout is " + timeout.toMillis() / 1000.0
                    + "; expected a number of seconds above 0");
        }
    }
}
