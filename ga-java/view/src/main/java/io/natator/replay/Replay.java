package io.natator.replay;

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
 * @param verdict whether it swims, in words, or null
 */
public record Replay(String title, StreamScene scene, String json, List<StreamFrame> frames,
        String verdict) {

    /** Copies the list. */
    public Replay {
        frames = List.copyOf(frames);
    }

    /** A swim that nobody has judged. */
    public Replay(String title, StreamScene scene, String json, List<StreamFrame> frames) {
        this(title, scene, json, frames, null);
    }
}
