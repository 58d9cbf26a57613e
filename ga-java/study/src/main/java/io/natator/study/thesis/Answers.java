package io.natator.study.thesis;

import io.natator.checkpoint.SwimSample;
import io.natator.kinematics.FishMode;
import io.natator.plot.Picture;
import io.natator.report.Charts;
import io.natator.report.FirstScreen;
import io.natator.verdict.ControlVerdict;
import io.natator.verdict.Measure;
import io.natator.verdict.Verdict;
import java.io.IOException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Comparator;
import java.util.HashSet;
import java.util.List;
import java.util.Locale;
import java.util.Optional;
import java.util.function.Function;
import java.util.stream.Collectors;
import java.util.stream.IntStream;
import org.knowm.xchart.XYChart;

/** The report's first screen: what came of the thesis, in five sentences, a table and a chart. */
final class Answers {

    private final StudyResults results;
    private final ClaimsSection claims;

    Answers(StudyResults results, ClaimsSection claims) {
        this.results = results;
        this.claims = claims;
    }

    private List<Subject> best(Water water) {
        return IntStream.rangeClosed(1, 4).mapToObj(creature -> results.best(creature, water)).flatMap(Optional::stream).toList();
    }

    /** The thesis' own gaits, without what is made of them here. */
    private List<Subject> published(Water water) {
        return results.data().gaits().stream().filter(gait -> gait.published() != null).map(gait -> Subject.of(gait, water)).toList();
    }

    private boolean swims(Subject subject) {
        return results.verdict(subject).map(ControlVerdict::kind).filter(Verdict.Kind.SWIMS::equals).isPresent();
    }

    List<String> sentences() {
        if (Arrays.stream(Water.values()).allMatch(water -> swimming(published(water)) == null)) {
            return List.of("**Nothing is measured yet.**");
        }
        List<String> sentences = new ArrayList<>();
        String evolved = inEach(water -> swimming(results.evolved(water)));
        sentences.add("**Of the thesis' gaits " + inEach(water -> swimming(published(water))) + " swim by every control"
                + (evolved.isEmpty() ? ".**" : "; of the gaits that evolved here " + evolved + " do.**"));
        String fastest = inEach(this::fastest);
        if (!fastest.isEmpty()) {
            sentences.add("The fastest that swims is " + fastest + ".");
        }
        String without = inEach(this::withoutWater);
        if (!without.isEmpty()) {
            sentences.add("Without water, where nothing can swim, what evolved moves at up to " + without + ".");
        }
        String like = inEach(this::eel);
        if (!like.isEmpty()) {
            sentences.add("Creature 2, which the thesis found to swim like an eel, evolves to swim like " + like + ".");
        }
        if (!claims.waters().isEmpty()) {
            sentences.add("Of the thesis' conclusions that can be tested " + inEach(claims::kept) + ".");
        }
        return sentences;
    }

    /** What is said of each water, where there is something; once, if it is the same in all. */
    private static String inEach(Function<Water, String> of) {
        List<String> told = Arrays.stream(Water.values()).map(of).toList();
        if (told.get(0) != null && new HashSet<>(told).size() == 1) {
            return told.get(0) + " in both waters";
        }
        return Arrays.stream(Water.values()).filter(water -> of.apply(water) != null)
                .map(water -> of.apply(water) + " in " + (water == Water.FLEX ? "`flex`" : water.words())).collect(Collectors.joining(", "));
    }

    private String swimming(List<Subject> subjects) {
        List<Subject> judged = subjects.stream().filter(subject -> results.verdict(subject).isPresent()).toList();
        return judged.isEmpty() ? null : judged.stream().filter(this::swims).count() + " of " + judged.size();
    }

    private String fastest(Water water) {
        return best(water).stream().filter(this::swims).max(Comparator.comparingDouble(subject -> results.speed(subject).orElseThrow().mean()))
                .map(this::speed).orElse(null);
    }

    /** In the units of the table below it, and in those in which fish are told. */
    private String speed(Subject subject) {
        Speed speed = results.speed(subject).orElseThrow();
        double ofBody = speed.mean() / results.bodyLength(subject.creature());
        return "creature " + subject.creature() + " at " + speed.text(1) + " units/s (" + TableFormat.shortNumber(ofBody) + " body lengths/s"
                + (endsAtWall(subject) ? ", until it touches a wall after " + seconds(subject) : "") + ")";
    }

    /** Whether its speed is of a shorter time than the whole. */
    private boolean endsAtWall(Subject subject) {
        SwimSample swim = results.swim(subject, Condition.WATER);
        return subject.water() == Water.OPEN_WATER && swim != null && swim.endsAtWall();
    }

