package io.natator.checkpoint;

import io.natator.config.Backend;
import io.natator.config.ExecutionSettings;
import io.natator.config.SimulatorMode;
import io.natator.simulator.Digest;
import java.nio.file.Path;
import java.time.Instant;
import java.time.temporal.ChronoUnit;

/**
 * Where and how a run was carried out; {@code environment.json}. Nothing in it changes the outcome but the simulator's
 * build.
 *
 * @param natator         version of this program
 * @param simulator       path of the native program, relative to the working directory
 * @param simulatorSha256 digest of that file
 * @param mode            how evaluations reach the native program
 * @param backend         what it computes on
 * @param device          number of the GPU
 * @param workers         evaluations at the same time
 * @param timeoutSeconds  time limit of an attempt at an evaluation
 * @param java            version of the Java runtime
 * @param system          operating system and processor architecture
 * @param processors      processors available
 * @param started         when this was written
 */
public record Environment(String natator, String simulator, String simulatorSha256, SimulatorMode mode, Backend backend,
        int device, int workers, double timeoutSeconds, String java, String system, int processors, String started) {

    /** The present environment. */
    public static Environment present(ExecutionSettings execution) {
        String version = Environment.class.getPackage().getImplementationVersion();
        return new Environment(version == null ? "development" : version, fromWorkingDirectory(execution.simulator()),
                Digest.of(execution.simulator()), execution.mode(), execution.backend(), execution.device(),
                execution.workers(), execution.timeout().toMillis() / 1000.0,
                Runtime.version().toString(),
                System.getProperty("os.name") + " " + System.getProperty("os.arch"),
                Runtime.getRuntime().availableProcessors(), Instant.now().truncatedTo(ChronoUnit.SECONDS).toString());
    }

    private static String fromWorkingDirectory(Path path) {
        return Path.of("").toAbsolutePath().relativize(path.toAbsolutePath()).toString();
    }
}
