package io.natator.jar;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.File;
import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.util.Arrays;
import java.util.Collection;
import java.util.List;
import java.util.TreeSet;
import java.util.zip.ZipEntry;
import java.util.zip.ZipFile;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

/** What the jar says of what it contains, checked on the jar that was packaged: in Maven's phase {@code verify}. */
class ThirdPartyJarCheck {

    private static final String META = "META-INF/";
    private static final List<String> OWN = List.of("io/natator/", "logback.xml");
    private static final int MIN_LICENCE_LENGTH = 1000;

    private ZipFile jar;

    @BeforeEach
    void open() throws IOException {
        jar = new ZipFile(System.getProperty("natator.jar"));
    }

    @AfterEach
    void close() throws IOException {
        jar.close();
    }

    /** A line of THIRD-PARTY.txt. */
    private record Library(String name, String version, List<String> texts, List<String> places) {
        static Library of(String line) {
            String[] fields = line.split(" \\| ");
            assertThat(fields).as(line).hasSize(4);
            String[] coordinates = fields[0].split(":");
            assertThat(coordinates).as(line).hasSize(3);
            return new Library(coordinates[1], coordinates[2], List.of(fields[2].split(" ")),
                    List.of(fields[3].split(" ")));
        }
    }

    private String text(String name) throws IOException {
        ZipEntry entry = jar.getEntry(name);
        assertThat(entry).as(name).isNotNull();
        return new String(jar.getInputStream(entry).readAllBytes(), StandardCharsets.UTF_8);
    }

    private List<Library> libraries() throws IOException {
        List<Library> all = text(META + "THIRD-PARTY.txt").lines().filter(line -> line.matches("\\S+:\\S+:\\S+ \\|.*"))
                .map(Library::of).toList();
        assertThat(all).isNotEmpty();
        return all;
    }

    @Test
    void everyFileIsOursOrThatOfALibraryThatIsNamed() throws IOException {
        List<String> places = libraries().stream().map(Library::places).flatMap(Collection::stream).toList();

        TreeSet<String> strange = new TreeSet<>();
        jar.stream().filter(entry -> !entry.isDirectory())
                .map(entry -> entry.getName().replaceFirst("^META-INF/versions/\\d+/", ""))
                .filter(name -> name.startsWith(META + "resources/") || !name.startsWith(META))
                .filter(name -> OWN.stream().noneMatch(name::startsWith) && places.stream().noneMatch(name::startsWith))
                .forEach(strange::add);

        assertThat(strange).as("files of libraries that META-INF/THIRD-PARTY.txt does not name").isEmpty();
    }

    @Test
    void everyLibraryHasItsLicenceText() throws IOException {
        for (Library library : libraries()) {
            for (String name : library.texts()) {
                String licence = text(Path.of(META, "licenses", name).normalize().toString());
                assertThat(licence).as(library.name()).hasSizeGreaterThan(MIN_LICENCE_LENGTH)
                        .containsIgnoringCase("copyright");
            }
            assertThat(library.places()).as(library.name()).allSatisfy(place -> assertThat(jar.stream())
                    .as(place).anyMatch(entry -> entry.getName().startsWith(place) && !entry.isDirectory()));
        }
    }

    @Test
    void theVersionsAreThoseOfTheBuild() throws IOException {
        List<String> jars = Arrays.stream(System.getProperty("java.class.path").split(File.pathSeparator))
                .map(path -> Path.of(path).getFileName().toString()).toList();

        assertThat(libraries()).allSatisfy(library -> assertThat(jars)
                .contains(library.name() + "-" + library.version() + ".jar"));
    }

    @Test
    void theNoticeIsOursAndKeepsTheirs() throws IOException {
        assertThat(text(META + "NOTICE").lines().limit(2)).containsExactly("Natator",
                "Copyright 2026 the Natator maintainers");
        assertThat(text(META + "NOTICE")).contains("# Jackson JSON processor");
        assertThat(text(META + "NOTICE.txt")).contains("Copyright 2016-2018 The Hipparchus project");
    }

    @Test
    void theNoticesOfTheWebServerAreThere() throws IOException {
        assertThat(text(META + "NOTICE.md")).contains("# Notices for Jakarta Annotations",
                "# Notices for Jakarta Transactions");
    }
}
