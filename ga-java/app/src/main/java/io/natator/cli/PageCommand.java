package io.natator.cli;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.base.InvalidInputException;
import io.natator.base.MergePatch;
import io.natator.base.Numbers;
import io.natator.body.Swimmer;
import io.natator.checkpoint.GaitScore;
import io.natator.checkpoint.RunReader;
import io.natator.cli.Section.Topic;
import io.natator.file.OutputFile;
import io.natator.replay.LivePageHtml;
import io.natator.replay.Replay;
import io.natator.replay.ReplayHtml;
import io.natator.replay.ReplayRecorder;
import io.natator.stream.StreamFrame;
import io.natator.stream.StreamOptions;
import io.natator.verdict.WinnerFacts;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Set;
import java.util.concurrent.Callable;
import java.util.stream.Stream;
import picocli.CommandLine.Command;
import picocli.CommandLine.ExitCode;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Model.OptionSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Parameters;
import picocli.CommandLine.Spec;

/** {@code natator page}: swims to be looked at anywhere. */
@Command(name = "page", mixinStandardHelpOptions = true,
        description = {"Simulates the best swimmers and writes one HTML file that replays them, water and all.",
                "It opens from disk in any browser of today, and loads nothing from anywhere.",
                "With --live the file simulates a swimmer by itself, with sliders, and needs no RUN."},
        footer = {"", "Examples:",
                "  natator page runs/creature-1-seed-1 --output swim.html",
                "  natator page runs/one runs/two --best 3 --no-water",
                "  natator page --live --output live.html"})
final class PageCommand implements Callable<Integer> {

    private static final double MEGABYTE = 1e6;
    private static final Set<String> WITH_LIVE = Set.of("--live", "--output", "--force", "--title", "--simulator-path");

    @Spec
    private CommandSpec spec;

    @Mixin
    private SceneOptions sceneOptions;

    @Parameters(paramLabel = "RUN|SCENE", arity = "0..*", description = "Run folders of evolve, or scenes: names as "
            + "thesis/creature-1, or files.")
    private List<String> sources = List.of();

    @Option(names = "--live", description = "A page that simulates one of the bundled swimmers in the browser: gait, "
            + "stiffness and viscosity are its sliders. Takes --output, --force and --title alone.")
    private boolean live;

    @Section(Topic.SCENE)
    @Option(names = "--gait", paramLabel = "FILE",
            description = "A JSON file with a gait, or a run's best.json, for all of them. A scene without one is at rest.")
    private Path gait;

    @Section(Topic.SCENE)
    @Option(names = "--policy", paramLabel = "FILE",
            description = "A policy that was learned, which drives all of them.")
    private Path policy;

    @Section(Topic.SCENE)
    @Option(names = "--best", paramLabel = "N", defaultValue = "1",
            description = "So many different gaits of each run, the best first. Default: ${DEFAULT-VALUE}.")
    private int best;

    @Section(Topic.OUTPUT)
    @Option(names = {"-o", "--output"}, paramLabel = "FILE", defaultValue = "swim.html",
            description = "Default: ${DEFAULT-VALUE}.")
    private Path output;

    @Section(Topic.OUTPUT)
    @Option(names = "--force", description = "Replace the file if it is already there.")
    private boolean force;

    @Section(Topic.OUTPUT)
    @Option(names = "--title", paramLabel = "TEXT", description = "Of the page. Default: what swims.")
    private String title;

    @Section(Topic.OUTPUT)
    @Option(names = "--max-size", paramLabel = "MB", defaultValue = "10",
            description = "Leave frames out until the file is no larger. Default: ${DEFAULT-VALUE}.")
    private double maxSize;

    @Section(Topic.OUTPUT)
    @Option(names = "--no-water", description = "Only the body.")
    private boolean noWater;

    @Mixin
    private SimulatorOption simulatorOption;

