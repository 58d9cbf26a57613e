package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.process.FakeSimulator;
import java.io.IOException;
import java.io.PrintWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.Arguments;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.MethodSource;
import org.junit.jupiter.params.provider.ValueSource;
import picocli.CommandLine;
import picocli.CommandLine.Command;

/** What can't be run is refused in one line with exit status 2, and nothing is written. */
class BadUsageTest extends FakeSimulatorTest {

    @Test
    void aMissingGpuIsOneLine() {
        assertThat(evolve("run", "--backend", "cuda")).isEqualTo(1);
        assertThat(err.toString().strip()).isEqualTo("natator evolve: simulator: no such device here");
        assertThat(folder.resolve("run")).doesNotExist();
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {
            "compare|natator compare: RUN requires at least 2 values, but none were specified; see natator compare --help",
            "compare NEVER|natator compare: RUN requires at least 2 values, but only 1 were specified: [",
            "compare NEVER NEVER --rank-starts 0|--rank-starts is 0; expected a whole number from 1 to 1000",
            "compare NEVER NEVER --rank-starts 2|--rank-starts goes with --json; give both",
            "compare NEVER NEVER --force|--force goes with --json; give both",
            "compare NEVER NEVER --starts 0 --json NEVER|--json goes without --starts 0; leave one of them out",
            "evolve --output-dir NEVER --seeds 100000|--seeds is 100000; expected a whole number from 1 to 10000",
            "evolve --seeds 2|--seeds goes with --output-dir; give both",
            "evolve --output-dir NEVER --seed 9223372036854775807 --seeds 2|--seed is 9223372036854775807; with --seeds 2 expected at most 9223372036854775805",
            "evolve --output-dir NEVER --seeds 2 --dry-run|--seeds goes without --dry-run; leave one of them out",
            "evolve --output-dir NEVER --seeds 2 --runs-at-once 5000|--runs-at-once is 5000; expected a whole number from 1 to 1024",
            "compare NEVER NEVER --starts 1|--starts is 1; expected 0, or a whole number from 2 to 1000"})
    void absurdNumbersOfOtherCommandsAreRefused(String arguments, String message) {
        refused(natator(arguments.replace("NEVER", path("never")).split(" "))).hasLineCount(1).contains(message);
        assertThat(folder.resolve("never")).doesNotExist();
    }

    @Test
    void anOutputFolderThatCannotBeIsSaidInWords() throws IOException {
        Path file = Files.writeString(folder.resolve("file"), "");
        Path link = Files.createSymbolicLink(folder.resolve("link"), Path.of("nowhere/at/all"));
        Map<Path, String> reasons = Map.of(file, "is a file, not a folder", file.resolve("a/b"),
                file + " is a file, not a folder",
                link, "is a link that leads nowhere", Path.of("/proc/run"), "/proc takes no new files or folders",
                Path.of("/proc/a/run"), "/proc takes no new files or folders");
        for (var one : reasons.entrySet()) {
            refused(evolve(one.getKey().toString())).isEqualTo(
                    "natator evolve: output folder " + one.getKey() + " cannot be made: " + one.getValue() + "\n");
        }
        for (Path one : List.of(file, file.resolve("a/b"), link)) {
            refused(evolve(one.toString(), "--dry-run")).isEqualTo(
                    "natator evolve: output folder " + one + " cannot be made: " + reasons.get(one) + "\n");
        }
        assertThat(file).isEmptyFile();
    }

