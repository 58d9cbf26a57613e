package io.natator.view;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static org.assertj.core.api.Assertions.assertThat;

import com.fasterxml.jackson.databind.JsonNode;
import com.microsoft.playwright.Browser.NewContextOptions;
import com.microsoft.playwright.Download;
import com.microsoft.playwright.Locator;
import io.natator.config.Json;
import java.awt.image.BufferedImage;
import java.io.IOException;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.concurrent.TimeUnit;
import java.util.regex.Pattern;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/** The page of {@code natator view} in a real browser, with the real simulator. */
@Timeout(value = 30, unit = TimeUnit.MINUTES)
class ViewPageTest extends BrowserTest {

    /** An empty picture has its background's few colours. */
    private static final int LEAST_COLOURS = 500;

    @TempDir
    private static Path folder;
    private static ViewServer water;
    private static ViewServer vacuum;

    private ViewServer server;

    @BeforeAll
    static void start() throws InterruptedException {
        Path run = ViewFixture.evolve(folder);
        water = ViewFixture.server("thesis/creature-1", run);
        vacuum = ViewFixture.server(ViewFixture.SCENE, run);
    }

    @AfterAll
    static void stop() {
        water.close();
        vacuum.close();
    }

    @BeforeEach
    void noSimulatorIsLeft() throws InterruptedException {
        ViewFixture.await("the end of the last page", () -> ViewFixture.simulators(ProcessHandle.current()).isEmpty());
    }

    @Override
    boolean isOwn(URI address) {
        return address.getScheme().matches("blob|data") || server.address().getAuthority().equals(address.getAuthority());
    }

    /** Opens the page and waits until it swims. */
    private void open(ViewServer on) {
        server = on;
        page.navigate(server.address().toString());
        awaitSwimming();
    }

    private void awaitSwimming() {
        await("window.natator && natator.frame() > 5");
        assertThat(get("status")).hasAttribute("data-state", "open");
    }

    /** Without water, which is quick to draw, and paused at its start. */
    private void openAtRest() {
        open(vacuum);
        get("run").click();
        get("reset").click();
        await("natator.frame() === 0");
    }

    /** Where the body is after so many frames from the start. */
    private List<?> pathOf(int frames) {
        get("reset").click();
        await("natator.frame() === 0");
        for (int i = 1; i <= frames; i++) {
            get("step").click();
            await("natator.frame() === " + i);
        }
        return (List<?>) page.evaluate("() => natator.position()");
    }

    private JsonNode gait() throws IOException {
        return Json.parse((String) page.evaluate("() => JSON.stringify(natator.scene().gait)"), JsonNode.class);
    }

    @Test
    void aSwimmerInWaterIsSeen() {
        open(water);
        await("natator.fps() > 0");

        BufferedImage before = picture(get("picture-a"));
        assertThat(colours(before)).isGreaterThan(LEAST_COLOURS);
        await("natator.frame() > 60");
        assertThat(difference(before, picture(get("picture-a")))).as("what has moved").isGreaterThan(0.005);
        assertThat(get("time-a")).containsText("s");
        assertThat(get("dropped-a")).hasText(Pattern.compile("\\d+"));
        assertThat(get("distance-a")).hasText(Pattern.compile("-?\\d+\\.\\d+"));
        assertThat(get("overlay-a")).isHidden();
        assertThat(get("banner")).isHidden();
    }

    /** Each of them draws its own way; both must do without a graphics card. */
    @ParameterizedTest
    @CsvSource({"webgl, WebGL", "plain, processor"})
    void bothWaysOfDrawingShowIt(String drawing, String name) {
        open(water);
        get("run").click();
        get("drawing").selectOption(drawing);
        choose("water-none");
        BufferedImage without = stillPicture(get("picture-a"));
        assertThat(page.evaluate("() => natator.drawing()")).isEqualTo(name);
        for (String shown : List.of("spheres", "surface")) {
            choose("water-" + shown);
            BufferedImage with = stillPicture(get("picture-a"));
            keepPicture("ViewPageTest-" + drawing + "-" + shown);
            assertThat(colours(with)).as("colours of %s", shown).isGreaterThan(LEAST_COLOURS);
            assertThat(difference(without, with)).as("share of %s", shown).isGreaterThan(0.2);
        }
    }

