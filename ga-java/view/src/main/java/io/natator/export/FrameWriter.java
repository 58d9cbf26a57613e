package io.natator.export;

import io.natator.stream.StreamFrame;
import java.io.Closeable;
import java.io.IOException;

/** Writes a swim in one format, frame by frame; memory does not grow with their number. */
interface FrameWriter extends Closeable {

    /** Writes the next frame. */
    void frame(StreamFrame frame) throws IOException;

    /** Writes what can only be written after the last frame; then the files are whole. */
    void finish() throws IOException;

    /** Closes what is open, whether finished or not. */
    @Override
    void close() throws IOException;
}
