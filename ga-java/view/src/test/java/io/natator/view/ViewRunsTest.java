package io.natator.view;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static org.assertj.core.api.Assertions.assertThat;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import com.microsoft.playwright.Locator;
import com.microsoft.playwright.Route;
import io.natator.config.Json;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Path;
import java.util.List;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

/** The gaits of runs, and two swimmers side by side. */
@Timeout(value = 30, unit = TimeUnit.MINUTES)
class ViewRunsTest extends ViewBrowserTest {

    @TempDir
    private static Path runs;
    private static ViewServer many;
    private static ViewServer bodies;

    @BeforeAll
    static void evolve() throws IOException, InterruptedException {
        many = ViewFixture.server(ViewFixture.evolveMany(runs));
        bodies = ViewFixture.server(ViewFixture.evolveBodies(runs));
    }

    @AfterAll
    static void end() {
        many.close();
        bodies.close();
    }

    @Test
    void theGenerationsOfARunAreWatched() throws IOException {
        open(vacuum);
        assertThat(get("run-chosen")).containsText("What swims is not of this run");

        get("chart-fitness").focus();
        page.keyboard().press("Home");

        assertThat(get("run-chosen")).containsText("Generation 0");
        assertThat(page.textContent("#run-facts")).as("the random one is not counted").endsWith(", 3 generations");
        for (String fact : List.of("body lengths/s", "at half the time step", "4 fresh starts, all completed",
                "selection loss",
                "cost of transport ", "Reynolds number 131, Strouhal number 0.313")) {
            assertThat(get("run-fresh")).containsText(fact);
        }
        assertThat(get("elites-figure")).isHidden();
        assertThat(get("front-figure")).isHidden();
        JsonNode first = best(0);
        await("Math.abs(natator.scene().gait.frequency - " + first.get("frequency") + ") < 1e-9");
        assertThat(page.evaluate("() => natator.scene().scheme")).isEqualTo("conserving");
        page.keyboard().press("End");
        await("Math.abs(natator.scene().gait.frequency - " + best(3).get("frequency") + ") < 1e-9");
    }

    /** The best of each kind, and what several objectives are weighed by: a click or a key swims any of them. */
    @Test
    void kindsAndFrontsAreSwum() throws IOException {
        page.setViewportSize(1280, 800);
        open(many);
        JsonNode map = answer(0).get("map");
        assertThat(get("elites-figure").locator("[role=option]")).hasCount(map.get("elites").size());
        assertThat(get("front-figure")).isHidden();
        JsonNode elite = map.get("elites").get(map.get("elites").size() / 2);

        get("elite-" + elite.get("column") + "-" + elite.get("row")).click();

        awaitGait(elite.get("gait"));
        assertThat(get("stage-a").locator("figcaption")).containsText("kinds, elite of ");
        assertThat(get("gait-looked-at")).containsText(" beats per body length, cost of transport ");
        assertThat(get("elites").locator(".swims")).hasCount(1);
        get("elites").focus();
        page.keyboard().press("Home");
        page.keyboard().press("Enter");
        awaitGait(map.get("elites").get(0).get("gait"));
        fits("elites");

        get("run-choice").selectOption("1");
        assertThat(get("elites-figure")).isHidden();
        JsonNode points = answer(1).get("front").get("points");
        assertThat(get("front-figure").locator("circle[role=option].best").count()).isBetween(3, points.size() - 1);
        assertThat(get("front").locator("text.axis").last())
                .hasText("work of the muscles, mass · length²/s² (less is better)");
        assertThat(get("front-choice")).isHidden();
        page.locator("#front-2").click();
        awaitGait(points.get(2).get("gait"));
        assertThat(get("front").locator(".swims")).hasId("front-2");
        assertThat(get("gait-looked-at")).containsText("no other is better in all");
        get("front").focus();
        page.keyboard().press("End");
        page.keyboard().press("Enter");
        awaitGait(points.get(points.size() - 1).get("gait"));
        assertThat(get("gait-looked-at")).containsText("another is better");
        fits("front");
        page.setViewportSize(390, 844);
        fits("front");
    }

