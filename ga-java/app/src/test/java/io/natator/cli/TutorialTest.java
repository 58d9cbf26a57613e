package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.JavaCommand;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

/** The tutorial's commands, run one after another in an empty folder with the real simulator; all that swims is cut short. */
@Timeout(value = 30, unit = TimeUnit.MINUTES)
class TutorialTest {

    private static final Path SIMULATOR = Path.of(System.getProperty("natator.simulator")).toAbsolutePath().normalize();
    private static final Path TUTORIAL = Path.of("../../sim-native/docs/tutorial.md");

    @TempDir
    private Path folder;

    @Test
    void itsCommandsDoWhatItSays() throws IOException, InterruptedException {
        List<String> commands = commands();
        assertThat(commands).hasSizeGreaterThanOrEqualTo(8);
        for (String command : commands) {
            if (command.startsWith("natator view ")) {
                showsUntilEnded(command + " --port 0 --no-browser");
            } else {
                runs(shorter(command));
            }
        }

        assertThat(folder.resolve("minnow.json")).isRegularFile();
        assertThat(folder.resolve("minnow-gait.json")).isRegularFile();
        assertThat(folder.resolve("runs/minnow/best.json")).isNotEmptyFile();
    }

    private static List<String> commands() throws IOException {
        List<String> commands = new ArrayList<>();
        boolean fenced = false;
        for (String line : Files.readAllLines(TUTORIAL)) {
            if (line.startsWith("```")) {
                fenced = !fenced;
            } else if (fenced && line.startsWith("natator")) {
                commands.add(line);
            }
        }
        return commands;
    }

    private static String shorter(String command) {
        return command.replace("--duration 2", "--duration 0.2").replace("--population 12 --generations 3",
                "--population 3 --generations 1 --starts 1").replace("natator check", "natator check --starts 2")
                .replace("natator converge", "natator converge --starts 2 --levels time/2");
    }

    private void runs(String command) throws IOException, InterruptedException {
        Process process = start(command);
        int status = process.waitFor();
        assertThat(status).as("%s: %s", command, said()).isZero();
    }

    /** Until it tells its address. */
    private void showsUntilEnded(String command) throws IOException, InterruptedException {
        Process process = start(command);
        while (process.isAlive() && !said().contains("http://")) {
            process.waitFor(20, TimeUnit.MILLISECONDS);
        }
        assertThat(process.isAlive()).as("%s: %s", command, said()).isTrue();
        process.destroy();
        process.waitFor();
    }

    private Process start(String command) throws IOException {
        List<String> words = new ArrayList<>(List.of(command.split(" +")));
        words.addAll(0, words.remove(0).equals("natator") ? JavaCommand.of(Main.class) : List.of(SIMULATOR.toString()));
        ProcessBuilder builder = new ProcessBuilder(words).directory(folder.toFile()).redirectErrorStream(true)
                .redirectOutput(folder.resolve("said.txt").toFile());
        builder.environment().put("NATATOR_SIM", SIMULATOR.toString());
        return builder.start();
    }

    private String said() throws IOException {
        return Files.readString(folder.resolve("said.txt"));
    }
}
