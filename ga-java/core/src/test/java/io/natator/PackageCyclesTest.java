package io.natator;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

/** No package needs one that needs it, not by a detour either. */
class PackageCyclesTest {

    @TempDir
    private Path sources;

    @Test
    void thisModuleHasNone() throws IOException {
        assertThat(PackageCycles.in(Path.of("src/main/java"))).isEmpty();
    }

    @Test
    void detoursStaticImportsAndWrittenOutNamesAreFound() throws IOException {
        write("a", "A", "import io.natator.b.B;");
        write("b", "B", "import static io.natator.c.C.ONE;");
        write("c", "C", "class C { io.natator.a.A.Inner inner; }");
        write("d", "D", "import io.natator.a.A;");
        assertThat(PackageCycles.in(sources)).containsExactly("io.natator.a -> io.natator.b: A",
                "io.natator.b -> io.natator.c: B",
                "io.natator.c -> io.natator.a: C");
    }

    @Test
    void commentsAndTheOwnPackageAreNoUse() throws IOException {
        write("a", "A", "import io.natator.b.B;");
        write("b", "B", "import io.natator.b.Other; // not io.natator.a.A", "/** {@link io.natator.a.A} */",
                "class B { }");
        assertThat(PackageCycles.in(sources)).isEmpty();
    }

    private void write(String folder, String name, String... lines) throws IOException {
        Path file = sources.resolve("io/natator/" + folder + "/" + name + ".java");
        Files.createDirectories(file.getParent());
        Files.writeString(file, String.join("\n", lines) + "\n");
    }
}
