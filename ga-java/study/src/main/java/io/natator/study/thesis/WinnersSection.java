package io.natator.study.thesis;

import io.natator.checkpoint.Controls;
import io.natator.checkpoint.SwimSample;
import io.natator.encoding.Gait;
import io.natator.report.ReportDocument;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Locale;
import java.util.SortedMap;
import java.util.SortedSet;
import java.util.TreeMap;
import java.util.TreeSet;
import java.util.stream.IntStream;

/** Every gait with its error bar, its verdict and what these rest on. */
final class WinnersSection {

    /** From here on a gene counts as being on its bound, as a share of its range. */
    private static final double AT_BOUND = 0.02;

    private final StudyResults results;

    WinnersSection(StudyResults results) {
        this.results = results;
    }

    void add(ReportDocument page) {
        page.heading(2, "What swims");
        page.text("Speeds in body lengths per second. Re, St and cavities (water at the end that does not follow the body, in volumes of the body): means of the runs, of "
                + "what may swim in open water.");
        for (Water water : Water.values()) {
            page.heading(3, water == Water.FLEX ? "The thesis' tank, flex" : "Open water, conserving");
            List<Subject> subjects = results.subjects().filter(subject -> subject.water() == water)
                    .filter(subject -> results.speed(subject).isPresent()).toList();
            List<String> header = new ArrayList<>(List.of("creature", "gait", "speed ± error", "starts", "half step", "half spacing", "per beat", "lasts (s)"));
            header.addAll(water == Water.OPEN_WATER ? List.of("Re", "St", "cavities") : List.of());
            page.table(header, subjects.stream().map(this::speeds).toList());
            page.folded("verdicts", inside -> inside.words(List.of("creature", "gait", "verdict"), subjects.stream().map(subject -> List.of(
                    "" + subject.creature(), subject.label(), results.verdict(subject).map(verdict -> Answers.sign(verdict) + " " + verdict.text())
                            .orElse(TableFormat.NOTHING))).toList()));
            page.folded("controls", inside -> inside.table(List.of("creature", "gait", "resting", "vacuum", "no clamp", "mirrored", "other water", "on the processor",
                    "under water"), subjects.stream().map(this::controls).toList()));
        }
        agreement(page);
        page.folded("the gaits, and which search bounds they are on", inside -> inside.table(List.of("creature", "water", "gait", "f (1/s)", "a", "φ", "on a bound"),
                results.subjects().filter(subject -> subject.isEvolved() || subject.water() == Water.FLEX).map(WinnersSection::gait).toList()));
    }

    /** How much depends on the chance of an evolution: what each seed found. Nothing where there is one seed only. */
    private void agreement(ReportDocument page) {
        SortedSet<Long> seeds = new TreeSet<>(results.evolved().stream().map(Subject::seed).toList());
        if (seeds.size() < 2) {
            return;
        }
        page.heading(3, "Whether evolutions agree");
        page.text("Speed ± error of each seed's winner: an evolution of its own, from other first gaits and other starts. They agree where the largest and the "
                + "least are no further apart than the larger error of these two.");
        List<String> header = new ArrayList<>(List.of("creature", "water"));
        seeds.forEach(seed -> header.add("seed " + seed));
        header.addAll(List.of("apart", "agree"));
        List<List<String>> rows = new ArrayList<>();
        for (Water water : Water.values()) {
            IntStream.rangeClosed(1, 4).mapToObj(creature -> agreement(creature, water, seeds)).filter(row -> !row.isEmpty()).forEach(rows::add);
        }
        page.table(header, rows);
    }

