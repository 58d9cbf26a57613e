package io.natator.view;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.config.Json;
import io.natator.replay.Replay;
import io.natator.replay.ReplayHtml;
import io.natator.replay.ReplayRecorder;
import io.natator.stream.StreamFrame;
import io.natator.stream.StreamOptions;
import java.io.IOException;
import java.net.URI;
import java.nio.file.Path;
import java.util.List;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

/** What {@code natator page} wrote, opened in a real browser. */
@Timeout(value = 30, unit = TimeUnit.MINUTES)
class ReplayBrowserTest extends BrowserTest {

    private static final String LOACH = """
            {"frequency":2,"amplitude":[0.4,0.35,0.3,0.25,0.2],"phase":[0,0.902,0.804,0.706,0.608]}""";

    @TempDir
    private Path folder;
    private Path file;

    @Override
    boolean isOwn(URI address) {
        return address.getScheme().matches("blob|data") || address.toString().contains(file.toString());
    }

    /** Plane flow is recorded with its water, and the body goes on where the tank has moved along. */
    @Test
    void aReplayShowsTheWakeInPlaneFlow() throws IOException, InterruptedException {
        Replay swim = new ReplayRecorder(ViewFixture.SIMULATOR).record("loach",
                StreamOptions.recording("plane/loach", null, Json.parse(LOACH, JsonNode.class), 0.7));
        assertThat(swim.waters()).as("before the end").hasSize(7);
        file = folder.resolve("loach.html");
        new ReplayHtml("loach", List.of(swim), true).write(file, 10_000_000);
        page.navigate(file.toUri() + "?drawing=plain");
        await("window.natator && natator.time() > 0");
        page.getByTestId("play").click();

        double first = seek(swim.frames().get(0));
        StreamFrame last = swim.frames().get(swim.frames().size() - 1);
        assertThat(last.distance()).isGreaterThan(0.3);
        assertThat(seek(last) - first).as("mean x of the body").isCloseTo(last.distance(), within(1e-4));
        assertThat(get("water-vorticity").isChecked()).isTrue();
        assertThat(get("water-surface").isHidden()).isTrue();
        await("/[1-9]0/.test(document.querySelector('[data-testid=legend-turns]').textContent)");
        assertThat(colours(stillPicture(get("picture-a")))).isGreaterThan(500);

        new ReplayHtml("loach", List.of(swim), false).write(file, 10_000_000);
        page.navigate(file.toUri() + "?drawing=plain");
        await("window.natator && natator.time() > 0");
        assertThat(get("water-vorticity").isHidden()).isTrue();
        assertThat(get("legend-turns").isHidden()).isTrue();
    }

    /** Goes to a frame; the mean x of its body. */
    private double seek(StreamFrame recorded) {
        page.evaluate("""
                time => {
                  const scrub = document.getElementById('scrub');
                  scrub.value = time;
                  scrub.dispatchEvent(new Event('input'));
                }""", recorded.time());
        await("Math.abs(natator.time() - " + recorded.time() + ") < 1e-6");
        return number("natator.scene().body.reduce((sum, i) => sum + natator.position()[3 * i], 0)"
                + " / natator.scene().body.length");
    }

    /** From the simulator through the packed file into the browser. */
    @Test
    void aReplayShowsThePlacesThatWereSimulated() throws InterruptedException {
        Replay swim = new ReplayRecorder(ViewFixture.SIMULATOR)
                .record("swim", StreamOptions.recording("thesis/creature-1", null, null, 0.25));
        file = folder.resolve("swim.html");
        ReplayHtml.Written written = new ReplayHtml("swim", List.of(swim), true).write(file, 10_000_000);
        page.navigate(file.toUri().toString());
        await("window.natator && natator.time() > 0");
        page.getByTestId("play").click();

        for (int frame : new int[] {0, 7, 15}) {
            StreamFrame recorded = swim.frames().get(frame);
            seek(recorded);

            List<?> shown = (List<?>) page.evaluate("() => natator.position()");

            assertThat(shown).hasSize(3 * swim.scene().particles());
            for (int i = 0; i < shown.size(); i++) {
                assertThat(((Number) shown.get(i)).doubleValue())
                        .isCloseTo(recorded.position()[i], within(1.05 * written.largestError()));
            }
        }
    }
}
