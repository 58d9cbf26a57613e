package io.natator.cli;

import io.natator.base.Numbers;
import java.math.BigInteger;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import picocli.CommandLine;
import picocli.CommandLine.Model.ArgSpec;
import picocli.CommandLine.TypeConversionException;

/** Numbers as the user writes them, by this program's rules; what is none is told without Java's names of types. */
final class NumberValues {

    private static final Pattern WHOLE = Pattern.compile("[+-]?[0-9]+");
    private static final Pattern LEAST = Pattern.compile("\\bfrom \\d+");

    private NumberValues() {
    }

    /** Makes all arguments of a command, and of those below it, take such numbers. */
    static void install(CommandLine command) {
        command.registerConverter(int.class, NumberValues::intOf).registerConverter(Integer.class, NumberValues::intOf)
                .registerConverter(long.class, NumberValues::longOf)
                .registerConverter(Long.class, NumberValues::longOf)
                .registerConverter(double.class, NumberValues::doubleOf)
                .registerConverter(Double.class, NumberValues::doubleOf);
    }

    /** What was wrong with a value, with the least number that the argument's description has instead of the type's. */
    static String withLeast(ArgSpec argument, String message) {
        Matcher least = LEAST.matcher(argument == null ? "" : String.join(" ", argument.description()));
        return least.find() ? message.replaceFirst("(?<=whole number )from -\\d+", least.group()) : message;
    }

    private static int intOf(String text) {
        return (int) whole(text, Integer.MIN_VALUE, Integer.MAX_VALUE);
    }

    private static long longOf(String text) {
        return whole(text, Long.MIN_VALUE, Long.MAX_VALUE);
    }

    private static long whole(String text, long least, long most) {
        if (!WHOLE.matcher(text).matches()) {
            throw refused("a whole number", text);
        }
        BigInteger value = new BigInteger(text);
        if (value.compareTo(BigInteger.valueOf(least)) < 0 || value.compareTo(BigInteger.valueOf(most)) > 0) {
            throw refused("a whole number from " + least + " to " + most, text);
        }
        return value.longValue();
    }

    private static double doubleOf(String text) {
        try {
            return Numbers.parse(text);
        } catch (NumberFormatException e) {
            throw refused("a number", text);
        }
    }

    private static TypeConversionException refused(String expected, String text) {
        return new TypeConversionException("expected " + expected + " but was '" + text + "'");
    }
}
