package io.natator.spark;

import com.fasterxml.jackson.core.JsonProcessingException;
import io.natator.config.Backend;
import io.natator.config.Json;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import java.util.ArrayList;
import java.util.Iterator;
import java.util.List;
import org.apache.spark.TaskContext;
import org.apache.spark.api.java.function.FlatMapFunction;
import org.apache.spark.resource.ResourceInformation;

/** What an executor does with a part of a generation: a list of requests in, an {@link PartitionResponse} out, both as JSON. */
final class Partition implements FlatMapFunction<Iterator<String>, String> {

    private static final long serialVersionUID = 1L;
    private static final String GPU = "gpu";
    private static final double NANOSECONDS = 1e9;

    private final String config;

    /** The configuration as JSON. */
    Partition(String config) {
        this.config = config;
    }

    @Override
    public Iterator<String> call(Iterator<String> lines)
            throws UnfitExecutorException, InterruptedException, JsonProcessingException {
        List<String> answers = new ArrayList<>();
        while (lines.hasNext()) {
            answers.add(answer(List.of(Json.parse(lines.next(), SimulationRequest[].class))));
        }
        return answers.iterator();
    }

    private String answer(List<SimulationRequest> requests)
            throws UnfitExecutorException, InterruptedException, JsonProcessingException {
        ExecutorConfig known = Json.parse(config, ExecutorConfig.class);
        ExecutorSimulator simulator = ExecutorSimulator.of(known, device(known));
        if (known.backend() != Backend.CPU && known.hash() == null) {
            return Json.line(simulator.kind(known));
        }
        long begun = System.nanoTime();
        List<SimulationResult> results = simulator.evaluate(requests, known);
        return Json.line(new PartitionResponse((System.nanoTime() - begun) / NANOSECONDS, results));
    }

    /** The GPU that Spark gave this task, else that of the configuration. */
    private static int device(ExecutorConfig config) throws UnfitExecutorException {
        ResourceInformation gpu = TaskContext.get().resourcesJMap().get(GPU);
        if (config.backend() == Backend.CPU || gpu == null || gpu.addresses().length == 0) {
            return config.device();
        }
        try {
            return Integer.parseInt(gpu.addresses()[0]);
        } catch (NumberFormatException e) {
            throw new UnfitExecutorException("GPU address is " + gpu.addresses()[0] + "; expected its number, from 0",
                    e);
        }
    }
}
