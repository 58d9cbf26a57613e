package io.natator.cli;

import io.natator.cache.EvaluationCache;
import io.natator.cli.Section.Topic;
import io.natator.config.Backend;
import io.natator.config.ExecutionSettings;
import picocli.CommandLine.Option;

/** Options that say how evaluations are carried out, and whether results of earlier runs are used. */
@Section(Topic.COMPUTING)
final class CachedExecutionOptions extends ExecutionOptions {

    @Option(names = "--no-cache",
            description = "Evaluate everything anew. Otherwise results of earlier evaluations are "
                    + "used, which are the same; from ~/.cache/natator/evaluations ($NATATOR_CACHE/evaluations).")
    private boolean off;

    @Override
    ExecutionSettings execution(Backend otherwise) throws InterruptedException {
        ExecutionSettings execution = super.execution(otherwise);
        return off ? execution : execution.withCache(EvaluationCache.ofUser());
    }
}
