package io.natator.view;

import java.io.IOException;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/**
 * Measures how many frames a second the page shows, drawn by three.js and by the processor, and writes
 * {@code results/benchmarks/page.csv}; see the README there. No test of the suite: it runs only where it is named.
 */
class PageSpeed extends BrowserTest {

    private static final Path TABLE = Path.of("..", "..", "results", "benchmarks", "page.csv");
    private static final int SPANS = 5;
    private static final int SPAN_MILLISECONDS = 2000;

    private static final List<String> ROWS = new ArrayList<>();
    private static Process view;
    private static URI address;

    /** As its user starts it: tests run without the compiler's later stages. */
    @BeforeAll
    static void start() throws IOException {
        ROWS.add("scheme,scene,drawing,from_s,simulated_per_s,shown_per_s,detail");
        view = new ProcessBuilder("java", "-jar", Path.of("..", "target", "natator.jar").toString(), "view",
                "--creature", "1",
                "--port", "0", "--no-browser", "--simulator-path", ViewFixture.SIMULATOR.toString())
                .redirectError(ProcessBuilder.Redirect.INHERIT).start();
        address = URI.create(view.inputReader().readLine());
    }

    @AfterAll
    static void stop() throws IOException {
        view.destroy();
        Files.write(TABLE, ROWS);
    }

    @Override
    boolean isOwn(URI other) {
        return other.getScheme().matches("blob|data") || address.getAuthority().equals(other.getAuthority());
    }

    @ParameterizedTest
    @CsvSource({"flex, thesis/creature-1, webgl", "flex, thesis/creature-1, plain",
            "conserving, thesis/creature-1, webgl",
            "conserving, thesis/creature-1, plain", "lattice, plane/loach, webgl", "lattice, plane/loach, plain"})
    void framesAreShown(String scheme, String scene, String drawing) {
        page.setViewportSize(1400, 900);
        page.navigate(address + "?drawing=" + drawing);
        await("window.natator && natator.frame() > 5");
        get("scene").selectOption(scene);
        await("natator.scene().scene === '" + scene + "'");
        get("scheme").selectOption(scheme);
        await("natator.scene().scheme === '" + scheme + "' && natator.frame() > 60");
        double frame = number("natator.frame()");
        double dropped = number("natator.dropped()");
        long time = System.nanoTime();
        for (int span = 0; span < SPANS; span++) {
            page.waitForTimeout(SPAN_MILLISECONDS);
            double seconds = (System.nanoTime() - time) / 1e9;
            double frames = number("natator.frame()") - frame;
            double missed = number("natator.dropped()") - dropped;
            ROWS.add(String.format(Locale.ROOT, "%s,%s,%s,%d,%.1f,%.1f,%.2f", scheme, scene,
                    page.evaluate("() => natator.drawing()"), span * SPAN_MILLISECONDS / 1000, frames / seconds,
                    (frames - missed) / seconds,
                    number("natator.share()")));
            time = System.nanoTime();
            frame += frames;
            dropped += missed;
        }
    }
}
