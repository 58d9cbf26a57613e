package io.natator.cli;

import java.util.Collection;
import java.util.Comparator;
import java.util.Locale;

/** Which of the known names somebody probably meant. */
final class Closest {

    private Closest() {
    }

    /** {@code ; did you mean evolve?}, or nothing if no name is near: begins so, or is other in a third of its letters. */
    static String hint(String given, Collection<String> known) {
        String small = given.toLowerCase(Locale.ROOT);
        return known.stream().filter(name -> isNear(small, name))
                .min(Comparator.comparingInt(name -> distance(small, name)))
                .map(name -> "; did you mean " + name + "?").orElse("");
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
