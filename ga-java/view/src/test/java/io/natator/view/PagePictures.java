package io.natator.view;

import io.natator.checkpoint.StoredRun;
import io.natator.config.EvolutionSettings;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/**
 * Makes the pictures of the page in {@code results/pictures}; see the README there. No test of the suite: it runs only
 * where it is named.
 */
class PagePictures extends BrowserTest {

    private static final Path RESULTS = Path.of("..", "..", "results");
    private static final int FRAMES = 180;

    private static final List<ViewServer> SERVERS = new ArrayList<>();
    private String authority;

    /** After the pages: one that loses its server complains. */
    @AfterAll
    static void stop() {
        SERVERS.forEach(ViewServer::close);
    }

    @Override
    boolean isOwn(URI address) {
        return address.getScheme().matches("blob|data") || authority.equals(address.getAuthority());
    }

    /** The gaits that results/thesis/README.md names as best evolved in scheme conserving. */
    @ParameterizedTest
    @ValueSource(strings = {"creature-1/conserving/seed-1", "creature-2/conserving/seed-3", "creature-3/conserving/seed-2",
        "creature-4/conserving/seed-1"})
    void aCreatureSwims(String name) throws Exception {
        Path run = RESULTS.resolve("thesis").resolve("runs").resolve(name);
        EvolutionSettings settings = StoredRun.settings(run);
        InitialScene start = new InitialScene(settings.scene(),
                InitialScene.patch(settings.overrides(), settings.scheme()),
                StoredRun.best(run).gait());
        ViewSettings view = new ViewSettings(ViewFixture.SIMULATOR, ViewSettings.LOOPBACK, 0, start, scene -> null,
                List.of(run));
        ViewServer server = new ViewServer(view);
        SERVERS.add(server);
        authority = server.address().getAuthority();
        page.navigate(server.address().toString());
        await("window.natator && natator.frame() >= " + FRAMES);
        get("run").click();
        awaitDrawings(30);
        String file = "page-" + name.substring(0, name.indexOf('/'));
        keepPicture(file);
        Files.move(Path.of("target", "screenshots", file + ".png"), RESULTS.resolve("pictures").resolve(file + ".png"),
                StandardCopyOption.REPLACE_EXISTING);
    }
}
