package io.natator.study.thesis;

import io.natator.report.FirstScreen;
import io.natator.verdict.Measure;
import java.util.List;

/**
 * A conclusion beside what was measured.
 *
 * @param says     the conclusion
 * @param water    in which it was tested
 * @param measured the numbers
 * @param outcome  whether they bear it out
 * @param isOurs   whether it is not the thesis' but was found here
 */
record Claim(String says, Water water, String measured, Outcome outcome, boolean isOurs) {

    /** A conclusion of the thesis. */
    Claim(String says, Water water, String measured, Outcome outcome) {
        this(says, water, measured, outcome, false);
    }

    /** The same, as one that was found here. */
    Claim ours() {
        return new Claim("(found here) " + says, water, measured, outcome, true);
    }

    /** Whether a conclusion holds. */
    enum Outcome {
        /** For everything that was tested. */
        HOLDS("holds"),
        /** For nothing that was tested. */
        FAILS("does not hold"),
        /** For some of it, or too little to tell from chance. */
        OPEN("open"),
        /** What it speaks of does not exist here. */
        VOID("no such thing");

        private final String words;

        Outcome(String words) {
            this.words = words;
        }

        /** In tables, with the sign that is coloured. */
        String told() {
            Measure.Outcome sign = switch (this) {
                case HOLDS -> Measure.Outcome.HOLDS;
                case FAILS -> Measure.Outcome.FAILS;
                case OPEN, VOID -> Measure.Outcome.NOT_MEASURED;
            };
            return FirstScreen.SIGNS.get(sign) + " " + words;
        }

        /** Of a single test. */
        static Outcome of(boolean holds) {
            return holds ? HOLDS : FAILS;
        }

        /** Of several tests: what they agree on. */
        static Outcome of(List<Outcome> each) {
            return each.stream().distinct().count() == 1 ? each.get(0) : OPEN;
        }
    }
}
