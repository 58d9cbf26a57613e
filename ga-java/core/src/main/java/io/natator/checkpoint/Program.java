package io.natator.checkpoint;

import com.fasterxml.jackson.annotation.JsonIgnoreProperties;
import io.natator.base.Sha256;
import io.natator.config.Backend;
import io.natator.config.Json;
import io.natator.process.ProgramInfo;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Objects;

/**
 * The native program that computed a result, and what on: all that can change the last digits, and with them, in a chaotic
 * system, whole swims.
 *
 * @param version         of its source
 * @param commit          that it was built from, or {@code unknown}
 * @param instructionSet  kernels that it used
 * @param backend         what it computed on
 * @param gpu             the GPU, or null
 * @param simulatorSha256 digest of the program
 */
@JsonIgnoreProperties(ignoreUnknown = true)
public record Program(String version, String commit, String instructionSet, Backend backend, String gpu,
        String simulatorSha256) {

    /** The program at a path. */
    public static Program at(Path simulator, Backend backend, int device) throws InterruptedException {
        ProgramInfo info = ProgramInfo.of(simulator);
        String gpu = backend != Backend.CPU ? info.device(device).orElse(null) : null;
        return new Program(info.version(), info.commit(), info.instructionSet(), backend, gpu, Sha256.of(simulator));
    }

    /**
     * The program of a run folder; null if the folder does not say.
     *
     * @throws io.natator.base.InvalidInputException if {@code environment.json} is damaged
     */
    public static Program of(Path run) {
        Path file = run.resolve(RunWriter.ENVIRONMENT);
        return Files.exists(file) ? Json.read(file, Program.class, "environment") : null;
    }

    /** How this program differs from another, in words; empty if no difference is known. */
    public String differenceTo(Program other) {
        List<String> found = new ArrayList<>();
        add(found, "version", version, other.version);
        add(found, "commit", commit, other.commit);
        add(found, "instruction set", instructionSet, other.instructionSet);
        add(found, "backend", backend.argument(), other.backend.argument());
        if (gpu != null || other.gpu != null) {
            add(found, "GPU", gpu, other.gpu);
        }
        if (found.isEmpty() && !Objects.equals(simulatorSha256, other.simulatorSha256)) {
            found.add("another build of the same commit");
        }
        return String.join("; ", found);
    }

    private static void add(List<String> found, String name, String mine, String other) {
        if (!Objects.equals(mine, other)) {
            found.add(name + " " + mine + ", now " + other);
        }
    }
}
