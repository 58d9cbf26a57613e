package io.natator.study.optimizer;

import com.fasterxml.jackson.annotation.JsonProperty;
import java.util.List;

/**
 * A gait that led a run at some time, again from starts that had no part in choosing it; a line of {@code SCENE-again.jsonl}.
 *
 * @param optimizer label of the variant
 * @param seed      of the run
 * @param genes     of the gait, in the order of the encoding
 * @param runs      what each of the fresh runs was worth
 */
record FreshGait(@JsonProperty(required = true) String optimizer, @JsonProperty(required = true) long seed,
        @JsonProperty(required = true) List<Double> genes, @JsonProperty(required = true) List<Double> runs) {
}
