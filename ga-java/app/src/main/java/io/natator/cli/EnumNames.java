package io.natator.cli;

import java.util.Arrays;
import java.util.List;
import java.util.Locale;
import picocli.CommandLine;
import picocli.CommandLine.ITypeConverter;
import picocli.CommandLine.Model.ArgSpec;
import picocli.CommandLine.TypeConversionException;

/** Names of enum constants as the user writes and reads them: lower case with hyphens, as in the files of a run. */
final class EnumNames {

    private EnumNames() {
    }

    /** Makes all arguments of a command, and of those below it, take such names in either case. */
    static void install(CommandLine command) {
        for (ArgSpec argument : command.getCommandSpec().args()) {
            Arrays.stream(
                    argument.typeInfo().isMultiValue() ? argument.auxiliaryTypes() : new Class<?>[] {argument.type()})
                    .filter(Class::isEnum).forEach(type -> command.registerConverter(typed(type), converter(type)));
        }
        command.getSubcommands().values().forEach(EnumNames::install);
    }

    @SuppressWarnings("unchecked")
    private static Class<Object> typed(Class<?> type) {
        return (Class<Object>) type;
    }

    private static ITypeConverter<Object> converter(Class<?> type) {
        List<String> names = Arrays.stream(type.getEnumConstants()).map(one -> of((Enum<?>) one)).toList();
        return given -> {
            int index = names.indexOf(given.toLowerCase(Locale.ROOT));
            if (index < 0) {
                throw new TypeConversionException("expected " + choice(names) + " but was '" + given + "'");
            }
            return type.getEnumConstants()[index];
        };
    }

    /** {@code cma-es} of {@code CMA_ES}. */
    static String of(Enum<?> constant) {
        return constant.name().toLowerCase(Locale.ROOT).replace('_', '-');
    }

    /** {@code a}, {@code a or b}, {@code a, b or c}. */
    static String choice(List<String> names) {
        int last = names.size() - 1;
        return last < 1 ? String.join("", names) : String.join(", ", names.subList(0, last)) + " or " + names.get(last);
    }
}
