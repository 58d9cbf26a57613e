package io.natator.base;

import java.math.BigDecimal;
import java.math.MathContext;
import java.util.Locale;
import java.util.regex.Pattern;

/** Numbers for people, and from them. */
public final class Numbers {

    private static final Pattern DECIMAL = Pattern.compile("[+-]?(\\d+\\.?\\d*|\\.\\d+)([eE][+-]?\\d+)?");

    private static final int MORE_DECIMALS = 2;

    private static final int WORTH_DECIMALS = 4;
    private static final int WORTH_DIGITS = 3;

    private Numbers() {
    }

    /**
     * A number in decimal digits, with or without an exponent; not all that Java takes for one, such as {@code 0x1p3},
     * {@code 1f} and {@code NaN}.
     *
     * @throws NumberFormatException if it is none
     */
    public static double parse(String text) {
        if (!DECIMAL.matcher(text).matches()) {
            throw new NumberFormatException(text);
        }
        return Double.parseDouble(text);
    }

    /** With so many decimals; what rounds to nothing has no sign. */
    public static String fixed(double value, int decimals) {
        String text = String.format(Locale.ROOT, "%." + decimals + "f", value);
        return text.matches("-0(\\.0*)?") ? text.substring(1) : text;
    }

    /**
     * A value and its error bar, with so many decimals, or with up to two more where that error would round to nothing: an error
     * of 0 says that a number is exact.
     */
    public static String withError(double value, double error, int decimals) {
        return fixed(value, decimalsOf(error, decimals)) + " " + error(error, decimals);
    }

    /** The error bar alone, as {@link #withError} has it. */
    public static String error(double error, int decimals) {
        return "± " + fixed(error, decimalsOf(error, decimals));
    }

    private static int decimalsOf(double error, int decimals) {
        int enough = decimals;
        while (enough < decimals + MORE_DECIMALS && roundsToNothing(error, enough)) {
            enough++;
        }
        return roundsToNothing(error, enough) ? decimals : enough;
    }

    private static boolean roundsToNothing(double error, int decimals) {
        return Math.abs(error) < 0.5 * Math.pow(10, -decimals);
    }

    /** What a gait is worth: with four decimals, or as many as show three digits of what is less than 0.001, such as an efficiency. */
    public static String worth(double value) {
        return fixed(value, worthDecimals(value));
    }

    /** The decimals that {@link #worth} shows of a value; of several they are those of the one that is furthest from 0. */
    public static int worthDecimals(double value) {
        double size = Math.abs(value);
        return size == 0 || size >= Math.pow(10, 1 - WORTH_DECIMALS) ? WORTH_DECIMALS
                : WORTH_DIGITS - 1 - (int) Math.floor(Math.log10(size));
    }

    /** So many of what a word stands for that has its plural by an s: 1 gait, 2 gaits. */
    public static String count(long count, String one) {
        return count + " " + one + (count == 1 ? "" : "s");
    }

    /** With so many digits, never in powers of ten; a finite number. */
    public static String significant(double value, int digits) {
        return BigDecimal.valueOf(value).round(new MathContext(digits)).stripTrailingZeros().toPlainString();
    }
}
