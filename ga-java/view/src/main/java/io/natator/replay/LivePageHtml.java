package io.natator.replay;

import io.natator.base.InvalidInputException;
import io.natator.file.OutputFile;
import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;

/** One HTML file that simulates a swimmer in the browser: the simulator is in it, as WebAssembly. */
public final class LivePageHtml {

    private static final String SCRIPT = "natator-live.js";
    private static final String MODULE = "natator-live.wasm";

    private LivePageHtml() {
    }

    /**
     * Writes the page.
     *
     * @param simulator the native program; the module is looked for beside it, installed or built
     * @return bytes of the file
     * @throws InvalidInputException        if there is no module, or no file can be of that name
     * @throws java.io.UncheckedIOException if the file cannot be written
     */
    public static long write(Path simulator, String title, Path file) {
        OutputFile.check(file);
        Path folder = folderOfModule(simulator);
        String script = new String(bytes(folder.resolve(SCRIPT)), StandardCharsets.UTF_8)
                + PageModules.resource("natator/solver-worker.js");
        byte[] html = PageHtml.of("natator/live-page.html", "natator/live-page.js", title,
                Map.of("solver", PageHtml.packed(bytes(folder.resolve(MODULE))), "solver-script",
                        PageHtml.packed(script.getBytes(StandardCharsets.UTF_8))))
                .getBytes(StandardCharsets.UTF_8);
        OutputFile.write(file, html);
        return html.length;
    }

    private static Path folderOfModule(Path simulator) {
        Path prefix = simulator.toAbsolutePath().getParent().getParent();
        Path installed = prefix.resolve("share/natator/live");
        Path built = prefix.resolveSibling("wasm").resolve("bin");
        for (Path folder : List.of(installed, built)) {
            if (Files.isRegularFile(folder.resolve(SCRIPT)) && Files.isRegularFile(folder.resolve(MODULE))) {
                return folder;
            }
        }
        throw new InvalidInputException(MODULE + " is neither in " + installed + " nor in " + built
                + "; in a checkout ./setup.sh --wasm && cmake --preset wasm && cmake --build --preset wasm makes it");
    }

    private static byte[] bytes(Path file) {
        try {
            return Files.readAllBytes(file);
        } catch (IOException e) {
            throw new InvalidInputException("cannot read " + file + ": " + e.getMessage());
        }
    }
}
