package io.natator.checkpoint;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.base.InvalidInputException;
import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.Json;
import io.natator.config.OperatorSet;
import io.natator.config.OptimizerKind;
import io.natator.evolution.EvaluationRecord;
import io.natator.evolution.Evolution;
import io.natator.evolution.EvolutionFailedException;
import io.natator.evolution.EvolutionListener;
import io.natator.evolution.EvolutionState;
import io.natator.evolution.ToySimulator;
import io.natator.process.Evaluator;
import io.natator.process.FakePool;
import io.natator.protocol.SimulationResult;
import java.io.IOException;
import java.io.RandomAccessFile;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.TreeMap;
import java.util.concurrent.TimeUnit;
import java.util.stream.Stream;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.EnumSource;
import org.junit.jupiter.params.provider.ValueSource;

class RunWriterTest {

    @TempDir
    private Path temporary;
    private Path run;

    @BeforeEach
    void choose() {
        run = temporary.resolve("run");
    }

    private static EvolutionSettings settings(OperatorSet operators) {
        return EvolutionSettings.of("thesis/creature-3", EncodingKind.DENSE, 5).withSize(12, 4).withSeed(99)
                .withOptimizer(OptimizerKind.JGAP, operators, 0.05);
    }

    /** Runs, or continues, what is in the folder. */
    private static ToySimulator evolve(RunWriter folder, EvolutionListener... more) {
        List<EvolutionListener> listeners = new ArrayList<>(List.of(folder));
        listeners.addAll(List.of(more));
        ToySimulator simulator = new ToySimulator();
        try (folder; Evaluator pool = new FakePool(simulator, 3)) {
            EvolutionState end = new Evolution(folder.settings(), pool, listeners, folder.recorded(), null)
                    .run(folder.checkpoint());
            folder.writeResults(end);
        }
        return simulator;
    }

    /** Whoever reads it would wait for ever. */
    @ParameterizedTest
    @ValueSource(strings = {"checkpoint.json", "checkpoint.json.gz", "savings.json", "check.json", "evaluations.jsonl",
            "timings.csv"})
    @Timeout(value = 10, unit = TimeUnit.MINUTES, threadMode = Timeout.ThreadMode.SEPARATE_THREAD)
    void aPipeInPlaceOfAFileIsRefused(String name) throws IOException, InterruptedException {
        RunWriter.create(run, settings(OperatorSet.CORRECTED)).close();
        assertThat(new ProcessBuilder("mkfifo", run.resolve(name).toString()).start().waitFor()).isZero();

        assertRefused(run.resolve(name) + " is not a regular file");
    }

    /** Before anything is computed that could not be written then. */
    @ParameterizedTest
    @ValueSource(strings = {"checkpoint.json", "checkpoint.json.gz", "best.json", "environment.json", "savings.json",
            "evaluations.jsonl",
            "generations.csv", "timings.csv"})
    void aFolderAndALinkThatLeadsNowhereInPlaceOfAFileAreRefused(String name) throws IOException {
        RunWriter.create(run, settings(OperatorSet.CORRECTED)).close();
        Path file = run.resolve(name);
        Files.createDirectories(file);
        assertRefused(file + " is a folder; expected a file");
        Files.delete(file);
        Files.createSymbolicLink(file, Path.of("nowhere"));
        assertRefused(file + " is a link that leads nowhere");
    }

    private void assertRefused(String message) {
        assertThatThrownBy(() -> RunWriter.open(run)).isInstanceOf(InvalidInputException.class).hasMessage(message);
        assertThatThrownBy(() -> RunReader.in(run)).isInstanceOf(InvalidInputException.class).hasMessage(message);
    }

