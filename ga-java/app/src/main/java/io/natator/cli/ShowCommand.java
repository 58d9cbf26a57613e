package io.natator.cli;

import io.natator.base.Numbers;
import io.natator.checkpoint.Controls;
import io.natator.checkpoint.Convergence;
import io.natator.checkpoint.EvaluationStatistics;
import io.natator.checkpoint.RunReader;
import io.natator.checkpoint.VacuumRecord;
import io.natator.cli.Section.Topic;
import io.natator.config.Budget;
import io.natator.config.EvolutionSettings;
import io.natator.config.Evolved;
import io.natator.config.FitnessKind;
import io.natator.config.Json;
import io.natator.config.WeightedObjective;
import io.natator.evolution.EvaluationRecord;
import io.natator.evolution.GenerationSummary;
import io.natator.evolution.Individual;
import io.natator.evolution.RecordedEvaluations;
import io.natator.file.ShellWord;
import io.natator.protocol.SimulationResult;
import io.natator.verdict.ControlVerdict;
import io.natator.verdict.ConvergenceText;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Path;
import java.util.List;
import java.util.Locale;
import java.util.concurrent.Callable;
import java.util.stream.Collectors;
import picocli.CommandLine.Command;
import picocli.CommandLine.ExitCode;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Parameters;
import picocli.CommandLine.Spec;

/** {@code natator show}: what is in a run folder. */
@Command(name = "show", mixinStandardHelpOptions = true,
        description = "Shows a run: settings, how far it is, its best gait, what it saved and what failed.")
final class ShowCommand implements Callable<Integer> {

    @Spec
    private CommandSpec spec;

    @Parameters(paramLabel = "RUN", description = "Run folder.")
    private Path folder;

    @Section(Topic.OUTPUT)
    @Option(names = "--json", description = "As a line of JSON for programs: what python -m natator report draws.")
    private boolean json;

    @Option(names = "--generation", paramLabel = "N",
            description = "Only the best gait of the generations up to N, and its body, "
                    + "as JSON: --gait of other commands takes it.")
    private Integer generation;

    @Override
    public Integer call() throws InterruptedException {
        StringWriter whole = new StringWriter();  // of what is refused meanwhile nothing is printed
        PrintWriter out = new PrintWriter(whole);
        if (generation == null) {
            print(out);
        } else {
            out.println(Json.line(SwimSource.bestUntil(generation, RunReader.in(folder))).strip());
        }
        spec.commandLine().getOut().print(whole);
        spec.commandLine().getOut().flush();
        return ExitCode.OK;
    }

    private void print(PrintWriter out) {
        RunReader run = RunReader.in(folder);
        RunDocument document = json ? new RunDocument(run) : null;
        OneLineErrors.warn(spec.commandLine(), run.damage());
        if (document != null) {
            out.println(document.json());
            return;
        }
        Controls controls = run.best() == null ? null : Controls.of(run.directory(), run.best().swimmer());
        Convergence convergence = run.best() == null ? null : Convergence.of(run.directory(), run.best().swimmer());
        out.println(settings(run.settings()));
        out.println(progress(run));
        if (run.state() != null) {
            new RunReport(out).print(run.settings(), run.state(), run.best(), run.directory());
            if (controls != null) {
                out.println("  checked     " + ControlVerdict.of(controls, convergence).text());
            }
            if (convergence != null) {
                out.println("  finer steps " + ConvergenceText.of(convergence));
            }
            printFront(run, out);
            if (run.elites() != null) {
                out.printf(
                        "map of gaits: the best of %s; natator view --run %s swims them, python -m natator report draws them%n",
                        Numbers.count(run.elites().moving().size(), "kind"), ShellWord.of(run.directory()));
            }
            printSavings(run, out);
        }
        printVacuum(run.vacuum(), out);
        printFailures(run.evaluations(), out);
    }

    /** On one line, what makes a run another one. */
    static String settings(EvolutionSettings settings) {
        StringBuilder text = new StringBuilder(settings.problem().scene());
        text.append(", ").append(EnumNames.of(settings.search().optimizer()))
                .append(settings.search().optimizer().usesOperators()
                        ? " (" + EnumNames.of(settings.search().operators()) + " operators)" : "");
        text.append(", population ").append(settings.search().population());
        if (settings.budget().generations() != Budget.NO_LIMIT) {
            text.append(", ").append(Numbers.count(settings.budget().generations(), "generation"));
        }
        if (settings.budget().evaluations() != null) {
            text.append(", ").append(Numbers.count(settings.budget().evaluations(), "evaluation"));
        }
        text.append(settings.problem().evolve() == null ? ""
                : settings.problem().evolve().what() == Evolved.BODY ? ", bodies with one gait" : ", gaits and bodies");
        text.append(", seed ").append(settings.search().seed());
        text.append(", ").append(EnumNames.of(settings.problem().encoding())).append(" genes");
        if (settings.search().optimizer().usesOperators() && settings.search().gaussianDeviation() != 0.05) {
            text.append(", Gaussian deviation ").append(settings.search().gaussianDeviation());
        }
        text.append(settings.search().starts() == 1 ? ""
                : ", " + EnumNames.of(settings.search().judge()) + " of " + settings.search().starts() + " starts");
        text.append(settings.problem().objectives() == null ? ""
                : ", objectives " + WeightedObjective.text(settings.problem().objectives()));
        text.append(settings.problem().fitness() == FitnessKind.NET ? ", net fitness" : "");
        text.append(", backend ").append(settings.budget().backend().argument());
        text.append(settings.problem().scheme() == null ? "" : ", scheme " + EnumNames.of(settings.problem().scheme()));
        text.append(settings.problem().duration() == null ? "" : ", " + settings.problem().duration() + " s");
        text.append(settings.problem().overrides() == null ? "" : ", overrides " + settings.problem().overrides());
        return text.toString();
    }

