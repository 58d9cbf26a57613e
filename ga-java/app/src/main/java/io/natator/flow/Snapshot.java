package io.natator.flow;

import io.natator.base.InvalidInputException;
import io.natator.file.CsvReader;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;

/**
 * All particles at one moment, as {@code natator-sim run --snapshot FILE} writes them.
 *
 * @param time  in seconds
 * @param fluid particles of the fluid
 * @param body  particles of the swimmer
 */
public record Snapshot(double time, List<Particle> fluid, List<Particle> body) {

    private static final List<String> COLUMNS = List.of("time", "kind", "x", "y", "z", "vx", "vy", "vz");

    /**
     * A particle.
     *
     * @param position x, y, z in scene units
     * @param velocity along x, y and z in scene units per second
     */
    public record Particle(double[] position, double[] velocity) {
    }

    /**
     * Reads the file.
     *
     * @throws InvalidInputException naming the line that is wrong
     */
    public static Snapshot read(Path file) {
        List<Particle> fluid = new ArrayList<>();
        List<Particle> body = new ArrayList<>();
        double time = 0;
        try (CsvReader table = new CsvReader(file, COLUMNS)) {
            while (table.next()) {
                time = table.number("time");
                (table.text("kind").equals("fluid") ? fluid : body).add(new Particle(
                        new double[] {table.number("x"), table.number("y"), table.number("z")},
                        new double[] {table.number("vx"), table.number("vy"), table.number("vz")}));
            }
        }
        return new Snapshot(time, fluid, body);
    }
}
