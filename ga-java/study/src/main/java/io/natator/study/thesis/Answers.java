package io.natator.study.thesis;

import io.natator.config.Scheme;
import io.natator.plot.Picture;
import io.natator.report.Charts;
import io.natator.report.FirstScreen;
import io.natator.study.Sample;
import java.io.IOException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.Locale;
import java.util.Objects;
import java.util.Optional;
import java.util.function.Function;
import java.util.stream.IntStream;
import java.util.stream.Stream;
import org.knowm.xchart.XYChart;

/** The report's first screen: what came of the thesis, in five sentences, a table and a chart. */
final class Answers {

    private final StudyResults results;
    private final ClaimsSection claims;

    Answers(StudyResults results, ClaimsSection claims) {
        this.results = results;
        this.claims = claims;
    }

    /** A gait of a creature in a scheme, as it was measured. */
    private record Swim(int creature, Scheme scheme, Sample fluid, Sample vacuum) {

        boolean swims() {
            return outcome().equals(ClaimsSection.YES);
        }

        String outcome() {
            return ClaimsSection.swims(fluid, vacuum);
        }
    }

    private List<Swim> published(Scheme scheme) {
        return results.data().gaits().stream().map(gait -> published(gait, scheme)).filter(swim -> swim.fluid.count() > 0).toList();
    }

    private Swim published(ThesisData.PublishedGait gait, Scheme scheme) {
        return new Swim(gait.creature(), scheme, results.speed(gait, scheme, ExperimentCatalogue.FLUID),
                results.speed(gait, scheme, ExperimentCatalogue.VACUUM));
    }

    private Stream<EvolvedRun> best(Scheme scheme) {
        return IntStream.rangeClosed(1, 4).mapToObj(creature -> results.best(creature, scheme)).filter(Objects::nonNull);
    }

    private Swim evolved(EvolvedRun run) {
        return new Swim(run.creature(), run.scheme(), results.speed(run, ExperimentCatalogue.FLUID),
                results.speed(run, ExperimentCatalogue.VACUUM));
    }

    private List<Swim> evolved(Scheme scheme) {
        return best(scheme).map(this::evolved).toList();
    }

    /** The evolution whose winner is the report's picture: the fastest that swims. */
    Optional<EvolvedRun> portrayed() {
        return ExperimentCatalogue.SCHEMES.stream().flatMap(this::best).max(Comparator
                .comparing((EvolvedRun run) -> evolved(run).swims()).thenComparingDouble(run -> evolved(run).fluid.mean()));
    }

    List<String> sentences() {
        List<String> sentences = new ArrayList<>();
        if (ExperimentCatalogue.SCHEMES.stream().allMatch(scheme -> published(scheme).isEmpty())) {
            return List.of("**Nothing is measured yet.**");
        }
        sentences.add("**Of the thesis' gaits " + inEach(scheme -> swimming(published(scheme))) + " swim"
                + (ExperimentCatalogue.SCHEMES.stream().allMatch(scheme -> evolved(scheme).isEmpty()) ? ".**"
                        : "; of its bodies " + inEach(scheme -> swimming(evolved(scheme))) + " evolve to swim.**"));
        String fastest = inEach(this::fastest);
        if (!fastest.isEmpty()) {
            sentences.add("The fastest that evolved and swims is " + fastest + ".");
            sentences.add("Without water, where nothing can swim, the evolved gaits move at up to "
                    + inEach(scheme -> TableFormat.shortNumber(evolved(scheme).stream().mapToDouble(swim -> Math.abs(swim.vacuum.mean()))
                            .filter(Double::isFinite).max().orElse(Double.NaN))) + " units/s.");
        }
        sentences.add("Of the thesis' conclusions that could be tested " + inEach(claims::kept) + " hold.");
        String like = inEach(this::eel);
        if (!like.isEmpty()) {
            sentences.add("Creature 2, which the thesis found to swim like an eel, evolves to swim like " + like + ".");
        }
        return sentences;
    }

