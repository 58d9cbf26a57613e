package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.io.TempDir;

/** Commands of {@code natator}, and what they print. */
abstract class CommandTest {

    static final Path SIMULATOR = Path.of(System.getProperty("natator.simulator")).normalize();

    @TempDir
    Path folder;
    final StringWriter out = new StringWriter();
    final StringWriter err = new StringWriter();

    /** Runs a command as it is. */
    int execute(String... arguments) {
        return Main.commandLine().setOut(new PrintWriter(out, true)).setErr(new PrintWriter(err, true))
                .execute(arguments);
    }

    /** Runs a command with the real simulator. */
    int natator(String... arguments) {
        return with(SIMULATOR, arguments);
    }

    /** Runs a command, which comes first, with a simulator. */
    int with(Path simulator, String... arguments) {
        List<String> all = new ArrayList<>(List.of(arguments));
        if (!arguments[0].equals("show")) {
            all.addAll(1, List.of("--simulator-path", simulator.toString()));
        }
        return execute(all.toArray(String[]::new));
    }

    int execute(List<String> arguments) {
        return execute(arguments.toArray(String[]::new));
    }

    int natator(List<String> arguments) {
        return natator(arguments.toArray(String[]::new));
    }

    /** Fails unless a command succeeded. */
    void ok(int status) {
        assertThat(status).as(err.toString()).isZero();
    }

    /** A path in the test's folder. */
    String path(String name) {
        return folder.resolve(name).toString();
    }

    /** Forgets what was printed so far. */
    void forget() {
        out.getBuffer().setLength(0);
        err.getBuffer().setLength(0);
    }

    String file(String runName, String name) throws IOException {
        return Files.readString(folder.resolve(runName).resolve(name));
    }
}
