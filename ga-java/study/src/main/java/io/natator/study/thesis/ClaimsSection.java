package io.natator.study.thesis;

import io.natator.report.Recording;
import io.natator.report.ReportDocument;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;

/** Which of the thesis' conclusions hold, by rules that are stated beside them. */
final class ClaimsSection {

    /** What the thesis says that this study cannot test. */
    private static final List<List<String>> UNTESTED = List.of(
            List.of("more substeps, iterations and a larger radius cost more", "what they cost is measured, interleaved, in "
                    + "[benchmarks](../benchmarks/README.md); a study's runs share their machine"),
            List.of("a body sampled from a triangle mesh does not swim", "that mesh is not published; Natator's own bodies from meshes swim, see "
                    + "the ray in [pictures](../pictures/README.md)"));

    private final List<Claim> claims = new ArrayList<>();

    ClaimsSection(StudyResults results, Map<String, Recording> recordings) {
        for (Water water : Water.values()) {
            claims.addAll(new MotionClaims(results, recordings).in(water));
            claims.addAll(new ParameterClaims(results).in(water));
            claims.addAll(new ActivationClaims(results).in(water));
        }
    }

    /** How many of the thesis' conclusions that could be tested in a water hold, in words; null if none could. */
    String kept(Water water) {
        List<Claim> tested = claims.stream().filter(one -> one.water() == water && !one.isOurs() && one.outcome() != Claim.Outcome.VOID).toList();
        return tested.isEmpty() ? null : count(tested, Claim.Outcome.HOLDS) + " of " + tested.size() + " hold and "
                + count(tested, Claim.Outcome.FAILS) + " do not";
    }

    private static long count(List<Claim> claims, Claim.Outcome outcome) {
        return claims.stream().filter(one -> one.outcome() == outcome).count();
    }

    void add(ReportDocument page) {
        page.heading(2, "Which conclusions hold");
        page.text("✔ for everything that was tested, ✘ for nothing of it; open: for some, or chance alone is as large. Parameters are judged "
                + "by all their values and by each gait that swims: creature 2's with twice the published phase step, and the best that "
                + "evolved of creatures 1 and 2. A speed differs if it differs by two standard errors and by a tenth. Speeds are "
                + "along the body's own heading, while a run lasts. What is marked (found here) is not the thesis' and not counted.");
        Set<String> says = new LinkedHashSet<>();
        claims.forEach(claim -> says.add(claim.says()));
        page.words(List.of("the thesis says", "in flex", "in open water"), says.stream().map(one -> List.of(one, outcome(one, Water.FLEX),
                outcome(one, Water.OPEN_WATER))).toList());
        page.folded("the numbers", inside -> inside.words(List.of("the thesis says", "water", "what was measured", "holds"),
                claims.stream().map(one -> List.of(one.says(), one.water().words(), one.measured(), one.outcome().told())).toList()));
        page.text("Not tested:");
        page.words(List.of("the thesis says", "why"), UNTESTED);
    }

    private String outcome(String says, Water water) {
        Optional<Claim> found = claims.stream().filter(one -> one.says().equals(says) && one.water() == water).findFirst();
        return found.map(one -> one.outcome().told()).orElse("");
    }

    /** Waters in which anything was tested. */
    List<Water> waters() {
        return Arrays.stream(Water.values()).filter(water -> kept(water) != null).toList();
    }
}
