package io.natator.view;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.config.Json;
import io.natator.encoding.Gait;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/**
 * Makes the pictures of the page in {@code results/pictures}; see the README there. No test of the suite: it runs only
 * where it is named.
 */
class PagePictures extends BrowserTest {

    private static final Path RESULTS = Path.of("..", "..", "results");
    private static final Path GAITS = Path.of("..", "..", "sim-native", "examples", "gaits");

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

    /** What is drawn: the name of the picture, a scene, a gait of sim-native/examples/gaits, frames, and how. */
    @ParameterizedTest
    @CsvSource({"creature-2, open-water/creature-2, fish-like, 90, surface, follow",
            "evolved-eel, endless/evolved-eel, evolved-eel, 90, surface, follow",
            "hoop, company/hoop, fish-like, 90, surface, follow",
            "school, company/school, fish-like, 90, surface, follow",
            "loach, plane/loach, loach, 240, vorticity, top",
            "vortices, lake/creature-2, fish-like, 60, vortices, follow"})
    void aCreatureSwims(String name, String scene, String gait, int frames, String shown, String camera)
            throws Exception {
        ObjectNode keys = (ObjectNode) Json.read(GAITS.resolve(gait + ".json"), JsonNode.class, "gait");
        keys.remove("$schema");
        InitialScene start = new InitialScene(scene, null, Json.tree(keys, Gait.class));
        ViewServer server = new ViewServer(
                new ViewSettings(ViewFixture.SIMULATOR, ViewSettings.LOOPBACK, 0, start, one -> null, List.of(), null));
        SERVERS.add(server);
        authority = server.address().getAuthority();
        page.setViewportSize(1400, 900);
        page.navigate(server.address().toString());
        await("window.natator && natator.frame() >= 0");
        get("camera-" + camera).click();
        get("water-" + shown).click();
        await("natator.frame() >= " + frames);
        get("run").click();
        get("trace").uncheck();
        get("drawing").selectOption("webgl");
        await("natator.samples() === 16");
        String file = "page-" + name;
        keepPicture(file);
        Files.move(Path.of("target", "screenshots", file + ".png"), RESULTS.resolve("pictures").resolve(file + ".png"),
                StandardCopyOption.REPLACE_EXISTING);
    }
}