    private String progress(RunReader run) {
        String how = "; continue by: " + Main.asCalled() + " resume " + ShellWord.of(folder);
        if (run.state() == null) {
            return withoutCheckpoint(run.recorded()) + how;
        }
        GenerationSummary last = run.state().history().get(run.state().generation());
        long more = Math.max(run.recorded().end() - run.state().evaluations(), 0);
        return String.format("generation %d: best %s, mean %s, median %s; %s", last.generation(),
                run.settings().problem().worthText(last.best()), run.settings().problem().worthText(last.mean()),
                run.settings().problem().worthText(last.median()), run.state().isLastOf(run.settings()) ? "finished"
                        : "not finished, " + Numbers.count(more, "evaluation") + " of the next" + how);
    }

    /** How far a run without a checkpoint is: it has none yet, or has lost it. */
    private static String withoutCheckpoint(RecordedEvaluations recorded) {
        long first = recorded.rows().stream().filter(one -> one.generation() == 0).count();
        return recorded.end() > first
                ? "no checkpoint.json, " + Numbers.count(recorded.end(), "evaluation") + " of several generations"
                : "no generation finished, " + Numbers.count(first, "evaluation") + " of the first";
    }

    /** What no other gait is better than in all objectives. */
    private static void printFront(RunReader run, PrintWriter out) {
        List<Individual> front = run.front();
        if (front.isEmpty()) {
            return;
        }
        out.println("of several objectives, the gaits that no other is better than in all");
        out.println("  " + run.settings().problem().objectives().stream()
                .map(one -> String.format("%-14s", EnumNames.of(one.objective())))
                .collect(Collectors.joining()) + "runs  genes");
        for (Individual one : front) {
            out.println("  " + one.objectives().stream().map(value -> String.format("%-14s", Numbers.worth(value)))
                    .collect(Collectors.joining()) + String.format("%-6d", one.runs()) + RunReport.row(one.genes()));
        }
    }

    private static void printSavings(RunReader run, PrintWriter out) {
        EvaluationStatistics statistics = run.statistics();
        if (statistics != null) {
            out.println("not simulated");
            out.printf(Locale.ROOT, "  early stop  %.1f %% of the time: %d of %s ended early, as if %.0f "
                    + "had not been made%n", 100 * statistics.shareOfEarlyStops(), statistics.stoppedEarly(),
                    Numbers.count(statistics.simulations(), "evaluation"),
                    statistics.shareOfEarlyStops() * statistics.simulations());
            out.printf("  unchanged   %s, evaluated in an earlier generation%n",
                    Numbers.count(statistics.unchanged(), "chromosome"));
            out.printf("  cache       %s, made by an earlier run%n",
                    Numbers.count(statistics.fromCache(), "evaluation"));
        }
    }

    private static void printVacuum(List<VacuumRecord> records, PrintWriter out) {
        for (VacuumRecord record : records) {
            out.printf(Locale.ROOT, "generation %d, evaluation %d: %s in %.2f s, in vacuum %s%n",
                    record.generation(), record.evaluation(), RunReport.number(record.distance()), record.simulated(),
                    record.drift() == null ? "no result" : RunReport.number(record.drift()));
        }
    }

    private static void printFailures(List<EvaluationRecord> evaluations, PrintWriter out) {
        print(SimulationResult.Status.FAILED, "evaluations failed", evaluations, out);
        print(SimulationResult.Status.REFUSED, "bodies refused", evaluations, out);
    }

    private static void print(SimulationResult.Status status, String what, List<EvaluationRecord> evaluations,
            PrintWriter out) {
        List<SimulationResult> found = evaluations.stream().map(EvaluationRecord::result)
                .filter(result -> result.status() == status).toList();
        if (!found.isEmpty()) {
            out.printf("%d of %d %s, the last, %d: %s%n", found.size(), evaluations.size(), what,
                    found.get(found.size() - 1).id(), found.get(found.size() - 1).error());
        }
    }
}
