package io.natator.study.thesis;

import io.natator.flow.FlowField;
import io.natator.kinematics.FishMode;
import io.natator.report.Recording;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Optional;
import java.util.stream.IntStream;

/** What the thesis says of how its creatures swim (chapter 3), by the best that evolved. */
final class MotionClaims {

    private static final double STRAIGHT = 30;
    private static final double EEL_SWING = 0.1;
    /** Of a body that folds up, the tail's swing is not measured. */
    private static final double LEAST_PART = 0.8;

    private final StudyResults results;
    private final Map<String, Recording> recordings;

    MotionClaims(StudyResults results, Map<String, Recording> recordings) {
        this.results = results;
        this.recordings = recordings;
    }

    List<Claim> in(Water water) {
        List<Claim> claims = new ArrayList<>();
        List<Subject> best = IntStream.rangeClosed(1, 4).mapToObj(creature -> results.best(creature, water)).flatMap(Optional::stream).toList();
        if (best.isEmpty()) {
            return claims;
        }
        straight(claims, water, best);
        swing(claims, water, best);
        vortices(claims, water);
        fastest(claims, water, best);
        eel(claims, water);
        return claims;
    }

    private void straight(List<Claim> claims, Water water, List<Subject> best) {
        List<Claim.Outcome> outcomes = new ArrayList<>();
        List<String> texts = new ArrayList<>();
        for (Subject subject : best) {
            List<SwimKinematics> motions = results.motions(subject);
            if (!motions.isEmpty()) {
                double yaw = Math.toDegrees(motions.stream().mapToDouble(SwimKinematics::largestYaw).max().orElseThrow());
                double roll = Math.toDegrees(motions.stream().mapToDouble(one -> Math.abs(one.end().roll())).max().orElseThrow());
                outcomes.add(Claim.Outcome.of(yaw < STRAIGHT && roll < STRAIGHT));
                texts.add(String.format(Locale.ROOT, "%d: %.0f°, %.0f°", subject.creature(), yaw, roll));
            }
        }
        add(claims, "swimming is stable and straight", water, "largest yaw and roll at the end — ", texts, outcomes);
    }

    private void swing(List<Claim> claims, Water water, List<Subject> best) {
        List<Claim.Outcome> outcomes = new ArrayList<>();
        List<String> texts = new ArrayList<>();
        for (Subject subject : best) {
            List<SwimKinematics> motions = results.motions(subject);
            if (!motions.isEmpty()) {
                boolean isMeasured = motions.stream().allMatch(one -> one.measuredPart() >= LEAST_PART);
                double swing = motions.stream().mapToDouble(SwimKinematics::tailSwing).average().orElseThrow();
                texts.add(subject.creature() + ": " + (isMeasured ? TableFormat.shortNumber(swing) : "folds up"));
                if (isMeasured) {
                    outcomes.add(Claim.Outcome.of(swing > EEL_SWING));
                }
            }
        }
        add(claims, "amplitudes are wider than real fish'", water, "tail's swing in body lengths, an eel's is 0.1 — ", texts, outcomes);
    }

    private static void add(List<Claim> claims, String says, Water water, String about, List<String> texts, List<Claim.Outcome> outcomes) {
        if (!texts.isEmpty()) {
            claims.add(new Claim(says, water, about + String.join("; ", texts),
                    outcomes.isEmpty() ? Claim.Outcome.OPEN : Claim.Outcome.of(outcomes)));
        }
    }

    /** By the water about creature 2 halfway through its swim, seen from above. */
    private void vortices(List<Claim> claims, Water water) {
        Recording recording = recordings.get("creature-2-" + water.label());
        Optional<FlowField> above = recording == null ? Optional.empty() : recording.flow().stream().findFirst();
        above.map(Wake::of).ifPresent(wake -> {
            claims.add(new Claim("vortices appear at the tail", water, "mean vorticity at the tail "
                    + TableFormat.shortNumber(wake.tail()) + ", at the head " + TableFormat.shortNumber(wake.head()) + " 1/s",
                    Claim.Outcome.of(wake.tail() > 2 * wake.head())));
            claims.add(new Claim("and die out quickly", water, "at the tail " + TableFormat.shortNumber(wake.tail())
                    + ", half a length to a length behind it " + TableFormat.shortNumber(wake.behind()) + " 1/s",
                    Double.isNaN(wake.behind()) ? Claim.Outcome.OPEN : Claim.Outcome.of(wake.behind() < wake.tail() / 2)));
        });
    }

    /** Creature 1 beside the fastest other one: told from chance where neither error bar reaches the other's speed. */
    private void fastest(List<Claim> claims, Water water, List<Subject> best) {
        List<String> texts = new ArrayList<>();
        Speed one = null;
        Speed other = null;
        for (Subject subject : best) {
            Speed speed = results.speed(subject).orElseThrow();
            texts.add(subject.creature() + ": " + speed.text(1));
            if (subject.creature() == 1) {
                one = speed;
            } else if (other == null || speed.mean() > other.mean()) {
                other = speed;
            }
        }
        if (one != null && other != null) {
            double difference = one.mean() - other.mean();
            boolean told = Math.abs(difference) > Math.hypot(one.error(), other.error());
            claims.add(new Claim("creature 1 is the fastest", water, "units/s — " + String.join("; ", texts),
                    told ? Claim.Outcome.of(difference > 0) : Claim.Outcome.OPEN));
        }
    }

    private void eel(List<Claim> claims, Water water) {
        results.best(2, water).map(results::motions).filter(motions -> !motions.isEmpty()).ifPresent(motions -> {
            boolean isEel = StudyResults.like(motions, SwimKinematics::fitsOfBody).filter(FishMode.ANGUILLIFORM::equals).isPresent();
            claims.add(new Claim("creature 2 swims like an eel (e 0.0402, 0.12 of no motion's)", water,
                    "e as a share of no motion's — " + StudyResults.likeWhich(motions, SwimKinematics::fitsOfBody), Claim.Outcome.of(isEel)));
        });
    }
}
