package io.natator.flow;

import io.natator.config.FileErrors;
import io.natator.config.InvalidInputException;
import java.io.BufferedReader;
import java.io.IOException;
import java.nio.file.Files;
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

    private static final String HEADER = "time,kind,mass,x,y,z,vx,vy,vz,density";

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
        int number = 1;
        try (BufferedReader lines = Files.newBufferedReader(file)) {
            if (!HEADER.equals(lines.readLine())) {
                throw new InvalidInputException(file + ": expected the columns " + HEADER);
            }
            for (String line = lines.readLine(); line != null; line = lines.readLine()) {
                number++;
                String[] fields = line.split(",", -1);
                time = Double.parseDouble(fields[0]);
                (fields[1].equals("fluid") ? fluid : body).add(new Particle(three(fields, 3), three(fields, 6)));
            }
            return new Snapshot(time, fluid, body);
        } catch (IOException e) {
            throw new InvalidInputException(file + " cannot be read: " + FileErrors.reason(file, e), e);
        } catch (NumberFormatException | ArrayIndexOutOfBoundsException e) {
            throw new InvalidInputException(file + ", line " + number + ": expected ten fields", e);
        }
    }

    private static double[] three(String[] fields, int first) {
        return new double[] {Double.parseDouble(fields[first]), Double.parseDouble(fields[first + 1]),
            Double.parseDouble(fields[first + 2])};
    }
}
