package io.natator.checkpoint;

import com.fasterxml.jackson.annotation.JsonIgnoreProperties;
import io.natator.base.Sha256;
import io.natator.config.Backend;
import io.natator.process.ProgramInfo;
import java.nio.file.Path;

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
}