    @Test
    void aFileThatIsTooLargeIsRefused() throws IOException {
        RunWriter.create(run, settings(OperatorSet.CORRECTED)).close();
        try (RandomAccessFile large = new RandomAccessFile(run.resolve("checkpoint.json").toFile(), "rw")) {
            large.setLength(3L << 30);
        }

        assertThatThrownBy(() -> RunWriter.open(run)).isInstanceOf(InvalidInputException.class)
                .hasMessage("checkpoint " + run.resolve("checkpoint.json")
                        + " cannot be read: larger than 1073741824 bytes");
    }

    @Test
    void onlyAFolderWithoutAnEvaluationIsRemoved() throws IOException {
        RunWriter.create(run, settings(OperatorSet.CORRECTED)).close();
        RunWriter.deleteUnlessBegun(run);
        assertThat(run).doesNotExist();

        evolve(RunWriter.create(run, settings(OperatorSet.CORRECTED)));
        Map<String, String> before = lastingFiles(run);
        RunWriter.deleteUnlessBegun(run);
        assertThat(lastingFiles(run)).isEqualTo(before);
        Files.delete(run.resolve("checkpoint.json"));
        RunWriter.deleteUnlessBegun(run);
        assertThat(run.resolve("evaluations.jsonl")).isNotEmptyFile();
    }

    /** The files that must not depend on anything but the settings. */
    private static Map<String, String> lastingFiles(Path folder) throws IOException {
        Map<String, String> files = new TreeMap<>();
        try (Stream<Path> paths = Files.list(folder)) {
            for (Path path : paths.filter(file -> !file.endsWith("timings.csv")).toList()) {
                files.put(path.getFileName().toString(), Files.readString(path));
            }
        }
        return files;
    }

    @Test
    void holdsAllThatARunIsMadeOf() throws IOException {
        evolve(RunWriter.create(run, settings(OperatorSet.CORRECTED)));

        assertThat(lastingFiles(run)).containsOnlyKeys("best.json", "checkpoint.json", "config.json", "digests.json",
                "digests.txt",
                "evaluations.jsonl", "generations.csv");
        List<String> rows = Files.readAllLines(run.resolve("generations.csv"));
        assertThat(rows).hasSize(6);
        assertThat(rows.get(0)).isEqualTo("generation,best,mean,median,worst,population,evaluations,unstable,failed");
        JsonNode best = Json.parse(Files.readString(run.resolve("best.json")), JsonNode.class);
        assertThat(rows.get(5)).startsWith("4," + best.get("distance").asText() + ",");
        assertThat(best.get("gait").get("amplitude")).hasSize(5);
        assertThat(Files.readAllLines(run.resolve("timings.csv"))).hasSize(6);
    }

    /** At every moment at which a run can be killed: copies its folder, and continues the copy. */
    @ParameterizedTest
    @EnumSource(OperatorSet.class)
    void aKilledRunContinuesAsIfNothingHadHappened(OperatorSet operators) throws IOException {
        List<Path> snapshots = new ArrayList<>();
        Random random = new Random(5);
        evolve(RunWriter.create(run, settings(operators)), new EvolutionListener() {
            @Override
            public void evaluated(EvaluationRecord evaluation) {
                if (random.nextInt(8) == 0) {
                    snapshot(snapshots);
                }
            }

            @Override
            public void generationFinished(EvolutionState state) {
                snapshot(snapshots);
            }
        });
        Map<String, String> whole = lastingFiles(run);

        assertThat(snapshots).hasSizeGreaterThan(10);
        for (Path snapshot : snapshots) {
            tear(snapshot, random);
            evolve(RunWriter.open(snapshot));

            assertThat(lastingFiles(snapshot)).isEqualTo(whole);
        }
    }

    /** Cuts the log anywhere after what belongs to the checkpoint. */
    private static void tear(Path folder, Random random) throws IOException {
        Path log = folder.resolve("evaluations.jsonl");
        String content = Files.readString(log);
        Path checkpoint = folder.resolve("checkpoint.json");
        long safe = !Files.exists(checkpoint) ? 0
                : Json.parse(Files.readString(checkpoint), EvolutionState.class).evaluations();
        int end = 0;
        for (long line = 0; line < safe; line++) {
            end = content.indexOf('\n', end) + 1;
        }
        Files.writeString(log, content.substring(0, end + random.nextInt(content.length() - end + 1)));
    }

