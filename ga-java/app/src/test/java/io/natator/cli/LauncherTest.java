package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.process.FakeSimulator;
import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** The script {@code natator}, which starts this program: how it says that it was called. Its Java only tells its arguments. */
class LauncherTest {

    private static final Path SCRIPT = Path.of(System.getProperty("natator.protocol"), "../cli/natator.sh").normalize();

    @TempDir
    private Path folder;

    @BeforeEach
    void programs() throws IOException {
        FakeSimulator.program(folder.resolve("natator"), Files.readString(SCRIPT));
        FakeSimulator.program(folder.resolve("java"), "#!/bin/sh\necho \"$1\"\n");
        Files.createFile(folder.resolve("natator.jar"));
    }

    private String said(String command) throws IOException, InterruptedException {
        ProcessBuilder builder = new ProcessBuilder("sh", "-c", command).directory(folder.toFile())
                .redirectErrorStream(true);
        builder.environment().put("PATH", folder + ":" + System.getenv("PATH"));
        builder.environment().put("NATATOR_JAR", folder.resolve("natator.jar").toString());
        builder.environment().remove("JAVA_HOME");
        Process process = builder.start();
        String said = new String(process.getInputStream().readAllBytes(), StandardCharsets.UTF_8);
        process.waitFor();
        return said.strip();
    }

    /** A name on the PATH, or a path. */
    @ParameterizedTest
    @ValueSource(strings = {"natator", "./natator"})
    void itSaysHowItWasCalled(String name) throws IOException, InterruptedException {
        assertThat(said(name + " new scene minnow")).isEqualTo("-Dnatator.command=" + name);
    }

    @Test
    void aWorkingDirectoryThatIsGoneIsTold() throws IOException, InterruptedException {
        assertThat(said("mkdir gone; cd gone; rmdir ../gone; natator show run; echo $?"))
                .endsWith("natator: the working directory is no longer there: go to another one by cd\n1");
    }

    /** As under cron and in containers, and where the locale is not installed. */
    @ParameterizedTest
    @ValueSource(strings = {"C", "POSIX", "xx_XX.UTF-8", ""})
    void namesOfFilesNeedNoLocale(String locale) throws IOException, InterruptedException {
        String java = Path.of(System.getProperty("java.home"), "bin", "java").toString();
        Files.writeString(folder.resolve("java"),
                "#!/bin/sh\nexec '" + java + "' -XshowSettings:properties -version 2>&1\n");

        assertThat(said("unset LANG LC_CTYPE; LC_ALL=" + locale + " ./natator show run"))
                .contains("sun.jnu.encoding = UTF-8");
    }

    @Test
    void aLocaleThatKnowsMoreThanAsciiIsKept() throws IOException, InterruptedException {
        Files.writeString(folder.resolve("java"), "#!/bin/sh\necho \"$LC_ALL\"\n");
        FakeSimulator.program(folder.resolve("locale"), "#!/bin/sh\necho ISO-8859-1\n");

        assertThat(said("LC_ALL=de_DE ./natator show run")).isEqualTo("de_DE");
    }
}
