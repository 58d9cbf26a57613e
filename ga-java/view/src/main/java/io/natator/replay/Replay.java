package io.natator.replay;

import io.natator.stream.StreamFrame;
import io.natator.stream.StreamScene;
import java.nio.ByteBuffer;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

/**
 * A swim with all its frames.
 *
 * @param title  what it is called in a choice of swims
 * @param scene  what stays the same
 * @param json   the scene as the simulator wrote it
 * @param frames from the settled start on, at equal times; at least one, with positions and densities
 * @param waters bodies of {@code WATR}, of some of the frames; empty where the water is not shown by its flow
 * @param facts  what is known of how it swims, in words, by what it is about; empty where nobody judged it
 */
public record Replay(String title, StreamScene scene, String json, List<StreamFrame> frames, List<ByteBuffer> waters,
        Map<String, String> facts) {

    /** Copies lists and map. */
    public Replay {
        frames = List.copyOf(frames);
        waters = List.copyOf(waters);
        facts = Collections.unmodifiableMap(new LinkedHashMap<>(facts));
    }

    /** The same swim with another title, and what is known of it. */
    public Replay with(String newTitle, Map<String, String> newFacts) {
        return new Replay(newTitle, scene, json, frames, waters, newFacts);
    }
}