    /** Presses one of several buttons in a row; the radio button itself is hidden. */
    private void choose(String testId) {
        get(testId).check(new Locator.CheckOptions().setForce(true));
    }

    @Test
    void aSliderChangesTheMotion() throws IOException {
        openAtRest();
        List<?> before = pathOf(12);
        assertThat(pathOf(12)).as("the same gait again").isEqualTo(before);

        get("amplitude-1").fill("0.2");
        await("natator.scene().gait.amplitude[0] === 0.2");

        assertThat(gait().get("amplitude").get(1).asDouble()).isEqualTo(0.6);
        assertThat(pathOf(12)).isNotEqualTo(before);
        get("frequency-number").fill("1.85");
        get("frequency-number").press("Enter");
        await("natator.scene().gait.frequency === 1.85");
    }

    @Test
    void aSolverSettingTakesEffectAtOnce() {
        openAtRest();

        get("damping").fill("3");
        await("natator.scene().definition.solver.damping === 3");

        assertThat(number("natator.scene().restarted ? 1 : 0")).isZero();
    }

    @Test
    void whatIsRefusedIsSaid() {
        openAtRest();

        get("frequency-number").fill("-7");
        get("frequency-number").press("Enter");

        assertThat(get("frequency-error")).containsText("-7 is not used; expected 0.01 to 60 /s");
        assertThat(number("natator.scene().gait.frequency")).isEqualTo(1.5);
    }

    /** What is refused leaves no trace in the next change. */
    @Test
    void afterARefusalTheRestCanBeChanged() throws IOException {
        openAtRest();
        get("frequency-number").fill("99");
        get("frequency-number").press("Enter");
        assertThat(get("frequency-error")).hasText("Frequency: 99 is not used; expected 0.01 to 60 /s");
        get("amplitude-1-number").fill("3");
        get("amplitude-1-number").press("Enter");
        assertThat(get("actuator-error")).hasText("amplitude of actuator 1: 3 is not used; expected 0 to 2");

        get("amplitude-1").fill("0.2");

        await("natator.scene().gait.amplitude[0] === 0.2");
        assertThat(gait().get("frequency").asDouble()).isEqualTo(1.5);
        assertThat(get("frequency-number")).hasValue("1.5");
        assertThat(get("frequency-error")).isHidden();
        get("frequency-number").fill("2.5");
        get("frequency-number").press("Enter");
        await("natator.scene().gait.frequency === 2.5");
    }

    /** Slows the page down, so that it draws with less detail; notes each picture that it shows black. */
    private static final String SLOW_AND_WATCHED = """
            () => {
              const sample = document.createElement('canvas').getContext('2d', {willReadFrequently: true});
              window.black = 0;
              const next = () => {
                const until = performance.now() + 25;
                while (performance.now() < until && !window.isQuick) { }
                sample.clearRect(0, 0, 30, 30);
                sample.drawImage(document.querySelector('.picture canvas'), 0, 0, 30, 30);
                const {data} = sample.getImageData(0, 0, 30, 30);
                window.black += data.every((value, i) => i % 4 === 3 || value < 8) ? 1 : 0;
                requestAnimationFrame(next);
              };
              requestAnimationFrame(next);
            }""";

    @Test
    void lessDetailIsNoBlackFlash() {
        open(water);
        get("drawing").selectOption("webgl");
        awaitDrawings(3);
        page.evaluate(SLOW_AND_WATCHED);

        await("natator.share() < 0.8");

        assertThat(number("window.black")).as("black pictures").isZero();
    }

    @Test
    void aPausedPictureGetsAllItsDetail() {
        open(water);
        get("drawing").selectOption("webgl");
        page.evaluate(SLOW_AND_WATCHED);
        await("natator.share() < 1");

        get("run").click();

        await("natator.share() === 1");
        page.evaluate("() => { window.isQuick = true; }");
        BufferedImage still = stillPicture(get("picture-a"));
        assertThat(number("natator.share()")).isOne();
        assertThat(colours(still)).isGreaterThan(LEAST_COLOURS);
    }

