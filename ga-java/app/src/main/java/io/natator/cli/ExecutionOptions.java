package io.natator.cli;

import io.natator.base.InvalidInputException;
import io.natator.cli.Section.Topic;
import io.natator.config.Backend;
import io.natator.config.ExecutionSettings;
import io.natator.config.Limits;
import io.natator.config.SimulatorMode;
import io.natator.process.ProgramInfo;
import java.time.Duration;
import java.util.List;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;

/** Options that say how evaluations are carried out. */
@Section(Topic.COMPUTING)
class ExecutionOptions {

    /** Set by spark-submit. */
    private static final String SUBMITTED = "spark.master";

    @Option(names = "--simulator", paramLabel = "MODE", description = "How evaluations reach the native program: "
            + "process (one for each), resident (processes kept alive), batch (a generation at once) or spark (a cluster). The "
            + "results are the same. Default: process; batch on backend cuda; spark where spark-submit started this.")
    private SimulatorMode mode;

    @Option(names = "--simulator-command", paramLabel = "COMMAND", description = "A command line that starts a program "
            + "like natator-sim serve, say \"ssh host natator-sim serve\". Several, each with its own option, share the "
            + "evaluations; the workers are those of all of them together. They must have this machine's "
            + "instruction set, or all the same NATATOR_ISA. Default: the native program here.")
    private List<String> commands = List.of();

    @Option(names = "--master", paramLabel = "URL",
            description = "The cluster's master in mode spark: local[4] or, for "
                    + "example, spark://host:7077. Default: what spark-submit was told.")
    private String master;

    @Option(names = "--backend", paramLabel = "BACKEND",
            description = "cpu, cuda (a GPU), or auto (a GPU where there is one). Default: the run's, of a new one "
                    + "or a single swim cpu; of compare, that of all runs, else cpu.")
    private Backend backend;

    @Option(names = "--device", paramLabel = "N",
            description = "Number of the GPU, several with commas between them, or all: each gets its share of every "
                    + "batch, and one that fails leaves it to the others. Default: 0.")
    private String device;

    @Option(names = "--workers", paramLabel = "N",
            description = "Evaluations at the same time; the result does not depend on it. Default: all processors.")
    private Integer workers;

    @Option(names = "--timeout", paramLabel = "SECONDS", description = "Longest time for one attempt at an evaluation. "
            + "Default: what follows from the scene's cost, for the thesis' scenes two minutes.")
    private Double timeoutSeconds;

    @Mixin
    private SimulatorOption simulator;

    /**
     * The settings, with a null time limit if none was given.
     *
     * @param otherwise the backend if none was given
     * @throws InterruptedException if the calling thread is interrupted while the simulator is asked for its GPUs
     */
    ExecutionSettings execution(Backend otherwise) throws InterruptedException {
        if (timeoutSeconds != null) {
            Limits.checkSeconds("--timeout", timeoutSeconds);
        }
        Backend chosen = backend != null ? backend : otherwise;
        SimulatorMode usual = !commands.isEmpty() ? SimulatorMode.RESIDENT
                : master != null || System.getProperty(SUBMITTED) != null ? SimulatorMode.SPARK
                        : chosen == Backend.CUDA ? SimulatorMode.BATCH : SimulatorMode.PROCESS;
        return new ExecutionSettings(simulator.path(), mode != null ? mode : usual, chosen, devices(chosen),
                workers != null ? workers : Runtime.getRuntime().availableProcessors(), timeoutSeconds == null ? null
                        : Duration.ofMillis(Math.max(1, Math.round(timeoutSeconds * 1000.0))),
                null, commands, master);
    }

    private List<Integer> devices(Backend chosen) throws InterruptedException {
        if (device == null) {
            return List.of(0);
        }
        if (chosen == Backend.CPU) {
            throw new InvalidInputException(
                    "--device is " + device + ", but the backend is cpu, which has no GPUs; expected --backend "
                            + "cuda or auto with it");
        }
        if (!commands.isEmpty()) {
            throw new InvalidInputException(
                    "--device is " + device + "; expected none beside --simulator-command, whose command lines say it");
        }
        return device.matches("\\d{1,4}") ? List.of(Integer.valueOf(device))
                : ProgramInfo.of(simulator.path()).devices(device);
    }
}
