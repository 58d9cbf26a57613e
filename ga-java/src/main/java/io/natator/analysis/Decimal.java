package io.natator.analysis;

import java.util.Locale;

/** Numbers as they are printed. */
public final class Decimal {

    private Decimal() {
    }

    /** A number with so many digits after the point; what is rounded to 0 has no sign. */
    public static String of(double value, int digits) {
        return String.format(Locale.ROOT, "%." + digits + "f", value).replaceFirst("^-(0\\.?0*)$", "$1");
    }
}
