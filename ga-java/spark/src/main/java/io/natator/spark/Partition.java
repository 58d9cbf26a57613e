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

/** What an executor does with a part of a generation: a list of requests in, an {@link Answer} out, both as JSON. */
final class Partition implements FlatMapFunction<Iterator<String>, String> {

    private static final long serialVersionUID = 1L;
    private static final String GPU = "gpu";
    private static final double NANOSECONDS = 1e9;

    private final String mission;

    /** The mission as JSON. */
    Partition(String mission) {
        this.mission = mission;
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
        Mission known = Json.parse(mission, Mission.class);
        ExecutorSimulator simulator = ExecutorSimulator.of(known, device(known));
        if (known.backend() != Backend.CPU && known.hash() == null) {
            return Json.line(simulator.kind(known));
        }
        long begun = System.nanoTime();
        List<SimulationResult> results = simulator.evaluate(requests, known);
        return Json.line(new Answer((System.nanoTime() - begun) / NANOSECONDS, results));
    }

    /** The GPU that Spark gave this task, else that of the mission. */
    private static int device(Mission mission) throws UnfitExecutorException {
        ResourceInformation gpu = TaskContext.get().resourcesJMap().get(GPU);
        if (mission.backend() == Backend.CPU || gpu == null || gpu.addresses().length == 0) {
            return mission.device();
        }
        try {
            return Integer.parseInt(gpu.addresses()[0]);
        } catch (NumberFormatException e) {
            throw new UnfitExecutorException("GPU address is " + gpu.addresses()[0] + "; expected its number, from 0", e);
        }
    }
}
