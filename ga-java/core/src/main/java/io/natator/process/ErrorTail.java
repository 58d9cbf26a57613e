package io.natator.process;

import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.InputStream;
import java.nio.charset.StandardCharsets;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;
import java.util.function.Consumer;

/** Reads what a program writes to standard error, until it closes that, and keeps the end of it; to be run by a thread of its own. */
public final class ErrorTail implements Runnable {

    /** Stands between lines where all are one. */
    static final String LINE_END = " | ";
    /** At least so many of the last bytes are told, and up to twice as many. */
    static final int KEPT_BYTES = 4096;
    private static final long GRACE_MILLISECONDS = 5000;

    private final InputStream stderr;
    private final CompletableFuture<String> text = new CompletableFuture<>();

    /** Reads a program's standard error. */
    public ErrorTail(InputStream stderr) {
        this.stderr = stderr;
    }

    @Override
    public void run() {
        try {
            text.complete(read(stderr));
        } catch (IOException e) {
            text.completeExceptionally(e);
        }
    }

    /** What was written in the end; empty if it cannot be read, or does not end within five seconds. */
    public String text() throws InterruptedException {
        try {
            return text.get(GRACE_MILLISECONDS, TimeUnit.MILLISECONDS);
        } catch (ExecutionException | TimeoutException e) {
            return "";
        }
    }

    /**
     * Reads to the end of the stream, which is then closed; the last few kilobytes as one line.
     *
     * @throws IOException if the stream cannot be read
     */
    static String read(InputStream stderr) throws IOException {
        return read(stderr, line -> {
        });
    }

    /**
     * Reads to the end of the stream and passes on each line as it comes; longer lines in pieces of {@value #KEPT_BYTES} bytes.
     *
     * @throws IOException if the stream cannot be read
     */
    static String read(InputStream stderr, Consumer<String> lines) throws IOException {
        try (stderr) {
            ByteArrayOutputStream kept = new ByteArrayOutputStream();
            ByteArrayOutputStream line = new ByteArrayOutputStream();
            byte[] buffer = new byte[KEPT_BYTES];
            for (int count = stderr.read(buffer); count >= 0; count = stderr.read(buffer)) {
                kept.write(buffer, 0, count);
                trim(kept);
                for (int i = 0; i < count; i++) {
                    if (buffer[i] != '\n') {
                        line.write(buffer[i]);
                    }
                    if (buffer[i] == '\n' || line.size() == KEPT_BYTES) {
                        lines.accept(line.toString(StandardCharsets.UTF_8));
                        line.reset();
                    }
                }
            }
            if (line.size() > 0) {
                lines.accept(line.toString(StandardCharsets.UTF_8));
            }
            return kept.toString(StandardCharsets.UTF_8).strip().replaceAll("\\s*\\R\\s*", LINE_END);
        }
    }

    /** Drops what is not of the end, now and then. */
    private static void trim(ByteArrayOutputStream kept) {
        if (kept.size() > 2 * KEPT_BYTES) {
            byte[] all = kept.toByteArray();
            kept.reset();
            kept.write(all, all.length - KEPT_BYTES, KEPT_BYTES);
        }
    }
}