    /** Those of distances in a run that went nowhere. */
    @Test
    void longLabelsOfSeveralObjectivesAreWhole() throws IOException {
        page.route("**/api/runs/1", route -> {
            try {
                ObjectNode changed = Json.parse(route.fetch().text(), ObjectNode.class);
                JsonNode points = changed.at("/front/points");
                for (int i = 0; i < points.size(); i++) {
                    ((ArrayNode) points.get(i).get("values")).set(0, -0.0022 - 0.0012 * i / points.size())
                            .set(1, -0.00022 - 0.00012 * i / points.size());
                }
                route.fulfill(
                        new Route.FulfillOptions().setContentType("application/json").setBody(changed.toString()));
            } catch (IOException e) {
                throw new UncheckedIOException(e);
            }
        });
        open(many);
        get("run-choice").selectOption("1");
        assertThat(get("front").locator("text", new Locator.LocatorOptions().setHasText("-0.0020"))).hasCount(1);
        assertThat(get("front").locator("text", new Locator.LocatorOptions().setHasText("-0.00020"))).hasCount(1);
        fits("front");
    }

    /** All swim with the same gait; a generation is told from another by its body. */
    @Test
    void bodiesAreDrawnAndSwum() throws IOException {
        page.setViewportSize(1280, 800);
        open(bodies);
        JsonNode answer = answer(0);
        JsonNode bests = answer.get("bests");
        assertThat(get("bodies-figure").locator("polygon")).hasCount(2 * answer.get("bodies").size());
        assertThat(get("bodies").getAttribute("aria-label"))
                .contains("the scene's, length 1.5; best of generation 0, length 1.");
        fits("bodies");
        get("chart-fitness").focus();
        for (int at : List.of(0, bests.size() - 1)) {
            page.keyboard().press(at == 0 ? "Home" : "End");
            page.keyboard().press("Enter");
            JsonNode body = bests.get(at).get("overrides").get("creature").get("profile");
            await("natator.scene().overrides.creature?.profile.length === " + body.get("length"));
            assertThat(get("run-chosen")).containsText("Generation " + bests.get(at).get("generation"));
        }
        assertThat(bests.get(0).get("overrides")).isNotEqualTo(bests.get(bests.size() - 1).get("overrides"));
    }

    /** No label is cut off, and no two of them lie on each other. */
    private void fits(String plot) {
        assertThat((List<?>) page.evaluate(
                """
                        plot => {
                          const svg = document.getElementById(plot);
                          const whole = svg.getBoundingClientRect();
                          const boxes = [...svg.querySelectorAll('text')].map(one => ({text: one.textContent, box: one.getBoundingClientRect()}));
                          const isOutside = ({box}) => box.left < whole.left - 1 || box.right > whole.right + 1 || box.top < whole.top - 1
                              || box.bottom > whole.bottom + 1 || whole.right > innerWidth;
                          const isOver = ({box: a}, {box: b}) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
                          return boxes.filter((one, i) => isOutside(one) || boxes.slice(i + 1).some(other => isOver(one, other)))
                              .map(one => one.text);
                        }""",
                plot)).isEmpty();
    }

    private void awaitGait(JsonNode gait) {
        await("((...both) => (([one, other]) => one.every((value, i) => Math.abs(value - other[i]) < 1e-9))"
                + "(both.map(gait => [gait.frequency, ...gait.amplitude, ...gait.phase])))(natator.scene().gait, "
                + gait + ")");
    }

    private JsonNode answer(int run) throws IOException {
        return Json.parse((String) page.evaluate("async run => (await fetch(`/api/runs/${run}`)).text()", run),
                JsonNode.class);
    }

    private JsonNode best(int generation) throws IOException {
        return answer(0).get("bests").get(generation).get("gait");
    }

    @Test
    void twoSwimSideBySide() {
        open(vacuum);

        get("compare").click();
        await("natator.views[1].frame() > 5");

        assertThat(get("stage-b")).isVisible();
        assertThat(ViewFixture.simulators(ProcessHandle.current())).hasSize(2);
        assertThat(colours(picture(get("picture-b")))).isGreaterThan(100);
        get("compare").click();
        assertThat(get("stage-b")).isHidden();
        assertThat(get("run")).hasText("Pause");
        double frame = number("natator.frame()");
        await("natator.frame() > " + (frame + 5));
    }

