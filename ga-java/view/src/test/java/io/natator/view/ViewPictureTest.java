package io.natator.view;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static org.assertj.core.api.Assertions.assertThat;

import java.awt.image.BufferedImage;
import java.util.List;
import java.util.concurrent.TimeUnit;
import java.util.regex.Pattern;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/** The picture of a swimmer in water, in both ways of drawing and with less detail. */
@Timeout(value = 30, unit = TimeUnit.MINUTES)
class ViewPictureTest extends ViewBrowserTest {

    /** An empty picture has its background's few colours. */
    private static final int MIN_COLOURS = 500;

    /** A browser that says it has a graphics card. */
    private static final String CARD = """
            const parameter = WebGL2RenderingContext.prototype.getParameter;
            WebGL2RenderingContext.prototype.getParameter = function(name) {
              const value = parameter.call(this, name);
              return /swiftshader/i.test(value) ? 'A card' : value;
            };""";

    @Test
    void aSwimmerInWaterIsSeen() {
        open(water);
        await("natator.fps() > 0");

        BufferedImage before = picture(get("picture-a"));
        assertThat(colours(before)).isGreaterThan(MIN_COLOURS);
        await("natator.frame() > " + (number("natator.frame()") + 60));
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
        page.setViewportSize(480, 360);
        open(water, FEW_PIXELS);
        pauseAt(3);
        get("drawing").selectOption(drawing);
        choose("water-none");
        BufferedImage without = restingPicture();
        assertThat(page.evaluate("() => natator.drawing()")).isEqualTo(name);
        for (String shown : List.of("spheres", "surface")) {
            choose("water-" + shown);
            BufferedImage with = restingPicture();
            keepPicture("ViewPictureTest-" + drawing + "-" + shown);
            assertThat(colours(with)).as("colours of %s", shown).isGreaterThan(MIN_COLOURS);
            assertThat(difference(without, with)).as("share of %s", shown).isGreaterThan(0.2);
        }
    }

    /** What the address remembers of a way of drawing that is no longer there counts for nothing. */
    @ParameterizedTest
    @CsvSource(quoteCharacter = '|', value = {"||, WebGL", "?drawing=plain, processor", "?drawing=webgpu, WebGL",
            "|#{\"look\":{\"drawing\":\"webgpu\"}}|, WebGL",
            "|?drawing=plain#{\"look\":{\"drawing\":\"webgl\"}}|, processor"})
    void aCardIsUsedUnlessTheAddressForcesAWayToDraw(String address, String name) {
        page.addInitScript(CARD);
        open(vacuum, address);

        assertThat(page.evaluate("() => natator.drawing()")).isEqualTo(name);
        assertThat(get("drawing")).hasValue(name.equals("processor") ? "plain" : "auto");
    }

    /**
     * Slows the page down, so that it draws with less detail; notes each picture that it shows black. Only what is drawn or
     * emptied between two pictures of the screen can be read: afterwards the screen has it, and reading gives black.
     */
    private static final String SLOW_AND_WATCHED = """
            () => {
              const sample = document.createElement('canvas').getContext('2d', {willReadFrequently: true});
              const picture = document.querySelector('.picture canvas');
              let isDrawn = false;
              let width = picture.width;
              const {drawElements} = WebGL2RenderingContext.prototype;
              WebGL2RenderingContext.prototype.drawElements = function(...parts) {
                isDrawn = true;
                return drawElements.apply(this, parts);
              };
              window.black = 0;
              window.watched = 0;
              const next = () => {
                const until = performance.now() + 25;
                while (performance.now() < until && !window.isQuick) { }
                if (isDrawn || picture.width !== width) {
                  sample.clearRect(0, 0, 30, 30);
                  sample.drawImage(picture, 0, 0, 30, 30);
                  const {data} = sample.getImageData(0, 0, 30, 30);
                  window.black += data.every((value, i) => i % 4 === 3 || value < 8) ? 1 : 0;
                  window.watched++;
                }
                isDrawn = false;
                width = picture.width;
                requestAnimationFrame(next);
              };
              requestAnimationFrame(next);
            }""";

    /** All detail at first, however slow: what is drawn with less is watched. */
    @Test
    void lessDetailIsNoBlackFlash() {
        open(water);
        get("quality").selectOption("1");
        get("drawing").selectOption("webgl");
        awaitDrawings(3);
        page.evaluate(SLOW_AND_WATCHED);
        get("quality").selectOption("auto");

        await("natator.share() < 0.8");

        assertThat(number("window.black")).as("black pictures").isZero();
        assertThat(number("window.watched")).as("pictures").isGreaterThan(1);
    }

    @Test
    void aPausedPictureGetsAllItsDetail() {
        open(water);
        get("drawing").selectOption("webgl");
        page.evaluate(SLOW_AND_WATCHED);
        await("natator.share() < 1");

        pause();

        await("natator.share() === 1");
        page.evaluate("() => { window.isQuick = true; }");
        await("natator.samples() >= 4 && natator.share() === 1");
        assertThat(colours(picture(get("picture-a")))).isGreaterThan(MIN_COLOURS);
    }
}
