package io.natator.simulator;

import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.InputStream;
import java.nio.charset.StandardCharsets;

/** The end of what a program writes to standard error. */
public final class ErrorTail {

    private static final int KEPT_BYTES = 4096;

    private ErrorTail() {
    }

    /**
     * Reads to the end of the stream, which is then closed; the last few kilobytes as one line.
     *
     * @throws IOException if the stream cannot be read
     */
    public static String read(InputStream stderr) throws IOException {
        try (stderr) {
            ByteArrayOutputStream kept = new ByteArrayOutputStream();
            byte[] buffer = new byte[KEPT_BYTES];
            for (int count = stderr.read(buffer); count >= 0; count = stderr.read(buffer)) {
                if (kept.size() + count > 2 * KEPT_BYTES) {
                    kept.reset();
                }
                kept.write(buffer, 0, count);
            }
            return kept.toString(StandardCharsets.UTF_8).strip().replaceAll("\\s*\\R\\s*", " | ");
        }
    }
}
