package io.natator.view;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Set;
import java.util.concurrent.BlockingQueue;
import java.util.concurrent.LinkedBlockingQueue;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** Whatever a watched file holds, the next time that it is saved is noticed too. */
class SavedFilesTest {

    private final BlockingQueue<String> told = new LinkedBlockingQueue<>();
    @TempDir
    private Path folder;

    private void save(Path file, String content) throws IOException, InterruptedException {
        Files.writeString(file, content);
        assertThat(told.poll(1, TimeUnit.MINUTES)).isEqualTo(file.toString());
        told.clear();
    }

    @ParameterizedTest
    @ValueSource(strings = {"{\"base\":\"x\\u0000.json\"}", "{\"creature\":{\"name\":\"\\u0000.json\"}}",
            "{\"base\":\"mine.json\"}",
            "{\"base\":\"pipe.json\"}", "{\"base\":\"folder.json\"}", "{\"base\":\"/\"}", "{\"base\":3}",
            "{\"base\":[\"x.json\"]}", "{\"creature\":3}",
            "[]", "3", "", "{", "\u0000"})
    void aSaveIsNoticedAfterAnyOther(String hostile) throws IOException, InterruptedException {
        Path scene = Files.writeString(folder.resolve("mine.json"), "{}");
        Files.createDirectory(folder.resolve("folder.json"));
        new ProcessBuilder("mkfifo", folder.resolve("pipe.json").toString()).start().waitFor();
        SavedFiles saved = new SavedFiles(Set.of(scene.toString()), told::add);
        try {
            save(scene, hostile);
            save(scene, "{\"duration\":1}");
        } finally {
            saved.close();
        }
    }

    @Test
    void aDeepOneToo() throws IOException, InterruptedException {
        aSaveIsNoticedAfterAnyOther("[".repeat(100000));
    }

    @Test
    void whoIsToldMayFail() throws IOException, InterruptedException {
        Path scene = Files.writeString(folder.resolve("mine.json"), "{}");
        SavedFiles saved = new SavedFiles(Set.of(scene.toString()), name -> {
            told.add(name);
            throw new IllegalStateException("for the test");
        });
        try {
            save(scene, "{ }");
            save(scene, "{  }");
        } finally {
            saved.close();
        }
    }
}
