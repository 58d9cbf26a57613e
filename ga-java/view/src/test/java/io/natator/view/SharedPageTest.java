package io.natator.view;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import com.fasterxml.jackson.databind.JsonNode;
import com.microsoft.playwright.Browser.NewContextOptions;
import com.microsoft.playwright.options.BoundingBox;
import io.natator.config.Json;
import io.natator.config.Scheme;
import io.natator.replay.Replay;
import io.natator.replay.ReplayHtml;
import io.natator.replay.ReplayRecorder;
import io.natator.stream.StreamFrame;
import io.natator.stream.StreamOptions;
import java.awt.image.BufferedImage;
import java.io.IOException;
import java.net.URI;
import java.nio.file.Path;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

/** The file that replays a swim, opened from disk. */
@Timeout(value = 30, unit = TimeUnit.MINUTES)
class SharedPageTest extends BrowserTest {

    private static final double SECONDS = 1;
    private static final String LOACH = """
            {"frequency":2,"amplitude":[0.4,0.35,0.3,0.25,0.2],"phase":[0,0.902,0.804,0.706,0.608]}""";

    @TempDir
    private static Path folder;
    private static Path file;
    private static Replay swim;
    private static double largestError;

    @BeforeAll
    static void write() throws IOException, InterruptedException {
        JsonNode gait = Json.parse(ViewFixture.GAIT.replace('\'', '"'), JsonNode.class);
        swim = new ReplayRecorder(ViewFixture.SIMULATOR).record("swim", StreamOptions
                .recording("thesis/creature-1", null, gait, SECONDS).with(Scheme.CONSERVING, null));
        file = folder.resolve("swim.html");
        Map<String, String> facts = new LinkedHashMap<>();
        facts.put("verdict", "swims: as told");
        facts.put("half step", "<slower>");
        swim = swim.with(swim.title(), facts);
        largestError = new ReplayHtml("swim", List.of(swim), true).write(file, 10_000_000).largestError();
    }

    @Override
    boolean isOwn(URI address) {
        return address.getScheme().matches("blob|data")
                || address.toString().matches("file://" + folder + "/\\w+\\.html([?#].*)?");
    }

    @Test
    void theSwimIsPlayedAgain() {
        page.navigate(file.toUri().toString());
        assertThat(get("status")).hasAttribute("data-state", "open");
        await("window.natator && natator.time() > 0.2");

        BufferedImage picture = picture(get("picture-a"));
        assertThat(colours(picture)).isGreaterThan(500);
        assertThat(number("natator.position().length")).isEqualTo(number("3 * natator.scene().particles"));
        assertThat(page.evaluate("() => natator.scene().scheme")).isEqualTo("conserving");
        assertThat(get("facts").locator("dt").first()).hasText("Verdict");
        assertThat(get("facts").locator("dd"))
                .containsText(new String[] {"swims: as told", "<slower>", "thesis/creature-1"});
        await("natator.time() > 0.9");
        await("natator.time() < 0.5");
    }

    /** From the simulator through the packed file into the browser. */
    @Test
    void itShowsThePlacesThatWereSimulated() {
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
                        .isCloseTo(recorded.position()[i], within(1.05 * largestError));
            }
        }
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

    /** Plane flow is recorded with its water, and the body goes on where the tank has moved along. */
    @Test
    void theWakeIsSeenInPlaneFlow() throws IOException, InterruptedException {
        Replay loach = new ReplayRecorder(ViewFixture.SIMULATOR).record("loach",
                StreamOptions.recording("plane/loach", null, Json.parse(LOACH, JsonNode.class), 0.7));
        assertThat(loach.waters()).as("before the end").hasSize(7);
        Path plane = folder.resolve("loach.html");
        new ReplayHtml("loach", List.of(loach), true).write(plane, 10_000_000);
        page.navigate(plane.toUri() + "?drawing=plain");
        await("window.natator && natator.time() > 0");
        get("play").click();

        double first = seek(loach.frames().get(0));
        StreamFrame last = loach.frames().get(loach.frames().size() - 1);
        assertThat(last.distance()).isGreaterThan(0.3);
        assertThat(seek(last) - first).as("mean x of the body").isCloseTo(last.distance(), within(1e-4));
        assertThat(get("water-vorticity").isChecked()).isTrue();
        assertThat(get("water-surface").isHidden()).isTrue();
        await("/[1-9]0/.test(document.querySelector('[data-testid=legend-turns]').textContent)");
        assertThat(colours(stillPicture(get("picture-a")))).isGreaterThan(500);

        new ReplayHtml("loach", List.of(loach), false).write(plane, 10_000_000);
        page.navigate(plane.toUri() + "?drawing=plain");
        await("window.natator && natator.time() > 0");
        assertThat(get("water-vorticity").isHidden()).isTrue();
        assertThat(get("legend-turns").isHidden()).isTrue();
    }

    @Test
    void aSmallScreenIsEnough() {
        useBrowser(new NewContextOptions().setViewportSize(390, 844).setDeviceScaleFactor(2).setHasTouch(true)
                .setIsMobile(true));
        page.navigate(file.toUri().toString());
        assertThat(get("status")).hasAttribute("data-state", "open");

        assertThat(number("document.documentElement.scrollWidth")).as("width").isLessThanOrEqualTo(390);
        assertThat(cutMenus()).isEmpty();
        BoundingBox title = page.locator("h1").boundingBox();
        BoundingBox help = get("help-open").boundingBox();
        assertThat(help.y + help.height / 2).as("in the first row").isCloseTo(title.y + title.height / 2, within(2.0));
        BoundingBox speed = get("chart-speed").boundingBox();
        BoundingBox momentum = get("chart-momentum").boundingBox();
        assertThat(momentum.x + momentum.width - speed.x).as("width of two charts").isGreaterThan(330);
        assertThat((List<?>) page.evaluate("""
                () => [...document.querySelectorAll('.charts .key')].map(one => one.parentNode)
                    .filter(one => one.getClientRects().length !== 1).map(one => one.outerHTML)"""))
                .as("lines of a legend parted from their names").isEmpty();
        get("play").tap();
        assertThat(get("play")).hasText("Play");
    }

    @Test
    void whatIsSeenIsTold() {
        page.navigate(file.toUri().toString());
        await("window.natator && natator.time() > 0.1");

        assertThat(get("about")).isHidden();
        page.keyboard().press("a");

        assertThat(get("about")).isVisible();
        assertThat(get("about")).containsText("plays it again");
        assertThat(get("about")).not().containsText("while you watch");
        page.keyboard().press("Escape");
        assertThat(get("about")).isHidden();
    }

    @Test
    void itStandsAtTheTimeThatIsChosen() {
        page.navigate(file.toUri().toString());
        await("window.natator && natator.time() > 0.1");
        get("play").click();

        get("scrub").fill("0.5");
        await("Math.abs(natator.time() - 0.5) < 0.02");
        BufferedImage still = stillPicture(get("picture-a"));
        double distance = number("natator.distance()");
        awaitDrawings(30);

        assertThat(number("natator.time()")).isBetween(0.48, 0.52);
        assertThat(difference(still, picture(get("picture-a")))).isZero();
        get("scrub").fill("0");
        await("natator.time() === 0");
        assertThat(number("natator.distance()")).as("at the start, but for rounding").isCloseTo(0, within(1e-4));
        assertThat(Math.abs(distance)).isGreaterThan(1e-3);
    }
}
