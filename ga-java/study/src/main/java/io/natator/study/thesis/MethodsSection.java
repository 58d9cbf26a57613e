package io.natator.study.thesis;

import io.natator.config.Json;
import io.natator.config.Numbers;
import io.natator.report.ReportDocument;
import io.natator.simulator.SimulationResult;
import java.util.Arrays;
import java.util.DoubleSummaryStatistics;
import java.util.IntSummaryStatistics;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Objects;
import java.util.Optional;
import java.util.stream.Collectors;

/** What was asked, what was simulated, and how it was judged: what a reviewer reads before any number. */
final class MethodsSection {

    private final StudyResults results;

    MethodsSection(StudyResults results) {
        this.results = results;
    }

    void add(ReportDocument page) {
        page.heading(2, "The question");
        page.text("P. Fajdiga's master's thesis (*Plavajoča bitja v simulaciji Nvidia Flex*, University of Ljubljana, 2019) evolved gaits of four "
                + "soft bodies in a tank simulated by NVIDIA Flex. It found that they swim, one of them like an eel. Do its "
                + "gaits swim, do its bodies evolve to swim, and is it swimming or the solver?");
        page.heading(2, "What was simulated");
        page.list(List.of(
                "`flex`: the thesis' tank and settings, in scheme `flex`, which agrees with NVIDIA Flex 1.2.0 ([574 experiments](../../tests/conformance/README.md), [whole swims](../flex-comparison/README.md)). "
                        + "Masses of fluid particles fall from 2 at the bottom to 1/14 at the top and damping drags against the tank, so it is no "
                        + "water, and it has neither a kinematic viscosity nor a Reynolds number.",
                "Open water: incompressible water of one density in scheme `conserving` ([how far it is water](../water/README.md)), 6 × 1.6 × 1.6 units at "
                        + "a spacing of 0.1; bodies of the thesis' shapes, as heavy as the water that they displace, with a cluster stiffness of 0.6 instead of "
                        + "0.2 and a spring stiffness of 0.4 instead of 1. Lengths are scene units, times seconds, the kinematic viscosity 0.002 units²/s" + reynolds(),
                sinking()));
        page.heading(2, "How it evolved");
        page.text(evolutions());
        page.heading(2, "How it was judged");
        page.list(List.of(
                "*Winner.* Selection by few runs collects luck. So the " + Finalists.COUNT + " best gaits of each evolution are run again from four starts that it did not "
                        + "have, in the scene as it is for the whole 4 s, and the one that goes furthest by its mean less a standard error is the winner. What is "
                        + "said of it comes from yet other starts.",
                "*Start.* In open water another arrangement of the water's particles; in `flex` a shift of all particles by at most 10⁻⁴ units.",
                "*Speed.* Way along x from rest, in the thesis' tank in the whole time by that time: a run that hits a wall early is not made faster by "
                        + "dividing by less. Open water stands for water without walls: there it is the way until a run ends at one, by the time "
                        + "until then. Verdicts compare ways, and speeds over the whole time.",
                "*Error.* The largest of three: half the 95 % interval of the mean (Student's t), the change at half the time step, the change at half "
                        + "the spacing of all particles with the body's motion kept. In `flex` the time step and the spacing are part of what the thesis "
                        + "defines; how much they change says how much of a speed is the discretisation's.",
                "*Swims.* Further than the same body with resting muscles by 0.05 body lengths and two standard errors; less than half as far in vacuum; at least "
                        + "half of its way left without the acceleration clamp (`flex`), mirrored and on the processor; within half of its way at half the time "
                        + "step; at least half of the body under water. One that only misses a control of the last four *may* swim; so may one whose way in vacuum or "
                        + "without the clamp is known, to two standard errors, no better than to either side of the half, and one that touches a wall within half "
                        + "a body length.",
                "*Like which fish.* The least e of the thesis (2.14 to 2.16) with the body's roll taken out, of those that are at most 0.8 of what no motion has and "
                        + "need no α below 0.1, over the part of the body that is measured at all times."));
    }

