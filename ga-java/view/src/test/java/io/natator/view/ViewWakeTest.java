package io.natator.view;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static org.assertj.core.api.Assertions.assertThat;

import io.natator.encoding.Gait;
import io.natator.process.Processes;
import java.awt.image.BufferedImage;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.regex.Pattern;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** The wake behind a swimmer: in plane flow, where there is no other water to be seen, and in a tank of particles. */
@Timeout(value = 30, unit = TimeUnit.MINUTES)
class ViewWakeTest extends ViewBrowserTest {

    /** By how much, of 255, violet and green stand out. */
    private static final int STRENGTH = 40;
    /** The share of such pixels with a wake, and without. */
    private static final double SEEN = 0.002;
    private static final double UNSEEN = 0.0005;

    private static ViewServer plane;

    @BeforeAll
    static void startPlane() throws InterruptedException {
        Gait gait = new Gait(2.0, List.of(0.4, 0.35, 0.3, 0.25, 0.2), List.of(0.0, 0.902, 0.804, 0.706, 0.608));
        plane = new ViewServer(new ViewSettings(ViewFixture.SIMULATOR, ViewSettings.LOOPBACK, 0,
                new InitialScene("plane/loach", null, gait), one -> null, List.of(), null));
    }

    @AfterAll
    static void stopPlane() {
        plane.close();
    }

    @ParameterizedTest
    @ValueSource(strings = {"webgl", "plain"})
    void planeFlowIsSeenByItsVorticity(String drawing) throws InterruptedException {
        open(plane, "?drawing=" + drawing + FEW_PIXELS);
        await("natator.time() > 0.7");
        pause();
        get("camera-top").check();

        assertThat(get("water-vorticity")).isChecked();
        assertThat(get("water-surface")).isHidden();
        assertThat(get("water-vortices")).isHidden();
        assertThat(get("legend-turns")).containsText("Water: vorticity, 1/s");
        assertThat(get("legend-turns")).containsText(Pattern.compile("[1-9]0"));
        assertThat(get("picture-a")).hasAttribute("aria-describedby", "legend");
        awaitTurning(true);
        for (String next : List.of("velocity", "pressure", "none")) {
            page.keyboard().press("w");
            assertThat(get("water-" + next)).isChecked();
        }
        assertThat(get("legend-turns")).isHidden();
        awaitTurning(false);
        page.keyboard().press("w");
        awaitTurning(true);
    }

    /** Pressure and forces are asked for where they are to be seen; the forces on all parts are all that is on the body. */
    @ParameterizedTest
    @ValueSource(strings = {"webgl", "plain"})
    void whatTheWaterDoesToABodyIsSeen(String drawing) {
        open(plane, "?drawing=" + drawing + FEW_PIXELS);
        await("natator.time() > 0.3");
        pause();
        get("camera-top").check();
        page.setViewportSize(480, 360);
        List<BufferedImage> pictures = new ArrayList<>();
        for (String shown : List.of("velocity", "pressure", "none")) {
            choose("water-" + shown);
            pictures.add(stillPicture(get("picture-a")));
        }
        assertThat(get("legend-turns")).isHidden();
        assertThat(get("plane-level")).isHidden();
        page.keyboard().press("u");
        assertThat(get("pressure")).isChecked();
        assertThat(get("legend-pressure")).containsText("Body: pressure");
        pictures.add(stillPicture(get("picture-a")));
        page.keyboard().press("o");
        await("natator.forces().length === 7 && natator.forces().flat().some(one => Math.abs(one) > 1)");
        assertThat(get("legend-lines")).containsText("Arrows on the body: force of the water");
        pictures.add(stillPicture(get("picture-a")));

        BufferedImage bare = pictures.get(2);
        for (int i : List.of(0, 1, 3, 4)) {
            assertThat(changed(bare, pictures.get(i))).as("picture " + i).isGreaterThan(SEEN);
        }
        assertThat(changed(pictures.get(3), pictures.get(4))).isGreaterThan(UNSEEN);
        choose("water-velocity");
        assertThat(get("legend-turns")).containsText("Water: speed, length/s");
    }

    /** Share of the pixels that differ. */
    private static double changed(BufferedImage one, BufferedImage other) {
        return share(one, other, (was, is) -> Math.max(Math.abs(was.getRed() - is.getRed()),
                Math.abs(was.getBlue() - is.getBlue())) > STRENGTH);
    }

    @Test
    void aPlaneIsMovedByKeyboardAndFlexKnowsNoForces() {
        open(water, "?drawing=plain" + FEW_PIXELS);
        choose("water-velocity");
        await("natator.hasWake()");
        pause();
        page.keyboard().press("n");
        assertThat(get("plane-along")).isChecked();
        BufferedImage before = stillPicture(get("picture-a"));
        get("place").focus();
        for (int i = 0; i < 20; i++) {
            page.keyboard().press("ArrowRight");
        }
        assertThat(get("place")).hasAttribute("aria-valuetext", "0.4 body lengths from the body");
        assertThat(changed(before, stillPicture(get("picture-a")))).isGreaterThan(SEEN);

        assertThat(get("water-pressure")).isHidden();
        assertThat(get("pressure")).isDisabled();
        assertThat(get("forces")).isDisabled();
    }

    /** Waits until a resting picture has pixels that are as violet or as green as what turns, or has none. */
    private void awaitTurning(boolean isSeen) throws InterruptedException {
        Processes.await("a picture " + (isSeen ? "with" : "without") + " water that turns", () -> {
            BufferedImage picture = restingPicture();
            double turning = share(picture, picture, (colour, same) -> {
                int green = colour.getGreen() - Math.max(colour.getRed(), colour.getBlue());
                int violet = Math.min(colour.getRed(), colour.getBlue()) - colour.getGreen();
                return green > STRENGTH || violet > STRENGTH;
            });
            return isSeen ? turning > SEEN : turning < UNSEEN;
        });
    }

    @Test
    void waterIsAskedForOnlyWhereItIsShown() {
        AtomicInteger asked = new AtomicInteger();
        page.onWebSocket(socket -> socket.onFrameSent(
                frame -> asked.addAndGet(frame.text().startsWith("{\"do\":\"water\"") ? 1 : 0)));
        open(plane, "?drawing=plain");
        await("natator.time() > 0.3");
        assertThat(asked).hasPositiveValue();

        get("water-none").check();
        await("natator.time() > " + (number("natator.time()") + 0.1));
        int before = asked.get();
        await("natator.time() > " + (number("natator.time()") + 0.3));
        assertThat(asked).hasValue(before);

        page.keyboard().press("y");
        assertThat(get("dye")).isChecked();
        await("natator.time() > " + (number("natator.time()") + 0.3));
        assertThat(asked).hasValueGreaterThan(before);
        assertThat(get("legend-lines")).containsText("dye from the tail");
    }

    @ParameterizedTest
    @ValueSource(strings = {"webgl", "plain"})
    void vorticesAreSeenInATankOfParticles(String drawing) throws InterruptedException {
        open(water, "?drawing=" + drawing + FEW_PIXELS);
        choose("water-none");
        await("natator.time() > 0.3");
        pause();
        awaitTurning(false);

        for (String shown : List.of("vorticity", "vortices")) {
            choose("water-" + shown);
            await("natator.hasWake()");
            awaitTurning(true);
            keepPicture("ViewWakeTest-" + drawing + "-" + shown);
        }
        assertThat(get("legend-turns")).containsText("Vortices");
    }
}