    @Override
    public Integer call() throws InterruptedException {
        if (live) {
            return writeLive();
        }
        if (sources.isEmpty()) {
            throw new InvalidInputException("no RUN or SCENE is named; expected at least one, or --live");
        }
        if (best < 1 || best > 1 && gait != null) {
            throw new InvalidInputException(
                    "--best is " + best + "; expected a whole number from 1, and 1 with --gait");
        }
        if (!(maxSize * MEGABYTE >= 1) || Double.isInfinite(maxSize)) {
            throw new InvalidInputException(
                    "--max-size is " + maxSize + "; expected a number of megabytes from 0.000001");
        }
        OutputFile.check(output, "--output", force);
        Path simulator = simulatorOption.path();
        List<Replay> swims = new ArrayList<>();
        for (SwimSource swimmer : sources.stream().map(this::swimmers).flatMap(List::stream).toList()) {
            swims.add(recorded(swimmer, simulator));
        }
        String heading = title != null ? title : swims.size() == 1 ? swims.get(0).title() : "Swimmers";
        ReplayHtml.Written written = new ReplayHtml(heading, swims, !noWater).write(output,
                (long) (maxSize * MEGABYTE));
        String precision = written.largestError() > 0
                ? String.format(Locale.ROOT, "water to %.0e of a length unit", written.largestError())
                : !noWater && swims.stream().anyMatch(swim -> !swim.waters().isEmpty()) ? "with the wake" : "no water";
        spec.commandLine().getOut().printf(Locale.ROOT, "%s: %.1f MB, %.0f frames a second%s, %s%n", output,
                written.bytes() / MEGABYTE, written.framesPerSecond(),
                written.isReduced() ? " (fewer than simulated, to stay under --max-size)" : "", precision);
        return ExitCode.OK;
    }

    private int writeLive() throws InterruptedException {
        List<String> given = Stream
                .concat(sources.stream(), spec.commandLine().getParseResult().matchedOptions().stream()
                        .map(OptionSpec::longestName).filter(name -> !WITH_LIVE.contains(name)))
                .toList();
        if (!given.isEmpty()) {
            throw new InvalidInputException(
                    "--live with " + given.get(0) + "; expected --output, --force and --title beside it at most");
        }
        OutputFile.check(output, "--output", force);
        long bytes = LivePageHtml.write(simulatorOption.path(),
                title != null ? title : "A swimmer of Natator", output);
        spec.commandLine().getOut().printf(Locale.ROOT, "%s: %.1f MB%n", output, bytes / MEGABYTE);
        return ExitCode.OK;
    }

    /** The best of a run, and with {@code --best} those after it. */
    private List<SwimSource> swimmers(String source) {
        SwimSource first = SwimSource.of(source, gait);
        if (best == 1) {
            return List.of(first);
        }
        if (first.run() == null) {
            throw new InvalidInputException(
                    "--best is " + best + "; expected 1 with " + source + ", which is no run folder");
        }
        RunReader run = RunReader.in(first.run());
        List<Swimmer> gaits = run.gaits().stream().map(GaitScore::swimmer).distinct().limit(best).toList();
        if (gaits.size() < best) {
            throw new InvalidInputException(
                    "--best is " + best + "; " + source + " knows " + Numbers.count(gaits.size(), "gait"));
        }
        return gaits.stream().map(one -> SwimSource.of(run, one, one.equals(run.best().swimmer()) ? run.best() : null))
                .toList();
    }

    private Replay recorded(SwimSource swimmer, Path simulator) throws InterruptedException {
        JsonNode overrides = MergePatch.both(swimmer.overrides(), sceneOptions.overrides());
        StreamOptions options = StreamOptions.recording(swimmer.scene(), overrides, swimmer.gaitJson(),
                swimmer.seconds(sceneOptions.duration(), overrides, simulator))
                .with(sceneOptions.scheme() != null ? sceneOptions.scheme() : swimmer.scheme(), null)
                .withPolicy(policy);
        Replay swim = new ReplayRecorder(simulator).record(swimmer.name(), options);
        StreamFrame last = swim.frames().get(swim.frames().size() - 1);
        boolean asStored = swimmer.best() != null && sceneOptions.overrides() == null && sceneOptions.scheme() == null;
        String name = swimmer.run() == null ? swimmer.name()
                : swimmer.run().toAbsolutePath().normalize().getFileName() + "";
        return swim.with(name + ": " + Numbers.fixed(last.distance(), 3) + " units in " + Numbers.fixed(last.time(), 2)
                + " s", asStored ? WinnerFacts.of(swimmer.run(), swimmer.best()) : Map.of());
    }
}
