package io.natator.study.cluster;

import io.natator.config.InvalidInputException;
import io.natator.encoding.Encoding;
import io.natator.encoding.GeneRange;
import io.natator.evolution.EvolutionFailedException;
import io.natator.file.AtomicFile;
import io.natator.file.CsvReader;
import io.natator.simulator.Evaluator;
import io.natator.simulator.SimulationRequest;
import io.natator.simulator.SimulationResult;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;

/** How long evaluations of gaits drawn at random take, one after another; early stops make some of them short. */
public final class EvaluationTimes {

    private static final double NANOSECONDS = 1e9;
    private static final String COLUMN = "seconds";

    private EvaluationTimes() {
    }

    /**
     * Measures them and writes them to a file with the columns evaluation, seconds and stopped (why a swim ended).
     *
     * @param encoding of the gaits of that scene
     * @param count    at least 1
     * @throws EvolutionFailedException if one fails
     */
    public static void measure(String scene, Encoding encoding, long seed, Evaluator evaluator, int count, Path file)
            throws InterruptedException {
        Random random = new Random(seed);
        StringBuilder rows = new StringBuilder("evaluation,").append(COLUMN).append(",stopped\n");
        for (int id = 0; id <= count; id++) {
            List<Double> genes = new ArrayList<>();
            for (GeneRange range : encoding.genes()) {
                genes.add(range.lower() + random.nextDouble() * (range.upper() - range.lower()));
            }
            SimulationRequest request = new SimulationRequest(id, scene, encoding.decode(genes), null, null, null);
            long start = System.nanoTime();
            SimulationResult result = evaluator.evaluate(request);
            if (result.status() == SimulationResult.Status.FAILED) {
                throw new EvolutionFailedException("an evaluation failed: " + result.error());
            }
            if (id > 0) {  // The first one starts the program and settles the scene.
                rows.append(id).append(',').append((System.nanoTime() - start) / NANOSECONDS).append(',').append(result.stopped())
                        .append('\n');
            }
        }
        AtomicFile.write(file, rows.toString());
    }

    /**
     * Reads such a file.
     *
     * @throws InvalidInputException if there is nothing in it, or a time that is not above 0
     */
    public static double[] read(Path file) {
        List<Double> times = new ArrayList<>();
        try (CsvReader table = new CsvReader(file, List.of(COLUMN))) {
            while (table.next()) {
                double seconds = table.number(COLUMN);
                if (!(seconds > 0) || seconds == Double.POSITIVE_INFINITY) {
                    throw new InvalidInputException(file + ": " + COLUMN + " is " + seconds + "; expected a number above 0");
                }
                times.add(seconds);
            }
        }
        if (times.isEmpty()) {
            throw new InvalidInputException(file + ": no row; expected times of evaluations");
        }
        return times.stream().mapToDouble(Double::doubleValue).toArray();
    }
}