    @Test
    void pauseHoldsStill() {
        open(vacuum);
        get("run").click();
        assertThat(get("run")).hasText("Run");
        // Frames may be under way, and the camera and the detail follow a little later.
        BufferedImage before = stillPicture(get("picture-a"));
        double frame = number("natator.frame()");

        awaitDrawings(60);

        assertThat(number("natator.frame()")).isEqualTo(frame);
        assertThat(difference(before, picture(get("picture-a")))).isZero();
        get("run").click();
        await("natator.frame() > " + (frame + 10));
    }

    @Test
    void aReloadReconnects() throws InterruptedException {
        open(vacuum);
        ProcessHandle before = ViewFixture.simulator();

        page.reload();
        awaitSwimming();

        ViewFixture.await("the end of the first simulator", () -> !before.isAlive());
        assertThat(ViewFixture.simulator().pid()).isNotEqualTo(before.pid());
    }

    @Test
    void aKilledSimulatorIsReportedAndGoesOn() {
        open(vacuum);
        await("natator.frame() > 60");
        // Slowly from here on, so that the next one is seen at its start.
        get("rate").selectOption("0.1");

        ViewFixture.simulator().destroyForcibly();

        assertThat(get("banner")).containsText("was lost");
        assertThat(get("banner")).containsText("started again");
        await("natator.frame() < 60 && natator.frame() > 10");
        assertThat(get("status")).hasAttribute("data-state", "open");
    }

    @Test
    void oneThatIsLostForGoodIsStartedAgainByAButton() throws InterruptedException {
        open(vacuum);
        for (int i = 0; i < 4; i++) {
            ViewFixture.await("a simulator", () -> ViewFixture.simulators(ProcessHandle.current()).size() == 1);
            ProcessHandle simulator = ViewFixture.simulator();
            simulator.destroyForcibly();
            ViewFixture.await("its end", () -> !simulator.isAlive());
        }
        assertThat(get("banner-again")).isVisible();
        assertThat(ViewFixture.simulators(ProcessHandle.current())).isEmpty();

        get("banner-again").click();

        assertThat(get("banner")).isHidden();
        ViewFixture.await("another simulator", () -> ViewFixture.simulators(ProcessHandle.current()).size() == 1);
        double frame = number("natator.frame()");
        await("natator.frame() !== " + frame);
    }

    /** Nothing is cut off, and nothing has to be scrolled for. */
    @ParameterizedTest
    @CsvSource({"1400, 900", "1280, 720", "1920, 1080"})
    void allOfItFitsTheWindow(int width, int height) {
        page.setViewportSize(width, height);
        open(vacuum);
        await("document.querySelector('[data-chart=envelope]').textContent !== ''");

        assertThat(number("document.documentElement.scrollHeight")).isLessThanOrEqualTo(height);
        assertThat(number("document.documentElement.scrollWidth")).isLessThanOrEqualTo(width);
        Object cut = page.evaluate("""
                () => [...document.querySelectorAll('.charts figcaption, .charts figcaption *, .charts canvas')]
                    .filter(one => one.scrollWidth > one.clientWidth + 1 && getComputedStyle(one).display !== 'inline'
                        || one.getBoundingClientRect().right > one.closest('figure').getBoundingClientRect().right
                        || one.getBoundingClientRect().bottom > innerHeight)
                    .map(one => one.outerHTML)""");
        assertThat((List<?>) cut).isEmpty();
        assertThat(get("picture-a").boundingBox().height).isGreaterThan(250);
        assertThat(cutMenus()).isEmpty();
    }

