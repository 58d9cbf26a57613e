package io.natator.cli;

import io.natator.cli.Section.Topic;
import io.natator.config.InvalidInputException;
import io.natator.file.OutputFile;
import io.natator.picture.From;
import io.natator.picture.PictureOptions;
import java.nio.file.Path;
import java.util.Locale;
import java.util.concurrent.Callable;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import picocli.CommandLine.Command;
import picocli.CommandLine.ExitCode;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

/** {@code natator picture}: a swim at one time as a PNG file. */
@Command(name = "picture", mixinStandardHelpOptions = true,
        description = {"Simulates a swim up to a time and draws it: the body in its water, with a scale. Needs no browser.",
            "Lengths are the same near and far, so that the scale holds for all of the picture."},
        customSynopsis = "natator picture [OPTIONS] RUN|SCENE",
        footer = {"", "Examples:",
            "  natator picture pool/eel --gait gait.json --at 1.5 -o eel.png",
            "  natator picture runs/one --from three-quarter --size 1200x800"})
final class PictureCommand implements Callable<Integer> {

    private static final Pattern SIZE = Pattern.compile("(\\d{1,6})x(\\d{1,6})");
    private static final int WIDTH = 1600;

    @Spec
    private CommandSpec spec;

    @Mixin
    private SceneChanges changes;

    @Mixin
    private SwimOptions swimOptions;

    @Section(Topic.SCENE)
    @Option(names = "--at", paramLabel = "SECONDS", description = "When, from 0 to the duration of the swim. Default: 1, or the "
            + "end of a shorter swim; 0 for a body at rest.")
    private Double at;

    @Section(Topic.OUTPUT)
    @Option(names = {"-o", "--output"}, paramLabel = "FILE", description = "Default: the scene's name and .png.")
    private Path output;

    @Section(Topic.OUTPUT)
    @Option(names = "--from", paramLabel = "WHERE", defaultValue = "side",
            description = "side, top, front or three-quarter. Default: ${DEFAULT-VALUE}.")
    private From from;

    @Section(Topic.OUTPUT)
    @Option(names = "--size", paramLabel = "WxH", description = "Pixels, " + PictureOptions.LEAST + " to " + PictureOptions.MOST
            + " each way. Default: " + WIDTH + " wide, as high as what is shown.")
    private String size;

    @Section(Topic.OUTPUT)
    @Option(names = "--no-water", description = "Only the body and its tank.")
    private boolean noWater;

    @Mixin
    private SimulatorOption simulatorOption;

    @Override
    public Integer call() throws InterruptedException {
        PictureOptions options = options();
        SwimSource swimmer = swimOptions.swimmer();
        Path file = output != null ? output : Path.of(swimmer.name() + ".png");
        if (!file.toString().toLowerCase(Locale.ROOT).endsWith(".png")) {
            throw new InvalidInputException("--output is " + file + "; expected a name that ends in .png");
        }
        OutputFile png = OutputFile.of(file);
        Path simulator = simulatorOption.path();
        DrawnSwim swim = swimmer.simulated(swimOptions.source(), simulator,
                () -> DrawnSwim.of(swimmer, changes.overrides(), changes.scheme(), at, options, simulator));
        png.write(swim.png());
        OneLineErrors.warn(spec.commandLine(), swimmer.changedScene(simulator));
        spec.commandLine().getOut().printf(Locale.ROOT, "%s: %d x %d pixels, at %.2f s%n", file, swim.picture().getWidth(),
                swim.picture().getHeight(), swim.time());
        return ExitCode.OK;
    }

    private PictureOptions options() {
        if (size == null) {
            return new PictureOptions(from, WIDTH, 0, !noWater);
        }
        Matcher numbers = SIZE.matcher(size);
        if (numbers.matches()) {
            int width = Integer.parseInt(numbers.group(1));
            int height = Integer.parseInt(numbers.group(2));
            if (Math.min(width, height) >= PictureOptions.LEAST && Math.max(width, height) <= PictureOptions.MOST) {
                return new PictureOptions(from, width, height, !noWater);
            }
        }
        throw new InvalidInputException("--size is " + size + "; expected pixels as 1200x800, each from "
                + PictureOptions.LEAST + " to " + PictureOptions.MOST);
    }
}
