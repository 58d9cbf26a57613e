package io.natator.study.optimizer;

import io.natator.config.EvolutionSettings;
import io.natator.config.OperatorSet;
import io.natator.config.OptimizerKind;

/** What is compared. */
public enum OptimizerVariant {
    /** The thesis' genetic algorithm with JGAP's mistakes mended. */
    JGAP_CORRECTED("jgap-corrected", OptimizerKind.JGAP, OperatorSet.CORRECTED),
    /** The thesis' genetic algorithm as JGAP ships its operators. */
    JGAP_STOCK("jgap-stock", OptimizerKind.JGAP, OperatorSet.STOCK),
    /** Covariance matrix adaptation. */
    CMA_ES("cma-es", OptimizerKind.CMA_ES, OperatorSet.CORRECTED),
    /** Random search. */
    RANDOM("random", OptimizerKind.RANDOM, OperatorSet.CORRECTED);

    private final String label;
    private final OptimizerKind kind;
    private final OperatorSet operators;

    OptimizerVariant(String label, OptimizerKind kind, OperatorSet operators) {
        this.label = label;
        this.kind = kind;
        this.operators = operators;
    }

    /** Its name in folders, tables and pictures. */
    public String label() {
        return label;
    }

    /** Whether its generations have the size that suits covariance matrix adaptation. */
    boolean isCmaEs() {
        return kind == OptimizerKind.CMA_ES;
    }

    EvolutionSettings in(EvolutionSettings settings) {
        return settings.withOptimizer(kind, operators, settings.gaussianDeviation());
    }
}
