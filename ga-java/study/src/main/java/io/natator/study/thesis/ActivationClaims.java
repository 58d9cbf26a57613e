package io.natator.study.thesis;

import io.natator.encoding.Gait;
import io.natator.study.Sample;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;

/** What the thesis says of potentiated activation (4.2) and of the body of two clusters (4.3). Speeds are along the own heading. */
final class ActivationClaims {

    /** Slower is no motion in vacuum worth the name. Scene units per second. */
    static final double STILL = 0.01;
    private static final double SURE = 2;
    private static final double GREATEST_POWER = 4;
    /** What "far faster" is to mean. */
    private static final double FAR = 1.5;

    private final StudyResults results;

    ActivationClaims(StudyResults results) {
        this.results = results;
    }

    List<Claim> in(Water water) {
        List<Claim> claims = new ArrayList<>();
        faster(claims, water);
        backwards(claims, "the same with 1 − Δφ swims backwards", water, false);
        inVacuum(claims, water);
        backwards(claims, "and in vacuum backwards with 1 − Δφ", water, true);
        twoClusters(claims, water);
        return claims;
    }

    private Sample speed(int creature, double power, int step, Water water, boolean vacuum) {
        return results.measurements().forward(results.catalogue().potentiated(creature, power, ExperimentCatalogue.PHASE_STEPS.get(step), water,
                vacuum));
    }

    private void faster(List<Claim> claims, Water water) {
        judge(claims, "potentiation (p = 4) swims far faster than the sine (p = 1)", water, creature -> {
            Sample sine = speed(creature, 1, 0, water, false);
            Sample powered = speed(creature, GREATEST_POWER, 0, water, false);
            return new Test(sine, powered, powered.mean() > FAR * Math.max(sine.mean(), 0) && powered.mean() > SURE * powered.standardError());
        });
    }

    private void backwards(List<Claim> claims, String says, Water water, boolean vacuum) {
        judge(claims, says, water, creature -> {
            Sample ahead = speed(creature, GREATEST_POWER, 0, water, vacuum);
            Sample back = speed(creature, GREATEST_POWER, 1, water, vacuum);
            return vacuum && Math.max(Math.abs(ahead.mean()), Math.abs(back.mean())) < STILL ? null
                    : new Test(ahead, back, ahead.mean() * back.mean() < 0 && Math.abs(back.mean()) > SURE * back.standardError()
                    && Math.abs(ahead.mean()) > SURE * ahead.standardError());
        });
    }

    private void inVacuum(List<Claim> claims, Water water) {
        judge(claims, "potentiation (p = 4) also accelerates in vacuum", water, creature -> {
            Sample sine = speed(creature, 1, 0, water, true);
            Sample powered = speed(creature, GREATEST_POWER, 0, water, true);
            return new Test(sine, powered, Math.abs(powered.mean()) > STILL);
        });
    }

    /** Two speeds, and whether they bear a claim out. */
    private record Test(Sample first, Sample second, boolean holds) {
    }

    /** Tests a claim by creatures 1 and 2. */
    private interface Tester {
        Test of(int creature);
    }

    private static void judge(List<Claim> claims, String says, Water water, Tester tester) {
        List<Claim.Outcome> outcomes = new ArrayList<>();
        List<String> texts = new ArrayList<>();
        for (int creature : List.of(1, 2)) {
            Test test = tester.of(creature);
            if (test != null && test.first.count() > 0 && test.second.count() > 0) {
                outcomes.add(Claim.Outcome.of(test.holds));
                texts.add("creature " + creature + ": " + TableFormat.shortNumber(test.first.mean()) + " and "
                        + TableFormat.shortNumber(test.second.mean()));
            }
        }
        claims.add(new Claim(says, water, texts.isEmpty() ? "nothing moves" : String.join("; ", texts),
                outcomes.isEmpty() ? Claim.Outcome.VOID : Claim.Outcome.of(outcomes)));
    }

    /** Whether the body of two clusters gets any further than the dead body drifts. */
    private void twoClusters(List<Claim> claims, Water water) {
        List<Gait> gaits = ExperimentCatalogue.gaitsOfTwoClusters();
        Sample resting = speed(gaits.get(0), water, ExperimentCatalogue.RESTING);
        List<Sample> swims = gaits.stream().map(gait -> speed(gait, water, ExperimentCatalogue.WATER)).filter(one -> one.count() > 0).toList();
        if (resting.count() == 0 || swims.isEmpty()) {
            return;
        }
        Sample best = swims.stream().max(Comparator.comparingDouble(Sample::mean)).orElseThrow();
        double net = best.mean() - resting.mean();
        boolean moves = net > SURE * Math.hypot(best.standardError(), resting.standardError()) && net > STILL;
        claims.add(new Claim("a body of two clusters does not swim", water, "at most " + TableFormat.number(net)
                + " more than at rest, by the best of " + swims.size() + " gaits", Claim.Outcome.of(!moves)));
    }

    private Sample speed(Gait gait, Water water, String setting) {
        return results.measurements().forward(results.catalogue().twoClusters(gait, water, setting));
    }
}
