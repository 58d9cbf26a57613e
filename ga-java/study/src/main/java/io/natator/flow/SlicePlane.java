package io.natator.flow;

/** From where the fluid is looked at (thesis figures 3.5 and 3.6). */
public enum SlicePlane {
    /** From above: x to the right, z down. */
    ABOVE("from above", 0, 2, 1),
    /** From the right side: x to the right, y up. */
    SIDE("from the side", 0, 1, 2);

    private final String label;
    private final int across;
    private final int along;
    private final int through;

    SlicePlane(String label, int across, int along, int through) {
        this.label = label;
        this.across = across;
        this.along = along;
        this.through = through;
    }

    /** As shown in titles. */
    public String label() {
        return label;
    }

    /** Number of the axis that runs to the right: 0 for x. */
    int first() {
        return across;
    }

    /** Number of the other axis of the plane. */
    int second() {
        return along;
    }

    /** Number of the axis at right angles to the plane. */
    int depth() {
        return through;
    }
}
