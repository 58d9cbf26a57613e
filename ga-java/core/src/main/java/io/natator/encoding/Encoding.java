package io.natator.encoding;

import java.util.List;

/**
 * Translates the genes of a chromosome into a gait (thesis 2.6). The order of the genes matters: single-point
 * crossover swaps a gene and all after it, so neighbouring genes are inherited together.
 */
public sealed interface Encoding permits DenseEncoding, SparseEncoding, WaveEncoding,
        SteeredEncoding {

    /** Names and ranges of the genes, in chromosome order. */
    List<GeneRange> genes();

    /**
     * The gait that these genes stand for.
     *
     * @param genes as many as {@link #genes()}, each within its range
     * @throws IllegalArgumentException if there are too few or too many, or one is outside its range
     */
    Gait decode(List<Double> genes);

    /** Fails unless the genes fit {@link #genes()}. */
    default void check(List<Double> genes) {
        GeneRange.check(genes(), genes);
    }
}
