package io.natator.view;

import com.microsoft.playwright.Browser;
import com.microsoft.playwright.BrowserType.LaunchOptions;
import com.microsoft.playwright.Playwright;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.stream.Stream;
import org.junit.jupiter.api.extension.BeforeAllCallback;
import org.junit.jupiter.api.extension.ExtensionContext;
import org.junit.jupiter.api.extension.ExtensionContext.Namespace;

/**
 * The browser that is installed here, without a screen and without a graphics card: one for all tests of a class, after
 * which it ends, since others count the processes that are left.
 */
final class Chromium implements BeforeAllCallback {

    /** Environment variable with the path of a browser. */
    private static final String VARIABLE = "NATATOR_BROWSER";
    private static final List<String> NAMES = List.of("chromium", "chromium-browser", "google-chrome",
            "google-chrome-stable");
    private static final List<String> ARGUMENTS = List.of("--no-sandbox", "--enable-unsafe-swiftshader",
            "--disable-gpu", "--disable-background-networking", "--disable-component-update", "--disable-sync");

    /** Of its start, which only failures take so long for. */
    private static final double PATIENCE_MILLISECONDS = 600_000;

    private Browser browser;

    /** The running browser and what drives it. */
    private record Running(Playwright playwright, Browser browser) implements AutoCloseable {

        static Running start() {
            // Chromium is the operating system's: this one brings none.
            Playwright playwright = Playwright.create(
                    new Playwright.CreateOptions().setEnv(Map.of("PLAYWRIGHT_SKIP_BROWSER_DOWNLOAD", "1")));
            return new Running(playwright, playwright.chromium().launch(
                    new LaunchOptions().setExecutablePath(installed()).setTimeout(PATIENCE_MILLISECONDS)
                            .setArgs(ARGUMENTS)));
        }

        @Override
        public void close() {
            playwright.close();
        }
    }

    private static Path installed() {
        String given = System.getenv(VARIABLE);
        return Stream.concat(Stream.of(given).filter(Objects::nonNull), NAMES.stream()).flatMap(Chromium::places)
                .filter(Files::isExecutable).findFirst().orElseThrow(() -> new IllegalStateException(
                        "no browser is installed (chromium, Google Chrome, or what " + VARIABLE
                                + " names); install one: ./setup.sh --browser"));
    }

    private static Stream<Path> places(String name) {
        return name.contains("/") ? Stream.of(Path.of(name))
                : Stream.of(System.getenv("PATH").split(":")).map(folder -> Path.of(folder, name));
    }

    @Override
    public void beforeAll(ExtensionContext context) {
        browser = context.getStore(Namespace.create(Chromium.class))
                .computeIfAbsent(Running.class, key -> Running.start(), Running.class).browser();
    }

    /** To be used from the first test on. */
    Browser browser() {
        return browser;
    }
}