    /** What is said of each scheme, where there is something. */
    private static String inEach(Function<Scheme, String> of) {
        return String.join(" and ", ExperimentCatalogue.SCHEMES.stream().filter(scheme -> of.apply(scheme) != null)
                .map(scheme -> of.apply(scheme) + " in `" + TableFormat.name(scheme) + "`").toList());
    }

    private static String swimming(List<Swim> swims) {
        return swims.isEmpty() ? null : swims.stream().filter(Swim::swims).count() + " of " + swims.size();
    }

    private String fastest(Scheme scheme) {
        return evolved(scheme).stream().filter(Swim::swims).max(Comparator.comparingDouble(swim -> swim.fluid.mean()))
                .map(swim -> "creature " + swim.creature + " at " + TableFormat.speed(swim.fluid) + " units/s, "
                        + TableFormat.shortNumber(swim.fluid.mean() / results.bodyLength(swim.creature) / results.data().eelBodyLengths())
                        + " of an eel's speed,").orElse(null);
    }

    private String eel(Scheme scheme) {
        EvolvedRun two = results.best(2, scheme);
        List<SwimKinematics> motions = two == null ? List.of() : results.motions(two);
        return motions.isEmpty() ? null
                : StudyResults.like(motions, SwimKinematics::fitsOfBody).map(fish -> fish.label() + " fish").orElse("no fish");
    }

    /** Speeds of each creature, the thesis' gait and the best that evolved. */
    FirstScreen.Evidence evidence() {
        List<List<String>> rows = new ArrayList<>();
        for (ThesisData.PublishedGait gait : results.data().gaits()) {
            List<String> row = new ArrayList<>(List.of(gait.creature() + (gait.published() != null ? "" : ", " + gait.about())));
            ExperimentCatalogue.SCHEMES.forEach(scheme -> row.add(told(published(gait, scheme))));
            ExperimentCatalogue.SCHEMES.forEach(scheme -> row.add(gait.published() == null ? ""
                    : evolved(scheme).stream().filter(swim -> swim.creature == gait.creature()).findFirst().map(Answers::told).orElse("")));
            rows.add(row);
        }
        return new FirstScreen.Evidence(List.of("creature", "thesis' gait, flex", "thesis' gait, conserving", "evolved, flex",
                "evolved, conserving"), rows, "Speed in water, units/s, mean ± standard deviation. ✔ swims, ✘ does not, – doubtful: "
                + "[the rules](#all-verdicts). Evolved: of the seeds the fastest that swims, else the fastest.");
    }

    private static String told(Swim swim) {
        return swim.fluid.count() == 0 ? "" : ClaimsSection.sign(swim.outcome()) + " " + TableFormat.speed(swim.fluid);
    }

    /**
     * Draws the same with error bars.
     *
     * @param file path without extension
     * @return the PNG file, or null if there is nothing to draw
     */
    Path draw(Path file) throws IOException {
        XYChart chart = Charts.lines("Speed in water", "creature", "scene units/s, ± one standard deviation");
        chart.getStyler().setXAxisMin(0.0).setXAxisMax(5.0);
        chart.setCustomXAxisTickLabelsFormatter(x -> Math.abs(x - Math.rint(x)) < 1e-6 && x > 0.5 && x < 4.5 ? String.format(Locale.ROOT, "%.0f", x) : "");
        int number = 0;
        for (Scheme scheme : ExperimentCatalogue.SCHEMES) {
            add(chart, "thesis, " + TableFormat.name(scheme), published(scheme), number++);
            add(chart, "evolved, " + TableFormat.name(scheme), evolved(scheme), number++);
        }
        return chart.getSeriesMap().isEmpty() ? null : Picture.save(chart, file);
    }

    /** Beside each other, so that bars do not hide bars. */
    private static void add(XYChart chart, String name, List<Swim> swims, int number) {
        if (!swims.isEmpty()) {
            Charts.addPoints(chart, name, swims.stream().mapToDouble(swim -> swim.creature + 0.12 * (number - 1.5)).toArray(),
                    swims.stream().mapToDouble(swim -> swim.fluid.mean()).toArray(),
                    swims.stream().mapToDouble(swim -> swim.fluid.hasSpread() ? swim.fluid.standardDeviation() : 0).toArray(), number);
        }
    }
}
