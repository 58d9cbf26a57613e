package io.natator.cli;

import io.natator.config.EvolutionSettings;
import io.natator.config.Json;
import io.natator.config.OptimizerKind;
import java.util.Arrays;
import java.util.Locale;
import java.util.stream.Collectors;
import picocli.CommandLine.ITypeConverter;
import picocli.CommandLine.TypeConversionException;

/** Reads an optimizer's name as it is written in {@code config.json}, so with the hyphen of cma-es. */
final class OptimizerName implements ITypeConverter<OptimizerKind> {

    @Override
    public OptimizerKind convert(String given) {
        return Arrays.stream(OptimizerKind.values()).filter(kind -> name(kind).equals(given.toLowerCase(Locale.ROOT)))
                .findFirst().orElseThrow(() -> new TypeConversionException("expected one of "
                        + Arrays.stream(OptimizerKind.values()).map(OptimizerName::name)
                                .collect(Collectors.joining(", ")) + " but was '" + given + "'"));
    }

    /** With the operators of JGAP, for people. */
    static String of(EvolutionSettings settings) {
        return name(settings.optimizer()) + (settings.optimizer() == OptimizerKind.JGAP
                ? " (" + settings.operators().name().toLowerCase(Locale.ROOT) + " operators)" : "");
    }

    private static String name(OptimizerKind kind) {
        return Json.line(kind).replace("\"", "");
    }
}