    /** As the command itself is. */
    @Test
    void aDryRunIntoAFolderThatIsNotEmptyIsRefused() throws IOException {
        Path full = Files.createDirectories(folder.resolve("full"));
        Path mine = Files.writeString(full.resolve("mine"), "");
        for (String[] more : new String[][] {{}, {"--dry-run"}}) {
            refused(evolve("full", more)).isEqualTo("natator evolve: output folder " + full
                    + " is not empty; choose another by --output-dir, or continue the run in it by natator resume\n");
            assertThat(out.toString()).isEmpty();
        }
        Files.delete(mine);
        ok(evolve("full", "--dry-run"));
        assertThat(full).isEmptyDirectory();
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', value = {
            "--population 1|population is 1",
            "--generations -1|generations is -1",
            "--generations many|Invalid value for option '--generations': expected a whole number but was 'many'; see natator evolve --help",
            "--generations 1.5|expected a whole number but was '1.5'; see",
            "--population 99999999999|expected a whole number from 2 to 2147483647 but was '99999999999'; see",
            "--workers -99999999999|expected a whole number from -2147483648 to 2147483647 but was '-99999999999'; see",
            "--seed one|expected a whole number but was 'one'; see natator evolve --help",
            "--evaluations 1e3|expected a whole number but was '1e3'; see natator evolve --help",
            "--duration 0x1p3|expected a number but was '0x1p3'; see natator evolve --help",
            "--optimizer nsga2 --objectives distance=0x1p3,work|--objectives has 'distance=0x1p3'; expected a weight above 0",
            "--creature 5|--creature is 5; expected 1, 2, 3 or 4, or the name of a bundled body",
            "--creature ../eel|--creature is ../eel; expected 1, 2, 3 or 4, or the name",
            "--creature 1 --scene thesis/creature-2|exclude each other",
            "--workers 0|workers is 0",
            "--device -1 --backend auto|device is -1",
            "--device all|--device is all, but the backend is cpu, which has no GPUs; expected --backend cuda or auto with it",
            "--device 0,1 --backend cpu|--device is 0,1, but the backend is cpu",
            "--device all --backend cuda --simulator-command true|--device is all; expected none beside --simulator-command",
            "--evaluations 0|evaluations is 0",
            "--starts 0|starts is 0; expected a whole number from 1 to 1000",
            "--starts 3 --judge lower-quartile|starts is 3; expected at least 4 with --judge lower-quartile",
            "--judge median|starts is 1; expected at least 3 with --judge median",
            "--objectives distance,work|optimizer jgap has one objective, not distance and work",
            "--optimizer nsga2|optimizer nsga2 is for several objectives",
            "--objectives speed|--objectives has 'speed'; expected some of",
            "--judge max|expected mean, median or lower-quartile but was 'max'",
            "--starts 4 --evaluations 3|evaluations is 3; expected at least the 4 starts of one gait",
            "--stop-after 0|--stop-after is 0.0",
            "--simulator thread|expected process, resident, batch or spark but was 'thread'",
            "--backend gpu|expected cpu, cuda or auto but was 'gpu'",
            "--optimizer cma|expected jgap, cma-es, random, nsga2, map-elites or external but was 'cma'",
            "--fitness speed|expected distance or net",
            "--timeout 0|--timeout is 0.0",
            "--timeout 1e300|--timeout is 1.0E300; expected a number of seconds above 0, up to 100000000",
            "--workers 5000|workers is 5000; expected a whole number from 1 to 1024",
            "--population 2000000000|population is 2000000000; expected a whole number from 2 to 100000",
            "--duration -1|duration is -1.0",
            "--duration 1e9|duration is 1.0E9; expected a number of seconds above 0, up to 1000000",
            "--operators magic|expected corrected or stock",
            "--encoding magic|expected dense, sparse, wave, dense-steered or sparse-steered",
            "--preset quik|expected quick or thesis but was 'quik'",
            "--scene no/such|expected a named scene or a file",
            "--scene no/such.json|expected a named scene or an existing file",
            "--overrides no-such.json|no-such.json does not exist",
            "--overrides {\"solver\":|--overrides: ",
            "--overrides [1]|--overrides is [1]; expected a JSON object, or a file that holds one",
            "--overrides null|--overrides is null; expected a JSON object, or a file that holds one",
            "--sed 3|--sed is no option of this command; did you mean --seed or --seeds? See natator evolve --help"})
    void badUsageIsOneLineAndStatus2(String arguments, String message) {
        refused(natator("evolve " + arguments, "--output-dir", path("never"))).hasLineCount(1)
                .startsWith("natator evolve: ").contains(message);
        assertThat(out.toString()).isEmpty();
        assertThat(folder.resolve("never")).doesNotExist();
    }

    /** Also what only a result tells, and by a dry run as well; a folder would be in the way of the corrected command. */
    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {
            "--optimizer nsga2 --objectives distance,goals|objective goals: the scene has none",
            "--scene goals/turn --fitness net|--fitness net is for scenes without goals, and goals/turn has some",
            "--scene fault/rejected|simulator: gait.frequency is 70; expected a number up to 60"})
    void whatTheSceneDoesNotHaveLeavesNoFolder(String options, String message) {
        for (String more : List.of("", " --dry-run")) {

            refused(evolve("run", (options + more).split(" "))).startsWith("natator evolve: " + message)
                    .hasLineCount(1);
            assertThat(folder.resolve("run")).doesNotExist();
        }
    }

    @Test
    void aDocumentOfARunNeedsACheckpoint() throws IOException {
        ok(evolve("run"));
        Files.delete(folder.resolve("run/checkpoint.json"));

        refused(natator("show", "--json", path("run"))).isEqualTo(
                "natator show: " + folder.resolve("run") + " has no checkpoint yet; finish it by natator resume\n");
    }

    /** What else is wrong with the run does not matter then. To finish what is finished would not help. */
    @ParameterizedTest
    @ValueSource(strings = {"show --json", "check"})
    void withoutABestGaitIsOneLine(String command) throws IOException {
        ok(evolve("run", "--scene", "fault/unstable"))
                .contains("\n  unstable    refused 42 of 42 evaluations: 42 broke law tank\n");
        Files.delete(folder.resolve("run/evaluations.jsonl"));

        refused(natator(command, path("run"))).isEqualTo("natator " + command.split(" ")[0] + ": "
                + folder.resolve("run")
                + " has no best gait: of its 42 evaluations none was measured, all were unstable, refused or failed; evolve anew, "
                + "where they were unstable with more solver.substeps in --overrides\n");
    }

    @Test
    void whatHasNoBestGaitYetIsToBeFinished() throws IOException {
        ok(evolve("run"));
        for (String name : List.of("checkpoint.json", "best.json")) {
            Files.delete(folder.resolve("run").resolve(name));
        }

        refused(natator("show", "--json", path("run"))).isEqualTo(
                "natator show: " + folder.resolve("run") + " has no best gait yet; finish it by natator resume\n");
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {
            "evolve --scene EMPTY|natator evolve: --scene is empty",
            "evolve --scene=EMPTY|natator evolve: --scene is empty",
            "evolve --output-dir EMPTY|natator evolve: --output-dir is empty",
            "evaluate --scene pool/creature-1 --gait EMPTY|natator evaluate: --gait is empty",
            "show EMPTY|natator show: RUN is empty",
            "compare a EMPTY|natator compare: RUN is empty",
            "resume EMPTY|natator resume: RUN is empty"})
    void anEmptyValueIsOneLine(String arguments, String message) {
        String[] given = Stream.of(arguments.split(" ")).map(one -> one.replace("EMPTY", "")).toArray(String[]::new);

        refused(natator(given)).isEqualTo(message + "; expected a value: is a variable of the shell not set? See "
                + message.substring(0, message.indexOf(':')) + " --help\n");
        assertThat(out.toString()).isEmpty();
    }

    /** Not what is missing since it is mistyped. */
    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', value = {
            "evaluate --sceen pool/creature-1 --gait 1|--sceen is no option of this command; did you mean --scheme or --scene? See natator evaluate --help",
            "evaluate --sceen pool/creature-1 --gait|--sceen is no option of this command; did you mean --scheme or --scene? See natator evaluate --help",
            "compare --startss 3|--startss is no option of this command; did you mean --starts? See natator compare --help",
            "evolve --seed|Missing required parameter for option '--seed' (N); see natator evolve --help",
            "show|Missing required parameter: 'RUN'; see natator show --help",
            "show one two|'two' is one argument too many; see natator show --help",
            "new fish minnow|`Invalid value for scene|creature|gait: expected scene, creature or gait but was 'fish'; see natator new --help`"})
    void theMistypedIsNamed(String arguments, String message) {
        refused(execute(arguments.split(" "))).isEqualTo("natator " + arguments.split(" ")[0] + ": " + message + "\n");
    }

    @Command(name = "end")
    record End(Error error) implements Runnable {
        @Override
        public void run() {
            throw error;
        }
    }

    private static Stream<Arguments> lacks() {
        return Stream.of(Arguments.of(new OutOfMemoryError(),
                "not enough memory: Java may take \\d+ MiB; give it more by JAVA_TOOL_OPTIONS=-Xmx16g, say"),
                Arguments.of(new NoClassDefFoundError("io/natator/Part"),
                        "a part of the program cannot be loaded: io/natator/Part; "
                                + "expected more open files than ulimit -n allows, or the jar as it was at the start"));
    }

    @ParameterizedTest
    @MethodSource("lacks")
    void whatJavaLacksIsOneLine(Error error, String message) {
        CommandLine command = Main.commandLine().addSubcommand(new End(error)).setErr(new PrintWriter(err, true));

        assertThat(command.execute("end")).isEqualTo(1);
        assertThat(err.toString()).matches("natator end: " + message + "\n");
    }

    @Test
    void aDryRunThatCannotTryTellsWhy() {
        assertThat(evolve("run", "--scene", "fault/exit", "--dry-run")).isEqualTo(1);
        assertThat(err.toString()).startsWith("natator evolve: a trial evaluation failed: ").contains("out of luck")
                .hasLineCount(1);
        assertThat(out.toString()).isEmpty();
    }

    /** Whatever is asked of it: that a program does not work is no fault of the scene. */
    @ParameterizedTest
    @ValueSource(strings = {"evolve --dry-run --scene", "evaluate --gait 1 0.5 0.5 0.5 --scene", "page",
            "new scene minnow --like"})
    void aSimulatorThatDoesNotWorkIsAFailure(String command) throws IOException {
        Path simulator = folder.resolve("simulator");
        String[] arguments = (command + " pool/eel --simulator-path " + simulator).split(" ");
        for (String program : List.of("#!/no/such/interpreter\n", "\u007fELF", "#!/bin/sh\nexit 7\n")) {
            FakeSimulator.program(simulator, program);

            assertThat(execute(arguments)).as(err.toString()).isEqualTo(1);
            assertThat(err.toString()).startsWith("natator " + arguments[0] + ": simulator: ").hasLineCount(1);
        }
    }

    @Test
    void aMissingSimulatorIsNamed() {
        refused(execute("evolve", "--simulator-path", "no/such/program"))
                .isEqualTo("natator evolve: --simulator-path is no/such/program; expected an executable file\n");
    }
}