    /** Of what may swim there. */
    private String reynolds() {
        DoubleSummaryStatistics all = results.subjects().filter(subject -> subject.water() == Water.OPEN_WATER).filter(results::maySwim)
                .map(subject -> results.controls(subject).orElseThrow().water().reynolds()).filter(Objects::nonNull)
                .mapToDouble(Double::doubleValue).summaryStatistics();
        return all.getCount() == 0 ? "." : String.format(Locale.ROOT, ": what swims there has a Reynolds number of %.0f to %.0f, as the larva of a fish.",
                all.getMin(), all.getMax());
    }

    private String sinking() {
        List<Experiment> all = List.of(1, 2, 3, 4).stream().map(results.catalogue()::sinking).toList();
        List<Double> times = all.stream().flatMap(one -> results.measurements().results(one).stream())
                .filter(one -> SimulationResult.AT_WALL.equals(one.stopped())).map(one -> one.simulated()).sorted().toList();
        long runs = all.stream().mapToLong(one -> results.measurements().results(one).size()).sum();
        return "Not the thesis' tank in scheme `conserving`: its bodies weigh 1.7 times the water that they displace" + (runs == 0 ? "."
                : "; " + times.size() + " of " + runs + " runs of its gaits there lie on the floor" + (times.isEmpty() ? "." : " after "
                + TableFormat.shortNumber(times.get(0)) + " to " + TableFormat.shortNumber(times.get(times.size() - 1)) + " s."));
    }

    private String evolutions() {
        if (results.runs().isEmpty()) {
            return "No evolution is finished.";
        }
        return "By the thesis' genetic algorithm: the best fifth and the roulette's choice, crossover, mutation, Gaussian mutation. "
                + Arrays.stream(Water.values()).map(this::evolutions).flatMap(Optional::stream).collect(Collectors.joining(" "));
    }

    /** Of a water; one sentence for each way in which evolution searched there. */
    private Optional<String> evolutions(Water water) {
        Map<Water.Evolving, List<Searched>> searches = results.runs().stream().filter(run -> run.water() == water)
                .map(run -> new Searched(run.creature(), Water.Evolving.of(run.storedSettings())))
                .collect(Collectors.groupingBy(one -> one.how().over(0), LinkedHashMap::new, Collectors.toList()));
        return searches.isEmpty() ? Optional.empty() : Optional.of(searches.values().stream().map(alike -> "In " + water.words() + " "
                + evolutions(alike, searches.size() > 1)).collect(Collectors.joining(" ")));
    }

    /** An evolution of a creature. */
    private record Searched(int creature, Water.Evolving how) {
    }

    /** Of those that differ by no more than their generations. */
    private static String evolutions(List<Searched> alike, boolean isOfSome) {
        List<String> creatures = alike.stream().map(Searched::creature).distinct().sorted().map(String::valueOf).toList();
        int last = creatures.size() - 1;
        String whose = last == 0 ? " of creature " + creatures.get(0) + ","
                : " of creatures " + String.join(", ", creatures.subList(0, last)) + " and " + creatures.get(last) + ",";
        Water.Evolving how = alike.get(0).how();
        return Numbers.count(alike.size(), "evolution") + (isOfSome ? whose : "") + " of " + how.population()
                + " chromosomes over " + generations(alike) + " generations, " + how.starts()
                + " starts for each new gait and the best judged again in every generation"
                + (how.duration() == null ? ", 4 s a run" : ", " + how.duration() + " s a run")
                + (how.overrides() == null ? "." : ", in a scene that costs less (`" + Json.line(how.overrides())
                + "`) than that in which they are judged.");
    }

    /** From the least to the most where some have gone on further than others. */
    private static String generations(List<Searched> alike) {
        IntSummaryStatistics all = alike.stream().mapToInt(one -> one.how().generations()).summaryStatistics();
        return all.getMin() == all.getMax() ? "" + all.getMin() : all.getMin() + " to " + all.getMax();
    }
}
