package io.natator.study.thesis;

import io.natator.encoding.Gait;

/**
 * A gait whose swimming is measured.
 *
 * @param name     unique in its water: {@code thesis/NAME} of a published gait, else the run folder that it evolved in
 * @param about    what it is, in words
 * @param creature of the thesis, 1 to 4
 * @param water    that it is for
 * @param seed     of the evolution that it won; 0 of a published gait
 */
record Subject(String name, String about, int creature, Water water, Gait gait, long seed) {

    /** A published gait in a water. */
    static Subject of(ThesisData.PublishedGait gait, Water water) {
        return new Subject("thesis/" + gait.name(), gait.about(), gait.creature(), water, gait.gait(), 0);
    }

    boolean isEvolved() {
        return seed > 0;
    }

    /** In tables. */
    String label() {
        return isEvolved() ? "evolved, seed " + seed : "thesis' gait" + (about.startsWith("as published") ? "" : ", " + about);
    }
}
