package io.natator.cli;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.cli.Section.Topic;
import io.natator.config.InvalidInputException;
import io.natator.config.MergePatch;
import io.natator.config.Numbers;
import io.natator.config.Scheme;
import io.natator.export.Export;
import io.natator.export.ExportContent;
import io.natator.export.ExportFormat;
import io.natator.export.Python;
import io.natator.stream.StreamField;
import io.natator.stream.StreamOptions;
import io.natator.verdict.Reproduction;
import java.nio.file.Path;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.TreeSet;
import java.util.concurrent.Callable;
import picocli.CommandLine.Command;
import picocli.CommandLine.ExitCode;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

/** {@code natator export}: a swim in the formats of other programs. */
@Command(name = "export", mixinStandardHelpOptions = true,
        description = {"Simulates a swim and writes it, frame by frame, for another program.",
            "vtp: ParaView; ply: Blender, a file for each frame; usd: USD as text, usdc: as binary; glb: glTF, bodies "
                + "alone with bones; csv: one table; npz: numpy. The folder appears when it is whole; metadata.json in "
                + "it says what was simulated."},
        customSynopsis = "natator export --format FORMAT [OPTIONS] RUN|SCENE",
        footer = {"", "Examples:",
            "  natator export --format vtp runs/creature-1-seed-1",
            "  natator export --format usd --gait gait.json --duration 2 thesis/creature-2"})
final class ExportCommand implements Callable<Integer> {

    @Spec
    private CommandSpec spec;

    @Mixin
    private SceneOptions sceneOptions;

    @Mixin
    private SwimOptions swimOptions;

    @Section(Topic.OUTPUT)
    @Option(names = "--format", required = true, paramLabel = "FORMAT", description = "vtp, ply, usd, usdc, glb, csv or npz. "
            + "usdc needs Python with usd-core (pip install usd-core).")
    private ExportFormat format;

    @Section(Topic.OUTPUT)
    @Option(names = "--output-dir", paramLabel = "DIR",
            description = "Default: RUN/export-FORMAT, or the scene's name and the format.")
    private Path outputDir;

    @Section(Topic.OUTPUT)
    @Option(names = "--force", description = "Replace an earlier export in the output folder.")
    private boolean force;

    @Section(Topic.OUTPUT)
    @Option(names = "--every", paramLabel = "N", defaultValue = "1",
            description = "Only every Nth frame, of 60 in a second for the thesis scenes. Default: ${DEFAULT-VALUE}.")
    private int every;

    @Section(Topic.OUTPUT)
    @Option(names = "--fields", paramLabel = "FIELD", split = ",", defaultValue = "position,velocity,density",
            description = "What to write of each particle: position (always), velocity, density. "
                    + "Default: ${DEFAULT-VALUE}.")
    private List<StreamField> fields;

    @Section(Topic.OUTPUT)
    @Option(names = "--no-water", description = "Leave out the water's particles.")
    private boolean noWater;

    @Section(Topic.OUTPUT)
    @Option(names = "--water-surface", description = "Also the water's surface, a mesh in every frame: vtp, ply, usd, "
            + "usdc. Needs Python with pysplashsurf (pip install pysplashsurf).")
    private boolean waterSurface;

    @Section(Topic.COMPUTING)
    @Option(names = "--python", paramLabel = "PROGRAM", defaultValue = "${env:NATATOR_PYTHON:-python3}",
            description = "A Python with what usdc and --water-surface need. Default: $NATATOR_PYTHON, else python3.")
    private String python;

    @Section(Topic.COMPUTING)
    @Option(names = "--precision", paramLabel = "PRECISION",
            description = "What the simulator computes in: float (default) or double. Files hold floats.")
    private String precision;

    @Mixin
    private SimulatorOption simulatorOption;

    @Override
    public Integer call() throws InterruptedException {
        if (every < 1) {
            throw new InvalidInputException("--every is " + every + "; expected a whole number from 1");
        }
        EachOnce.check("--fields", fields, StreamField::text);
        if (spec.commandLine().getParseResult().hasMatchedOption("--python") && format != ExportFormat.USDC && !waterSurface) {
            throw new InvalidInputException("--python and --format " + format.text()
                    + ": expected --format usdc or --water-surface with it, which alone need a Python");
        }
        Path simulator = simulatorOption.path();
        SwimSource swimmer = swimOptions.swimmer();
        return swimmer.simulated(swimOptions.source(), simulator, () -> export(swimmer, simulator));
    }

    private int export(SwimSource swimmer, Path simulator) throws InterruptedException {
        JsonNode overrides = MergePatch.both(swimmer.overrides(), sceneOptions.overrides());
        Scheme scheme = sceneOptions.scheme() != null ? sceneOptions.scheme() : swimmer.scheme();
        TreeSet<StreamField> wanted = new TreeSet<>(fields);
        wanted.add(StreamField.POSITION);
        StreamOptions options = StreamOptions
                .recording(swimmer.scene(), overrides, swimmer.gaitJson(),
                        swimmer.seconds(sceneOptions.duration(), overrides, simulator))
                .with(scheme, precision).withFields(List.copyOf(wanted)).withEvery(every);
        Path folder = outputDir != null ? outputDir : swimmer.run() != null
                ? swimmer.run().resolve("export-" + format.text()) : Path.of(swimmer.name() + "-" + format.text());
        Map<Long, Double> distances = new HashMap<>();
        Export.Written written = new Export(format, folder, force, new ExportContent(!noWater, waterSurface),
                new Python(python))
                .write(simulator, options, swimmer.described(), distances::put);
        Reproduction stored = swimmer.reproduction(simulator, sceneOptions.overrides(), sceneOptions.scheme(), precision);
        Double today = stored == null ? null : distances.get(stored.lastFrame());
        String difference = today == null ? null : stored.difference(today, 0);
        if (difference != null) {
            spec.commandLine().getErr().println(difference);
        } else {
            OneLineErrors.warn(spec.commandLine(), swimmer.changedScene(simulator));
        }
        spec.commandLine().getOut().printf(format.holdsParticles()
                ? "%s: %s of %d particles of water and %d others%n" : "%s: %s of bodies alone%n", folder,
                Numbers.count(written.frames(), "frame"), written.water(), written.solids());
        return ExitCode.OK;
    }
}
