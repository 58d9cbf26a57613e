package io.natator.study.thesis;

import io.natator.study.Sample;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Optional;
import java.util.function.Function;

/** What the thesis concludes from its parameter study (4.1), by all values and all gaits that swim. */
final class ParameterClaims {

    private final StudyResults results;

    ParameterClaims(StudyResults results) {
        this.results = results;
    }

    /** Those that can be tested in a water. */
    List<Claim> in(Water water) {
        List<Claim> claims = new ArrayList<>();
        above(claims, "cohesion hinders", water, Parameter.COHESION, Trend::hinders);
        above(claims, "surface tension hinders", water, Parameter.SURFACE_TENSION, Trend::hinders);
        Parameter viscosity = water == Water.FLEX ? Parameter.VISCOSITY : Parameter.KINEMATIC_VISCOSITY;
        below(claims, "viscosity helps: with less it swims worse", water, viscosity, Trend::hinders);
        above(claims, "too much viscosity hinders", water, viscosity, Trend::hinders);
        above(claims, "vorticity confinement makes no visible difference", water, Parameter.VORTICITY_CONFINEMENT, Trend::makesNoDifference);
        below(claims, "a body much lighter than the fluid cannot move", water, Parameter.BODY_MASS, Trend::stops);
        above(claims, "a larger radius hinders", water, water == Water.FLEX ? Parameter.RADIUS : Parameter.KERNEL_SUPPORT, Trend::hinders);
        above(claims, "damping slows a little in fluid", water, Parameter.DAMPING, Trend::slowsALittle);
        unstable(claims, "a small radius is unstable", water, Parameter.SMALL_RADIUS);
        unstable(claims, "few substeps are unstable", water, Parameter.SUBSTEPS);
        vacuum("damping strongly suppresses the motion in vacuum", water, Parameter.DAMPING).ifPresent(claims::add);
        vacuum("the motion in vacuum is the acceleration clamp", water, Parameter.MAX_ACCELERATION).map(Claim::ours).ifPresent(claims::add);
        return claims;
    }

    private void above(List<Claim> claims, String says, Water water, Parameter parameter, Function<Trend, Claim.Outcome> rule) {
        parameter.in(water).ifPresent(range -> judge(claims, says, water, parameter, range, range.above(), rule));
    }

    private void below(List<Claim> claims, String says, Water water, Parameter parameter, Function<Trend, Claim.Outcome> rule) {
        parameter.in(water).ifPresent(range -> {
            List<Double> values = new ArrayList<>(range.below());
            Collections.reverse(values);
            judge(claims, says, water, parameter, range, values, rule);
        });
    }

    /** By each gait that swims; one that does not tells nothing of what hinders swimming. */
    private void judge(List<Claim> claims, String says, Water water, Parameter parameter, Parameter.Range range, List<Double> values,
            Function<Trend, Claim.Outcome> rule) {
        List<Claim.Outcome> outcomes = new ArrayList<>();
        List<String> texts = new ArrayList<>();
        for (Subject subject : results.studied(water)) {
            Trend trend = new Trend(forward(subject, parameter, range.standard(), false),
                    values.stream().map(value -> forward(subject, parameter, value, false)).toList());
            if (trend.isKnown() && trend.swims()) {
                outcomes.add(rule.apply(trend));
                texts.add(name(subject) + " " + trend.text());
            }
        }
        if (!outcomes.isEmpty()) {
            claims.add(new Claim(says, water, parameter.label() + " " + listed(values) + " — " + String.join("; ", texts),
                    Claim.Outcome.of(outcomes)));
        }
    }

    private static String listed(List<Double> values) {
        return String.join(", ", values.stream().map(TableFormat::value).toList());
    }

    /** In short. */
    static String name(Subject subject) {
        return "creature " + subject.creature() + (subject.isEvolved() ? " evolved" : "");
    }

    private Sample forward(Subject subject, Parameter parameter, double value, boolean vacuum) {
        return results.measurements().forward(results.catalogue().study(subject, parameter, value, vacuum));
    }

    /** Whether runs blow up at the lowest value. */
    private void unstable(List<Claim> claims, String says, Water water, Parameter parameter) {
        parameter.in(water).ifPresent(range -> {
            double least = range.values().get(0);
            long runs = 0;
            long unstable = 0;
            for (Subject subject : results.studied(water)) {
                Experiment experiment = results.catalogue().study(subject, parameter, least, false);
                runs += results.measurements().results(experiment).size();
                unstable += results.measurements().unstable(experiment);
            }
            if (runs > 0) {
                claims.add(new Claim(says, water, parameter.label() + " " + TableFormat.value(least) + " — " + unstable + " of " + runs
                        + " runs blow up", unstable == runs ? Claim.Outcome.HOLDS : unstable == 0 ? Claim.Outcome.FAILS : Claim.Outcome.OPEN));
            }
        });
    }

    /** Whether the greatest value leaves a third of the motion in vacuum or less, of gaits that move there. */
    private Optional<Claim> vacuum(String says, Water water, Parameter parameter) {
        Optional<Parameter.Range> range = parameter.in(water).filter(one -> parameter.alsoInVacuum(water));
        if (range.isEmpty()) {
            return Optional.empty();
        }
        double greatest = range.get().values().get(range.get().values().size() - 1);
        List<Claim.Outcome> outcomes = new ArrayList<>();
        List<String> texts = new ArrayList<>();
        for (Subject subject : results.studied(water)) {
            Sample usual = forward(subject, parameter, range.get().standard(), true);
            Sample changed = forward(subject, parameter, greatest, true);
            if (usual.count() > 0 && changed.count() > 0 && Math.abs(usual.mean()) > ActivationClaims.STILL) {
                outcomes.add(Claim.Outcome.of(Math.abs(changed.mean()) < Math.abs(usual.mean()) / 3));
                texts.add(name(subject) + " " + TableFormat.shortNumber(usual.mean()) + " → " + TableFormat.shortNumber(changed.mean()));
            }
        }
        return Optional.of(new Claim(says, water, outcomes.isEmpty() ? "nothing moves" : parameter.label() + " " + TableFormat.value(greatest) + " — "
                + String.join("; ", texts), outcomes.isEmpty() ? Claim.Outcome.VOID : Claim.Outcome.of(outcomes)));
    }
}
