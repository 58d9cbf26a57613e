package io.natator.cli;

import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.JsonNode;
import io.natator.body.Swimmer;
import io.natator.checkpoint.Convergence;
import io.natator.checkpoint.RunReader;
import io.natator.cli.Section.Topic;
import io.natator.config.Backend;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.config.Limits;
import io.natator.process.ConvergeProgram;
import io.natator.protocol.FinerLevel;
import io.natator.protocol.RequestRejectedException;
import io.natator.protocol.SimulationRequest;
import io.natator.run.EvolutionRun;
import io.natator.verdict.ConvergenceText;
import java.io.PrintWriter;
import java.nio.file.Path;
import java.util.List;
import java.util.concurrent.Callable;
import picocli.CommandLine.Command;
import picocli.CommandLine.ExitCode;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Parameters;
import picocli.CommandLine.Spec;

/** {@code natator converge}: how far the speed of a run's winner depends on time step and spacing. */
@Command(name = "converge", mixinStandardHelpOptions = true,
        description = {
                "Runs a run's best gait as it was evolved, at half the time step and at half the spacing of the particles, "
                        + "body and motion kept, and tells what its speed goes to, with an error bar.",
                "Keeps what it found in RUN/converge.json, each run in RUN/converge.jsonl: the same command goes on after a kill, and "
                        + "does not do again what is there."},
        footer = {"", "Example:", "  natator converge runs/creature-1-seed-1"})
final class ConvergeCommand implements Callable<Integer> {

    @Spec
    private CommandSpec spec;

    @Section(Topic.EXTENT)
    @Option(names = "--starts", paramLabel = "K", defaultValue = "4",
            description = "Perturbed starts at each level, from 2. Default: ${DEFAULT-VALUE}.")
    private int starts;

    @Section(Topic.EXTENT)
    @Option(names = "--levels", paramLabel = "LEVEL", split = ",", defaultValue = "time/2,spacing/2",
            description = "Of time/2, time/4, spacing/2 and both/2, beside the run's own. Default: ${DEFAULT-VALUE}.")
    private List<String> levels;

    @Section(Topic.COMPUTING)
    @Option(names = "--backend", paramLabel = "BACKEND",
            description = "cpu, cuda (a GPU), or auto (a GPU where there is one). Default: the run's.")
    private Backend backend;

    @Mixin
    private SimulatorOption simulator;

    @Parameters(paramLabel = "RUN", description = "Run folder.")
    private Path folder;

    @Override
    public Integer call() throws InterruptedException {
        Limits.checkSeveralStarts("--starts", starts);
        List<FinerLevel> finer = levels.stream().map(FinerLevel::of).toList();
        RunReader run = RunReader.in(folder);
        Swimmer swimmer = run.requiredBest().swimmer();
        EvolutionSettings settings = run.settings();
        ExecutionSettings execution = EvolutionRun.withTimeLimit(ExecutionSettings.of(simulator.path())
                .withBackend(backend != null ? backend : settings.budget().backend()), settings);
        run.checkUnchanged(execution.simulator());
        PrintWriter out = spec.commandLine().getOut();
        // The table is a result, the runs are progress.
        JsonNode answer = new ConvergeProgram(execution).of(SimulationRequest.of(0, settings, swimmer), starts, finer,
                Convergence.runs(run.directory()), spec.commandLine().getErr()::println, out::println);
        try {
            out.println(ConvergenceText.of(Convergence.write(run.directory(), swimmer, answer)));
        } catch (JsonProcessingException e) {
            throw new RequestRejectedException("converge: unexpected answer", false);
        }
        out.flush();
        return ExitCode.OK;
    }
}