    private void snapshot(List<Path> snapshots) {
        try {
            Path copy = Files.createDirectories(temporary.resolve("killed-" + snapshots.size()));
            try (Stream<Path> files = Files.list(run)) {
                for (Path file : files.toList()) {
                    Files.copy(file, copy.resolve(file.getFileName()));
                }
            }
            snapshots.add(copy);
        } catch (IOException e) {
            throw new AssertionError(e);
        }
    }

    @Test
    void finishedEvaluationsAreNotRepeated() throws IOException {
        evolve(RunWriter.create(run, settings(OperatorSet.CORRECTED)));
        long all = Files.readAllLines(run.resolve("evaluations.jsonl")).size();
        Files.delete(run.resolve("checkpoint.json"));

        ToySimulator second = evolve(RunWriter.open(run));

        assertThat(second.calls()).isZero();
        assertThat(Files.readAllLines(run.resolve("evaluations.jsonl"))).hasSize((int) all);
    }

    @Test
    void nothingIsOverwritten() throws IOException {
        Files.createDirectories(run);
        Files.writeString(run.resolve("thesis.tex"), "years of work");

        assertThatThrownBy(() -> RunWriter.create(run, settings(OperatorSet.CORRECTED)))
                .isInstanceOf(InvalidInputException.class).hasMessageContaining("is not empty");
        assertThatThrownBy(() -> RunWriter.open(run)).isInstanceOf(InvalidInputException.class)
                .hasMessageContaining("is not a run folder");
        try (Stream<Path> files = Files.list(run)) {
            assertThat(files).hasSize(1);
        }
    }

    @Test
    void aGenerationThatFailedIsSimulatedAnew() throws IOException {
        evolve(RunWriter.create(temporary.resolve("whole"), settings(OperatorSet.CORRECTED)));
        RunWriter broken = RunWriter.create(run, settings(OperatorSet.CORRECTED));
        ToySimulator toy = new ToySimulator();
        try (broken;
                Evaluator pool = new FakePool(request -> request.id() < 15 ? toy.evaluate(request)
                        : SimulationResult.failed(request.id(), "no memory"), 2)) {
            Evolution evolution = new Evolution(broken.settings(), pool, List.of(broken), broken.recorded(),
                    null);
            assertThatThrownBy(() -> evolution.run(null)).isInstanceOf(EvolutionFailedException.class)
                    .hasMessageContaining("simulations failed, the first: no memory");
        }

        evolve(RunWriter.open(run));

        assertThat(lastingFiles(run)).isEqualTo(lastingFiles(temporary.resolve("whole")));
    }

    @Test
    void twoRunsCannotShareAFolder() {
        try (RunWriter first = RunWriter.create(run, settings(OperatorSet.CORRECTED))) {
            assertThat(first.checkpoint()).isNull();
            assertThatThrownBy(() -> RunWriter.open(run)).isInstanceOf(InvalidInputException.class)
                    .hasMessageContaining("is in use");
        }
    }

    /** A run after some generation, as a kill leaves it. */
    private Path killed(int generation) throws IOException {
        List<Path> snapshots = new ArrayList<>();
        evolve(RunWriter.create(run, settings(OperatorSet.CORRECTED)), new EvolutionListener() {
            @Override
            public void evaluated(EvaluationRecord evaluation) {
                if (evaluation.generation() == generation) {
                    snapshot(snapshots);
                }
            }
        });
        return snapshots.get(snapshots.size() - 1);
    }

    private static void edit(Path file, String from, String to) throws IOException {
        String before = Files.readString(file);
        Files.writeString(file, before.replaceFirst(from, to));
        assertThat(before).isNotEqualTo(Files.readString(file));
    }

