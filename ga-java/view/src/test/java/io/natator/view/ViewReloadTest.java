package io.natator.view;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static org.assertj.core.api.Assertions.assertThat;

import com.microsoft.playwright.Browser.NewContextOptions;
import java.io.IOException;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

/** The files of a scene are saved while it is watched. */
@Timeout(value = 30, unit = TimeUnit.MINUTES)
class ViewReloadTest extends BrowserTest {

    private static ViewServer server;

    @TempDir
    private Path folder;

    @AfterAll
    static void stop() {
        server.close();
    }

    @Override
    boolean isOwn(URI address) {
        return address.getScheme().equals("data") || server.address().getAuthority().equals(address.getAuthority());
    }

    /** A scene in vacuum whose creature is a file too. */
    private Path scene(String solver) throws IOException {
        return Files.writeString(folder.resolve("mine.json"), "{\"solver\":{\"gravity\":[0,0,0]," + solver
                + "},\"creature\":{\"name\":\"body.json\"}}");
    }

    private void body(String joints) throws IOException {
        Files.writeString(folder.resolve("body.json"),
                "{\"slices\":[{\"height\":3,\"width\":3,\"count\":17}],\"joints\":[" + joints + "]}");
    }

    @Test
    void aSavedFileIsReadAgainAndAFaultyOneLeavesWhatRuns() throws IOException, InterruptedException {
        useBrowser(new NewContextOptions().setViewportSize(480, 360));  // quicker to draw
        body("4,8,12");
        Path file = scene("\"damping\":1");
        server = ViewFixture.server(file.toString());
        page.navigate(server.address().toString());
        await("window.natator && natator.frame() > 5");

        scene("\"damping\":3");
        await("natator.scene().definition.solver.damping === 3");
        assertThat(get("banner")).containsText("mine.json was read again.");
        assertThat(number("natator.scene().gait.frequency")).as("the same gait").isEqualTo(1.5);

        scene("\"damping\":-3");
        assertThat(get("banner")).containsText("solver.damping = -3: must be a number in [0, 1000]");
        await("natator.frame() > " + number("natator.frame()"));
        assertThat(number("natator.scene().definition.solver.damping")).isEqualTo(3);

        Path fresh = Files.copy(scene("\"damping\":2"), folder.resolve("fresh"));
        Files.move(fresh, file, StandardCopyOption.REPLACE_EXISTING);  // as some editors do
        await("natator.scene().definition.solver.damping === 2");
        assertThat(get("banner")).containsText("mine.json was read again.");

        body("3,6,9,12,15");
        await("natator.scene().actuators === 4 && natator.scene().gait.amplitude[3] > 0");  // the old gait does not fit
    }
}