    private String seconds(Subject subject) {
        return String.format(Locale.ROOT, "%.1f s", results.lasted(subject).mean());
    }

    private String withoutWater(Water water) {
        return best(water).stream().map(subject -> Math.abs(results.speed(subject, Condition.VACUUM).mean())).filter(Double::isFinite)
                .max(Double::compare).map(speed -> TableFormat.shortNumber(speed) + " units/s").orElse(null);
    }

    private String eel(Water water) {
        return results.best(2, water).map(results::motions).filter(motions -> !motions.isEmpty()).map(motions -> StudyResults
                .like(motions, SwimKinematics::fitsOfBody).map(FishMode::label).map(name -> name + " fish").orElse("no fish")).orElse(null);
    }

    /** Speeds of each creature, the thesis' gait and the best that evolved. */
    FirstScreen.Evidence evidence() {
        List<List<String>> rows = new ArrayList<>();
        for (ThesisData.PublishedGait gait : results.data().gaits()) {
            boolean isPublished = gait.published() != null;
            List<String> row = new ArrayList<>(List.of(gait.creature() + (isPublished ? "" : ", " + gait.about()),
                    isPublished ? TableFormat.shortNumber(gait.published().speed()) : ""));
            for (Water water : Water.values()) {
                row.add(told(Optional.of(Subject.of(gait, water))));
            }
            for (Water water : Water.values()) {
                row.add(isPublished ? toldOfSeeds(gait.creature(), water) : "");
            }
            rows.add(row);
        }
        return new FirstScreen.Evidence(List.of("creature", "published", "thesis' gait, flex", "thesis' gait, open water", "evolved, flex",
                "evolved, open water"), rows, "Speed in scene units/s ± the largest of: the 95 % interval over fresh starts, the change at half "
                + "the time step, the change at half the spacing (where evolved). ✔ swims by every control, ✘ does not, – may: "
                + "[what the controls are](#how-it-was-judged). Evolved: of the seeds the one that gets furthest by the lesser of its ways at both time steps, and "
                + "how many of them swim." + untilWalls());
    }

    private String untilWalls() {
        String ends = best(Water.OPEN_WATER).stream().filter(this::endsAtWall)
                .map(subject -> "creature " + subject.creature() + " after " + seconds(subject)).collect(Collectors.joining(", "));
        return ends.isEmpty() ? "" : " In open water a speed is that until a wall is touched: by " + ends + ".";
    }

    private String told(Optional<Subject> subject) {
        return subject.flatMap(one -> results.speed(one).map(speed -> results.verdict(one).map(Answers::sign).orElse("–") + " "
                + speed.text(1))).orElse("");
    }

    private String toldOfSeeds(int creature, Water water) {
        String seeds = swimming(results.evolved(water).stream().filter(subject -> subject.creature() == creature).toList());
        return told(results.best(creature, water)) + (seeds == null ? "" : " (" + seeds + ")");
    }

    /** What stands before a verdict: ✔, ✘ or –. */
    static String sign(ControlVerdict verdict) {
        return FirstScreen.SIGNS.get(switch (verdict.kind()) {
            case SWIMS -> Measure.Outcome.HOLDS;
            case DOES_NOT_SWIM -> Measure.Outcome.FAILS;
            case UNPROVEN -> Measure.Outcome.NOT_MEASURED;
        });
    }

    /**
     * Draws the same with error bars.
     *
     * @param file path without extension
     * @return the PNG file, or null if there is nothing to draw
     */
    Path draw(Path file) throws IOException {
        XYChart chart = Charts.lines("Speed in water", "creature", "scene units/s");
        Charts.name(chart, List.of("1", "2", "3", "4"));
        int number = 0;
        for (Water water : Water.values()) {
            add(chart, "thesis' gait, " + water.words(), results.catalogue().published(water), number++);
            add(chart, "evolved, " + water.words(), best(water), number++);
        }
        return chart.getSeriesMap().isEmpty() ? null : Picture.save(chart, file);
    }

    /** Beside each other, so that bars do not hide bars. */
    private void add(XYChart chart, String name, List<Subject> subjects, int number) {
        List<Subject> known = subjects.stream().filter(subject -> results.speed(subject).isPresent()).toList();
        if (!known.isEmpty()) {
            List<Speed> speeds = known.stream().map(subject -> results.speed(subject).orElseThrow()).toList();
            Charts.addPoints(chart, name, known.stream().mapToDouble(subject -> subject.creature() + 0.12 * (number - 1.5)).toArray(),
                    speeds.stream().mapToDouble(Speed::mean).toArray(), speeds.stream().mapToDouble(Speed::error).toArray(), number);
        }
    }
}
