package io.natator.view;

import static org.assertj.core.api.Assertions.assertThat;

import com.microsoft.playwright.Browser.NewContextOptions;
import com.microsoft.playwright.BrowserContext;
import com.microsoft.playwright.ConsoleMessage;
import com.microsoft.playwright.Locator;
import com.microsoft.playwright.Page;
import com.microsoft.playwright.assertions.PlaywrightAssertions;
import java.awt.Color;
import java.awt.image.BufferedImage;
import java.io.ByteArrayInputStream;
import java.io.IOException;
import java.io.InputStream;
import java.io.UncheckedIOException;
import java.net.URI;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.function.BiPredicate;
import java.util.stream.IntStream;
import javax.imageio.ImageIO;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.TestInfo;
import org.junit.jupiter.api.extension.RegisterExtension;

/**
 * Tests of pages in a real browser. Each has a profile of its own; at its end its picture is kept in
 * {@code target/screenshots}, the console must have shown no error, and nothing may have been asked of another host.
 */
abstract class BrowserTest {

    @RegisterExtension
    static final Chromium CHROMIUM = new Chromium();

    /** Small, since the processor draws all pixels. */
    static final int WIDTH = 800;
    static final int HEIGHT = 480;
    private static final String AXE = "/META-INF/resources/webjars/axe-core/4.6.3/axe.min.js";
    private static final Path SCREENSHOTS = Path.of("target", "screenshots");
    /** Much is drawn by one processor that also simulates, and does other work besides: only failures wait so long. */
    private static final double PATIENCE_MILLISECONDS = 600_000;

    private final List<String> complaints = new ArrayList<>();
    private final List<String> addresses = new ArrayList<>();
    private BrowserContext context;
    private String name;
    Page page;

    @BeforeEach
    void openBrowser(TestInfo test) {
        name = getClass().getSimpleName() + "-" + test.getTestMethod().orElseThrow().getName();
        useBrowser(new NewContextOptions().setViewportSize(WIDTH, HEIGHT));
    }

    /** Goes on in another window, such as that of a telephone. */
    void useBrowser(NewContextOptions options) {
        if (context != null) {
            context.close();
        }
        context = CHROMIUM.browser().newContext(options);
        context.setDefaultTimeout(PATIENCE_MILLISECONDS);
        context.setDefaultNavigationTimeout(PATIENCE_MILLISECONDS);
        PlaywrightAssertions.setDefaultAssertionTimeout(PATIENCE_MILLISECONDS);
        context.onConsoleMessage(this::note);
        context.onWebError(error -> complaints.add(error.error()));
        context.onRequest(request -> addresses.add(request.url()));
        page = context.newPage();
        page.onWebSocket(socket -> addresses.add(socket.url()));
    }

    private void note(ConsoleMessage message) {
        if (message.type().equals("error")) {
            complaints.add(message.text() + " at " + message.location());
        }
    }

    @AfterEach
    void closeBrowser() {
        keepPicture(name);
        context.close();
        assertThat(complaints).as("errors in the console").isEmpty();
        assertThat(addresses).as("asked for").isNotEmpty().allSatisfy(address -> assertThat(isOwn(URI.create(address)))
                .as(address.substring(0, Math.min(200, address.length()))).isTrue());
    }

    /** Whether an address is of the server under test or of the page itself. */
    abstract boolean isOwn(URI address);

    /** Keeps what is seen now. */
    void keepPicture(String fileName) {
        page.screenshot(new Page.ScreenshotOptions().setPath(SCREENSHOTS.resolve(fileName + ".png")));
    }

    /** The element with a test id. */
    Locator get(String testId) {
        return page.getByTestId(testId);
    }

    /** Waits until a JavaScript expression is true. */
    void await(String expression) {
        page.waitForFunction("() => " + expression);
    }

    /** A number that a JavaScript expression gives. */
    double number(String expression) {
        return ((Number) page.evaluate("() => " + expression)).doubleValue();
    }

