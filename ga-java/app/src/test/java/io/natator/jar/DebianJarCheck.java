package io.natator.jar;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assumptions.assumeThat;

import java.io.IOException;
import java.io.InputStream;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.stream.Stream;
import java.util.zip.GZIPInputStream;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

/** The Debian package of what was built: what it says of itself, what it holds, and that its programs run from where it is unpacked. */
class DebianJarCheck {

    private static final Path SOURCE = Path.of(System.getProperty("natator.protocol")).toAbsolutePath().normalize()
            .getParent();
    private static final Path BUILD = Path.of(System.getProperty("natator.simulator")).toAbsolutePath().normalize()
            .getParent().getParent();

    @TempDir
    private static Path folder;
    private static Path root;
    private static Path deb;

    @TempDir
    private Path elsewhere;

    private record Ended(int status, String output, String errors) {
    }

    @BeforeAll
    static void pack() throws IOException, InterruptedException {
        if (System.getenv("CI") == null) {
            assumeThat(Path.of("/usr/bin/dpkg-shlibdeps")).as("dpkg-dev, which ./setup.sh --readers installs").exists();
        }
        said(folder, "cpack", "--config", BUILD.resolve("CPackConfig.cmake").toString(), "-G", "DEB", "-B",
                folder.toString());
        try (Stream<Path> files = Files.list(folder)) {
            deb = files.filter(file -> file.toString().endsWith(".deb")).findAny().orElseThrow();
        }
        root = folder.resolve("root");
        said(folder, "dpkg-deb", "--extract", deb.toString(), root.toString());
    }

    /** With no variable of the caller's but where Java is. */
    private static Ended run(Path directory, List<String> variables, String... command)
            throws IOException, InterruptedException {
        Path output = folder.resolve("output.txt");
        Path errors = folder.resolve("errors.txt");
        ProcessBuilder builder = new ProcessBuilder(command).directory(directory.toFile())
                .redirectOutput(output.toFile())
                .redirectError(errors.toFile());
        builder.environment().keySet().removeIf(name -> name.startsWith("NATATOR_"));
        builder.environment().put("JAVA_HOME", System.getProperty("java.home"));
        builder.environment().put("NATATOR_CACHE", "");
        variables.forEach(variable -> builder.environment().put(variable.split("=")[0], variable.split("=")[1]));
        int status = builder.start().waitFor();
        return new Ended(status, Files.readString(output, StandardCharsets.UTF_8),
                Files.readString(errors, StandardCharsets.UTF_8));
    }

    private static String said(Path directory, String... command) throws IOException, InterruptedException {
        Ended ended = run(directory, List.of(), command);
        assertThat(ended.status()).as(ended.toString()).isZero();
        return ended.output();
    }

    private static String program(String name) {
        return root.resolve("usr/bin").resolve(name).toString();
    }

    private static String unpacked(String name) throws IOException {
        try (InputStream file = new GZIPInputStream(Files.newInputStream(root.resolve("usr/share").resolve(name)))) {
            return new String(file.readAllBytes(), StandardCharsets.UTF_8);
        }
    }

    private static String version() throws IOException {
        return Files.readString(SOURCE.resolveSibling("CMakeLists.txt"))
                .replaceFirst("(?s).*?project\\(natator VERSION (\\S+) .*", "$1");
    }

    @Test
    void itSaysWhatItIsAndNeeds() throws IOException, InterruptedException {
        assertThat(deb.getFileName().toString()).matches("natator_" + version() + "_\\w+\\.deb");
        assertThat(said(folder, "dpkg-deb", "--field", deb.toString()))
                .contains("Package: natator\n", "Version: " + version() + "\n",
                        "Section: science\n")
                .containsPattern("Maintainer: .+ <.+@.+>\n").containsPattern("Depends: default-jre-headless "
                        + "\\(>= 2:1\\.17\\) \\| java17-runtime-headless, libc6 \\(>= [\\d.]+\\)")
                .doesNotContain("libstdc++");
    }

    /** No scripts that run as root, no files that its removal would leave. */
    @Test
    void nothingIsDoneButUnpacking() throws IOException, InterruptedException {
        said(folder, "dpkg-deb", "--control", deb.toString(), folder.resolve("control").toString());

        try (Stream<Path> files = Files.list(folder.resolve("control"))) {
            assertThat(files.map(file -> file.getFileName().toString())).containsExactlyInAnyOrder("control",
                    "md5sums");
        }
    }

    @Test
    void itHoldsWhatTheSourceHas() throws IOException, InterruptedException {
        Path data = root.resolve("usr/share/natator");
        for (String kind : List.of("scenes", "creatures", "examples/gaits", "protocol")) {
            Path from = SOURCE.resolve(kind);
            try (Stream<Path> files = Files.walk(from)) {
                assertThat(files.filter(file -> file.toString().endsWith(".json"))).isNotEmpty()
                        .allSatisfy(file -> assertThat(data.resolve(from.getFileName()).resolve(from.relativize(file)))
                                .hasSameBinaryContentAs(file));
            }
        }
        assertThat(data.resolve("natator.jar")).hasSameBinaryContentAs(Path.of(System.getProperty("natator.jar")));
        assertThat(root.resolve("usr/share/doc/natator/copyright")).content().contains("common-licenses/Apache-2.0",
                "Niels Lohmann");
        assertThat(unpacked("man/man1/natator.1.gz"))
                .contains(".SH NAME\nnatator \\- evolves", "resume    Continues a run")
                .containsPattern("(?m)^  \\\\-h, \\\\-\\\\-help  ");
        assertThat(unpacked("man/man1/natator-sim.1.gz")).contains(".SH NAME\nnatator\\-sim \\- simulates",
                "Subcommands:");
        assertThat(unpacked("doc/natator/changelog.gz")).startsWith("natator (" + version() + ") ");
        try (Stream<Path> files = Files.walk(root)) {
            assertThat(files.filter(Files::isRegularFile))
                    .allSatisfy(file -> assertThat(root.relativize(file).toString()).contains("natator"));
        }
    }

    @Test
    void itsProgramsRun() throws IOException, InterruptedException {
        assertThat(said(elsewhere, program("natator-sim"), "--version")).startsWith("natator-sim " + version() + ", ");
        assertThat(said(elsewhere, program("natator-sim"), "run", "pool/eel", "--duration", "0.05"))
                .contains("pool/eel");
        assertThat(said(elsewhere, program("natator"), "--version")).startsWith("natator " + version());

        said(elsewhere, program("natator"), "new", "creature", "minnow");

        assertThat(elsewhere.resolve("minnow.json")).content()
                .contains(root.toRealPath().resolve("usr/share/natator/protocol").toString());
    }

    /** The page and what it loads are in the jar. */
    @Test
    void itMakesThePage() throws IOException, InterruptedException {
        said(elsewhere, program("natator"), "page", "pool/eel", "--duration", "0.05", "--output", "eel.html");

        assertThat(elsewhere.resolve("eel.html")).content().contains("<html");
    }
}
