package io.natator.view;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static org.assertj.core.api.Assertions.assertThat;

import com.fasterxml.jackson.databind.JsonNode;
import com.microsoft.playwright.Download;
import io.natator.config.Json;
import java.io.IOException;
import java.nio.file.Files;
import java.util.List;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** What is changed on the page while it swims. */
@Timeout(value = 30, unit = TimeUnit.MINUTES)
class ViewControlsTest extends ViewBrowserTest {

    @Test
    void aSliderChangesTheMotion() throws IOException {
        openAtRest();
        List<?> before = pathOf(12);
        assertThat(pathOf(12)).as("the same gait again").isEqualTo(before);

        get("amplitude-1").fill("0.2");
        await("natator.scene().gait.amplitude[0] === 0.2");

        assertThat(gait().get("amplitude").get(1).asDouble()).isEqualTo(0.6);
        assertThat(pathOf(12)).isNotEqualTo(before);
        get("frequency-number").fill("1.85");
        get("frequency-number").press("Enter");
        await("natator.scene().gait.frequency === 1.85");
    }

    /** By as much more for each actuator, so that what an evolved gait has of its own stays; as far as the beat leaves room. */
    @Test
    void steeringBendsTheBodyBesideTheBeat() throws IOException {
        openAtRest();
        List<?> straight = pathOf(12);
        get("steer").fill("0.5");
        await("natator.scene().gait.offset?.every(one => one === 0.5)");
        assertThat(pathOf(12)).isNotEqualTo(straight);
        get("steer-number").fill("1.75");
        get("steer-number").press("Enter");
        await("natator.scene().gait.offset.every((one, i) => Math.abs(one + natator.scene().gait.amplitude[i] - 2) < 1e-9)");
        get("steer-number").fill("3");
        get("steer-number").press("Enter");
        assertThat(get("steer-error")).hasText("Steer: 3 is not used; expected -2 to 2");
        assertThat(gait().get("amplitude").get(1).asDouble()).isEqualTo(0.6);
    }

    /** Where the body is after so many frames from the start. */
    private List<?> pathOf(int frames) {
        get("reset").click();
        await("natator.frame() === 0");
        for (int i = 1; i <= frames; i++) {
            get("step").click();
            await("natator.frame() === " + i);
        }
        return (List<?>) page.evaluate("() => natator.position()");
    }

    @Test
    void aSolverSettingTakesEffectAtOnce() {
        openAtRest();

        get("damping").fill("3");
        await("natator.scene().definition.solver.damping === 3");

        assertThat(number("natator.scene().restarted ? 1 : 0")).isZero();
    }

    @Test
    void whatIsRefusedIsSaid() {
        openAtRest();

        get("frequency-number").fill("-7");
        get("frequency-number").press("Enter");

        assertThat(get("frequency-error")).containsText("-7 is not used; expected 0.01 to 60 /s");
        assertThat(number("natator.scene().gait.frequency")).isEqualTo(1.5);
    }

    /** What is refused leaves no trace in the next change. */
    @Test
    void afterARefusalTheRestCanBeChanged() throws IOException {
        openAtRest();
        get("frequency-number").fill("99");
        get("frequency-number").press("Enter");
        assertThat(get("frequency-error")).hasText("Frequency: 99 is not used; expected 0.01 to 60 /s");
        get("amplitude-1-number").fill("3");
        get("amplitude-1-number").press("Enter");
        assertThat(get("actuator-error")).hasText("amplitude of actuator 1: 3 is not used; expected 0 to 2");

        get("amplitude-1").fill("0.2");

        await("natator.scene().gait.amplitude[0] === 0.2");
        assertThat(gait().get("frequency").asDouble()).isEqualTo(1.5);
        assertThat(get("frequency-number")).hasValue("1.5");
        assertThat(get("frequency-error")).isHidden();
        get("frequency-number").fill("2.5");
        get("frequency-number").press("Enter");
        await("natator.scene().gait.frequency === 2.5");
    }

    @Test
    void aGaitIsSavedAsAFile() throws IOException {
        openAtRest();

        Download saved = page.waitForDownload(() -> get("gait-save").click());

        JsonNode gait = Json.parse(Files.readString(saved.path()), JsonNode.class);
        assertThat(gait).isEqualTo(gait());
        assertThat(saved.suggestedFilename()).endsWith("-gait.json");
    }

    @Test
    void waterComesAndGoes() {
        open(vacuum);
        get("vacuum").uncheck();
        await("natator.scene().fluid[1] > 1000 && natator.frame() > 5");
        assertThat(get("solidIterations")).isDisabled();
        get("scheme").selectOption("conserving");
        await("natator.scene().scheme === 'conserving' && natator.frame() > 5");
        get("solidIterations").fill("2");
        await("natator.scene().definition.solver.solidIterations === 2");

        get("vacuum").check();
        await("natator.scene().fluid[1] === 0");
        assertThat(page.evaluate("() => natator.scene().scheme")).isEqualTo("conserving");
    }

    @Test
    void theKeyboardIsEnough() {
        open(vacuum);

        page.keyboard().press("Space");
        assertThat(get("run")).hasText("Run");
        page.keyboard().press("r");
        await("natator.frame() === 0");
        page.keyboard().press(".");
        await("natator.frame() === 1");
        page.keyboard().press("2");
        assertThat(get("camera-side")).isChecked();
        page.keyboard().press("?");
        assertThat(get("help")).isVisible();
        page.keyboard().press("Escape");
        assertThat(get("help")).isHidden();
        for (int i = 0; i < 60 && !isFocused("frequency"); i++) {
            page.keyboard().press("Tab");
        }
        page.keyboard().press("ArrowRight");
        await("Math.abs(natator.scene().gait.frequency - 1.51) < 1e-9");
    }

    private boolean isFocused(String testId) {
        return (Boolean) page.evaluate("id => document.activeElement.dataset.testid === id", testId);
    }
}
