package io.natator.study.thesis;

import io.natator.config.Numbers;
import io.natator.config.Scheme;
import io.natator.study.Sample;
import java.math.BigDecimal;
import java.util.List;
import java.util.Locale;
import java.util.stream.Collectors;

/** Numbers as the tables show them. */
final class TableFormat {

    static final String NOTHING = "–";
    private static final int LONG = 4;
    private static final int SHORT = 2;

    private TableFormat() {
    }

    /** Mean ± standard deviation, or the one value that there is. */
    static String speed(Sample sample) {
        return sample.count() == 0 ? NOTHING : sample.hasSpread()
                ? withError(sample.mean(), sample.standardDeviation(), LONG)
                : number(sample.mean());
    }

    static String number(double value) {
        return rounded(value, LONG);
    }

    static String shortNumber(double value) {
        return rounded(value, SHORT);
    }

    /** A short number and its error bar, which is not rounded to nothing. */
    static String withError(double value, double error) {
        return withError(value, error, SHORT);
    }

    /** The error bar alone. */
    static String error(double error) {
        return Double.isFinite(error) ? Numbers.error(error, SHORT) : NOTHING;
    }

    private static String withError(double value, double error, int decimals) {
        return Double.isFinite(value) ? Numbers.withError(value, error, decimals) : NOTHING;
    }

    private static String rounded(double value, int decimals) {
        return Double.isFinite(value) ? Numbers.fixed(value, decimals) : NOTHING;
    }

    static String list(List<Double> values) {
        return values.stream().map(value -> String.format(Locale.ROOT, "%.3f", value)).collect(Collectors.joining(" "));
    }

    static String name(Scheme scheme) {
        return scheme.name().toLowerCase(Locale.ROOT);
    }

    /** A parameter's value: whole where it is, and no limit where it is as good as none. */
    static String value(double value) {
        return value >= 1e20 ? "none" : value == Math.rint(value) ? "" + (long) value : BigDecimal.valueOf(value).toPlainString();
    }
}
