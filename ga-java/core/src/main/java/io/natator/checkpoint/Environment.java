package io.natator.checkpoint;

import com.fasterxml.jackson.annotation.JsonInclude;
import io.natator.base.Sha256;
import io.natator.config.Backend;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.config.SimulatorMode;
import io.natator.process.ProgramInfo;
import java.nio.file.Path;
import java.time.Instant;
import java.time.temporal.ChronoUnit;
import java.util.List;

/**
 * Where and how a run was carried out, and by which settings; {@code environment.json}. Nothing else in it changes the outcome
 * but the simulator's build.
 *
 * @param natator         version of this program
 * @param simulator       path of the native program, relative to the working directory
 * @param simulatorSha256 digest of that file
 * @param version         of the native program's source
 * @param commit          that it was built from, or {@code unknown}
 * @param instructionSet  kernels that it uses on this processor
 * @param mode            how evaluations reach the native program
 * @param backend         what it computes on
 * @param devices         numbers of the GPUs
 * @param gpu             the first one's name; null if none is used
 * @param workers         evaluations at the same time
 * @param timeoutSeconds  time limit of an attempt at an evaluation
 * @param java            version of the Java runtime
 * @param system          operating system and processor architecture
 * @param processors      processors available
 * @param started         when this was written
 * @param sceneSha256     digest of the run's scene, by which a scene that was changed since is noticed; null of what is no run
 * @param settings        of the run, by which a {@code config.json} that was edited since is noticed; null of what is no run
 */
@JsonInclude(JsonInclude.Include.NON_NULL)
public record Environment(String natator, String simulator, String simulatorSha256, String version, String commit,
        String instructionSet, SimulatorMode mode, Backend backend, List<Integer> devices, String gpu,
        int workers, double timeoutSeconds, String java, String system, int processors, String started,
        String sceneSha256, EvolutionSettings settings) {

    /**
     * The present environment.
     *
     * @param sceneSha256 digest of the run's scene, or null
     * @param settings    of the run, or null
     *
     * @throws io.natator.protocol.RequestRejectedException if the simulator cannot be run
     */
    public static Environment present(ExecutionSettings execution, String sceneSha256, EvolutionSettings settings)
            throws InterruptedException {
        ProgramInfo program = ProgramInfo.of(execution.simulator());
        String gpu = execution.backend() == Backend.CPU ? null : program.device(execution.device()).orElse(null);
        String version = Environment.class.getPackage().getImplementationVersion();
        return new Environment(version == null ? "development" : version, fromWorkingDirectory(execution.simulator()),
                Sha256.of(execution.simulator()), program.version(), program.commit(), program.instructionSet(),
                execution.mode(), execution.backend(), execution.devices(), gpu, execution.workers(),
                execution.timeout().toMillis() / 1000.0, Runtime.version().toString(),
                System.getProperty("os.name") + " " + System.getProperty("os.arch"),
                Runtime.getRuntime().availableProcessors(), Instant.now().truncatedTo(ChronoUnit.SECONDS).toString(),
                sceneSha256, settings);
    }

    private static String fromWorkingDirectory(Path path) {
        return Path.of("").toAbsolutePath().relativize(path.toAbsolutePath()).toString();
    }
}
