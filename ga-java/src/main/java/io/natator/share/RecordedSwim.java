package io.natator.share;

import io.natator.stream.StreamFrame;
import io.natator.stream.StreamScene;
import java.util.List;

/**
 * A swim with all its frames.
 *
 * @param title  what it is called in a choice of swims
 * @param scene  what stays the same
 * @param json   the scene as the simulator wrote it
 * @param frames from the settled start on, at equal times; at least one, with positions and densities
 */
public record RecordedSwim(String title, StreamScene scene, String json, List<StreamFrame> frames) {

    /** Copies the list. */
    public RecordedSwim {
        frames = List.copyOf(frames);
    }
}