    private List<String> agreement(int creature, Water water, SortedSet<Long> seeds) {
        double length = results.bodyLength(creature);
        SortedMap<Long, Speed> speeds = new TreeMap<>();
        results.evolved(water).stream().filter(subject -> subject.creature() == creature)
                .forEach(subject -> results.speed(subject).ifPresent(speed -> speeds.put(subject.seed(), speed)));
        if (speeds.size() < 2) {
            return List.of();
        }
        Agreement agreement = new Agreement(speeds.values());
        List<String> row = new ArrayList<>(List.of("" + creature, water.words()));
        seeds.forEach(seed -> row.add(speeds.containsKey(seed) ? speeds.get(seed).text(length) : TableFormat.NOTHING));
        row.add(TableFormat.shortNumber(agreement.apart() / length));
        row.add(agreement.holds() ? "✔" : "✘");
        return row;
    }

    private List<String> speeds(Subject subject) {
        Speed speed = results.speed(subject).orElseThrow();
        double length = results.bodyLength(subject.creature());
        List<String> row = new ArrayList<>(List.of("" + subject.creature(), subject.label(), speed.text(length),
                speed.scatterText(length), signed(speed.halfStep() / length), signed(speed.halfSpacing() / length),
                TableFormat.shortNumber(speed.mean() / length / subject.gait().frequency()),
                String.format(Locale.ROOT, "%.1f", results.lasted(subject).mean())));
        if (subject.water() == Water.OPEN_WATER) {
            row.addAll(flow(results.maySwim(subject) ? results.controls(subject).orElseThrow().water() : null));
        }
        return row;
    }

    /** Numbers of the water around what may swim; without any, null. */
    private static List<String> flow(SwimSample swim) {
        return swim == null ? Collections.nCopies(3, TableFormat.NOTHING)
                : List.of(figure(swim.reynolds()), decimal(swim.strouhal()), decimal(swim.cavities()));
    }

    private static String signed(double change) {
        return Double.isNaN(change) ? TableFormat.NOTHING : String.format(Locale.ROOT, "%+.2f", change);
    }

    private static String figure(Double value) {
        return value == null ? TableFormat.NOTHING : String.format(Locale.ROOT, "%.0f", value);
    }

    private static String decimal(Double value) {
        return value == null ? TableFormat.NOTHING : TableFormat.shortNumber(value);
    }

    private List<String> controls(Subject subject) {
        double length = results.bodyLength(subject.creature());
        List<String> row = new ArrayList<>(List.of("" + subject.creature(), subject.label()));
        for (Condition condition : List.of(Condition.RESTING, Condition.VACUUM, Condition.NO_CLAMP, Condition.MIRRORED, Condition.OTHER_WATER)) {
            row.add(Condition.in(subject.water()).contains(condition) ? TableFormat.shortNumber(results.speed(subject, condition).mean() / length)
                    : TableFormat.NOTHING);
        }
        Controls controls = results.controls(subject).orElse(null);
        row.add(controls == null || controls.otherBackend() == null ? TableFormat.NOTHING
                : TableFormat.shortNumber(results.speedOnProcessor(subject).mean() / length));
        row.add(controls == null || controls.underWater() == null ? TableFormat.NOTHING
                : String.format(Locale.ROOT, "%.0f %%", 100 * controls.underWater()));
        return row;
    }

    private static List<String> gait(Subject subject) {
        Gait gait = subject.gait();
        return List.of("" + subject.creature(), subject.water().words(), subject.label(), TableFormat.number(gait.frequency()), TableFormat.list(gait.amplitude()),
                TableFormat.list(gait.phase()), bounds(gait));
    }

    /** Which of frequency (0.5 to 2) and amplitudes (0 to 1) are on a bound of what was searched. */
    private static String bounds(Gait gait) {
        List<String> on = new ArrayList<>();
        if (Math.min(gait.frequency() - 0.5, 2 - gait.frequency()) < AT_BOUND * 1.5) {
            on.add("f");
        }
        long amplitudes = gait.amplitude().stream().filter(one -> Math.min(one, 1 - one) < AT_BOUND).count();
        if (amplitudes > 0) {
            on.add(amplitudes + " of " + gait.amplitude().size() + " a");
        }
        return on.isEmpty() ? TableFormat.NOTHING : String.join(", ", on);
    }
}
