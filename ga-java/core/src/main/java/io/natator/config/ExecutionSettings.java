package io.natator.config;

import io.natator.base.InvalidInputException;
import io.soabase.recordbuilder.core.RecordBuilder;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;

/**
 * How evaluations are carried out; only the backend (and the GPU's model) changes the outcome, in the last digits.
 *
 * @param simulator the {@code natator-sim} program
 * @param mode      how evaluations reach it
 * @param backend   what it computes on
 * @param devices   numbers of the GPUs, from 0, all of one kind; evaluations are spread over them
 * @param workers   evaluations at the same time, from 1 to {@link Limits#AT_ONCE}; in mode batch the program decides
 * @param timeout   longest time for one attempt at an evaluation, or null to derive it from the scene's cost
 * @param cache     folder of evaluations that need not be done again, or null for none
 * @param commands  command lines for {@code /bin/sh}, each of which starts a program that speaks the protocol of
 *                  {@code natator-sim serve}, maybe on another machine; evaluations are spread over them. None: {@code simulator}
 * @param master    URL of the Spark master in mode spark, or null for the one that the program was submitted to
 */
@RecordBuilder
public record ExecutionSettings(Path simulator, SimulatorMode mode, Backend backend, List<Integer> devices,
        int workers, Duration timeout, Path cache, List<String> commands, String master)
        implements ExecutionSettingsBuilder.With {

    /**
     * Checks the ranges.
     *
     * @throws InvalidInputException naming the setting that is out of range
     */
    public ExecutionSettings {
        commands = List.copyOf(commands);
        devices = List.copyOf(devices);
        Limits.checkCount("workers", workers, Limits.AT_ONCE);
        if (commands.stream().anyMatch(String::isBlank)) {
            throw new InvalidInputException("simulator command is blank; expected a command line");
        }
        if (!commands.isEmpty() && (mode == SimulatorMode.PROCESS || mode == SimulatorMode.SPARK)) {
            throw new InvalidInputException(
                    "simulator commands keep running; expected simulator mode resident or batch, "
                            + "not " + Json.name(mode));
        }
        if (master != null && mode != SimulatorMode.SPARK) {
            throw new InvalidInputException("master is " + master + "; expected simulator mode spark with it, not "
                    + Json.name(mode));
        }
        if (mode == SimulatorMode.SPARK && backend == Backend.AUTO) {
            throw new InvalidInputException(
                    "backend is auto; expected cpu or cuda in simulator mode spark, the same on all machines");
        }
        if (devices.isEmpty() || devices.stream().anyMatch(device -> device < 0)
                || devices.stream().distinct().count() < devices.size()) {
            throw new InvalidInputException("devices are " + devices + "; expected whole numbers from 0, each once");
        }
        if (devices.size() > 1 && mode == SimulatorMode.SPARK) {
            throw new InvalidInputException(
                    "devices are " + devices + "; expected one in simulator mode spark, which gives "
                            + "executors their GPUs");
        }
        if (timeout != null && (timeout.isNegative() || timeout.isZero())) {
            throw new InvalidInputException("timeout is " + timeout.toMillis() / 1000.0
                    + "; expected a number of seconds above 0");
        }
    }

    /**
     * All processors of this machine, by resident processes; no cache; time limit from the scene's cost. The command
     * line's default is a process for each evaluation, as in the thesis.
     */
    public static ExecutionSettings of(Path simulator) {
        return new ExecutionSettings(simulator, SimulatorMode.RESIDENT, Backend.CPU, List.of(0),
                Runtime.getRuntime().availableProcessors(), null, null, List.of(), null);
    }

    /** The first GPU, for what needs no more than one. */
    public int device() {
        return devices.get(0);
    }

    /**
     * Sample size for the estimate of the run time: a batch, else no more than the processors do at once, since others
     * only wait.
     *
     * @param population evaluations of a batch
     */
    public int trials(int population) {
        return inBatches() ? population : Math.min(workers, Runtime.getRuntime().availableProcessors());
    }

    /** Whether many evaluations are computed together, so that most of a generation comes at once. */
    public boolean inBatches() {
        return mode == SimulatorMode.BATCH || mode == SimulatorMode.SPARK && backend == Backend.CUDA;
    }

    /** Whether it is this machine that computes, or one that has shown the same bits. A GPU elsewhere may be of any kind. */
    public boolean isKnownHere() {
        return mode != SimulatorMode.SPARK || backend == Backend.CPU;
    }

    /** These settings in another mode. */
    @Override
    public ExecutionSettings withMode(SimulatorMode newMode) {
        return with(to -> to.mode(newMode).master(newMode == SimulatorMode.SPARK ? master : null));
    }

}
