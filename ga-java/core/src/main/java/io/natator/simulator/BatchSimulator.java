package io.natator.simulator;

import io.natator.config.ExecutionSettings;
import io.natator.config.Json;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.concurrent.BlockingQueue;
import java.util.concurrent.LinkedBlockingQueue;
import java.util.concurrent.TimeUnit;
import java.util.function.Consumer;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * One native process that is given all evaluations that wait, for a backend that computes many together. Evaluations
 * that several threads ask for share a batch.
 *
 * <p>When the process fails, what it had not answered is tried again in two halves, so that an evaluation which ends
 * the process is found and fails alone, at its second attempt by itself.
 */
public final class BatchSimulator implements Evaluator {

    private static final Logger LOG = LoggerFactory.getLogger(BatchSimulator.class);
    /** Most evaluations in a batch, what {@code serve} takes together. */
    private static final int MOST = 1024;
    /** How long no more requests come before a batch is begun. */
    private static final long LULL_MILLISECONDS = 10;
    private static final long POLL_MILLISECONDS = 100;
    /** A GPU does at least so many evaluations in the time that one takes on a processor. */
    private static final int TOGETHER = 32;
    /** Failures without an answer between them after which the program is taken to be broken: two searches of 1024. */
    private static final int MOST_FAILURES = 24;

    private final ExecutionSettings settings;
    private final ServeCommands commands;
    private final ProcessGroup group = new ProcessGroup();
    private final BlockingQueue<Job> waiting = new LinkedBlockingQueue<>();
    private final Thread dispatcher = new Thread(this::dispatch, "batches");

    // Of the dispatcher alone.
    private ServeProcess process;
    private long numbers;
    private int failures;

    /** A request of a call, and where its result goes. */
    private record Job(SimulationRequest request, Call call) {

        void done(SimulationResult result) {
            call.replies.add(new Reply(result.withId(request.id()), null));
        }

        void rejected(RequestRejectedException reason) {
            call.replies.add(new Reply(null, reason));
        }
    }

    private record Reply(SimulationResult result, RequestRejectedException rejection) {
    }

    /** A call of {@link #evaluateAll}. */
    private static final class Call {
        private final BlockingQueue<Reply> replies = new LinkedBlockingQueue<>();
        private volatile boolean abandoned;
    }

    /**
     * A simulator whose process is started when it is needed.
     *
     * @param settings with a time limit, which is that of one evaluation
     */
    public BatchSimulator(ExecutionSettings settings) {
        this.settings = settings;
        this.commands = new ServeCommands(settings);
        dispatcher.setDaemon(true);
        dispatcher.start();
    }

    @Override
    public void evaluateAll(List<SimulationRequest> requests, Consumer<SimulationResult> whenDone)
            throws InterruptedException {
        Call call = new Call();
        try {
            requests.forEach(request -> waiting.add(new Job(request, call)));
            for (int i = 0; i < requests.size(); i++) {
                Reply reply = null;
                while (reply == null) {
                    group.failIfStopped();
                    reply = call.replies.poll(POLL_MILLISECONDS, TimeUnit.MILLISECONDS);
                }
                if (reply.rejection != null) {
                    throw reply.rejection;
                }
                whenDone.accept(reply.result);
            }
        } finally {
            call.abandoned = true;
        }
    }

    private void dispatch() {
        try {
            for (;;) {
                evaluate(takeBatch());
            }
        } catch (InterruptedException e) {
            // Closed.
        } finally {
            endProcess();
        }
    }

    /** Waits for a request, then takes all that come until none does for a moment. */
    private List<Job> takeBatch() throws InterruptedException {
        List<Job> batch = new ArrayList<>();
        for (Job job = waiting.take(); job != null; job = waiting.poll(LULL_MILLISECONDS, TimeUnit.MILLISECONDS)) {
            batch.add(job);
            waiting.drainTo(batch, MOST - batch.size());
            if (batch.size() == MOST) {
                break;
            }
        }
        return batch;
    }

    /** Evaluates a batch, and what a failure leaves of it in ever smaller parts. */
    private void evaluate(List<Job> batch) throws InterruptedException {
        List<Job> jobs = batch.stream().filter(job -> !job.call.abandoned).toList();
        if (jobs.isEmpty()) {
            return;
        }
        Map<Long, Job> open = new LinkedHashMap<>();
        try {
            attempt(jobs, open);
        } catch (SimulatorFailure e) {
            retry(List.copyOf(open.values()), e.getMessage());
        } catch (RequestRejectedException e) {
            endProcess();
            Set<Call> told = new HashSet<>();
            open.values().stream().filter(job -> told.add(job.call)).forEach(job -> job.rejected(e));
        }
    }

    private void retry(List<Job> open, String reason) throws InterruptedException {
        endProcess();
        group.failIfStopped();
        failures++;
        LOG.debug("batch, {} evaluations without an answer: {}", open.size(), reason);
        if (failures >= MOST_FAILURES) {
            open.forEach(job -> job.done(SimulationResult.failed(0, reason)));
        } else if (open.size() > 1) {
            evaluate(open.subList(0, open.size() / 2));
            evaluate(open.subList(open.size() / 2, open.size()));
        } else {
            evaluateAgain(open.get(0));
        }
    }

    /** The second attempt at an evaluation by itself. */
    private void evaluateAgain(Job job) throws InterruptedException {
        try {
            attempt(List.of(job), new LinkedHashMap<>());
        } catch (SimulatorFailure e) {
            endProcess();
            group.failIfStopped();
            failures++;
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
    private void attempt(List<Job> jobs, Map<Long, Job> open) throws SimulatorFailure, InterruptedException {
        StringBuilder lines = new StringBuilder();
        for (Job job : jobs) {
            open.put(++numbers, job);
            lines.append(Json.line(job.request.withId(numbers))).append('\n');
        }
        if (process != null && !process.isReady()) {
            endProcess();
        }
        if (process == null) {
            process = commands.start(group, null, jobs.get(0).request);
        }
        process.send(lines.toString());
        while (!open.isEmpty()) {
            long together = 1 + (open.size() - 1) / TOGETHER;
            SimulationResult result = process.receive(settings.timeout().multipliedBy(together).toNanos());
            Job job = result.id() == null ? null : open.remove(result.id());
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
                job.done(result);
            }
        }
    }

    private void endProcess() {
        if (process != null) {
            process.close();
            process = null;
        }
    }

    @Override
    public void close() {
        group.close();
        dispatcher.interrupt();
    }
}
