package io.natator.export;

/** Colours of clusters, from the head on, again from the first after the last; linear red, green and blue, 0 to 1. */
final class ClusterColours {

    private static final float[][] PALETTE = {{0.894f, 0.510f, 0.176f}, {0.839f, 0.278f, 0.302f},
        {0.741f, 0.290f, 0.573f}, {0.451f, 0.373f, 0.725f}, {0.984f, 0.737f, 0.294f}};

    private ClusterColours() {
    }

    /** The colour of a cluster; that of the first for a particle without one. */
    static float[] of(int cluster) {
        return PALETTE[Math.max(0, cluster) % PALETTE.length].clone();
    }
}
