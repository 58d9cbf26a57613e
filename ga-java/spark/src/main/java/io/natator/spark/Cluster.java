package io.natator.spark;

import io.natator.base.InvalidInputException;
import io.natator.base.Sha256;
import io.natator.config.Backend;
import io.natator.config.ExecutionSettings;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.HashSet;
import java.util.Map;
import java.util.Set;
import org.apache.spark.SparkConf;
import org.apache.spark.api.java.JavaSparkContext;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/** The cluster that this program uses, one for all evaluators: Spark allows one context in a virtual machine. */
final class Cluster {

    private static final Logger LOG = LoggerFactory.getLogger(Cluster.class);
    private static final long PATIENCE_NANOSECONDS = 30_000_000_000L;
    private static final String GPUS = "spark.executor.resource.gpu.amount";

    /**
     * What evaluations ask of Spark, where the user does not say otherwise. An executor that is unfit gets no more work; the
     * machine that it is on may have others, and one that was killed says nothing about the machine.
     */
    private static final Map<String, String> SETTINGS = Map.ofEntries(
            Map.entry("spark.app.name", "natator"),
            Map.entry("spark.log.level", "ERROR"),  // failed tasks are told of in one line each, see ExecutorLog
            Map.entry("spark.scheduler.mode", "FAIR"), Map.entry("spark.locality.wait", "0"),
            Map.entry("spark.ui.showConsoleProgress", "false"), Map.entry("spark.task.maxFailures", "16"),
            Map.entry("spark.excludeOnFailure.enabled", "true"),
            Map.entry("spark.excludeOnFailure.task.maxTaskAttemptsPerExecutor", "1"),
            Map.entry("spark.excludeOnFailure.task.maxTaskAttemptsPerNode", "15"),
            Map.entry("spark.excludeOnFailure.stage.maxFailedTasksPerExecutor", "1"),
            Map.entry("spark.excludeOnFailure.stage.maxFailedExecutorsPerNode", "1000000"),
            Map.entry("spark.excludeOnFailure.application.maxFailedTasksPerExecutor", "1"),
            Map.entry("spark.excludeOnFailure.application.maxFailedExecutorsPerNode", "1000000"),
            Map.entry("spark.scheduler.excludeOnFailure.unschedulableTaskSetTimeout", "20s"),
            Map.entry("spark.speculation", "true"), Map.entry("spark.speculation.multiplier", "3"),
            Map.entry("spark.speculation.quantile", "0.9"), Map.entry("spark.speculation.minTaskRuntime", "10s"));

    private static Cluster present;

    private final JavaSparkContext context;
    private final ExecutorLog log = new ExecutorLog();
    private final Path folder;
    private final Set<String> files = new HashSet<>();
    private volatile long alone = System.nanoTime();
    private volatile boolean toldOfWaiting;

    private Cluster(JavaSparkContext context) throws IOException {
        this.context = context;
        this.folder = Files.createTempDirectory("natator-cluster");
        folder.toFile().deleteOnExit();
        context.sc().addSparkListener(log);
    }

    /**
     * The cluster that the settings name; all that this program opens must be on the same one.
     *
     * @throws InvalidInputException if there is none, or another one is in use
     */
    static synchronized Cluster of(ExecutionSettings execution) {
        if (present == null || present.context.sc().isStopped()) {
            SparkConf settings = settings(execution);
            try {
                present = new Cluster(new JavaSparkContext(settings));
            } catch (IOException e) {
                throw new UncheckedIOException("cannot make a temporary folder: " + e.getMessage(), e);
            } catch (RuntimeException e) {
                throw refused(settings.get("spark.master"), e);
            }
        } else if (execution.master() != null && !execution.master().equals(present.context.master())) {
            throw new InvalidInputException("master is " + execution.master() + "; expected " + present.context.master()
                    + ", which this program uses already");
        }
        return present;
    }

    private static InvalidInputException refused(String master, Exception reason) {
        return new InvalidInputException("master is " + master + ", where no Spark application can be started: "
                + reason.getMessage(), reason);
    }

    private static SparkConf settings(ExecutionSettings execution) {
        SparkConf settings = new SparkConf();
        if (execution.master() != null) {
            settings.setMaster(execution.master());
        }
        if (!settings.contains("spark.master")) {
            throw new InvalidInputException("no Spark master; expected --master URL, as spark://host:7077 or local[4]");
        }
        SETTINGS.forEach(settings::setIfMissing);
        String instructionSet = System.getenv("NATATOR_ISA");
        if (instructionSet != null) {
            settings.setIfMissing("spark.executorEnv.NATATOR_ISA", instructionSet);
        }
        // Also of a few evaluations by themselves, that of a machine which hangs is begun again elsewhere.
        settings.setIfMissing("spark.speculation.task.duration.threshold", execution.timeout().toMillis() + "ms");
        if (execution.backend() == Backend.CUDA && settings.contains(GPUS)) {
            settings.setIfMissing("spark.task.resource.gpu.amount", "1");
        }
        return settings;
    }

    /** Ends the application, if there is one. */
    static synchronized void leave() {
        if (present != null) {
            present.context.stop();
            present = null;
        }
    }

    JavaSparkContext context() {
        return context;
    }

    ExecutorLog log() {
        return log;
    }

    /** Whether Spark has given up, as where the master is gone. */
    boolean isLost() {
        return context.sc().isStopped();
    }

    /** Ends the actions of a group. */
    void cancel(String group) {
        try {
            context.cancelJobGroup(group);
        } catch (IllegalStateException e) {
            // Spark has ended, and all actions with it.
        }
    }

    /**
     * Gives a file to all executors, those to come as well.
     *
     * @param kind the beginning of its name there
     * @return its name there, which has the digest of its content
     */
    String send(String kind, Path file) {
        String digest = Sha256.of(file);
        return send(SentFile.name(kind, digest), copy -> Files.copy(file, copy));
    }

    /** Gives a text to all executors, as a file. */
    String send(String kind, String text) {
        return send(SentFile.name(kind, Sha256.of(text)), copy -> Files.writeString(copy, text));
    }

    private synchronized String send(String name, Writer content) {
        if (files.add(name)) {
            Path copy = folder.resolve(name);
            try {
                content.write(copy);
            } catch (IOException e) {
                throw new UncheckedIOException("cannot write " + copy + ": " + e.getMessage(), e);
            }
            copy.toFile().deleteOnExit();
            context.addFile(copy.toString());
        }
        return name;
    }

    private interface Writer {
        void write(Path copy) throws IOException;
    }

    /** How many evaluations the cluster does at once now; with GPUs how many batches. */
    int slots(Backend backend) {
        if (backend != Backend.CUDA) {
            return Math.max(1, context.defaultParallelism());
        }
        return Math.max(1, executors()) * Math.max(1, context.getConf().getInt(GPUS, 1));
    }

    private int executors() {
        return context.sc().statusTracker().getExecutorInfos().length - (context.isLocal() ? 0 : 1);
    }

    /** Says once that nothing can happen yet, where it is so for long; Spark only warns, among much else. */
    void tellOfWaiting() {
        if (executors() > 0) {
            alone = System.nanoTime();
        } else if (System.nanoTime() - alone > PATIENCE_NANOSECONDS && !toldOfWaiting) {
            toldOfWaiting = true;
            LOG.error(
                    "no executor for {} s; are there workers at {} with enough free memory ({}, --executor-memory) and cores?",
                    PATIENCE_NANOSECONDS / 1_000_000_000, context.master(),
                    context.getConf().get("spark.executor.memory", "1g"));
        }
    }
}
