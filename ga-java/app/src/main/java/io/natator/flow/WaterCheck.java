package io.natator.flow;

import io.natator.config.ExecutionSettings;
import io.natator.process.TrajectoryRecorder;
import io.natator.protocol.SimulationRequest;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;

/** Looks whether a swimmer is in the water. */
public final class WaterCheck {

    private WaterCheck() {
    }

    /**
     * Mean share of the body's particles under water at a moment and at the end.
     *
     * @param request   that does not end early; run once for each, on the processor
     * @param moment    in seconds
     * @param execution with a time limit
     * @return null without water
     */
    public static Double shareUnderWater(SimulationRequest request, double moment, ExecutionSettings execution)
            throws InterruptedException {
        List<Double> shares = new ArrayList<>();
        try {
            Path file = Files.createTempFile("natator-", ".csv");
            try {
                for (Double at : Arrays.asList(moment, null)) {
                    Files.deleteIfExists(file);
                    new TrajectoryRecorder(execution).record(request, null, file, at);
                    Double share = Files.exists(file) ? WaterLevel.shareBelow(Snapshot.read(file)) : null;
                    if (share != null) {
                        shares.add(share);
                    }
                }
            } finally {
                Files.deleteIfExists(file);
            }
        } catch (IOException e) {
            throw new UncheckedIOException("cannot record a run: " + e.getMessage(), e);
        }
        return shares.isEmpty() ? null : shares.stream().mapToDouble(Double::doubleValue).average().orElseThrow();
    }
}
