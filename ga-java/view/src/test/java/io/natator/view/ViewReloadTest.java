package io.natator.view;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static org.assertj.core.api.Assertions.assertThat;

import com.microsoft.playwright.Browser.NewContextOptions;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

/** The files of a scene are saved while it is watched. */
@Timeout(value = 30, unit = TimeUnit.MINUTES)
class ViewReloadTest extends BrowserTest {

    private static final List<ViewServer> SERVERS = new ArrayList<>();

    @TempDir
    private Path folder;
    private ViewServer server;

    /** After the pages: one that loses its server complains. */
    @AfterAll
    static void stop() {
        SERVERS.forEach(ViewServer::close);
    }

    @Override
    boolean isOwn(URI address) {
        return address.getScheme().equals("data") || server.address().getAuthority().equals(address.getAuthority());
    }

    /** A scene in vacuum whose creature is a file too. */
    private Path scene(String solver) throws IOException {
        return scene("mine.json", solver);
    }

    private Path scene(String name, String solver) throws IOException {
        return Files.writeString(folder.resolve(name), "{\"solver\":{\"gravity\":[0,0,0]," + solver
                + "},\"creature\":{\"name\":\"body.json\"}}");
    }

    private void body(String joints) throws IOException {
        Files.writeString(folder.resolve("body.json"),
                "{\"slices\":[{\"height\":3,\"width\":3,\"count\":17}],\"joints\":[" + joints + "]}");
    }

    /** Shows a scene until it swims, in a small window, which is quicker to draw. */
    private void open(Path scene) throws InterruptedException {
        server = ViewFixture.server(scene.toString());
        SERVERS.add(server);
        page.navigate(server.address().toString());
        await("window.natator && natator.frame() > 5");
    }

    @BeforeEach
    void useSmallWindow() {
        useBrowser(new NewContextOptions().setViewportSize(480, 360));
    }

    @Test
    void aSavedFileIsReadAgainAndAFaultyOneLeavesWhatRuns() throws IOException, InterruptedException {
        body("4,8,12");
        Path file = scene("\"damping\":1");
        open(file);

        scene("\"damping\":3");
        await("natator.scene().definition.solver.damping === 3");
        assertThat(get("banner")).containsText("mine.json was read again.");
        assertThat(number("natator.scene().gait.frequency")).as("the same gait").isEqualTo(1.5);

        scene("\"damping\":-3");
        assertThat(get("banner")).containsText("solver.damping = -3: must be a number in [0, 1000]");
        await("natator.frame() > " + number("natator.frame()"));
        assertThat(number("natator.scene().definition.solver.damping")).isEqualTo(3);

        Files.move(scene("fresh", "\"damping\":2"), file, StandardCopyOption.REPLACE_EXISTING);  // as some editors do
        await("natator.scene().definition.solver.damping === 2");
        assertThat(get("banner")).containsText("mine.json was read again.");

        body("3,6,9,12,15");
        await("natator.scene().actuators === 4 && natator.scene().gait.amplitude[3] > 0");  // the old gait does not fit
    }

    /** Other muscles need another gait; what cannot be read yet does not. */
    @Test
    void aFileThatIsReadBeforeItIsWrittenCostsNoGait() throws IOException, InterruptedException {
        body("4,8,12");
        Path file = scene("\"damping\":1");
        page.routeWebSocket("**/stream", toPage -> toPage.connectToServer().onMessage(message -> {
            if (message.text() == null) {
                toPage.send(message.binary());
                return;
            }
            if (message.text().contains("\"error\"")) {
                written("\"damping\":3");
            }
            toPage.send(message.text());
        }));
        open(file);

        Files.writeString(file, "");
        await("natator.scene().definition.solver.damping === 3");

        assertThat(get("banner")).containsText("mine.json was read again.");
        assertThat(page.evaluate("() => JSON.stringify(natator.scene().gait.amplitude)")).isEqualTo("[0.9,0.6]");
    }

    private void written(String solver) {
        try {
            scene(solver);
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }
}
