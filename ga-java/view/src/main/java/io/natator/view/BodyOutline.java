package io.natator.view;

import io.natator.body.ProfileBody;
import io.natator.checkpoint.RunReader;
import java.util.ArrayList;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Set;

/**
 * How a body looks, to be drawn.
 *
 * @param label    whose it is
 * @param length   in scene units
 * @param sections [part of the length, height, width] from nose to tail, in scene units but the first
 * @param joints   in parts of the length
 */
record BodyOutline(String label, double length, List<double[]> sections, List<Double> joints) {

    /** Bodies of generations that are shown besides the scene's. */
    private static final int BODIES = 4;

    /** The scene's body, and the best of generations from the first to the last; null of a run that evolves gaits alone. */
    static List<BodyOutline> of(RunReader run, List<RunResponse.Best> bests) {
        if (run.settings().problem().evolve() == null) {
            return null;
        }
        ProfileBody scene = run.settings().problem().evolve().body();
        List<BodyOutline> outlines = new ArrayList<>(List.of(of("the scene's", scene)));
        Set<RunResponse.Best> shown = new LinkedHashSet<>();
        for (int i = 0; i < BODIES && !bests.isEmpty(); i++) {
            shown.add(bests.get((bests.size() - 1) * i / (BODIES - 1)));
        }
        shown.forEach(
                best -> outlines.add(of("best of generation " + best.generation(), scene.with(best.overrides()))));
        return outlines;
    }

    private static BodyOutline of(String label, ProfileBody body) {
        return new BodyOutline(label, body.length(), body.sections(), body.joints());
    }
}
