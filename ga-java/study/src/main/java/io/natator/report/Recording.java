package io.natator.report;

import com.fasterxml.jackson.annotation.JsonProperty;
import io.natator.config.InvalidInputException;
import io.natator.file.CompressedJson;
import io.natator.flow.FlowField;
import io.natator.kinematics.Attitude;
import io.natator.kinematics.BodyPath;
import io.natator.kinematics.SpinePath;
import io.natator.simulator.SimulationRequest;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;

/**
 * What pictures of a run are drawn from; a file {@code NAME.json.gz}. Lengths are rounded to 10⁻⁶ scene units.
 *
 * @param program  SHA-256 of the native program that ran it
 * @param request  what was run
 * @param spine    centres of the slices
 * @param centres  [frame][x, y, z] of the body's centre
 * @param attitude in every frame
 * @param flow     the fluid at one moment, from above and from the side; empty without fluid
 */
public record Recording(@JsonProperty(required = true) String program,
        @JsonProperty(required = true) SimulationRequest request, SpinePath spine, double[][] centres,
        List<Attitude> attitude, List<FlowField> flow) {

    private static final double DIGITS = 1e6;

    /** A recording of a path. */
    public static Recording of(String program, SimulationRequest request, BodyPath path, List<FlowField> flow) {
        SpinePath spine = path.spine();
        double[][][] centres = spine.centres();
        double[][] body = new double[path.times().length][];
        List<Attitude> attitude = new ArrayList<>();
        for (int frame = 0; frame < body.length; frame++) {
            body[frame] = path.centre(frame);
            round(body[frame]);
            for (double[] slice : centres[frame]) {
                round(slice);
            }
            attitude.add(Attitude.of(path.particles()[0], path.particles()[frame]));
        }
        return new Recording(program, request, spine, body, attitude, flow);
    }

    private static void round(double[] values) {
        for (int i = 0; i < values.length; i++) {
            values[i] = Math.round(values[i] * DIGITS) / DIGITS;
        }
    }

    /** The spine with the body's roll taken out. */
    public SpinePath unrolled() {
        return spine.unrolled(attitude);
    }

    /** Writes the file; it appears whole. */
    public void write(Path file) {
        try {
            Files.createDirectories(file.toAbsolutePath().getParent());
        } catch (IOException e) {
            throw new UncheckedIOException("cannot write " + file + ": " + e.getMessage(), e);
        }
        CompressedJson.write(file, this);
    }

    /**
     * Reads a file.
     *
     * @throws InvalidInputException if it is no recording
     */
    public static Recording read(Path file) {
        return CompressedJson.read(file, Recording.class, "recording");
    }
}