    @Test
    void aSmallScreenIsEnough() {
        useBrowser(new NewContextOptions().setViewportSize(390, 844).setDeviceScaleFactor(2).setHasTouch(true)
                .setIsMobile(true));
        open(vacuum);

        assertThat(number("document.documentElement.scrollWidth")).as("width").isLessThanOrEqualTo(390);
        assertThat(get("picture-a").boundingBox().height).isGreaterThan(200);
        assertThat(cutMenus()).isEmpty();
        get("run").tap();
        assertThat(get("run")).hasText("Run");
        get("frequency").scrollIntoViewIfNeeded();
        assertThat(get("frequency").boundingBox().width).isGreaterThan(80);
        get("frequency").fill("1.2");
        await("natator.scene().gait.frequency === 1.2");
        get("picture-a").scrollIntoViewIfNeeded();
        assertThat(colours(picture(get("picture-a")))).isGreaterThan(100);
    }

    @Test
    void theKeyboardIsEnough() {
        open(vacuum);

        page.keyboard().press("Space");
        assertThat(get("run")).hasText("Run");
        page.keyboard().press("r");
        await("natator.frame() === 0");
        page.keyboard().press(".");
        await("natator.frame() === 1");
        page.keyboard().press("2");
        assertThat(get("camera-side")).isChecked();
        page.keyboard().press("?");
        assertThat(get("help")).isVisible();
        page.keyboard().press("Escape");
        assertThat(get("help")).isHidden();
        for (int i = 0; i < 60 && !isFocused("frequency"); i++) {
            page.keyboard().press("Tab");
        }
        page.keyboard().press("ArrowRight");
        await("Math.abs(natator.scene().gait.frequency - 1.51) < 1e-9");
    }

    private boolean isFocused(String testId) {
        return (Boolean) page.evaluate("id => document.activeElement.dataset.testid === id", testId);
    }

    @Test
    void theGenerationsOfARunAreWatched() throws IOException {
        open(vacuum);

        get("chart-fitness").focus();
        page.keyboard().press("Home");

        assertThat(get("run-chosen")).containsText("Generation 0");
        JsonNode first = best(0);
        await("Math.abs(natator.scene().gait.frequency - " + first.get("frequency") + ") < 1e-9");
        assertThat(page.evaluate("() => natator.scene().scheme")).isEqualTo("conserving");
        page.keyboard().press("End");
        await("Math.abs(natator.scene().gait.frequency - " + best(3).get("frequency") + ") < 1e-9");
    }

    private JsonNode best(int generation) throws IOException {
        return Json.parse((String) page.evaluate("async () => (await fetch('/api/runs/0')).text()"), JsonNode.class)
                .get("bests").get(generation).get("gait");
    }

    @Test
    void twoSwimSideBySide() {
        open(vacuum);

        get("compare").click();
        await("natator.views[1].frame() > 5");

        assertThat(get("stage-b")).isVisible();
        assertThat(ViewFixture.simulators(ProcessHandle.current())).hasSize(2);
        assertThat(colours(picture(get("picture-b")))).isGreaterThan(100);
        get("compare").click();
        assertThat(get("stage-b")).isHidden();
        assertThat(get("run")).hasText("Pause");
        double frame = number("natator.frame()");
        await("natator.frame() > " + (frame + 5));
    }

    /** Whose a line in a chart is shows by its colour, which is that of the caption; what it is, by its dashes. */
    @Test
    void twoSwimInColoursOfTheirOwn() {
        open(vacuum);
        await("(" + PIXELS + ")('momentum', '--series-2') > 20");
        get("compare").click();
        choose("which-1");
        get("amplitude-1").fill("0.2");
        await("natator.views.length === 2 && natator.views[1].time() > 0.5");
        get("run").click();
        assertThat(get("run")).hasText("Run");
        awaitDrawings(60);

        assertThat(number("(" + PIXELS + ")('momentum', '--series-1')")).as("of the left one").isGreaterThan(20);
        assertThat(number("(" + PIXELS + ")('momentum', '--series-b')")).as("of the right one").isGreaterThan(20);
        assertThat(number("(" + PIXELS + ")('momentum', '--series-2')")).as("of neither").isZero();
        assertThat(get("charts").locator("figure:has(#chart-momentum) .key").first())
                .hasCSS("color", (String) page.evaluate("() => getComputedStyle(document.querySelector('.hint')).color"));
    }

