package io.natator.view;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import com.microsoft.playwright.Browser.NewContextOptions;
import com.microsoft.playwright.Download;
import java.awt.image.BufferedImage;
import java.io.IOException;
import java.nio.file.Files;
import java.util.List;
import java.util.concurrent.TimeUnit;
import javax.imageio.ImageIO;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import io.natator.process.Processes;

/** What is around the picture, and what becomes of both when a simulator or the page ends. */
@Timeout(value = 30, unit = TimeUnit.MINUTES)
class ViewPageTest extends ViewBrowserTest {

    @Test
    void pauseHoldsStill() {
        open(vacuum);
        pause();
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

        Processes.await("the end of the first simulator", () -> !before.isAlive());
        assertThat(ViewFixture.simulator().pid()).isNotEqualTo(before.pid());
    }

    @Test
    void aKilledSimulatorIsReportedAndGoesOn() {
        open(vacuum);

        ViewFixture.simulator().destroyForcibly();

        assertThat(get("banner")).containsText("was lost");
        assertThat(get("banner")).containsText("started again");
        await("natator.frame() > " + number("natator.frame()"));
        assertThat(get("status")).hasAttribute("data-state", "open");
    }

    @Test
    void oneThatIsLostForGoodIsStartedAgainByAButton() throws InterruptedException {
        open(vacuum);
        for (int i = 0; i < 4; i++) {
            Processes.await("a simulator", () -> ViewFixture.simulators(ProcessHandle.current()).size() == 1);
            ProcessHandle simulator = ViewFixture.simulator();
            simulator.destroyForcibly();
            Processes.await("its end", () -> !simulator.isAlive());
        }
        assertThat(get("banner-again")).isVisible();
        assertThat(ViewFixture.simulators(ProcessHandle.current())).isEmpty();

        get("banner-again").click();

        assertThat(get("banner")).isHidden();
        Processes.await("another simulator", () -> ViewFixture.simulators(ProcessHandle.current()).size() == 1);
        double frame = number("natator.frame()");
        await("natator.frame() !== " + frame);
    }

    /** Nothing is cut off, and nothing has to be scrolled for. */
    @Test
    void allOfItFitsTheWindow() {
        open(vacuum);
        await("document.querySelector('[data-chart=speed]').textContent !== ''");
        fits(1400, 900);
        fits(1280, 720);
        fits(1920, 1080);
    }

    /** While it swims; what changes all the time is not said. */
    @Test
    void aScreenReaderCanTellWhatIsThere() throws IOException {
        open(vacuum);
        assertThat(said(30)).isEmpty();
        assertThat(barriers()).isEmpty();
        get("about-open").click();
        assertThat(barriers()).isEmpty();
    }

    private void fits(int width, int height) {
        page.setViewportSize(width, height);
        awaitDrawings(3);

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
    void aPresentationIsThePictureAlone() {
        open(vacuum);
        assertThat(get("chart-density")).isHidden();
        assertThat(get("legend-water")).isHidden();
        assertThat(get("legend-muscles")).containsText("−50 %");

        page.keyboard().press("p");

        assertThat(get("run")).isHidden();
        assertThat(get("gait")).isHidden();
        assertThat(get("legend")).isVisible();
        assertThat(get("picture-a").boundingBox().height).isGreaterThan(HEIGHT - 20);
        assertThat(get("present-end")).isFocused();
        page.keyboard().press("Escape");
        assertThat(get("run")).isVisible();
        get("about-open").click();
        assertThat(get("about")).isVisible();
        assertThat(get("about")).containsText("What still moves forwards does so by an error");
    }

    @Test
    void picturesAndFilmsAreSaved() throws IOException {
        open(vacuum);

        Download picture = page.waitForDownload(() -> get("picture-save").click());

        assertThat(picture.suggestedFilename()).isEqualTo("creature-1-vacuum-picture.png");
        BufferedImage saved = ImageIO.read(picture.path().toFile());
        assertThat(saved.getWidth()).isCloseTo((int) get("stages").boundingBox().width, within(2));
        assertThat(colours(saved)).isGreaterThan(100);
        get("film").click();
        assertThat(get("film")).hasAttribute("aria-pressed", "true");
        awaitDrawings(20);
        Download film = page.waitForDownload(() -> get("film").click());
        assertThat(film.suggestedFilename()).isEqualTo("creature-1-vacuum-film.webm");
        assertThat(Files.readAllBytes(film.path())).startsWith(0x1a, 0x45, 0xdf, 0xa3).hasSizeGreaterThan(1000);
        get("run").click();
        get("film").click();
        Download brief = page.waitForDownload(() -> get("film").click());
        assertThat(Files.readAllBytes(brief.path())).as("ended at once, of a swim that rests").startsWith(0x1a, 0x45,
                0xdf, 0xa3);
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
}
