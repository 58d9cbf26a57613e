package io.natator.cli;

import io.natator.base.InvalidInputException;
import io.natator.cli.Section.Topic;
import io.natator.config.FileErrors;
import io.natator.config.Json;
import java.io.IOException;
import java.io.PrintWriter;
import java.io.UncheckedIOException;
import java.nio.file.FileAlreadyExistsException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardOpenOption;
import java.util.concurrent.Callable;
import picocli.CommandLine.Command;
import picocli.CommandLine.ExitCode;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Parameters;
import picocli.CommandLine.Spec;

/** {@code natator new}: a file of one's own to begin with. */
@Command(name = "new", mixinStandardHelpOptions = true,
        description = {
                "Writes a scene, a creature or a gait to begin with, which runs as it is, and says what to try next.",
                "By its $schema, editors such as VS Code complete and explain every key of it."},
        footer = {"", "Examples:",
                "  natator new scene minnow",
                "  natator new gait minnow-gait --like minnow.json",
                "  natator new creature my-tuna --like open-water/tuna"})
final class NewCommand implements Callable<Integer> {

    private static final String SUFFIX = ".json";

    @Spec
    private CommandSpec spec;

    @Parameters(index = "0", paramLabel = "scene|creature|gait", description = "What the file is to describe.")
    private Kind kind;

    @Parameters(index = "1", paramLabel = "NAME", description = "Letters, digits, - and _.")
    private String name;

    @Section(Topic.SCENE)
    @Option(names = "--like", paramLabel = "SCENE",
            description = "A scene, by name or file, that is to be changed, whose "
                    + "creature is to be changed, or whose muscles are to be driven. Default: a fish in pool/water; for a gait, "
                    + "pool/eel.")
    private String like;

    @Section(Topic.OUTPUT)
    @Option(names = {"-o", "--output"}, paramLabel = "FILE",
            description = "Default: NAME.json. It must not be there yet.")
    private Path output;

    @Mixin
    private SimulatorOption simulator;

    /** What files describe. */
    enum Kind {
        SCENE, CREATURE, GAIT
    }

    @Override
    public Integer call() throws InterruptedException {
        if (!name.matches("[\\p{L}\\p{N}][\\p{L}\\p{M}\\p{N}_-]{0,63}")) {
            throw new InvalidInputException(
                    "NAME is " + name + "; expected at most 64 letters, digits, - and _, not beginning with - or _");
        }
        Path file = output == null ? Path.of(name + SUFFIX) : output;
        if (!file.toString().endsWith(SUFFIX)) {
            throw new InvalidInputException("--output is " + file + "; expected a name that ends in " + SUFFIX);
        }
        if (Files.exists(file)) {
            throw new InvalidInputException(occupied(file));
        }
        StartingFiles files = new StartingFiles(simulator.path());
        StartingFiles.StartingFile start = switch (kind) {
            case SCENE -> files.scene(name, like, file);
            case CREATURE -> files.creature(name, like, file);
            case GAIT -> files.gait(like, file);
        };
        write(file, Json.document(start.content()));
        PrintWriter out = spec.commandLine().getOut();
        out.println(file + ": a " + EnumNames.of(kind) + " to begin with. Next:");
        start.next().forEach(command -> out.println("  " + command));
        return ExitCode.OK;
    }

    private static void write(Path file, String content) {
        try {
            Files.writeString(file, content, StandardOpenOption.CREATE_NEW);
        } catch (FileAlreadyExistsException e) {
            throw new InvalidInputException(occupied(file), e);
        } catch (IOException e) {
            file.toFile().delete();
            throw new UncheckedIOException("cannot write " + file + ": " + FileErrors.whyNotMade(file, e), e);
        }
    }

    private static String occupied(Path file) {
        return file + " is already there; expected a new file, choose one by --output";
    }
}
