package io.natator.process;

import io.natator.base.InvalidInputException;
import io.natator.config.ExecutionSettings;
import java.util.ServiceLoader;

/** What opens evaluators of mode spark: a service, so that this module needs nothing of Apache Spark. */
public interface ClusterEvaluators {

    /**
     * An evaluator whose evaluations are carried out by the executors of a cluster.
     *
     * @param execution in mode spark, with a time limit
     * @throws InvalidInputException if the cluster is not to be had
     */
    Evaluator evaluator(ExecutionSettings execution);

    /** Opens an evaluator by the module for Spark, if this program has it. */
    static Evaluator open(ExecutionSettings execution) {
        return ServiceLoader.load(ClusterEvaluators.class, ClusterEvaluators.class.getClassLoader()).findFirst()
                .orElseThrow(() -> new InvalidInputException("this program has no simulator mode spark; expected "
                        + "natator-spark.jar, started by spark-submit (ga-java/docs/cluster.md)"))
                .evaluator(execution);
    }
}
