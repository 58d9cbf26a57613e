package io.natator.cli;

import io.natator.cache.EvaluationCache;
import io.natator.cli.Section.Topic;
import io.natator.config.ExecutionSettings;
import picocli.CommandLine.Option;

/** Whether results of earlier runs are used. */
@Section(Topic.COMPUTING)
final class CacheOptions {

    @Option(names = "--no-cache",
            description = "Evaluate everything anew. Otherwise results of earlier evaluations are "
                    + "used, which are the same; from ~/.cache/natator/evaluations ($NATATOR_CACHE/evaluations).")
    private boolean off;

    ExecutionSettings in(ExecutionSettings execution) {
        return off ? execution : execution.withCache(EvaluationCache.ofUser());
    }
}