    /** Whose a line in a chart is shows by its colour, which is that of the caption; what it is, by its dashes. */
    @Test
    void twoSwimInColoursOfTheirOwn() {
        open(vacuum);
        await("(" + PIXELS + ")('momentum', '--series-2') > 20");
        page.evaluate(CHANGE_SECOND_AT_ONCE);
        await("natator.views[1].time() > 0.5");
        assertThat(number("natator.views[1].scene().gait.amplitude[0]")).isEqualTo(0.2);
        assertThat(number("natator.views[0].scene().gait.amplitude[0]")).isEqualTo(0.9);
        for (String own : List.of("--series-1", "--series-b")) {
            await("(" + PIXELS + ")('distance', '" + own + "') > 20");
        }
        pause();
        awaitDrawings(60);

        assertThat(number("(" + PIXELS + ")('momentum', '--series-2')")).as("of neither").isZero();
        assertThat(get("charts").locator("figure:has(#chart-momentum) .key").first())
                .hasCSS("color",
                        (String) page.evaluate("() => getComputedStyle(document.querySelector('.hint')).color"));
    }

    /** Changes the gait of the second view before that is connected. */
    private static final String CHANGE_SECOND_AT_ONCE = """
            () => {
              document.getElementById('compare').click();
              document.querySelector('[data-testid=which-1]').click();
              const amplitude = document.querySelector('[data-testid=amplitude-1]');
              amplitude.value = 0.2;
              amplitude.dispatchEvent(new Event('input'));
            }""";

    /** How many pixels of a chart have about a colour of the page. */
    private static final String PIXELS = """
            (chart, colour) => {
              const canvas = document.getElementById(`chart-${chart}`);
              const hex = getComputedStyle(canvas).getPropertyValue(colour).trim();
              const wanted = [1, 3, 5].map(at => parseInt(hex.slice(at, at + 2), 16));
              const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
              let count = 0;
              for (let i = 0; i < data.length; i += 4) {
                const isNear = wanted.every((value, k) => Math.abs(value - data[i + k]) < 24);
                count += isNear && data[i + 3] > 128 ? 1 : 0;
              }
              return count;
            }""";

    /** One swims in water, which takes longer; the other one waits. */
    @Test
    void twoSwimInStep() {
        open(vacuum);
        get("compare").click();
        await("natator.views[1].frame() > 5");
        choose("which-1");
        get("vacuum").uncheck();
        // The other one goes back to the start with it.
        await("natator.views[1].position().length > 3000 && natator.views[0].frame() === natator.views[1].frame()");

        Object apart = page.evaluate("""
                () => new Promise(done => {
                  let most = 0, count = 40;
                  const next = () => {
                    most = Math.max(most, Math.abs(natator.views[0].time() - natator.views[1].time()));
                    count-- > 0 ? requestAnimationFrame(next) : done(most);
                  };
                  requestAnimationFrame(next);
                })""");
        assertThat(((Number) apart).doubleValue()).as("simulated seconds between them").isLessThan(1e-9);
        pause();
        get("reset").click();
        await("natator.views[0].frame() === 0 && natator.views[1].frame() === 0");
        for (int i = 1; i <= 3; i++) {
            get("step").click();
            await("natator.views[0].frame() === " + i + " && natator.views[1].frame() === " + i);
        }
        assertThat(get("time-b")).hasText("0.05 s");
        assertThat(get("time-a")).hasText("0.05 s");
        get("run").click();
        await("natator.views[0].frame() > 10 && natator.views[1].frame() > 10");
    }

    @Test
    void generationsAreComparedByName() {
        open(vacuum);
        assertThat(get("run-chosen")).containsText("What swims is not of this run");
        get("chart-fitness").focus();
        page.keyboard().press("Home");
        assertThat(get("stage-a").locator("figcaption")).containsText("my-run, generation 0");

        get("run-compare").click();
        assertThat(get("stage-b").locator("figcaption")).containsText("my-run, generation 0");
        assertThat(get("stage-a").locator("figcaption")).containsText("creature-1-vacuum, gait of your own");

        choose("which-0");
        get("chart-fitness").focus();
        page.keyboard().press("Home");
        assertThat(get("stage-a").locator("figcaption")).containsText("my-run, generation 0");
        get("compare").click();
        assertThat(get("stage-b")).isHidden();
        await("(views => views?.length === 1 && JSON.stringify(views[0].gait) === JSON.stringify(natator.scene().gait))"
                + "(JSON.parse(decodeURIComponent(location.hash.slice(1)) || '{}').views)");  // the address remembers soon, not at once
        page.reload();
        awaitSwimming();
        assertThat(get("run-chosen")).containsText("Generation 0");
        get("run-compare").click();
        assertThat(get("run-error")).hasText("This gait swims already: choose another one first.");
        assertThat(get("stage-b")).isHidden();
    }
}
