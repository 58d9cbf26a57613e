package io.natator.cli;

import io.natator.config.EvolutionSettings;
import io.natator.config.OptimizerKind;

/** An optimizer for people. */
final class OptimizerName {

    private OptimizerName() {
    }

    /** With the operators of JGAP. */
    static String of(EvolutionSettings settings) {
        return EnumNames.of(settings.search().optimizer()) + (settings.search().optimizer() == OptimizerKind.JGAP
                ? " (" + EnumNames.of(settings.search().operators()) + " operators)" : "");
    }
}
