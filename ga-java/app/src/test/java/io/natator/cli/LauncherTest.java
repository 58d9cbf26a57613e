package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

/** The script {@code natator}, which starts this program: how it says that it was called. Its Java only tells its arguments. */
class LauncherTest {

    private static final Path SCRIPT =
            Path.of(System.getProperty("natator.protocol"), "../cli/natator.sh").normalize();

    @TempDir
    private Path folder;

    @BeforeEach
    void programs() throws IOException {
        Path launcher = Files.copy(SCRIPT, folder.resolve("natator"), StandardCopyOption.REPLACE_EXISTING);
        Path java = Files.writeString(folder.resolve("java"), "#!/bin/sh\necho \"$1\"\n");
        assertThat(launcher.toFile().setExecutable(true) && java.toFile().setExecutable(true)).isTrue();
        Files.createFile(folder.resolve("natator.jar"));
    }

    private String said(String command) throws IOException, InterruptedException {
        ProcessBuilder builder = new ProcessBuilder("sh", "-c", command).directory(folder.toFile()).redirectErrorStream(true);
        builder.environment().put("PATH", folder + ":" + System.getenv("PATH"));
        builder.environment().put("NATATOR_JAR", folder.resolve("natator.jar").toString());
        builder.environment().remove("JAVA_HOME");
        Process process = builder.start();
        String said = new String(process.getInputStream().readAllBytes(), StandardCharsets.UTF_8);
        process.waitFor();
        return said.strip();
    }

    @Test
    void byNameOnThePathItIsItsName() throws IOException, InterruptedException {
        assertThat(said("natator new scene minnow")).isEqualTo("-Dnatator.command=natator");
    }

    @Test
    void byAPathItIsThatPath() throws IOException, InterruptedException {
        assertThat(said("./natator new scene minnow")).isEqualTo("-Dnatator.command=./natator");
    }
}
