package io.natator.process;

import io.natator.config.Json;
import io.natator.protocol.RequestRejectedException;
import io.natator.protocol.SimulationResult;
import io.natator.protocol.SimulatorFailure;
import java.time.Duration;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * One native process that computes batches. When it fails, what it had not answered is tried by another worker, or, where
 * there is none or that one fails too, again in two halves, so that an evaluation which ends the process is found and fails
 * alone, at its second attempt by itself. To be run by a thread of its own.
 */
final class BatchWorker implements Runnable {

    private static final Logger LOG = LoggerFactory.getLogger(BatchWorker.class);
    /** A GPU does at least so many evaluations in the time that one takes on a processor. */
    private static final int TOGETHER = 32;
    /** Failures without an answer between them after which the program is taken to be broken: two searches of 1024. */
    private static final int MAX_FAILURES = 24;

    private final BatchQueue queue;
    private final BatchQueue.Worker self;
    private final ServeCommands commands;
    private final ServeCommands.Command command;
    private final ProcessGroup group;
    private final Duration timeout;

    private ServeProcess process;
    private long numbers;
    private int failures;
    private boolean hasAnswered;

    /**
     * A worker whose process is started when it is needed.
     *
     * @param command which starts it
     * @param group   to which it belongs
     * @param timeout of one evaluation
     */
    BatchWorker(BatchQueue queue, ServeCommands commands, ServeCommands.Command command, ProcessGroup group,
            Duration timeout) {
        this.queue = queue;
        this.self = queue.join();
        this.commands = commands;
        this.command = command;
        this.group = group;
        this.timeout = timeout;
    }

    @Override
    public void run() {
        try {
            for (BatchQueue.Batch batch = queue.take(self); batch != null; batch = queue.take(self)) {
                begin(batch);
            }
            LOG.warn("{} gets no more work: it failed where others did not", command);
        } catch (InterruptedException e) {
            // Closed.
        } finally {
            endProcess();
        }
    }

    private void begin(BatchQueue.Batch batch) throws InterruptedException {
        List<BatchJob> jobs = batch.jobs().stream().filter(job -> !job.isAbandoned()).toList();
        boolean first = batch.failedAt() == null;
        if (evaluate(jobs, first) && !first && !jobs.isEmpty()) {
            queue.blame(batch.failedAt());
        }
    }

    /**
     * Evaluates jobs, and what a failure leaves of them in ever smaller parts.
     *
     * @param elsewhere whether another worker is to try first what is left
     * @return whether there was no failure
     */
    private boolean evaluate(List<BatchJob> jobs, boolean elsewhere) throws InterruptedException {
        if (jobs.isEmpty()) {
            return true;
        }
        Map<Long, BatchJob> open = new LinkedHashMap<>();
        try {
            attempt(jobs, open);
            return true;
        } catch (SimulatorFailure e) {
            endAfterFailure();
            List<BatchJob> left = List.copyOf(open.values());
            LOG.debug("{}: {} evaluations without an answer: {}", command, left.size(), e.getMessage());
            if (!elsewhere || !queue.handOver(left, self)) {
                retry(left, e.getMessage());
            }
        } catch (RequestRejectedException e) {
            endProcess();
            List<BatchJob> left = List.copyOf(open.values());
            if (!isLost(e) || !queue.handOver(left, self)) {
                Set<BatchJob.Call> told = new HashSet<>();
                left.stream().filter(job -> told.add(job.call())).forEach(job -> job.rejected(e));
            }
        }
        return false;
    }

    /** Whether a device that has worked is there no more, and others are. */
    private boolean isLost(RequestRejectedException reason) {
        return hasAnswered && !reason.isBadInput() && queue.leave(self);
    }

    private void retry(List<BatchJob> open, String reason) throws InterruptedException {
        if (failures >= MAX_FAILURES) {
            open.forEach(job -> job.done(SimulationResult.failed(0, reason)));
        } else if (open.size() > 1) {
            evaluate(open.subList(0, open.size() / 2), false);
            evaluate(open.subList(open.size() / 2, open.size()), false);
        } else {
            evaluateAgain(open.get(0));
        }
    }

    /** The second attempt at an evaluation by itself. */
    private void evaluateAgain(BatchJob job) throws InterruptedException {
        try {
            attempt(List.of(job), new LinkedHashMap<>());
        } catch (SimulatorFailure e) {
            endAfterFailure();
            job.done(SimulationResult.failed(0, e.getMessage()));
        } catch (RequestRejectedException e) {
            job.rejected(e);
        }
    }

    /**
     * Sends jobs and hands out their results.
     *
     * @param open holds afterwards the jobs without a result, by the number that they were sent under
     */
    private void attempt(List<BatchJob> jobs, Map<Long, BatchJob> open) throws SimulatorFailure, InterruptedException {
        StringBuilder lines = new StringBuilder();
        for (BatchJob job : jobs) {
            open.put(++numbers, job);
            lines.append(Json.line(job.request().withId(numbers))).append('\n');
        }
        if (process != null && !process.isReady()) {
            endProcess();
        }
        if (process == null) {
            process = commands.start(group, command, jobs.get(0).request());
        }
        process.send(lines.toString());
        while (!open.isEmpty()) {
            long together = 1 + (open.size() - 1) / TOGETHER;
            SimulationResult result = process.receive(timeout.multipliedBy(together).toNanos());
            BatchJob job = result.id() == null ? null : open.remove(result.id());
            if (result.status() == SimulationResult.Status.ERROR) {
                RequestRejectedException rejection = new RequestRejectedException(result.error(), true);
                if (job == null) {
                    throw rejection;
                }
                job.rejected(rejection);
            } else if (job == null) {
                throw new SimulatorFailure("no valid result: id " + result.id() + " was not asked for");
            } else {
                failures = 0;
                hasAnswered = true;
                job.done(result);
            }
        }
    }

    private void endAfterFailure() throws InterruptedException {
        endProcess();
        group.failIfStopped();
        failures++;
    }

    private void endProcess() {
        if (process != null) {
            process.close();
            process = null;
        }
    }
}