    /** How many pixels of a chart have about a colour of the page. */
    private static final String PIXELS = """
            (chart, colour) => {
              const canvas = document.getElementById(`chart-${chart}`);
              const hex = getComputedStyle(canvas).getPropertyValue(colour).trim();
              const wanted = [1, 3, 5].map(at => parseInt(hex.slice(at, at + 2), 16));
              const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
              let count = 0;
              for (let i = 0; i < data.length; i += 4) {
                const isNear = wanted.every((value, k) => Math.abs(value - data[i + k]) < 24);
                count += isNear && data[i + 3] > 128 ? 1 : 0;
              }
              return count;
            }""";

    /** One swims in water, which takes longer; the other one waits. */
    @Test
    void twoSwimInStep() {
        open(vacuum);
        get("compare").click();
        await("natator.views[1].frame() > 5");
        choose("which-1");
        get("vacuum").uncheck();
        // The other one goes back to the start with it.
        await("natator.views[1].position().length > 3000 && natator.views[0].frame() === natator.views[1].frame()");

        Object apart = page.evaluate("""
                () => new Promise(done => {
                  let most = 0, count = 40;
                  const next = () => {
                    most = Math.max(most, Math.abs(natator.views[0].time() - natator.views[1].time()));
                    count-- > 0 ? requestAnimationFrame(next) : done(most);
                  };
                  requestAnimationFrame(next);
                })""");
        assertThat(((Number) apart).doubleValue()).as("simulated seconds between them").isLessThan(1e-9);
        get("run").click();
        assertThat(get("run")).hasText("Run");
        get("reset").click();
        await("natator.views[0].frame() === 0 && natator.views[1].frame() === 0");
        for (int i = 1; i <= 3; i++) {
            get("step").click();
            await("natator.views[0].frame() === " + i + " && natator.views[1].frame() === " + i);
        }
        assertThat(get("time-b")).hasText("0.05 s");
        assertThat(get("time-a")).hasText("0.05 s");
        get("run").click();
        await("natator.views[0].frame() > 10 && natator.views[1].frame() > 10");
    }

    @Test
    void generationsAreComparedByName() {
        open(vacuum);
        assertThat(get("run-chosen")).containsText("What swims is not of this run");
        get("chart-fitness").focus();
        page.keyboard().press("Home");
        assertThat(get("stage-a").locator("figcaption")).containsText("my-run, generation 0");

        get("run-compare").click();
        assertThat(get("stage-b").locator("figcaption")).containsText("my-run, generation 0");
        assertThat(get("stage-a").locator("figcaption")).containsText("creature-1-vacuum, gait of your own");

        choose("which-0");
        get("chart-fitness").focus();
        page.keyboard().press("Home");
        assertThat(get("stage-a").locator("figcaption")).containsText("my-run, generation 0");
        get("compare").click();
        assertThat(get("stage-b")).isHidden();
        await("(views => views?.length === 1 && JSON.stringify(views[0].gait) === JSON.stringify(natator.scene().gait))"
                + "(JSON.parse(decodeURIComponent(location.hash.slice(1)) || '{}').views)");  // the address remembers soon, not at once
        page.reload();
        awaitSwimming();
        assertThat(get("run-chosen")).containsText("Generation 0");
        get("run-compare").click();
        assertThat(get("run-error")).hasText("This gait swims already: choose another generation first.");
        assertThat(get("stage-b")).isHidden();
    }

    @Test
    void aGaitIsSavedAsAFile() throws IOException {
        openAtRest();

        Download saved = page.waitForDownload(() -> get("gait-save").click());

        JsonNode gait = Json.parse(Files.readString(saved.path()), JsonNode.class);
        assertThat(gait).isEqualTo(gait());
        assertThat(saved.suggestedFilename()).endsWith("-gait.json");
    }

    @Test
    void waterComesAndGoes() {
        open(vacuum);
        get("vacuum").uncheck();
        await("natator.scene().fluid[1] > 1000 && natator.frame() > 5");
        get("scheme").selectOption("conserving");
        await("natator.scene().scheme === 'conserving' && natator.frame() > 5");

        get("vacuum").check();
        await("natator.scene().fluid[1] === 0");
        assertThat(page.evaluate("() => natator.scene().scheme")).isEqualTo("conserving");
    }
}
