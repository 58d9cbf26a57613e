package io.natator.cache;

import io.natator.config.ExecutionSettings;
import io.natator.process.Evaluator;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.atomic.AtomicLong;
import java.util.function.Consumer;

/**
 * Looks in a cache before it asks another evaluator, and keeps what that finds as soon as it is there, so that nothing
 * is lost when a run is killed. The results are the same to the bit.
 */
public final class CachedEvaluator implements Evaluator {

    private final Evaluator evaluator;
    private final EvaluationCache cache;
    private final EvaluationKeys keys;
    private final AtomicLong found = new AtomicLong();

    private CachedEvaluator(Evaluator evaluator, EvaluationCache cache, EvaluationKeys keys) {
        this.evaluator = evaluator;
        this.cache = cache;
        this.keys = keys;
    }

    /**
     * Wraps an evaluator, which is closed with this one.
     *
     * @param execution how the evaluator works
     * @throws io.natator.protocol.RequestRejectedException if the simulator cannot be run
     */
    public CachedEvaluator(Evaluator evaluator, EvaluationCache cache, ExecutionSettings execution)
            throws InterruptedException {
        this(evaluator, cache, new EvaluationKeys(execution));
    }

    /** A view of this evaluator and cache with a count of its own; closing either closes the evaluator. */
    public CachedEvaluator counting() {
        return new CachedEvaluator(evaluator, cache, keys);
    }

    /** How many results came from the cache. */
    public long found() {
        return found.get();
    }

    @Override
    public void evaluateAll(List<SimulationRequest> requests, Consumer<SimulationResult> whenDone)
            throws InterruptedException {
        List<SimulationRequest> missing = new ArrayList<>();
        Map<Long, String> missed = new HashMap<>();
        for (SimulationRequest request : requests) {
            String key = keys.of(request);
            SimulationResult known = cache.find(key);
            if (known == null) {
                missing.add(request);
                missed.put(request.id(), key);
            } else {
                found.incrementAndGet();
                whenDone.accept(known.withId(request.id()));
            }
        }
        evaluator.evaluateAll(missing, result -> {
            if (result.status() == SimulationResult.Status.OK || result.status() == SimulationResult.Status.UNSTABLE) {
                cache.store(missed.get(result.id()), result.withId(0L));
            }
            whenDone.accept(result);
        });
    }

    @Override
    public void close() {
        evaluator.close();
    }
}
