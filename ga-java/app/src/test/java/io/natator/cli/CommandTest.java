package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.checkpoint.RunFiles;
import java.io.IOException;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.stream.Stream;
import org.assertj.core.api.AbstractStringAssert;
import org.junit.jupiter.api.io.TempDir;

/** Commands of {@code natator}, and what the last one printed. */
abstract class CommandTest {

    static final Path SIMULATOR = Path.of(System.getProperty("natator.simulator")).normalize();

    @TempDir
    Path folder;
    final StringWriter out = new StringWriter();
    final StringWriter err = new StringWriter();

    /** Runs a command as it is. */
    int execute(String... arguments) {
        out.getBuffer().setLength(0);
        err.getBuffer().setLength(0);
        return Main.commandLine().setOut(new PrintWriter(out, true)).setErr(new PrintWriter(err, true))
                .execute(arguments);
    }

    /** Runs a command with the real simulator. */
    int natator(String... arguments) {
        return with(SIMULATOR, arguments);
    }

    /** Runs a command, which comes first and may have words of its arguments with it, with a simulator. */
    int with(Path simulator, String... arguments) {
        List<String> all = new ArrayList<>(List.of(words(arguments)));
        if (!all.get(0).equals("show")) {
            all.addAll(1, List.of("--simulator-path", simulator.toString()));
        }
        return execute(all.toArray(String[]::new));
    }

    int natator(List<String> arguments) {
        return natator(arguments.toArray(String[]::new));
    }

    /** The words of the first, and the others as they are. */
    static String[] words(String... arguments) {
        return Stream.concat(Stream.of(arguments[0].split(" ")), Stream.of(arguments).skip(1)).toArray(String[]::new);
    }

    /** Fails unless two runs in the test's folder have files of the same bytes. */
    void assertSameRuns(String one, String other, String... more) {
        RunFiles.assertSame(folder.resolve(one), folder.resolve(other), more);
    }

    /** Fails unless a command succeeded; what it printed. */
    AbstractStringAssert<?> ok(int status) {
        assertThat(status).as(err.toString()).isZero();
        return assertThat(out.toString());
    }

    /** Fails unless a command was refused as bad input; what it said of that. */
    AbstractStringAssert<?> refused(int status) {
        assertThat(status).as(out.toString()).isEqualTo(2);
        return assertThat(err.toString());
    }

    /** A path in the test's folder. */
    String path(String name) {
        return folder.resolve(name).toString();
    }

    String file(String runName, String name) throws IOException {
        return Files.readString(folder.resolve(runName).resolve(name));
    }
}
