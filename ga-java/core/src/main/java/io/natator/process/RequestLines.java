package io.natator.process;

import io.natator.protocol.ResultReader;
import java.io.IOException;
import java.io.OutputStream;
import java.nio.charset.StandardCharsets;
import java.util.concurrent.BlockingQueue;
import java.util.concurrent.LinkedBlockingQueue;
import java.util.function.Consumer;

/** What a program is to read from standard input. Running it writes that, until it is closed, for a thread of its own. */
final class RequestLines implements Runnable, AutoCloseable {

    private static final byte[] CLOSE = new byte[0];

    private final OutputStream stdin;
    private final Consumer<String> onFault;
    private final BlockingQueue<byte[]> lines = new LinkedBlockingQueue<>();

    /**
     * To a program's standard input.
     *
     * @param onFault told why nothing more will be written, unless the program does not read on
     */
    RequestLines(OutputStream stdin, Consumer<String> onFault) {
        this.stdin = stdin;
        this.onFault = onFault;
    }

    /** Adds whole lines. */
    void add(String text) {
        lines.add(text.getBytes(StandardCharsets.UTF_8));
    }

    @Override
    public void run() {
        try (stdin) {
            write();
        } catch (IOException e) {
            // The program has closed its input or has ended: what it answers, or does not, tells.
        }
    }

    private void write() throws IOException {
        try {
            for (byte[] bytes = lines.take(); bytes.length > 0; bytes = lines.take()) {
                stdin.write(bytes);
                stdin.flush();
            }
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        } catch (RuntimeException | Error e) {
            // Such as a lack of memory. Whoever waits for an answer is to be told at once, before the program finds its input at an end.
            onFault.accept("input not writable: " + ResultReader.shown(e.toString()));
        }
    }

    @Override
    public void close() {
        lines.add(CLOSE);
    }
}
