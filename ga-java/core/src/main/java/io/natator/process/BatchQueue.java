package io.natator.process;

import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Deque;
import java.util.Iterator;
import java.util.List;
import java.util.concurrent.TimeUnit;

/**
 * Evaluations that wait to be computed together, shared out evenly among those that compute them. What one of them fails
 * at, another tries: if it succeeds there, the first was at fault, and who is at fault twice gets nothing more as long as
 * there are others. For several threads.
 */
final class BatchQueue {

    /** Most evaluations in a batch, what {@code serve} takes together. */
    private static final int MAX_BATCH = 1024;
    /** How long no more requests come before a batch is begun. */
    private static final long LULL = TimeUnit.MILLISECONDS.toNanos(3);
    private static final int MAX_FAULTS = 2;

    private final Deque<BatchJob> waiting = new ArrayDeque<>();
    private final Deque<Batch> returned = new ArrayDeque<>();
    private final List<Worker> workers = new ArrayList<>();
    private long lastAdded;

    /** One that computes batches. */
    static final class Worker {
        private boolean busy;
        private int faults;
    }

    /**
     * Evaluations to be computed together.
     *
     * @param failedAt who has tried in vain, or null
     */
    record Batch(List<BatchJob> jobs, Worker failedAt) {
    }

    /** Takes part from now on. */
    synchronized Worker join() {
        Worker worker = new Worker();
        workers.add(worker);
        return worker;
    }

    synchronized void add(List<BatchJob> jobs) {
        waiting.addAll(jobs);
        lastAdded = System.nanoTime();
        notifyAll();
    }

    /**
     * Waits for evaluations, then until no more come for a moment; the share of this worker, if others wait too.
     *
     * @return null if the worker gets no more, having failed where others did not
     */
    synchronized Batch take(Worker worker) throws InterruptedException {
        worker.busy = false;
        while (workers.contains(worker)) {
            Batch again = returnedFor(worker);
            if (again != null) {
                worker.busy = true;
                return again;
            }
            long lull = waiting.isEmpty() ? Long.MAX_VALUE : lastAdded + LULL - System.nanoTime();
            if (lull <= 0 || waiting.size() >= MAX_BATCH * workers.size()) {
                Batch share = share();
                worker.busy = true;
                return share;
            }
            TimeUnit.NANOSECONDS.timedWait(this, lull);
        }
        return null;
    }

    private Batch returnedFor(Worker worker) {
        for (Batch batch : returned) {
            if (batch.failedAt != worker || workers.size() == 1) {
                returned.remove(batch);
                return batch;
            }
        }
        return null;
    }

    /**
     * What is left for each that has nothing to do. It is dealt out like cards: evaluations that take alike long, such as a
     * gait's from its starts, stand together.
     */
    private Batch share() {
        int idle = (int) workers.stream().filter(worker -> !worker.busy).count();
        List<BatchJob> jobs = new ArrayList<>();
        Iterator<BatchJob> cards = waiting.iterator();
        for (int k = 0; cards.hasNext() && jobs.size() < MAX_BATCH; k++) {
            BatchJob job = cards.next();
            if (k % idle == 0) {
                jobs.add(job);
                cards.remove();
            }
        }
        return new Batch(jobs, null);
    }

    /**
     * Leaves what a worker failed at to the others.
     *
     * @return false if there are none
     */
    synchronized boolean handOver(List<BatchJob> jobs, Worker worker) {
        if (!hasOthers(worker)) {
            return false;
        }
        returned.add(new Batch(jobs, worker));
        notifyAll();
        return true;
    }

    /** Says that a batch which a worker failed at was no trouble elsewhere. */
    synchronized void blame(Worker worker) {
        if (++worker.faults >= MAX_FAULTS) {
            leave(worker);
        }
    }

    /**
     * Takes no more part.
     *
     * @return false if nobody else would be left, so that it must
     */
    synchronized boolean leave(Worker worker) {
        if (!hasOthers(worker)) {
            return false;
        }
        workers.remove(worker);
        notifyAll();
        return true;
    }

    private boolean hasOthers(Worker worker) {
        return workers.stream().anyMatch(each -> each != worker);
    }
}
