package io.natator.checkpoint;

import static org.assertj.core.api.Assertions.assertThat;

import java.nio.file.Path;
import java.util.List;
import java.util.stream.Stream;

/** What a run computed. */
public final class RunFiles {

    private static final List<String> RESULTS = List.of("generations.csv", "best.json", "checkpoint.json",
            "evaluations.jsonl");

    private RunFiles() {
    }

    /** Fails unless two runs' results, and more files of these names, have the same bytes. */
    public static void assertSame(Path run, Path other, String... more) {
        Stream.concat(RESULTS.stream(), Stream.of(more)).forEach(
                name -> assertThat(run.resolve(name)).as(name).hasSameBinaryContentAs(other.resolve(name)));
    }
}