    /** Waits until the page has been drawn so many times more. */
    void awaitDrawings(int count) {
        page.evaluate("""
                count => new Promise(done => {
                  const next = () => count-- > 0 ? requestAnimationFrame(next) : done();
                  next();
                })""", count);
    }

    /** The menus whose chosen entry is not seen whole. */
    List<?> cutMenus() {
        return (List<?>) page.evaluate("""
                () => [...document.querySelectorAll('select')].filter(one => one.checkVisibility()).filter(one => {
                  const whole = one.cloneNode();
                  whole.append(new Option(one.selectedOptions[0].text));
                  whole.style.cssText = 'position: absolute; width: max-content; max-width: none;';
                  one.parentNode.append(whole);
                  const isCut = whole.offsetWidth > one.offsetWidth + 1;
                  whole.remove();
                  return isCut;
                }).map(one => one.id)""");
    }

    /** What axe-core finds on the page that keeps out who does not see it or has no mouse: rule and element. */
    List<?> barriers() throws IOException {
        try (InputStream script = getClass().getResourceAsStream(AXE)) {
            page.evaluate(new String(script.readAllBytes(), StandardCharsets.UTF_8));
        }
        return (List<?>) page.evaluate("""
                async () => (await axe.run()).violations
                    .flatMap(({id, nodes}) => nodes.map(({html}) => `${id}: ${html}`))""");
    }

    /** What a screen reader says of itself while the page is drawn so many times: it must not go on and on. */
    List<?> said(int drawings) {
        page.evaluate("""
                () => {
                  window.said = [];
                  const live = 'output, [role=status], [role=alert], [role=log], [aria-live]';
                  new MutationObserver(changes => changes.forEach(({target}) => {
                    const element = target.nodeType === Node.TEXT_NODE ? target.parentElement : target;
                    const region = element.closest(live);
                    if (region !== null && region.ariaLive !== 'off') {
                      said.push(region.textContent);
                    }
                  })).observe(document.body, {subtree: true, childList: true, characterData: true});
                }""");
        awaitDrawings(drawings);
        return (List<?>) page.evaluate("() => said");
    }

    /** What an element looks like when it has come to rest. */
    BufferedImage stillPicture(Locator element) {
        BufferedImage last = picture(element);
        long end = System.nanoTime() + (long) (PATIENCE_MILLISECONDS * 1e6);
        while (true) {
            awaitDrawings(20);
            BufferedImage next = picture(element);
            if (difference(last, next) == 0) {
                return next;
            }
            assertThat(System.nanoTime()).as("the picture still changes").isLessThan(end);
            last = next;
        }
    }

    /** What an element looks like. */
    static BufferedImage picture(Locator element) {
        try {
            return ImageIO.read(new ByteArrayInputStream(element.screenshot()));
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    /** The colours of all pixels of a picture, row by row. */
    static int[] pixels(BufferedImage picture) {
        return picture.getRGB(0, 0, picture.getWidth(), picture.getHeight(), null, 0, picture.getWidth());
    }

    /** Number of different colours in a picture. */
    static int colours(BufferedImage picture) {
        return (int) Arrays.stream(pixels(picture)).distinct().count();
    }

    /** Share of the pixels that differ between two pictures of the same size, 0 to 1. */
    static double difference(BufferedImage one, BufferedImage other) {
        return share(one, other, (was, is) -> !was.equals(is));
    }

    /** Share of the pixels of two pictures of the same size whose colours are as a condition has it, 0 to 1. */
    static double share(BufferedImage one, BufferedImage other, BiPredicate<Color, Color> condition) {
        int[] were = pixels(one);
        int[] are = pixels(other);
        long count = IntStream.range(0, were.length)
                .filter(i -> condition.test(new Color(were[i]), new Color(are[i]))).count();
        return count / (double) were.length;
    }
}