    /** Of a generation that is finished, and of one that is not. */
    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {
            "evaluations.jsonl|\"distance\":[-0-9.eE]+|\"distance\":-1.0|evaluations.jsonl, line 1 was edited",
            "evaluations.jsonl|\"simulated\":[-0-9.eE]+|\"simulated\":1.25|evaluations.jsonl, line 1 was edited",
            "evaluations.jsonl|(?s)^(.*\"distance\":)[-0-9.eE]+|$19.5|was edited",
            "checkpoint.json|\"distance\" : [-0-9.eE]+|\"distance\" : 9.5|checkpoint.json was edited",
            "checkpoint.json|\"mean\" : [-0-9.eE]+|\"mean\" : 9.5|checkpoint.json was edited",
            "checkpoint.json|\"evaluations\" : [0-9]+|\"evaluations\" : 3|checkpoint.json was edited",
            "best.json|\"distance\" : [-0-9.eE]+|\"distance\" : 9.5|best.json was edited"})
    void whatWasEditedIsToldOf(String name, String from, String to, String message) throws IOException {
        Path folder = killed(2);
        edit(folder.resolve(name), from, to);

        assertThatThrownBy(() -> RunWriter.open(folder)).isInstanceOf(InvalidInputException.class)
                .hasMessageContaining(message).hasMessageContaining("; expected it as the run wrote it")
                .hasMessageNotContaining("\n");
        Files.delete(folder.resolve("digests.json"));
        Files.delete(folder.resolve("digests.txt"));
        RunWriter.open(folder).close();
    }

    /** Whichever file is removed or cut anywhere: it is told, or the outcome is the same. */
    @Test
    void aFileThatIsGoneOrCutIsToldOfOrDoesNotMatter() throws IOException {
        Path folder = killed(2);
        Map<String, String> whole = lastingFiles(run);
        Map<String, String> files = lastingFiles(folder);
        int same = 0;
        for (String name : files.keySet()) {
            for (double share : new double[] {-1, 0, 0.3, 0.5, 0.999}) {
                Path copy = Files.createDirectories(temporary.resolve(name + share));
                for (Map.Entry<String, String> file : files.entrySet()) {
                    Files.writeString(copy.resolve(file.getKey()), file.getValue());
                }
                if (share < 0) {
                    Files.delete(copy.resolve(name));
                } else {
                    Files.writeString(copy.resolve(name),
                            files.get(name).substring(0, (int) (share * files.get(name).length())));
                }
                try {
                    evolve(RunWriter.open(copy));
                } catch (InvalidInputException e) {
                    assertThat(e.getMessage()).contains(copy.toString()).doesNotContain("\n");
                    continue;
                }
                same++;
                for (Map.Entry<String, String> file : lastingFiles(copy).entrySet()) {
                    assertThat(List.of("digests.json", "config.json").contains(file.getKey())
                            || file.getValue().equals(whole.get(file.getKey())))
                            .as("%s, %s of %s", file.getKey(), share, name).isTrue();
                }
            }
        }
        assertThat(same).isBetween(10, 25);
    }

    /** It has none of the digests, gets them, and is guarded from then on. */
    @Test
    void aRunOfAnEarlierVersionGoesOn() throws IOException {
        Path folder = killed(2);
        Map<String, String> whole = lastingFiles(run);
        Files.delete(folder.resolve("digests.json"));
        Files.delete(folder.resolve("digests.txt"));
        evolve(RunWriter.open(folder));
        assertThat(lastingFiles(folder)).isEqualTo(whole);

        edit(folder.resolve("evaluations.jsonl"), "\"distance\":[-0-9.eE]+", "\"distance\":-1.0");
        assertThatThrownBy(() -> RunWriter.open(folder)).hasMessageContaining("evaluations.jsonl, line 1 was edited");
    }
}
