package io.natator.cache;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.protocol.Results;
import io.natator.protocol.SimulationResult;
import io.natator.protocol.SwimmingNumbers;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Collections;
import java.util.List;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class EvaluationCacheTest {

    private static final SimulationResult RESULT = Results.ok(0.1 + 0.2)
            .with(to -> to.stopped("no-progress").simulated(2.5).frames(150).hash("17a1dfe6c68edf45").work(0.7)
                    .swimming(new SwimmingNumbers(0.1, null, 131.4, 1e5, 0.02, null)));

    @TempDir
    private Path folder;

    private List<Path> files() throws IOException {
        try (Stream<Path> files = Files.walk(folder)) {
            return files.filter(Files::isRegularFile).toList();
        }
    }

    @Test
    void givesBackEveryBitUnderItsKeyAlone() {
        EvaluationCache cache = new EvaluationCache(folder.resolve("new"));
        assertThat(cache.find("key")).isNull();

        cache.store("key", RESULT);

        assertThat(new EvaluationCache(folder.resolve("new")).find("key")).isEqualTo(RESULT);
        assertThat(cache.find("kez")).isNull();
    }

    /** Every byte of the file, changed or cut off before. */
    @Test
    void damageCountsAsMissing() throws IOException {
        EvaluationCache cache = new EvaluationCache(folder);
        cache.store("key", RESULT);
        Path file = files().get(0);
        byte[] whole = Files.readAllBytes(file);
        for (int i = 0; i < whole.length; i++) {
            byte[] changed = whole.clone();
            changed[i] ^= 1;
            Files.write(file, changed);
            assertThat(cache.find("key")).as("byte %d changed", i).isNull();
            Files.write(file, Arrays.copyOf(whole, i));
            assertThat(cache.find("key")).as("cut to %d bytes", i).isNull();
        }

        cache.store("key", RESULT);
        assertThat(cache.find("key")).isEqualTo(RESULT);
    }

    @Test
    void manyWritersAndReadersSeeWholeEntriesOnly() throws InterruptedException, IOException {
        List<Thread> threads = new ArrayList<>();
        List<Object> wrong = Collections.synchronizedList(new ArrayList<>());
        for (int i = 0; i < 6; i++) {
            EvaluationCache own = new EvaluationCache(folder);
            boolean writes = i % 2 == 0;
            threads.add(new Thread(() -> {
                for (int n = 0; n < 200; n++) {
                    if (writes) {
                        own.store("key " + n % 5, RESULT);
                    } else {
                        SimulationResult found = own.find("key " + n % 5);
                        if (found != null && !found.equals(RESULT)) {
                            wrong.add(found);
                        }
                    }
                }
            }));
        }
        threads.forEach(Thread::start);
        for (Thread thread : threads) {
            thread.join();
        }

        assertThat(wrong).isEmpty();
        assertThat(files()).as("nothing but five entries").hasSize(5);
    }

    @Test
    void aFolderThatCannotBeWrittenIsNoFailure() throws IOException {
        Path file = Files.writeString(folder.resolve("file"), "");
        EvaluationCache cache = new EvaluationCache(file);

        cache.store("key", RESULT);
        assertThat(cache.find("key")).isNull();
    }
}
