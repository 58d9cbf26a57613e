package io.natator.evolution;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.config.Json;
import io.natator.process.OptimizerPipe;
import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStreamReader;
import java.io.PipedInputStream;
import java.io.PipedOutputStream;
import java.io.UncheckedIOException;
import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.List;
import java.util.SplittableRandom;

/** An optimizer outside the program, as far as a pipe can tell: steps from the best that it was told, by a random sequence of its own. */
class ToyOptimizer implements AutoCloseable {

    private static final int BUFFER = 1 << 20;
    private static final double STEP = 0.2;

    /** All lines that it was told. */
    final List<String> told = new ArrayList<>();
    final OptimizerPipe pipe;
    private final PipedInputStream in = new PipedInputStream(BUFFER);
    private final PipedOutputStream toIt = new PipedOutputStream();
    private final PipedOutputStream out = new PipedOutputStream();
    private final Thread thread = new Thread(this::speak, "toy-optimizer");
    private SplittableRandom random;
    private JsonNode genes;
    private int population;
    private JsonNode best;
    private double fitness = Double.NEGATIVE_INFINITY;

    ToyOptimizer() {
        try {
            toIt.connect(in);
            pipe = new OptimizerPipe(new PipedInputStream(out, BUFFER), toIt);
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
        thread.setDaemon(true);
        thread.start();
    }

    private void speak() {
        try (out; BufferedReader lines = new BufferedReader(new InputStreamReader(in, StandardCharsets.UTF_8))) {
            for (String line = lines.readLine(); line != null; line = lines.readLine()) {
                told.add(line);
                String answer = answer(Json.parse(line, ObjectNode.class));
                if (answer != null) {
                    say(answer);
                }
            }
        } catch (IOException e) {
            // The other end has gone, or this one was told to.
        }
    }

    /**
     * What it says to a message, with its line end; null for nothing.
     *
     * @throws IOException to end
     */
    String answer(JsonNode message) throws IOException {
        switch (message.get("do").asText()) {
            case "begin" -> {
                genes = message.get("genes");
                population = message.get("population").asInt();
                random = new SplittableRandom(message.get("seed").asLong());
            }
            case "ask" -> {
                return "{\"candidates\":" + candidates() + "}\n";
            }
            case "tell" -> message.get("candidates").forEach(one -> {
                if (one.get("fitness").asDouble(-1) > fitness) {
                    fitness = one.get("fitness").asDouble();
                    best = one.get("genes");
                }
            });
            default -> {
            }
        }
        return null;
    }

    final void say(String text) throws IOException {
        out.write(text.getBytes(StandardCharsets.UTF_8));
        out.flush();
    }

    List<List<Double>> candidates() {
        List<List<Double>> candidates = new ArrayList<>();
        for (int i = 0; i < population; i++) {
            List<Double> candidate = new ArrayList<>();
            for (JsonNode gene : genes) {
                double lower = gene.get("lower").asDouble();
                double upper = gene.get("upper").asDouble();
                double value = best == null ? random.nextDouble(lower, upper)
                        : best.get(candidate.size()).asDouble() + STEP * (upper - lower) * random.nextDouble(-1, 1);
                candidate.add(Math.min(Math.max(value, lower), upper));
            }
            candidates.add(candidate);
        }
        return candidates;
    }

    /** Waits until it has heard all that it was told. */
    @Override
    public void close() {
        pipe.close();
        try {
            toIt.close();
            thread.join();
        } catch (IOException | InterruptedException e) {
            throw new IllegalStateException(e);
        }
    }
}
