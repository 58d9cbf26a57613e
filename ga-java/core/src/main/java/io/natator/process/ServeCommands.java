package io.natator.process;

import io.natator.config.Backend;
import io.natator.config.ExecutionSettings;
import io.natator.config.Json;
import io.natator.protocol.RequestRejectedException;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import io.natator.protocol.SimulationResult.Status;
import io.natator.protocol.SimulatorFailure;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;

/**
 * What processes are started by: the program itself, or the commands that were given instead of it. The next process is
 * that of the command that has failed least, and of these has the fewest running: so a machine that is away costs a
 * second attempt now and then. Programs that were given must swim as this one does, bit by bit. For several threads.
 */
final class ServeCommands {

    /** Simulated time of the swim that programs are compared by, s. */
    private static final double SAMPLE = 0.05;

    private final ExecutionSettings settings;
    private final List<Command> commands = new ArrayList<>();
    private Sample sample;

    /** A swim, and the hash of its end or null. */
    private record Sample(SimulationRequest request, String hash) {
    }

    /** One of them. Counts are guarded by the list of all. */
    static final class Command {
        private final List<String> words;
        private final String given;
        private int running;
        private int failures;

        private Command(List<String> words, String given) {
            this.words = words;
            this.given = given;
        }

        List<String> words() {
            return words;
        }

        @Override
        public String toString() {
            return given != null ? "--simulator-command \"" + given + "\"" : String.join(" ", words);
        }
    }

    ServeCommands(ExecutionSettings settings) {
        this.settings = settings;
        if (settings.commands().isEmpty()) {
            for (int device : settings.devices()) {
                commands.add(new Command(List.of(settings.simulator().toString(), "serve", "--backend",
                        settings.backend().argument(), "--device", "" + device), null));
            }
        }
        for (String line : settings.commands()) {
            commands.add(new Command(List.of("/bin/sh", "-c", line), line));
        }
    }

    /** All commands. */
    List<Command> all() {
        return List.copyOf(commands);
    }

    /**
     * Starts a process of any of them.
     *
     * @param avoided what has just failed, or null; another one is preferred to it
     * @param request of the kind that the process is for
     * @throws SimulatorFailure         if it cannot be compared with the others
     * @throws RequestRejectedException if it does not start, or its program swims otherwise than the others
     */
    ServeProcess startAny(ProcessGroup group, Command avoided, SimulationRequest request)
            throws SimulatorFailure, InterruptedException {
        Command command;
        synchronized (commands) {
            command = commands.stream()
                    .min(Comparator.comparing((Command each) -> each == avoided).thenComparing(each -> each.failures)
                            .thenComparing(each -> each.running))
                    .orElseThrow();
            command.running++;
        }
        try {
            return start(group, command, request);
        } catch (SimulatorFailure | InterruptedException | RuntimeException e) {
            ended(command, true);
            throw e;
        }
    }

    /**
     * Starts a process of one of them.
     *
     * @param request of the kind that the process is for
     * @throws SimulatorFailure         if it cannot be compared with the others
     * @throws RequestRejectedException if it does not start, or its program swims otherwise than the others
     */
    ServeProcess start(ProcessGroup group, Command command, SimulationRequest request)
            throws SimulatorFailure, InterruptedException {
        ServeProcess process = new ServeProcess(group, command);
        if (command.given != null) {
            compare(process, command, request);
        }
        return process;
    }

    /** To be told of the end of each process of any. */
    void ended(Command command, boolean failed) {
        synchronized (commands) {
            command.running--;
            command.failures += failed ? 1 : 0;
        }
    }

    private void compare(ServeProcess process, Command command, SimulationRequest request)
            throws SimulatorFailure, InterruptedException {
        boolean same = false;
        try {
            Sample expected = sampleOf(request);
            process.send(Json.line(expected.request) + "\n");
            SimulationResult result = process.receive(settings.timeout().toNanos());
            if (result.status() == Status.ERROR) {
                throw new RequestRejectedException(command + ": " + result.error(), true);
            }
            String hash = hashOf(expected, result);
            if (!hash.equals(result.hash())) {
                throw new RequestRejectedException(command + " swims otherwise than "
                        + (settings.backend() == Backend.CPU ? "this program" : "another") + " (hash " + result.hash()
                        + ", not " + hash + ", after " + SAMPLE + " s): another version, instruction set (NATATOR_ISA) "
                        + "or kind of GPU", true);
            }
            same = true;
        } finally {
            if (!same) {
                process.close();
            }
        }
    }

    /** The swim that all are compared by, a short one of the first that was asked for. */
    private synchronized Sample sampleOf(SimulationRequest request) throws SimulatorFailure, InterruptedException {
        if (sample == null) {
            SimulationRequest cut = request.withDuration(SAMPLE);
            String hash = null;
            if (settings.backend() == Backend.CPU) {
                try (ProcessEvaluator own = new ProcessEvaluator(settings)) {
                    SimulationResult result = own.evaluate(cut);
                    hash = result.hash();
                    if (hash == null) {
                        throw new SimulatorFailure("nothing to compare other programs with: " + result.error());
                    }
                }
            }
            sample = new Sample(cut, hash);
        }
        return sample;
    }

    /** What this machine's program comes to; with another backend than the processor, what was answered first. */
    private synchronized String hashOf(Sample expected, SimulationResult answer) {
        if (expected.hash != null) {
            return expected.hash;
        }
        if (sample.hash == null && answer.hash() != null) {
            sample = new Sample(expected.request, answer.hash());
        }
        return sample.hash == null ? "" : sample.hash;
    }
}
