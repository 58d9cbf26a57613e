package io.natator.cli;

import java.util.Collection;
import java.util.Comparator;
import java.util.List;
import java.util.Locale;
import java.util.Map;

/** Which of the known names somebody probably meant. */
final class Closest {

    /** What others call it. */
    private static final Map<String, String> ALSO_CALLED = Map.of("gpu", "cuda", "gltf", "glb", "nsga-ii", "nsga2",
            "cmaes", "cma-es");

    private Closest() {
    }

    /** {@code ; did you mean evolve?}, or nothing if no name is near: begins so, or is other in a third of its letters. */
    static String hint(String given, Collection<String> known) {
        String small = given.toLowerCase(Locale.ROOT);
        String meant = ALSO_CALLED.get(small);
        if (meant != null && known.contains(meant)) {
            return "; did you mean " + meant + "?";
        }
        return known.stream().filter(name -> isNear(small, name))
                .min(Comparator.comparingInt(name -> distance(small, name)))
                .map(name -> "; did you mean " + name + "?").orElse("");
    }

    /** The same hint for scenes, compared by the last part of their names; at most three that are equally near. */
    static String scenes(String given, Collection<String> known) {
        String small = given.toLowerCase(Locale.ROOT);
        List<String> near = known.stream().filter(name -> isNear(last(small), last(name)) || isNear(small, name))
                .sorted(Comparator.comparingInt((String name) -> distance(last(small), last(name)))
                        .thenComparingInt(name -> distance(small, name)))
                .toList();
        return near.isEmpty() ? "" : "; did you mean " + EnumNames.choice(near.stream()
                .filter(name -> distance(last(small), last(name)) == distance(last(small), last(near.get(0)))).limit(3)
                .toList()) + "?";
    }

    private static String last(String scene) {
        return scene.substring(scene.lastIndexOf('/') + 1);
    }

    private static boolean isNear(String given, String name) {
        boolean begins = name.startsWith(given) && given.replace("-", "").length() > 1;
        return begins || 3 * distance(given, name) <= Math.max(name.length(), 3);
    }

    /** Letters to insert, remove or change to get from one word to the other (Levenshtein 1966). */
    private static int distance(String from, String to) {
        int[] row = new int[to.length() + 1];
        for (int j = 0; j <= to.length(); j++) {
            row[j] = j;
        }
        for (int i = 1; i <= from.length(); i++) {
            int diagonal = row[0];
            row[0] = i;
            for (int j = 1; j <= to.length(); j++) {
                int changed = diagonal + (from.charAt(i - 1) == to.charAt(j - 1) ? 0 : 1);
                diagonal = row[j];
                row[j] = Math.min(changed, 1 + Math.min(row[j], row[j - 1]));
            }
        }
        return row[to.length()];
    }
}
