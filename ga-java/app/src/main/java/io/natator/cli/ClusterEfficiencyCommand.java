package io.natator.cli;

import io.natator.cli.Section.Topic;
import io.natator.config.EncodingKind;
import io.natator.config.ExecutionSettings;
import io.natator.config.FileErrors;
import io.natator.config.InvalidInputException;
import io.natator.config.Limits;
import io.natator.file.GeneratedPage;
import io.natator.file.OutputFolder;
import io.natator.simulator.Evaluator;
import io.natator.simulator.SceneInfo;
import io.natator.simulator.TimeLimit;
import io.natator.study.cluster.Assumptions;
import io.natator.study.cluster.ClusterStudy;
import io.natator.study.cluster.EvaluationTimes;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.concurrent.Callable;
import picocli.CommandLine.Command;
import picocli.CommandLine.ExitCode;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

/** {@code natator cluster-efficiency}: how many executors are worth their while, by a simulation. */
@Command(name = "cluster-efficiency", mixinStandardHelpOptions = true,
        description = {"Simulates clusters of 10 to 10 000 executors with measured times of evaluations, failures and slow machines, "
                + "and tells which share of their time would go into evaluations that count.",
            "Measures how long evaluations take here, one after another, unless DIR/times.csv has it."},
        customSynopsis = "natator cluster-efficiency --output-dir DIR [OPTIONS]",
        footer = {"", "Example:", "  natator cluster-efficiency --output-dir cluster --failures-per-hour 0.1"})
final class ClusterEfficiencyCommand implements Callable<Integer> {

    private static final double MILLISECOND = 1e-3;
    private static final int MOST_EVALUATIONS = 100_000;
    private static final double MOST_FAILURES = 3600;
    private static final double MOST_TIMES_AS_SLOW = 1000;

    @Spec
    private CommandSpec spec;

    @Mixin
    private SimulatorOption simulator;

    @Section(Topic.OUTPUT)
    @Option(names = "--output-dir", required = true, paramLabel = "DIR", description = "Where the results go.")
    private Path directory;

    @Section(Topic.SCENE)
    @Option(names = "--scene", paramLabel = "NAME|FILE", defaultValue = "thesis/creature-1",
            description = "What evaluations are measured in. Default: ${DEFAULT-VALUE}.")
    private String scene;

    @Section(Topic.EXTENT)
    @Option(names = "--evaluations", paramLabel = "N", defaultValue = "150",
            description = "How many are measured, of gaits drawn at random. Default: ${DEFAULT-VALUE}.")
    private int evaluations;

    @Section(Topic.EXTENT)
    @Option(names = "--seed", paramLabel = "N", defaultValue = "1", description = "Of all that is drawn. Default: ${DEFAULT-VALUE}.")
    private long seed;

    @Section(Topic.COMPUTING)
    @Option(names = "--part-ms", paramLabel = "MS", defaultValue = "3",
            description = "Time of the driver for each part of a generation, which is one evaluation or more. Default: ${DEFAULT-VALUE}.")
    private double perPart;

    @Section(Topic.COMPUTING)
    @Option(names = "--driver-ms", paramLabel = "MS", defaultValue = "0.5",
            description = "Time of the driver for each evaluation, besides that for its part. Default: ${DEFAULT-VALUE}.")
    private double perEvaluation;

    @Section(Topic.COMPUTING)
    @Option(names = "--generation-ms", paramLabel = "MS", defaultValue = "100",
            description = "Time of the driver between two generations. Default: ${DEFAULT-VALUE}.")
    private double perGeneration;

    @Section(Topic.COMPUTING)
    @Option(names = "--latency-ms", paramLabel = "MS", defaultValue = "10",
            description = "From the driver to an executor and back. Default: ${DEFAULT-VALUE}.")
    private double latency;

    @Section(Topic.COMPUTING)
    @Option(names = "--failures-per-hour", paramLabel = "N", defaultValue = "0.02",
            description = "How often an executor fails. Default: ${DEFAULT-VALUE}, every other day.")
    private double failures;

    @Section(Topic.COMPUTING)
    @Option(names = "--restart", paramLabel = "SECONDS", defaultValue = "30",
            description = "Until a failed executor is back. Default: ${DEFAULT-VALUE}.")
    private double restart;

    @Section(Topic.COMPUTING)
    @Option(names = "--slow-share", paramLabel = "SHARE", defaultValue = "0.02",
            description = "Share of the executors that are slow. Default: ${DEFAULT-VALUE}.")
    private double slowShare;

    @Section(Topic.COMPUTING)
    @Option(names = "--slow-factor", paramLabel = "X", defaultValue = "3",
            description = "How many times as long evaluations take there. Default: ${DEFAULT-VALUE}.")
    private double slowFactor;

    @Override
    public Integer call() throws InterruptedException {
        Limits.checkCount("--evaluations", evaluations, MOST_EVALUATIONS);
        check("--part-ms", perPart, 0, 1 / MILLISECOND);
        check("--driver-ms", perEvaluation, 0, 1 / MILLISECOND);
        check("--generation-ms", perGeneration, 0, Limits.SECONDS / MILLISECOND);
        check("--latency-ms", latency, 0, Limits.SECONDS / MILLISECOND);
        check("--failures-per-hour", failures, 0, MOST_FAILURES);
        check("--restart", restart, 0, Limits.SECONDS);
        check("--slow-share", slowShare, 0, 1);
        check("--slow-factor", slowFactor, 1, MOST_TIMES_AS_SLOW);
        GeneratedPage.check(directory);
        OutputFolder.make(directory);
        Path times = directory.resolve("times.csv");
        try {
            if (!Files.exists(times)) {
                measure(times);
            }
            Assumptions cluster = new Assumptions(MILLISECOND * perPart, MILLISECOND * perEvaluation, MILLISECOND * latency,
                    MILLISECOND * perGeneration, failures, restart, slowShare, slowFactor, true);
            spec.commandLine().getOut().println(new ClusterStudy(cluster, EvaluationTimes.read(times), seed)
                    .writeTo(directory, CommandText.of(spec, List.of("--simulator-path"))));
        } catch (IOException e) {
            throw new UncheckedIOException(directory + " cannot be written: " + FileErrors.whyNotMade(directory, e), e);
        }
        return ExitCode.OK;
    }

    private void measure(Path file) throws InterruptedException {
        String name = SceneOptions.scene("--scene", scene);
        SceneInfo info = SceneInfo.toEvolve(name, EncodingKind.DENSE, null, simulator.path());
        ExecutionSettings alone = ExecutionSettings.of(simulator.path()).withWorkers(1).withTimeout(TimeLimit.of(info, null));
        try (Evaluator evaluator = Evaluator.open(alone)) {
            EvaluationTimes.measure(name, EncodingKind.DENSE.forActuators(info.actuators()), seed, evaluator, evaluations, file);
        }
    }

    private static void check(String name, double value, double least, double most) {
        if (!(value >= least && value <= most)) {
            throw new InvalidInputException(name + " is " + value + "; expected a number from " + least + " to " + most);
        }
    }
}
