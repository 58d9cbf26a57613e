package io.natator.spark;

import java.io.Serializable;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.BlockingQueue;
import java.util.concurrent.LinkedBlockingQueue;
import java.util.concurrent.TimeUnit;
import java.util.stream.IntStream;
import org.apache.spark.SimpleFutureAction;
import org.apache.spark.SparkContext;
import org.apache.spark.rdd.RDD;
import scala.collection.Iterator;
import scala.collection.immutable.Seq;
import scala.jdk.javaapi.CollectionConverters;
import scala.runtime.AbstractFunction0;
import scala.runtime.AbstractFunction1;
import scala.runtime.AbstractFunction2;
import scala.runtime.BoxedUnit;

/** An action under way, of whose parts each hands over its answer when it is done. Of parts done twice one counts. */
final class ClusterJob implements AutoCloseable {

    private final SimpleFutureAction<BoxedUnit> action;
    private final BlockingQueue<String> answers = new LinkedBlockingQueue<>();

    /** Spark gave the action up; the message says why, in one line. */
    static final class FailedException extends RuntimeException {

        private static final long serialVersionUID = 1L;

        FailedException(Throwable cause) {
            super(String.valueOf(cause.getMessage()).lines().findFirst().orElse(""), cause);
        }
    }

    /**
     * Begins.
     *
     * @param group of actions that can be cancelled together
     * @param what  it does, for Spark's page
     * @param parts begun in this order
     * @param work  what is done with each
     */
    ClusterJob(Cluster cluster, String group, String what, List<String> parts, Partition work) {
        SparkContext context = cluster.context().sc();
        try {
            cluster.context().setJobGroup(group, what, true);
            // Several evolutions at once share the cluster evenly.
            context.setLocalProperty("spark.scheduler.pool", Thread.currentThread().getName());
            RDD<String> done = cluster.context().parallelize(parts, parts.size()).mapPartitions(work).rdd();
            Seq<Object> all = CollectionConverters
                    .asScala(IntStream.range(0, parts.size()).<Object>mapToObj(i -> i).toList()).toSeq();
            action = context.submitJob(done, new Collected(), all, new AbstractFunction2<>() {
                @Override
                public BoxedUnit apply(Object part, ArrayList<String> lines) {
                    answers.addAll(lines);
                    return BoxedUnit.UNIT;
                }
            }, new AbstractFunction0<>() {
                @Override
                public BoxedUnit apply() {
                    return BoxedUnit.UNIT;
                }
            });
        } catch (IllegalStateException e) {
            throw new FailedException(e);  // the context was stopped
        }
    }

    /** Takes the answer to a part; runs where it is. */
    private static final class Collected extends AbstractFunction1<Iterator<String>, ArrayList<String>>
            implements
                Serializable {

        private static final long serialVersionUID = 1L;

        @Override
        public ArrayList<String> apply(Iterator<String> lines) {
            ArrayList<String> all = new ArrayList<>();
            while (lines.hasNext()) {
                all.add(lines.next());
            }
            return all;
        }
    }

    /** Whether there are answers that were not taken. */
    boolean hasAnswers() {
        return !answers.isEmpty();
    }

    /** The next answer, or null if there is none in that time. */
    String next(long time, TimeUnit unit) throws InterruptedException {
        return answers.poll(time, unit);
    }

    /**
     * Whether no more answers will come than there are.
     *
     * @throws FailedException if the action failed
     */
    boolean hasEnded() {
        if (!action.isCompleted()) {
            return false;
        }
        if (action.value().get().isFailure()) {
            throw new FailedException(action.value().get().failed().get());
        }
        return true;
    }

    /** Gives up what is not done. */
    @Override
    public void close() {
        if (!action.isCompleted()) {
            action.cancel();
        }
    }
}
