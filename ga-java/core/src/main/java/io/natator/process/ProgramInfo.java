package io.natator.process;

import com.fasterxml.jackson.annotation.JsonIgnoreProperties;
import com.fasterxml.jackson.annotation.JsonProperty;
import com.fasterxml.jackson.core.JsonProcessingException;
import io.natator.base.InvalidInputException;
import io.natator.config.Json;
import io.natator.protocol.RefusedSceneException;
import io.natator.protocol.RequestRejectedException;
import io.natator.protocol.SimulatorFailure;
import java.nio.file.Path;
import java.time.Duration;
import java.util.Arrays;
import java.util.List;
import java.util.Optional;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import java.util.stream.IntStream;

/**
 * What the simulator says about itself ({@code natator-sim info --json}).
 *
 * @param version        version of its source
 * @param commit         that it was built from, or {@code unknown}; null from a program that does not say
 * @param instructionSet kernels that it uses on this processor
 * @param devices        GPUs, by number
 * @param scenes         names of the scenes that come with it
 * @param schemas        folder of the schemas of its files, for editors; null from a program that does not say
 */
@JsonIgnoreProperties(ignoreUnknown = true)
public record ProgramInfo(@JsonProperty(required = true) String version, String commit,
        @JsonProperty(required = true) String instructionSet, @JsonProperty(required = true) List<String> devices,
        List<String> scenes, String schemas) {

    /** Copies the scenes. */
    public ProgramInfo {
        scenes = scenes == null ? List.of() : List.copyOf(scenes);
    }

    private static final Duration TIMEOUT = Duration.ofSeconds(60);
    private static final Duration VERSION_TIMEOUT = Duration.ofSeconds(1);
    private static final Pattern VERSION = Pattern.compile("natator-sim (\\d[\\w.]*), ");

    /**
     * Asks the simulator about itself.
     *
     * @throws InvalidInputException    if it says something else
     * @throws RequestRejectedException if it cannot be run
     */
    public static ProgramInfo of(Path simulator) throws InterruptedException {
        try {
            return Json.parse(ask(simulator, List.of("info", "--json"), "itself"), ProgramInfo.class);
        } catch (JsonProcessingException e) {
            throw new InvalidInputException("simulator does not describe itself: " + Json.reason(e), e);
        }
    }

    /**
     * What {@code natator-sim --version} says of its version; null of a program that says none within a second.
     *
     * @throws RequestRejectedException if it fails, or does not start
     */
    static String version(Path simulator) throws InterruptedException {
        try (NativeProgram program = new NativeProgram(simulator, VERSION_TIMEOUT)) {
            NativeProgram.Output output = program.call(List.of("--version"), "", line -> {
            });
            Matcher said = VERSION.matcher(output.text());
            if (said.lookingAt()) {
                return said.group(1);
            }
            if (output.exitStatus() != 0) {
                throw new RequestRejectedException(simulator + " --version: exit status " + output.exitStatus(), false);
            }
            return null;
        } catch (SimulatorFailure e) {
            return null;
        }
    }

    /**
     * The numbers of GPUs that a choice means: {@code all}, or numbers with commas between them.
     *
     * @return at least one; 0 for {@code all} where there is none, which the simulator then says
     * @throws InvalidInputException if it is neither, or the GPUs are not all of one kind
     */
    public List<Integer> devices(String choice) {
        List<Integer> numbers;
        if (choice.equals("all")) {
            numbers = IntStream.range(0, Math.max(1, devices.size())).boxed().toList();
        } else if (choice.matches("\\d{1,4}(,\\d{1,4})*")) {
            numbers = Arrays.stream(choice.split(",")).map(Integer::valueOf).toList();
        } else {
            throw new InvalidInputException(
                    "--device is " + choice + "; expected a GPU's number, several with commas between them, or all");
        }
        List<String> kinds = numbers.stream().flatMap(number -> kind(number).stream()).distinct().toList();
        if (kinds.size() > 1) {
            throw new InvalidInputException(
                    "--device " + choice + " are GPUs of several kinds (" + String.join("; ", kinds)
                            + "), whose last digits differ; expected some of one kind");
        }
        return numbers;
    }

    /** A GPU's description, with its number. */
    public Optional<String> device(int number) {
        return devices.stream().filter(device -> device.startsWith(number + ":")).findFirst();
    }

    /** A GPU's description without its number. */
    public Optional<String> kind(int number) {
        return device(number).map(device -> device.substring(device.indexOf(':') + 1).strip());
    }

    /**
     * What {@code natator-sim info} writes.
     *
     * @param subject what is asked about, for the message
     * @throws RefusedSceneException    if it does not take that
     * @throws RequestRejectedException if it cannot be started, or fails
     */
    static String ask(Path simulator, List<String> arguments, String subject) throws InterruptedException {
        try (NativeProgram program = new NativeProgram(simulator, TIMEOUT)) {
            NativeProgram.Output output = program.call(arguments, "", line -> {
            });
            if (output.exitStatus() != ExitStatus.OK) {
                throw output.failure(subject);
            }
            return output.text();
        } catch (SimulatorFailure e) {
            throw new RequestRejectedException("no description of " + subject + ": " + e.getMessage(), false);
        }
    }
}
