package io.natator.cli;

import io.natator.base.Numbers;
import java.util.List;
import picocli.CommandLine;
import picocli.CommandLine.Model.ArgSpec;
import picocli.CommandLine.ParameterException;

/** Refuses what is no number where an argument is one: in this program's words, not by the name of a type. */
final class NumberValues {

    private static final List<Class<?>> WHOLE = List.of(int.class, Integer.class, long.class, Long.class);
    private static final List<Class<?>> ANY = List.of(double.class, Double.class);

    private NumberValues() {
    }

    /** Makes a command, and those below it, read numbers by this program's rules, not by Java's. */
    static void install(CommandLine command) {
        command.registerConverter(double.class, Numbers::parse).registerConverter(Double.class, Numbers::parse);
    }

    /** Whether the error is that a value is no such number as its argument is. */
    static boolean isNone(ParameterException error) {
        ArgSpec argument = error.getArgSpec();
        return argument != null && error.getValue() != null
                && (WHOLE.contains(type(argument)) || ANY.contains(type(argument)));
    }

    /** {@code --seed is x; expected a whole number}. */
    static String message(ParameterException error) {
        ArgSpec argument = error.getArgSpec();
        return error.getValue().isEmpty() ? EmptyValues.message(argument)
                : EmptyValues.name(argument) + " is " + error.getValue() + "; expected "
                        + expected(argument, error.getValue());
    }

    private static String expected(ArgSpec argument, String given) {
        if (ANY.contains(type(argument))) {
            return argument.paramLabel().equals("SECONDS") ? "a number of seconds" : "a number";
        }
        boolean isLong = type(argument) == long.class || type(argument) == Long.class;
        return "a whole number" + (!given.matches("[+-]?\\d+") ? ""
                : " from " + (isLong ? Long.MIN_VALUE + " to " + Long.MAX_VALUE
                        : Integer.MIN_VALUE + " to " + Integer.MAX_VALUE));
    }

    private static Class<?> type(ArgSpec argument) {
        return argument.typeInfo().isMultiValue() ? argument.auxiliaryTypes()[0] : argument.type();
    }
}
