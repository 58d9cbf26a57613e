package io.natator.study;

/** Over which time, from the end of settling, a mean speed is taken. */
enum Interval {
    /** 0 to 2 s. */
    TWO_SECONDS(2, "v_0_2"),
    /** 0 to 4 s, the time of an evaluation in the thesis (2.6). */
    FOUR_SECONDS(4, "v_0_4");

    private final double duration;
    private final String flexColumn;

    Interval(double duration, String flexColumn) {
        this.duration = duration;
        this.flexColumn = flexColumn;
    }

    /** Length in seconds. */
    double duration() {
        return duration;
    }

    /** Name of the column that holds the measured speed. */
    String flexColumn() {
        return flexColumn;
    }

    /** As shown: {@code 0–4 s}. */
    String label() {
        return "0–" + Math.round(duration) + " s";
    }
}
