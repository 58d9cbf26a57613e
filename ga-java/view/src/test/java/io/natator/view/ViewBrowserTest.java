package io.natator.view;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;

import com.fasterxml.jackson.databind.JsonNode;
import com.microsoft.playwright.Locator;
import io.natator.config.Json;
import io.natator.process.Processes;
import java.awt.image.BufferedImage;
import java.io.IOException;
import java.net.URI;
import java.net.URLEncoder;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.io.TempDir;

/** Tests of the page of {@code natator view} in a real browser, with the real simulator. */
abstract class ViewBrowserTest extends BrowserTest {

    /** What makes the address one at which a picture has few pixels and, however slow it is, keeps them and its way to be drawn. */
    static final String FEW_PIXELS = "#"
            + URLEncoder.encode("{\"look\":{\"quality\":\"0.5\"}}", StandardCharsets.UTF_8);

    @TempDir
    private static Path folder;
    static ViewServer water;
    static ViewServer vacuum;

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
        Processes.await("the end of the last page", () -> ViewFixture.simulators(ProcessHandle.current()).isEmpty());
    }

    @Override
    boolean isOwn(URI address) {
        return address.getScheme().matches("blob|data")
                || server.address().getAuthority().equals(address.getAuthority());
    }

    /** Opens the page and waits until it swims. */
    void open(ViewServer on) {
        open(on, "");
    }

    /** Likewise, at an address that says more. */
    void open(ViewServer on, String more) {
        server = on;
        page.navigate(server.address() + more);
        awaitSwimming();
    }

    void awaitSwimming() {
        await("window.natator && natator.frame() > 5");
        assertThat(get("status")).hasAttribute("data-state", "open");
    }

    /** Without water, which is quick to draw, and paused at its start. */
    void openAtRest() {
        open(vacuum);
        pauseAt(0);
    }

    /** Pauses what swims, and waits for the answer; frames may still be under way. */
    void pause() {
        get("run").click();
        assertThat(get("run")).hasText("Run");
    }

    /** Begins anew and pauses at a frame, after which none is under way. */
    void pauseAt(int frame) {
        pause();
        get("reset").click();
        await("natator.frame() === 0");
        for (int next = 1; next <= frame; next++) {
            get("step").click();
            await("natator.frame() === " + next);
        }
    }

    /** What is seen of a picture that nothing changes any more, from its first sample on: those to come only smooth it. */
    BufferedImage restingPicture() {
        awaitDrawings(3);
        await("natator.samples() > 0");
        return picture(get("picture-a"));
    }

    /** Presses one of several buttons in a row; the radio button itself is hidden. */
    void choose(String testId) {
        get(testId).check(new Locator.CheckOptions().setForce(true));
    }

    JsonNode gait() throws IOException {
        return Json.parse((String) page.evaluate("() => JSON.stringify(natator.scene().gait)"), JsonNode.class);
    }
}
