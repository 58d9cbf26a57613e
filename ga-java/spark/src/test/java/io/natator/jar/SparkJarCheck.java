package io.natator.jar;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.util.List;
import java.util.zip.ZipFile;
import org.junit.jupiter.api.Test;

/** What the jar for Spark says of what it contains, and that it contains nothing that a cluster has. */
class SparkJarCheck extends ThirdPartyJarCheck {

    private static final List<String> STRANGE = List.of("com/fasterxml/", "ch/qos/logback", "logback.xml",
            "io/javalin/",
            "org/eclipse/jetty", "kotlin/", "jakarta/", "org/slf4j/", "org/apache/spark/", "org/apache/logging/",
            "scala/");

    @Test
    void nothingInItMeetsWhatAClusterHas() throws IOException {
        try (ZipFile jar = new ZipFile(System.getProperty("natator.jar"))) {
            assertThat(jar.stream().map(entry -> entry.getName().replaceFirst("^META-INF/versions/\\d+/", ""))
                    .filter(name -> STRANGE.stream().anyMatch(name::startsWith))).isEmpty();
            assertThat(jar.getEntry("io/natator/shaded/jackson/databind/ObjectMapper.class")).isNotNull();
        }
    }

    /** There is none in this jar. */
    @Override
    void theNoticesOfTheWebServerAreThere() throws IOException {
        try (ZipFile jar = new ZipFile(System.getProperty("natator.jar"))) {
            assertThat(jar.getEntry("META-INF/NOTICE.md")).isNull();
        }
    }
}
