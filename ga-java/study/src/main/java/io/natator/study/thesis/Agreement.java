package io.natator.study.thesis;

import java.util.Collection;
import java.util.Collections;
import java.util.Comparator;

/**
 * Whether evolutions of one creature in one water, each from a seed of its own, found equally fast swimmers.
 *
 * @param speeds of their winners; at least one
 */
record Agreement(Collection<Speed> speeds) {

    private static final Comparator<Speed> BY_MEAN = Comparator.comparingDouble(Speed::mean);

    /** The largest mean less the least one, in scene units per second. */
    double apart() {
        return Collections.max(speeds, BY_MEAN).mean() - Collections.min(speeds, BY_MEAN).mean();
    }

    /** Whether the fastest and the slowest are no further apart than the larger error of these two. */
    boolean holds() {
        return apart() <= Math.max(Collections.max(speeds, BY_MEAN).error(), Collections.min(speeds, BY_MEAN).error());
    }
}
