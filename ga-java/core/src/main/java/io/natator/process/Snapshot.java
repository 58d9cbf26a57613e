package io.natator.process;

import io.natator.base.InvalidInputException;
import io.natator.config.ExecutionSettings;
import io.natator.config.Json;
import io.natator.protocol.RefusedSceneException;
import io.natator.protocol.RequestRejectedException;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulatorFailure;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

/**
 * All particles at one moment of a run, by their places x, y, z in scene units.
 *
 * @param fluid particles of the fluid
 * @param body  particles of the swimmer
 */
public record Snapshot(List<double[]> fluid, List<double[]> body) {

    /** Width of a column of water, in mean distances of its particles. */
    private static final double WIDTH = 2;

    /**
     * That of {@code natator-sim run}, on the processor.
     *
     * @param request   from the scene's own start
     * @param at        the moment in seconds, or null for the end of the run
     * @param execution with a time limit
     * @return without particles if the run became unstable before
     * @throws RefusedSceneException    if the program refuses the request
     * @throws RequestRejectedException if it fails
     */
    public static Snapshot of(SimulationRequest request, Double at, ExecutionSettings execution)
            throws InterruptedException {
        Path file = null;
        try (NativeProgram program = new NativeProgram(execution.simulator(), execution.timeout())) {
            file = Files.createTempFile("natator-", ".csv");
            Files.delete(file);
            List<String> arguments = new ArrayList<>(List.of("run", request.scene(), "--snapshot", file.toString()));
            add(arguments, "--gait", request.gait() == null ? null : Json.line(request.gait()));
            add(arguments, "--duration", request.duration());
            add(arguments, "--scheme", request.scheme() == null ? null : Json.name(request.scheme()));
            add(arguments, "--overrides", request.overrides());
            add(arguments, "--at", at);
            NativeProgram.Output output = program.call(arguments, "", line -> {
            });
            if (output.exitStatus() != ExitStatus.OK && output.exitStatus() != ExitStatus.UNSTABLE) {
                throw output.failure("scene " + request.scene());
            }
            return read(file);
        } catch (SimulatorFailure e) {
            throw new RequestRejectedException("scene " + request.scene() + " cannot be recorded: " + e.getMessage(),
                    false);
        } catch (IOException e) {
            throw new UncheckedIOException("cannot record a run: " + e.getMessage(), e);
        } finally {
            if (file != null) {
                file.toFile().delete();
            }
        }
    }

    private static void add(List<String> arguments, String option, Object value) {
        if (value != null) {
            arguments.addAll(List.of(option, value.toString()));
        }
    }

    private static Snapshot read(Path file) throws IOException {
        Snapshot snapshot = new Snapshot(new ArrayList<>(), new ArrayList<>());
        List<String> lines = Files.exists(file) ? Files.readAllLines(file) : List.of();
        List<String> columns = lines.isEmpty() ? List.of() : List.of(lines.get(0).split(","));
        int x = columns.indexOf("x");
        for (String line : lines.subList(Math.min(1, lines.size()), lines.size())) {
            String[] row = line.split(",");
            try {
                (row[columns.indexOf("kind")].equals("fluid") ? snapshot.fluid : snapshot.body)
                        .add(new double[] {Double.parseDouble(row[x]), Double.parseDouble(row[x + 1]),
                                Double.parseDouble(row[x + 2])});
            } catch (IndexOutOfBoundsException | NumberFormatException e) {
                throw new InvalidInputException(
                        "no valid snapshot: found " + line + "; expected " + String.join(",", columns), e);
            }
        }
        return snapshot;
    }

    /**
     * Share of the body's particles below the water's level, which is the median of the uppermost particles of all columns:
     * waves, and what was splashed, do not raise it.
     *
     * @return null without water or without a body
     */
    public Double shareUnderWater() {
        if (fluid.isEmpty() || body.isEmpty()) {
            return null;
        }
        double width = WIDTH * meanDistance();
        Map<List<Long>, Double> tops = new HashMap<>();
        for (double[] one : fluid) {
            tops.merge(List.of((long) Math.floor(one[0] / width), (long) Math.floor(one[2] / width)), one[1],
                    Math::max);
        }
        double[] sorted = tops.values().stream().mapToDouble(Double::doubleValue).sorted().toArray();
        double level = sorted[sorted.length / 2];
        return body.stream().filter(one -> one[1] < level).count() / (double) body.size();
    }

    /** Mean distance of fluid particles that fill their box, in scene units. */
    private double meanDistance() {
        double volume = 1;
        for (int axis = 0; axis < 3; axis++) {
            int along = axis;
            double[] places = fluid.stream().mapToDouble(one -> one[along]).sorted().toArray();
            volume *= Math.max(places[places.length - 1] - places[0], 1e-6);
        }
        return Math.cbrt(volume / fluid.size());
    }
}
