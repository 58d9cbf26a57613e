package io.natator.spark;

import io.natator.config.ExecutionSettings;
import io.natator.process.ClusterEvaluators;
import io.natator.process.Evaluator;

/** Opens evaluators on the cluster of this program. */
public final class SparkEvaluators implements ClusterEvaluators {

    /** For the service loader. */
    public SparkEvaluators() {
    }

    @Override
    public Evaluator evaluator(ExecutionSettings execution) {
        return new SparkEvaluator(Cluster.of(execution), execution);
    }
}
