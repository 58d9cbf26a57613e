package io.natator.spark;

import io.natator.base.InvalidInputException;
import io.natator.config.Backend;
import io.natator.config.ExecutionSettings;
import io.natator.config.SimulatorMode;
import io.natator.process.Evaluator;
import io.natator.process.ProcessEvaluator;
import io.natator.process.ProgramInfo;
import io.natator.protocol.RequestRejectedException;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import io.natator.protocol.SimulationResultBuilder;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;

/**
 * The native program of an executor: processes that stay alive for all its tasks, of one configuration on one device. Gets
 * no work before it was seen to do as the driver's.
 */
final class ExecutorSimulator {

    private static final Map<Key, ExecutorSimulator> ALL = new ConcurrentHashMap<>();

    private final Path program;
    private final ExecutionSettings settings;
    private final Evaluator simulator;
    /** Samples that came out as they should. */
    private final Set<String> done = ConcurrentHashMap.newKeySet();
    private ProgramInfo info;

    /** What configurations have in common that can share processes. */
    private record Key(Path program, Backend backend, int device, long timeout) {
    }

    /** What a GPU is called and how it swims. */
    record Kind(String gpu, String hash) {
    }

    private ExecutorSimulator(Key key) {
        this.program = key.program;
        boolean alone = key.backend == Backend.CPU;
        this.settings = ExecutionSettings.of(key.program).withMode(alone ? SimulatorMode.RESIDENT : SimulatorMode.BATCH)
                .withBackend(key.backend).withDevices(List.of(key.device))
                .withWorkers(Runtime.getRuntime().availableProcessors()).withTimeout(Duration.ofMillis(key.timeout));
        this.simulator = Evaluator.open(settings);
    }

    /**
     * The one for a configuration on a device; the same for all tasks of this virtual machine.
     *
     * @throws UnfitExecutorException if this executor does otherwise than the driver
     */
    static ExecutorSimulator of(ExecutorConfig config, int device) throws UnfitExecutorException, InterruptedException {
        ExecutorSimulator simulator = ALL.computeIfAbsent(
                new Key(SentFile.get(config.program()), config.backend(), device, config.timeout()),
                ExecutorSimulator::new);
        simulator.check(config, false);
        return simulator;
    }

    /** One check at a time: what one task finds out the others need not. */
    private synchronized void check(ExecutorConfig config, boolean again)
            throws UnfitExecutorException, InterruptedException {
        if (info == null) {
            try {
                info = ProgramInfo.of(program);
            } catch (InvalidInputException | RequestRejectedException e) {
                throw new UnfitExecutorException("the native program does not run: " + e.getMessage(), e);
            }
        }
        if (config.instructionSet() != null && !config.instructionSet().equals(info.instructionSet())) {
            throw new UnfitExecutorException("instruction set is " + info.instructionSet() + ", the driver's is "
                    + config.instructionSet() + ": last digits would differ; set NATATOR_ISA for all to what all have");
        }
        if (config.gpu() != null && !config.gpu().equals(gpu())) {
            throw new UnfitExecutorException("GPU is " + gpu() + ", the first was " + config.gpu()
                    + ": last digits would differ");
        }
        if (config.hash() != null && (again || !done.contains(config.hash()))) {
            SimulationResult result = swim(config.sample());
            if (!config.hash().equals(result.hash())) {
                throw new UnfitExecutorException("swims otherwise than "
                        + (config.backend() == Backend.CPU ? "the driver"
                                : "the first GPU")
                        + " (hash " + Objects.requireNonNullElse(result.hash(), "none: " + result.error())
                        + ", not " + config.hash() + ", after " + config.sample().duration() + " s)");
            }
            done.add(config.hash());
        }
    }

    /**
     * What the others are to be like.
     *
     * @throws UnfitExecutorException if the sample comes to no end that can be compared
     */
    Kind kind(ExecutorConfig config) throws UnfitExecutorException, InterruptedException {
        SimulationResult result = swim(config.sample());
        if (result.hash() == null) {
            throw new UnfitExecutorException("the first swim has no end to compare others with: " + result.error());
        }
        return new Kind(gpu(), result.hash());
    }

    /** The name without the number, or null on the processor. */
    private String gpu() {
        return settings.backend() == Backend.CPU ? null : info.kind(settings.device()).orElse("none");
    }

    private SimulationResult swim(SimulationRequest sample) throws UnfitExecutorException, InterruptedException {
        SimulationRequest here = located(sample);
        try (ProcessEvaluator single = new ProcessEvaluator(settings)) {
            return single.evaluate(here);
        } catch (RequestRejectedException e) {
            throw new UnfitExecutorException(e.getMessage(), e);
        }
    }

    private static SimulationRequest located(SimulationRequest request) throws UnfitExecutorException {
        return SceneFiles.withScene(request, SentFile.get(request.scene()).toString());
    }

    /**
     * Evaluates all, up to the first that the program refuses. An evaluation that fails is believed to be at fault itself
     * only if this executor still swims as it should.
     *
     * @throws UnfitExecutorException if it is this executor that fails
     */
    List<SimulationResult> evaluate(List<SimulationRequest> requests, ExecutorConfig config)
            throws UnfitExecutorException, InterruptedException {
        List<SimulationResult> results = new ArrayList<>();
        List<SimulationRequest> here = new ArrayList<>();
        for (SimulationRequest request : requests) {
            here.add(located(request));
        }
        try {
            if (settings.inBatches()) {
                simulator.evaluateAll(here, results::add);
            } else {
                for (SimulationRequest request : here) {
                    results.add(simulator.evaluate(request));
                }
            }
        } catch (RequestRejectedException e) {
            if (!e.isBadInput()) {
                throw new UnfitExecutorException(e.getMessage(), e);
            }
            results.add(refused(settings.inBatches() ? null : here.get(results.size()).id(), e.getMessage()));
        }
        if (results.stream().anyMatch(result -> result.status() == SimulationResult.Status.FAILED)) {
            check(config, true);
        }
        return results;
    }

    /** With the request's number, where it is known which of them it was. */
    private static SimulationResult refused(Long id, String reason) {
        return SimulationResultBuilder.builder().id(id).status(SimulationResult.Status.ERROR).error(reason).build();
    }
}
