package io.natator.spark;

import com.fasterxml.jackson.core.JsonProcessingException;
import io.natator.base.Numbers;
import io.natator.base.Sha256;
import io.natator.config.Backend;
import io.natator.config.ExecutionSettings;
import io.natator.config.Json;
import io.natator.process.Evaluator;
import io.natator.process.ProcessEvaluator;
import io.natator.process.ProgramEnd;
import io.natator.process.ProgramInfo;
import io.natator.protocol.RequestRejectedException;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import io.natator.protocol.SimulationResult.Status;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.UUID;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.function.Consumer;

/**
 * Spreads evaluations over a cluster. A call is one action of Spark; results come as soon as a {@link Partitioner part} is done.
 * What an executor does not finish another one does again, with the same bits.
 */
final class SparkEvaluator implements Evaluator {

    /** Simulated time of the swim that executors are compared by, s. */
    private static final double SAMPLE = 0.05;
    private static final long POLL_MILLISECONDS = 100;

    private final Cluster cluster;
    private final ExecutionSettings execution;
    private final SceneFiles scenes;
    private final Partitioner parts = new Partitioner();
    /** Calls under way, which share the cluster evenly. */
    private final AtomicInteger calls = new AtomicInteger();
    private final String name = "natator-" + UUID.randomUUID();
    private ExecutorConfig config;
    private volatile boolean closed;

    /** An evaluator whose executors get the program when they first need it. */
    SparkEvaluator(Cluster cluster, ExecutionSettings execution) {
        this.cluster = cluster;
        this.execution = execution;
        this.scenes = new SceneFiles(cluster, execution.simulator());
    }

    @Override
    public void evaluateAll(List<SimulationRequest> requests, Consumer<SimulationResult> whenDone)
            throws InterruptedException {
        if (requests.isEmpty()) {
            return;
        }
        failIfClosed();
        if (cluster.isLost()) {
            throw new RequestRejectedException("the cluster is lost: Spark has ended the application", false);
        }
        ExecutorConfig known = missionFor(requests.get(0));
        int together = calls.incrementAndGet();
        try {
            evaluate(requests, Math.max(1, cluster.slots(execution.backend()) / together), known, whenDone);
        } finally {
            calls.decrementAndGet();
        }
    }

    /** With so many slots for this call. */
    private void evaluate(List<SimulationRequest> requests, int slots, ExecutorConfig given,
            Consumer<SimulationResult> whenDone)
            throws InterruptedException {
        Map<Long, List<SimulationRequest>> open = new HashMap<>();
        List<String> lines = new ArrayList<>();
        for (List<SimulationRequest> part : execution.backend() == Backend.CPU ? parts.of(requests, slots)
                : Partitioner.evenly(requests, cluster.slots(execution.backend()))) {
            List<SimulationRequest> sent = new ArrayList<>();
            for (SimulationRequest request : part) {
                sent.add(scenes.sent(request));
                open.put(request.id(), part);
            }
            lines.add(Json.line(sent));
        }
        carryOut(Numbers.count(requests.size(), "evaluation"), lines, given, line -> {
            PartitionResponse answer = read(line, PartitionResponse.class);
            List<SimulationRequest> part = null;
            for (SimulationResult result : answer.results()) {
                if (result.status() == Status.ERROR) {
                    throw new RequestRejectedException(result.error(), true);
                }
                part = open.remove(result.id());
                if (part == null) {
                    throw new IllegalStateException("result " + result.id() + " came twice, or was not asked for");
                }
                whenDone.accept(result);
            }
            if (part == null || answer.results().size() != part.size()) {
                throw new IllegalStateException(answer.results().size() + " results came of a part that has "
                        + (part == null ? "others" : part.size()));
            }
            parts.took(part, answer.seconds());
        });
    }

    private void carryOut(String what, List<String> lines, ExecutorConfig given, Consumer<String> whenDone)
            throws InterruptedException {
        try (ClusterJob job = new ClusterJob(cluster, name, what, lines, new Partition(Json.line(given)))) {
            for (int left = lines.size(); left > 0;) {
                failIfClosed();
                String line = job.next(POLL_MILLISECONDS, TimeUnit.MILLISECONDS);
                if (line != null) {
                    whenDone.accept(line);
                    left--;
                } else if (job.hasEnded() && !job.hasAnswers()) {
                    throw new IllegalStateException(left + " of " + lines.size() + " answers did not come");
                } else {
                    cluster.tellOfWaiting();
                }
            }
        } catch (ClusterJob.FailedException e) {
            failIfClosed();
            throw failure(e);
        }
    }

    /** Spark ends by itself when this program is told to, at the same time as the evolution. */
    private void failIfClosed() throws InterruptedException {
        if (closed || ProgramEnd.hasBegun()) {
            throw new InterruptedException("evaluations were stopped");
        }
    }

    /** What to tell the user: why executors refused, if they did. */
    private RequestRejectedException failure(ClusterJob.FailedException failed) {
        ExecutorLog.Refusal refusal = cluster.log().last();
        String text = cluster.isLost() ? "the cluster is lost: " + failed.getMessage()
                : refusal != null ? "no executor can do it; " + refusal.reason() : failed.getMessage();
        return new RequestRejectedException(text, !cluster.isLost() && refusal != null && refusal.differs());
    }

    /** What executors are told, found out once. */
    private synchronized ExecutorConfig missionFor(SimulationRequest request) throws InterruptedException {
        if (config == null) {
            boolean here = execution.backend() == Backend.CPU;
            SimulationRequest cut = request.withDuration(SAMPLE);
            String hash = here ? swim(cut) : null;
            ExecutorConfig first = new ExecutorConfig(cluster.send("natator-sim", execution.simulator()),
                    Sha256.of(execution.simulator()),
                    here ? ProgramInfo.of(execution.simulator()).instructionSet() : null, execution.backend(),
                    execution.device(), execution.timeout().toMillis(), here && hash == null ? null : scenes.sent(cut),
                    hash, null);
            config = here ? first : like(first);
        }
        return config;
    }

    /** The hash of the end of the swim on this machine; null if it has no end that others can be compared with. */
    private String swim(SimulationRequest sample) throws InterruptedException {
        try (ProcessEvaluator own = new ProcessEvaluator(execution)) {
            return own.evaluate(sample).hash();
        }
    }

    /** The configuration with the kind of the GPU that answers first. */
    private ExecutorConfig like(ExecutorConfig first) throws InterruptedException {
        List<ExecutorSimulator.Kind> kinds = new ArrayList<>();
        carryOut("a first swim", List.of(Json.line(List.of(first.sample()))), first,
                line -> kinds.add(read(line, ExecutorSimulator.Kind.class)));
        return first.like(kinds.get(0).hash(), kinds.get(0).gpu());
    }

    private static <T> T read(String line, Class<T> type) {
        try {
            return Json.parse(line, type);
        } catch (JsonProcessingException e) {
            throw new IllegalStateException("no answer of an executor: " + Json.reason(e), e);
        }
    }

    @Override
    public void close() {
        closed = true;
        cluster.cancel(name);
    }
}
