package io.natator.export;

import io.natator.config.InvalidInputException;
import java.io.IOException;
import java.io.InputStream;
import java.lang.ProcessBuilder.Redirect;
import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.List;

/**
 * A Python whose packages do what has no good library in Java.
 *
 * @param program as on the command line
 */
public record Python(String program) {

    private static final String QUIET = "import signal; signal.signal(signal.SIGINT, signal.SIG_DFL)\n";

    /**
     * Fails early where a package is missing.
     *
     * @param option  that needs it, for messages
     * @param module  to be imported
     * @param pypiName its name on PyPI
     * @throws InvalidInputException if there is no such program, or it lacks the package
     */
    void require(String option, String module, String pypiName) throws InterruptedException {
        Process process;
        try {
            process = new ProcessBuilder(program, "-c", "import " + module).redirectOutput(Redirect.DISCARD)
                    .redirectError(Redirect.DISCARD).start();
            process.getOutputStream().close();
        } catch (IOException e) {
            throw new InvalidInputException(option + " needs Python, and " + program
                    + " cannot be started; name another by --python", e);
        }
        try {
            if (process.waitFor() != 0) {
                throw new InvalidInputException(option + " needs the Python package " + pypiName + ", which " + program
                        + " cannot import: pip install " + pypiName + ", or name another Python by --python");
            }
        } finally {
            process.destroyForcibly();
        }
    }

    /** Starts a script that lies beside this class. Ctrl-C, which reaches it too, ends it without a word. */
    Process start(String script, String... arguments) throws IOException {
        String text;
        try (InputStream in = Python.class.getResourceAsStream(script)) {
            text = new String(in.readAllBytes(), StandardCharsets.UTF_8);
        }
        List<String> command = new ArrayList<>(List.of(program, "-c", QUIET + text));
        command.addAll(List.of(arguments));
        return new ProcessBuilder(command).redirectError(Redirect.INHERIT).start();
    }

    /** Runs a script to its end. */
    void run(String script, String... arguments) throws IOException {
        Process process = start(script, arguments);
        try {
            process.getOutputStream().close();
            int status = process.waitFor();
            if (status != 0) {
                throw new IOException(script + ": exit status " + status);
            }
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw new IOException(script + ": interrupted", e);
        } finally {
            process.destroyForcibly();
        }
    }
}
