package io.natator.cli;

import io.natator.base.InvalidInputException;
import io.natator.checkpoint.RunReader;
import io.natator.cli.Section.Topic;
import io.natator.compare.RunComparison;
import io.natator.config.Backend;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.config.Limits;
import io.natator.file.OutputFile;
import io.natator.process.Evaluator;
import io.natator.run.EvolutionRun;
import io.natator.verdict.FreshText;
import io.natator.verdict.Verdict;
import java.io.PrintWriter;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.concurrent.Callable;
import picocli.CommandLine.Command;
import picocli.CommandLine.ExitCode;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Parameters;
import picocli.CommandLine.Spec;

/** {@code natator compare}: runs side by side. */
@Command(name = "compare", mixinStandardHelpOptions = true,
        description = {
                "Sets runs side by side: settings, best fitness after the same number of evaluations, best gaits.",
                "Then runs the best gaits from fresh starts, and compares them after equal numbers of evaluations and after equal "
                        + "simulated time: medians with intervals, a rank test, an effect size. Runs that differ only in their seeds stand "
                        + "together."},
        footer = {"", "Example:", "  natator compare runs/one runs/two"})
final class CompareCommand implements Callable<Integer> {

    private static final int STEPS = 5;

    @Spec
    private CommandSpec spec;

    @Mixin
    private CachedExecutionOptions executionOptions;

    @Section(Topic.EXTENT)
    @Option(names = "--starts", paramLabel = "N", defaultValue = "8",
            description = "Fresh starts of each best gait, from 2; 0: nothing is run. Default: ${DEFAULT-VALUE}.")
    private int starts;

    @Section(Topic.OUTPUT)
    @Option(names = "--json", paramLabel = "FILE",
            description = "Also write a line of JSON for each run: settings, course, winner, and "
                    + "what its best gaits at a tenth, a quarter, half and all of the budgets were worth from the fresh starts.")
    private Path json;

    @Section(Topic.OUTPUT)
    @Option(names = "--force", description = "Replace the file of --json if it is already there.")
    private boolean force;

    @Section(Topic.EXTENT)
    @Option(names = "--rank-starts", paramLabel = "N",
            description = "For --json: run all gaits of each last generation from so many fresh starts, from 1, too.")
    private Integer rankStarts;

    @Parameters(paramLabel = "RUN", arity = "2..*", description = "Run folders, at least two.")
    private List<Path> folders;

    @Override
    public Integer call() throws InterruptedException {
        if (starts != 0 && starts < 2 || starts > Limits.STARTS) {
            throw new InvalidInputException(
                    "--starts is " + starts + "; expected 0, or a whole number from 2 to " + Limits.STARTS);
        }
        if (rankStarts != null) {
            Limits.checkCount("--rank-starts", rankStarts, Limits.STARTS);
        }
        if (json == null && (rankStarts != null || force)) {
            throw new InvalidInputException(
                    (force ? "--force" : "--rank-starts") + " goes with --json; give both");
        }
        if (json != null && starts == 0) {
            throw new InvalidInputException("--json goes without --starts 0; leave one of them out");
        }
        List<RunReader> runs = folders.stream().map(RunReader::in).toList();
        RejectRepeated.checkFolders("RUN", folders);
        if (json != null) {
            OutputFile.check(json, "--json", force);
        }
        if (starts > 0) {
            Path simulator = executionOptions.execution(Backend.CPU).simulator();
            for (RunReader run : runs) {
                run.checkUnchanged(simulator);
            }
        }
        PrintWriter out = spec.commandLine().getOut();
        for (int i = 0; i < runs.size(); i++) {
            out.printf("%d  %s: %s%n", i + 1, runs.get(i).directory(), ShowCommand.settings(runs.get(i).settings()));
        }
        printCurves(runs, out);
        printBests(runs, out);
        out.flush();
        if (starts > 0) {
            runAgain(runs.stream().map(RunReader::settings).toList(), out);
            out.flush();
        }
        return ExitCode.OK;
    }

    private void runAgain(List<EvolutionSettings> settings, PrintWriter out) throws InterruptedException {
        Backend backend = settings.stream().map(one -> one.budget().backend()).distinct().count() == 1
                ? settings.get(0).budget().backend() : Backend.CPU;
        ExecutionSettings execution = EvolutionRun.withTimeLimit(executionOptions.execution(backend), settings);
        RunComparison comparison = new RunComparison(folders, starts, json != null);
        PrintWriter err = spec.commandLine().getErr();
        err.println("running " + comparison.swims() + " swims from fresh starts; --starts 0 leaves that out");
        err.flush();
        try (Evaluator evaluator = EvolutionRun.open(execution)) {
            comparison.run(evaluator, execution.simulator());
            if (json != null) {
                String lines = String.join("\n",
                        comparison.json(rankStarts == null ? 0 : rankStarts, evaluator, execution.simulator())) + "\n";
                OutputFile.write(json, lines.getBytes(StandardCharsets.UTF_8));
            }
        }
        comparison.lines().forEach(out::println);
    }

    private static void printCurves(List<RunReader> runs, PrintWriter out) {
        List<double[]> curves = runs.stream().map(RunReader::bestWorth).toList();
        int common = curves.stream().mapToInt(curve -> curve.length).min().orElse(0);
        out.print("evaluations");
        for (int i = 1; i <= runs.size(); i++) {
            out.printf("%12s", "best " + i);
        }
        out.println();
        for (int step = 1; step <= STEPS && common >= STEPS; step++) {
            int place = (int) ((long) common * step / STEPS);
            printRow(place, runs, curves, out);
        }
        int longest = curves.stream().mapToInt(curve -> curve.length).max().orElse(0);
        if (longest > common) {
            printRow(longest, runs, curves, out);
        }
    }

    /** Runs that are not so long, or have no gait as yet, have no number there. */
    private static void printRow(int place, List<RunReader> runs, List<double[]> curves, PrintWriter out) {
        out.printf("%11d", place);
        for (int i = 0; i < runs.size(); i++) {
            double[] curve = curves.get(i);
            out.printf("%12s", curve.length < place || Double.isNaN(curve[place - 1]) ? ""
                    : runs.get(i).settings().problem().worthText(curve[place - 1]));
        }
        out.println();
    }

    private static void printBests(List<RunReader> runs, PrintWriter out) {
        for (int i = 0; i < runs.size(); i++) {
            var best = runs.get(i).best();
            if (best == null) {
                out.printf("%d  no gait as yet%n", i + 1);
            } else {
                Map<String, String> fresh = FreshText.of(best);
                out.printf("%d  %s%n   distance %s, speed %s%s, f %s, a %s, phi %s%s%n", i + 1, Verdict.of(best).text(),
                        fresh.getOrDefault("distance", RunReport.number(best.distance()) + ", one run"),
                        fresh.getOrDefault("speed", RunReport.number(best.speed()) + " units/s"),
                        best.vacuum() == null || best.vacuum().distance() == null ? ""
                                : ", in vacuum " + RunReport.number(best.vacuum().speed()) + " units/s",
                        RunReport.number(best.gait().frequency()), RunReport.row(best.gait().amplitude()),
                        RunReport.row(best.gait().phase()),
                        best.gait().offset() == null ? "" : ", offset " + RunReport.row(best.gait().offset()));
                List.of("half step", "selected").stream().filter(fresh::containsKey)
                        .forEach(name -> out.printf("   %s %s%n", name, fresh.get(name)));
            }
        }
    }
}
