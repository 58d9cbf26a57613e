package io.natator.study.thesis;

import io.natator.study.Sample;
import java.util.List;
import java.util.Locale;

/** How a speed goes as a parameter moves away from the value that it has in the thesis. */
record Trend(Sample usual, List<Sample> changed) {

    /** Differences are told from chance by so many standard errors, and from what does not matter by this share. */
    private static final double SURE = 2;
    private static final double SHARE = 0.1;
    /** A body that does not move by a tenth of what it did. */
    private static final double STANDS = 0.1;

    /** Whether all values are measured. */
    boolean isKnown() {
        return usual.count() > 1 && !changed.isEmpty() && changed.stream().allMatch(one -> one.count() > 0);
    }

    /** Whether there is a speed to be changed: forwards, and beyond chance. */
    boolean swims() {
        return usual.mean() > SURE * usual.standardError() && usual.mean() > 0;
    }

    /** Speed falls at the farthest value, and rises at none. */
    Claim.Outcome hinders() {
        boolean falls = differs(last(), -1);
        boolean rises = changed.stream().anyMatch(one -> differs(one, 1));
        return falls && !rises ? Claim.Outcome.HOLDS : falls ? Claim.Outcome.OPEN : Claim.Outcome.FAILS;
    }

    /** No value changes the speed by a tenth of it beyond chance; open where chance alone is larger. */
    Claim.Outcome makesNoDifference() {
        boolean changes = changed.stream().anyMatch(one -> differs(one, -1) || differs(one, 1));
        boolean tells = changed.stream().allMatch(one -> SURE * Math.hypot(one.standardError(), usual.standardError()) <= SHARE * usual.mean());
        return changes ? Claim.Outcome.FAILS : tells ? Claim.Outcome.HOLDS : Claim.Outcome.OPEN;
    }

    /** At the farthest value it hardly moves, in either direction. */
    Claim.Outcome stops() {
        return Claim.Outcome.of(Math.abs(last().mean()) < STANDS * usual.mean());
    }

    /** At the farthest value it is slower, but has half its speed or more. */
    Claim.Outcome slowsALittle() {
        return Claim.Outcome.of(differs(last(), -1) && last().mean() > usual.mean() / 2);
    }

    /** Beyond chance and by a tenth, upwards or downwards. */
    private boolean differs(Sample one, int direction) {
        double difference = direction * (one.mean() - usual.mean());
        return difference > SURE * Math.hypot(one.standardError(), usual.standardError()) && difference > SHARE * usual.mean();
    }

    private Sample last() {
        return changed.get(changed.size() - 1);
    }

    /** Speed at all values as a share of the usual, the farthest last: {@code 0.104: 102, 83, 41 %}. */
    String text() {
        StringBuilder text = new StringBuilder(TableFormat.shortNumber(usual.mean())).append(": ");
        for (int i = 0; i < changed.size(); i++) {
            text.append(i == 0 ? "" : ", ").append(String.format(Locale.ROOT, "%.0f", 100 * changed.get(i).mean() / usual.mean()));
        }
        return text.append(" %").toString();
    }
}
