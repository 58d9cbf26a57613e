package io.natator.spark;

import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import org.apache.spark.ExceptionFailure;
import org.apache.spark.scheduler.SparkListener;
import org.apache.spark.scheduler.SparkListenerExecutorRemoved;
import org.apache.spark.scheduler.SparkListenerTaskEnd;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/** Tells of executors that are lost or unfit, of each reason in one line, and remembers why the last one was unfit. */
final class ExecutorLog extends SparkListener {

    private static final Logger LOG = LoggerFactory.getLogger(ExecutorLog.class);

    private final Set<String> told = ConcurrentHashMap.newKeySet();
    private final Set<String> lost = ConcurrentHashMap.newKeySet();
    private volatile Refusal last;

    /**
     * Why an executor got no more work.
     *
     * @param reason   with the executor and its machine
     * @param differs whether it was the executor itself that said so
     */
    record Refusal(String reason, boolean differs) {
    }

    /** The last one, or null. */
    Refusal last() {
        return last;
    }

    @Override
    public void onTaskEnd(SparkListenerTaskEnd end) {
        if (end.reason() instanceof ExceptionFailure failure) {
            boolean differs = failure.className().equals(UnfitExecutorException.class.getName());
            String reason = "executor " + end.taskInfo().executorId() + " on " + end.taskInfo().host() + ": "
                    + (differs ? "" : failure.className() + ": ") + failure.description();
            last = new Refusal(reason, differs);
            if (told.add(reason)) {
                LOG.error("{}; it gets no more work, others do its evaluations", reason);
            }
        }
    }

    @Override
    public void onExecutorRemoved(SparkListenerExecutorRemoved removed) {
        if (lost.add(removed.executorId()) && told.add(removed.reason())) {
            LOG.error("executor {} is lost: {}; others do its evaluations", removed.executorId(), removed.reason());
        }
    }
}
