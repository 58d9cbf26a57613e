package io.natator.study.thesis;

import io.natator.config.Backend;
import io.natator.config.ExecutionSettings;
import io.natator.config.SimulatorMode;
import io.natator.simulator.Evaluator;
import io.natator.simulator.SimulationRequest;
import io.natator.simulator.SimulationResult;
import java.util.ArrayList;
import java.util.Collection;
import java.util.Collections;
import java.util.List;
import java.util.Objects;
import java.util.Random;

/**
 * A measured run that the present program has done again.
 *
 * @param request  what was run
 * @param stored   hash of the final state that is stored
 * @param now      that of today
 */
public record Repeated(SimulationRequest request, String stored, String now) {

    /** Whether not a bit differs. */
    public boolean isSame() {
        return Objects.equals(stored, now);
    }

    /** Runs some rows again, drawn by chance. */
    static List<Repeated> of(Collection<Measurement> rows, int count, long seed, ExecutionSettings execution) throws InterruptedException {
        List<Measurement> drawn = new ArrayList<>(rows);
        Collections.shuffle(drawn, new Random(seed));
        drawn = drawn.subList(0, Math.min(count, drawn.size()));
        ExecutionSettings processor = execution.withCommands(List.of()).withBackend(Backend.CPU).withMode(SimulatorMode.RESIDENT);
        List<SimulationRequest> requests = new ArrayList<>();
        drawn.forEach(row -> requests.add(row.request().withId(requests.size())));
        List<SimulationResult> results = new ArrayList<>();
        try (Evaluator evaluator = Evaluator.open(processor)) {
            evaluator.evaluateInOrder(requests, results::add);
        }
        List<Repeated> repeated = new ArrayList<>();
        for (int i = 0; i < drawn.size(); i++) {
            repeated.add(new Repeated(drawn.get(i).request(), drawn.get(i).result().hash(), results.get(i).hash()));
        }
        return repeated;
    }
}
