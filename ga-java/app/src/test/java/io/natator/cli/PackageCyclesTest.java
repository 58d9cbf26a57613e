package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.PackageCycles;
import java.io.IOException;
import java.nio.file.Path;
import org.junit.jupiter.api.Test;

/** No package of the program needs one that needs it. */
class PackageCyclesTest {

    @Test
    void thisModuleHasNone() throws IOException {
        assertThat(PackageCycles.in(Path.of("src/main/java"))).isEmpty();
    }
}
