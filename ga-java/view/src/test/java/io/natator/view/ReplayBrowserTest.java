package io.natator.view;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.natator.replay.Replay;
import io.natator.replay.ReplayHtml;
import io.natator.replay.ReplayRecorder;
import io.natator.stream.StreamFrame;
import io.natator.stream.StreamOptions;
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

    @TempDir
    private Path folder;
    private Path file;

    @Override
    boolean isOwn(URI address) {
        return address.getScheme().matches("blob|data") || address.toString().contains(file.toString());
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
            page.evaluate("""
                    time => {
                      const scrub = document.getElementById('scrub');
                      scrub.value = time;
                      scrub.dispatchEvent(new Event('input'));
                    }""", recorded.time());
            await("Math.abs(natator.time() - " + recorded.time() + ") < 1e-6");

            List<?> shown = (List<?>) page.evaluate("() => natator.position()");

            assertThat(shown).hasSize(3 * swim.scene().particles());
            for (int i = 0; i < shown.size(); i++) {
                assertThat(((Number) shown.get(i)).doubleValue())
                        .isCloseTo(recorded.position()[i], within(1.05 * written.largestError()));
            }
        }
    }
}
