package io.natator.spark;

import com.fasterxml.jackson.core.JsonProcessingException;
import io.natator.config.Backend;
import io.natator.config.Json;
import io.natator.simulator.SimulationRequest;
import io.natator.simulator.SimulationResult;
import java.util.ArrayList;
import java.util.Iterator;
import java.util.List;
import org.apache.spark.TaskContext;
import org.apache.spark.api.java.function.FlatMapFunction;
import org.apache.spark.resource.ResourceInformation;

/** What an executor does with a part of a generation: requests in, results out, each as JSON. */
final class Partition implements FlatMapFunction<Iterator<String>, String> {

    private static final long serialVersionUID = 1L;
    private static final String GPU = "gpu";

    private final String mission;

    /** The mission as JSON. */
    Partition(String mission) {
        this.mission = mission;
    }

    @Override
    public Iterator<String> call(Iterator<String> lines)
            throws UnfitExecutorException, InterruptedException, JsonProcessingException {
        List<SimulationRequest> requests = new ArrayList<>();
        while (lines.hasNext()) {
            requests.add(Json.parse(lines.next(), SimulationRequest.class));
        }
        if (requests.isEmpty()) {
            return List.<String>of().iterator();
        }
        Mission known = Json.parse(mission, Mission.class);
        ExecutorSimulator simulator = ExecutorSimulator.of(known, device(known));
        if (known.backend() != Backend.CPU && known.hash() == null) {
            return List.of(Json.line(simulator.kind(known))).iterator();
        }
        List<String> answers = new ArrayList<>();
        for (SimulationResult result : simulator.evaluate(requests, known)) {
            answers.add(Json.line(result));
        }
        return answers.iterator();
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
