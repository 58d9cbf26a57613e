package io.natator.cli;

import io.natator.base.InvalidInputException;
import io.natator.body.Swimmer;
import io.natator.checkpoint.Controls;
import io.natator.checkpoint.StoredRun;
import io.natator.cli.Section.Topic;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.config.Limits;
import io.natator.flow.WaterCheck;
import io.natator.protocol.RequestRejectedException;
import io.natator.protocol.SimulationRequest;
import io.natator.run.ControlRuns;
import io.natator.run.EvolutionRun;
import java.io.UncheckedIOException;
import java.nio.file.Path;
import java.util.concurrent.Callable;
import picocli.CommandLine.Command;
import picocli.CommandLine.ExitCode;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Parameters;
import picocli.CommandLine.Spec;

/** {@code natator check}: whether a run's winner swims, by what should not. */
@Command(name = "check", mixinStandardHelpOptions = true,
        description = {"Runs a run's best gait from fresh starts beside its controls: resting muscles, vacuum, no "
            + "acceleration clamp (flex), half the time step, mirrored, on the other backend; and looks how much of the body "
            + "is in the water.",
            "Prints one verdict, and keeps all in RUN/check.json."},
        footer = {"", "Example:", "  natator check runs/creature-1-seed-1"})
final class CheckCommand implements Callable<Integer> {

    @Spec
    private CommandSpec spec;

    @Mixin
    private ExecutionOptions executionOptions;

    @Mixin
    private CacheOptions cacheOptions;

    @Section(Topic.EXTENT)
    @Option(names = "--starts", paramLabel = "K", defaultValue = "4",
            description = "Runs under each condition, from 2. Default: ${DEFAULT-VALUE}.")
    private int starts;

    @Parameters(paramLabel = "RUN", description = "Run folder.")
    private Path folder;

    @Override
    public Integer call() throws InterruptedException {
        Limits.checkSeveralStarts("--starts", starts);
        StoredRun run = StoredRun.in(folder);
        Swimmer swimmer = run.requiredBest().swimmer();
        EvolutionSettings settings = run.settings();
        ExecutionSettings execution = EvolutionRun.withTimeLimit(
                cacheOptions.in(executionOptions.execution(settings.budget().backend())), settings);
        run.checkUnchanged(execution.simulator());
        Controls controls = new ControlRuns(settings, execution, starts).of(swimmer);
        Controls all = controls.withUnderWater(underWater(SimulationRequest.of(0, settings, swimmer).withoutStops(),
                controls.duration(), execution));
        new ControlReport(spec.commandLine().getOut()).print(all);
        all.write(run.directory());
        return ExitCode.OK;
    }

    /** Halfway and at the end; null without water, and, with a warning, if that fails: the controls are worth having without. */
    private Double underWater(SimulationRequest request, double duration, ExecutionSettings execution) throws InterruptedException {
        try {
            return WaterCheck.shareUnderWater(request, duration / 2, execution);
        } catch (InvalidInputException | RequestRejectedException | UncheckedIOException e) {
            OneLineErrors.warn(spec.commandLine(), e.getMessage() + "; how much of the body is under water is left out");
            return null;
        }
    }
}
