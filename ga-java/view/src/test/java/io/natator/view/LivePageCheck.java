package io.natator.view;

import static org.assertj.core.api.Assertions.assertThat;

import com.microsoft.playwright.Browser.NewContextOptions;
import com.microsoft.playwright.Locator;
import com.microsoft.playwright.options.ColorScheme;
import io.natator.replay.LivePageHtml;
import java.io.IOException;
import java.net.URI;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

/**
 * What {@code natator page --live} writes, opened from disk in a real browser. No test of the suite: it needs what
 * {@code cmake --build --preset wasm} makes, and runs only where it is named.
 */
class LivePageCheck extends BrowserTest {

    private static final int MAX_TABS = 40;

    @TempDir
    private Path folder;
    private Path file;

    @Override
    boolean isOwn(URI address) {
        return address.getScheme().matches("blob|data") || address.toString().contains(file.toString());
    }

    @BeforeEach
    void write() {
        file = folder.resolve("live.html");
        assertThat(LivePageHtml.write(ViewFixture.SIMULATOR, "A swimmer", file)).isBetween(500_000L, 3_000_000L);
    }

    private void open(String query) {
        page.navigate(file.toUri() + query);
        await("window.natator && natator.frame() > 5");
    }

    @Test
    void aSliderChangesTheSwim() {
        open("");
        await("natator.time() > 0.5");
        List<?> before = (List<?>) page.evaluate("() => natator.position()");
        double distance = number("natator.distance()");

        get("frequency").focus();
        page.keyboard().press("ArrowRight");
        await("Math.abs(natator.scene().gait.frequency - 2.05) < 1e-9");
        await("natator.time() > 1 && natator.distance() > " + (distance + 0.05));
        assertThat((List<?>) page.evaluate("() => natator.position()")).isNotEqualTo(before);
        assertThat(get("speed").innerText()).matches("\\d\\.\\d\\d");
        get("viscosity-number").fill("10");
        get("viscosity-number").press("Enter");
        await("Math.abs(natator.scene().definition.solver.kinematicViscosity - 0.004) < 1e-9");
        get("stiffness-number").fill("0.5");
        get("stiffness-number").press("Enter");
        await("Math.abs(natator.scene().definition.creature.springStiffness - 0.3) < 1e-9");
        assertThat(cutMenus()).isEmpty();
    }

    /** The speed, once for a change; not what changes all the time. */
    @Test
    void aScreenReaderTellsWhatAChangeDid() throws IOException {
        open("");
        assertThat(barriers()).isEmpty();
        assertThat(said(30)).isEmpty();
        get("waves").focus();
        page.keyboard().press("ArrowRight");
        await("/^Speed .?\\d\\.\\d\\d body lengths per second$/.test(document.querySelector('[data-testid=told]').textContent)");
        assertThat(said(30)).isEmpty();
    }

    @Test
    void anotherBodySwimsAndComesBackToItsStart() {
        open("");
        get("swimmer-Tadpole").check();
        await("natator.scene().definition.creature.name === 'tadpole' && natator.scene().gait.amplitude.length === 5"
                + " && natator.time() > 0.3");
        get("tail-number").fill("0.5");
        get("tail-number").press("Enter");
        await("natator.scene().gait.amplitude[4] === 0.5");

        get("restore").click();
        await("natator.scene().gait.amplitude[4] === 1");
        get("run").click();
        get("reset").click();
        await("natator.time() === 0");
        assertThat(get("run").innerText()).isEqualTo("Swim");
    }

    /** Asked for of the simulator in the page, by itself in plane flow, by keyboard in a tank of particles. */
    @Test
    void theWakeIsSeen() {
        open("?drawing=plain");
        await("natator.scene().scene === 'plane/loach' && natator.scene().gait.frequency === 2 && natator.time() > 0.4");
        assertThat(get("water-vorticity").isChecked()).isTrue();
        assertThat(get("water-surface").isHidden()).isTrue();
        await("natator.hasWake()");
        await("/[1-9]0/.test(document.querySelector('[data-testid=legend-turns]').textContent)");
        get("swimmer-Eel").check();
        await("natator.scene().scene === 'endless/small'");
        get("water-surface").check();
        page.keyboard().press("w");
        assertThat(get("water-vorticity").isChecked()).isTrue();
        await("document.querySelector('[data-testid=legend-turns]').checkVisibility()");
        get("swimmer-Loach").check();
        await("natator.scene().scene === 'plane/loach' && natator.time() > 0.4");
        page.keyboard().press("o");
        assertThat(get("forces").isChecked()).isTrue();
        await("natator.forces().flat().some(one => Math.abs(one) > 1)");
        page.keyboard().press("u");
        await("/[1-9]/.test(document.querySelector('[data-testid=legend-pressure]').textContent)");
        get("viscosity-number").fill("2");
        get("viscosity-number").press("Enter");
        await("Math.abs(natator.scene().definition.solver.kinematicViscosity - 0.0008) < 1e-9");
        get("water-none").check();
        assertThat(get("legend-turns").isHidden()).isTrue();
    }

    /** As where workers are not allowed. */
    @Test
    void itRunsWithoutAWorker() {
        open("?worker=no");
        await("natator.time() > 0.2");
        assertThat(page.workers()).isEmpty();
    }

    @Test
    void aTelephoneInTheDark() throws IOException {
        useBrowser(
                new NewContextOptions().setViewportSize(390, 844).setColorScheme(ColorScheme.DARK).setHasTouch(true));
        open("");

        assertThat(page.locator("html").getAttribute("data-theme")).isEqualTo("dark");
        assertThat(number("document.documentElement.scrollWidth")).isLessThanOrEqualTo(390);
        assertThat(barriers()).isEmpty();
    }

    @Test
    void theKeyboardReachesTheSliders() {
        open("");
        Locator last = get("viscosity");
        for (int i = 0; i < MAX_TABS && !(boolean) last.evaluate("one => one === document.activeElement"); i++) {
            page.keyboard().press("Tab");
        }
        assertThat(last.evaluate("one => one === document.activeElement")).isEqualTo(true);
        page.keyboard().press("ArrowRight");
        await("Math.abs(natator.scene().definition.solver.kinematicViscosity - 0.0008) < 1e-9");
    }
}
