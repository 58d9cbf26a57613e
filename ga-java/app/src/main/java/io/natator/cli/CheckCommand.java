package io.natator.cli;

import io.natator.base.InvalidInputException;
import io.natator.base.Numbers;
import io.natator.body.Swimmer;
import io.natator.checkpoint.Controls;
import io.natator.checkpoint.Convergence;
import io.natator.checkpoint.RunReader;
import io.natator.checkpoint.SwimSample;
import io.natator.cli.Section.Topic;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.config.Limits;
import io.natator.process.Snapshot;
import io.natator.protocol.RequestRejectedException;
import io.natator.protocol.SimulationRequest;
import io.natator.run.ControlRuns;
import io.natator.run.EvolutionRun;
import io.natator.verdict.ControlVerdict;
import java.io.PrintWriter;
import java.io.UncheckedIOException;
import java.nio.file.Path;
import java.util.concurrent.Callable;
import java.util.stream.Collectors;
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
    private CachedExecutionOptions executionOptions;

    @Section(Topic.EXTENT)
    @Option(names = "--starts", paramLabel = "K", defaultValue = "4",
            description = "Runs under each condition, from 2. Default: ${DEFAULT-VALUE}.")
    private int starts;

    @Parameters(paramLabel = "RUN", description = "Run folder.")
    private Path folder;

    @Override
    public Integer call() throws InterruptedException {
        Limits.checkSeveralStarts("--starts", starts);
        RunReader run = RunReader.in(folder);
        Swimmer swimmer = run.requiredBest().swimmer();
        EvolutionSettings settings = run.settings();
        ExecutionSettings execution = EvolutionRun
                .withTimeLimit(executionOptions.execution(settings.budget().backend()), settings);
        run.checkUnchanged(execution.simulator());
        Controls controls = new ControlRuns(settings, execution, starts).of(swimmer);
        Controls all = controls.withUnderWater(underWater(SimulationRequest.of(0, settings, swimmer).withoutStops(),
                controls.duration(), execution));
        print(all, Convergence.of(run.directory(), swimmer), spec.commandLine().getOut());
        all.write(run.directory());
        return ExitCode.OK;
    }

    /** Halfway and at the end; null without water, and, with a warning, if that fails: the controls are worth having without. */
    private Double underWater(SimulationRequest request, double duration, ExecutionSettings execution)
            throws InterruptedException {
        try {
            Double halfway = Snapshot.of(request, duration / 2, execution).shareUnderWater();
            Double end = Snapshot.of(request, null, execution).shareUnderWater();
            return halfway == null || end == null ? null : Double.valueOf((halfway + end) / 2);
        } catch (InvalidInputException | RequestRejectedException | UncheckedIOException e) {
            OneLineErrors.warn(spec.commandLine(),
                    e.getMessage() + "; how much of the body is under water is left out");
            return null;
        }
    }

    /** Prints the table of controls and the verdict. */
    private void print(Controls controls, Convergence convergence, PrintWriter out) {
        out.printf("%-26s%-22s%s%n", "distance in " + Numbers.fixed(controls.duration(), 2) + " s", "mean ± sd",
                "runs");
        line("in water", controls.water(), out);
        line("with resting muscles", controls.resting(), out);
        line("in vacuum", controls.vacuum(), out);
        if (controls.clampOff() != null) {
            line("no acceleration clamp", controls.clampOff(), out);
        }
        line("half the time step", controls.halfStep(), out);
        line("mirrored", controls.mirrored(), out);
        if (controls.otherBackend() == null) {
            out.printf("%-26s%s%n", "other backend", "not tried: this machine has no GPU, or the program does none");
        } else {
            line("on " + controls.backend(), controls.otherBackend(), out);
        }
        if (controls.underWater() != null) {
            out.printf("%-26s%s %% of the body%n", "under water", Numbers.fixed(100 * controls.underWater(), 0));
        }
        if (convergence == null || convergence.halfSpacing() == null) {
            out.printf("%-26s%s%n", "half the spacing", "not tried: natator converge " + folder);
        }
        out.println("verdict: " + ControlVerdict.of(controls, convergence).text());
        out.flush();
    }

    private static void line(String what, SwimSample sample, PrintWriter out) {
        String ends = sample.stopped().entrySet().stream().map(one -> one.getValue() + " " + one.getKey())
                .collect(Collectors.joining(", "));
        out.printf("%-26s%-22s%s%n", what,
                Numbers.withError(sample.distance().mean(), sample.distance().sd(), RunReport.DIGITS), ends);
    }
}
