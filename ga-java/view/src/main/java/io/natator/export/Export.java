package io.natator.export;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.config.FileErrors;
import io.natator.config.InvalidInputException;
import io.natator.config.Json;
import io.natator.stream.StreamFrame;
import io.natator.stream.StreamMessage;
import io.natator.stream.StreamOptions;
import io.natator.stream.StreamProcess;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.function.BiConsumer;

/** Simulates a swim once and writes every frame of it as it comes. */
public final class Export {

    /** Frames that the simulator may be ahead. */
    private static final int CREDIT = 2;
    /** What a {@code SCEN} says of the stream, not of the scene, and what files hold anyway. */
    private static final List<String> NOT_METADATA = List.of("protocol", "number", "restarted", "mass", "fluid");

    private final ExportFormat format;
    private final Path folder;
    private final boolean replace;
    private final ExportContent content;
    private final Python python;

    /**
     * What was written.
     *
     * @param frames their number
     * @param water  number of water particles in each, 0 of a format without them
     * @param solids number of other particles in each
     */
    public record Written(int frames, int water, int solids) {
    }

    /**
     * An export yet to be done.
     *
     * @param folder  which appears when it is done
     * @param replace whether an earlier export may be there
     * @param content what to write of the swim
     * @param python  for formats and surfaces that need it
     */
    public Export(ExportFormat format, Path folder, boolean replace, ExportContent content, Python python) {
        this.format = format;
        this.folder = folder;
        this.replace = replace;
        this.content = content;
        this.python = python;
    }

    /**
     * Simulates and writes.
     *
     * @param simulator the native program
     * @param options   a lossless stream with an end, with positions
     * @param source    further entries of {@code metadata.json}
     * @param onFrame   told the number and the distance of each frame
     * @throws InvalidInputException if the folder is occupied, the format does not hold what is wanted, a package of
     *                               Python is missing, or the program refuses the options
     * @throws UncheckedIOException  if a file cannot be written, or the simulation fails; the folder does not appear
     * @throws InterruptedException  if this virtual machine is shutting down
     */
    public Written write(Path simulator, StreamOptions options, ObjectNode source,
            BiConsumer<Long, Double> onFrame) throws InterruptedException {
        requirePackages();
        try (ExportFolder target = ExportFolder.begin(folder, replace);
                StreamProcess process = new StreamProcess(simulator, options)) {
            Written written = write(process, target.path(), source.deepCopy().put("every", options.every()), options.until(),
                    onFrame);
            target.commit();
            return written;
        } catch (IOException e) {
            throw new UncheckedIOException("no export to " + folder + ": " + FileErrors.whyNotMade(folder, e), e);
        }
    }

    private void requirePackages() throws InterruptedException {
        if (content.waterSurface() && !format.holdsWaterSurface()) {
            throw new InvalidInputException("--water-surface and --format " + format.text()
                    + ": expected a format that holds meshes of many shapes: vtp, ply, usd or usdc");
        }
        if (content.waterSurface()) {
            python.require("--water-surface", WaterSurface.MODULE, WaterSurface.MODULE);
        }
        if (format == ExportFormat.USDC) {
            python.require("--format usdc", "pxr.Sdf", "usd-core");
        }
    }

    private Written write(StreamProcess process, Path path, ObjectNode source, double duration, BiConsumer<Long, Double> onFrame)
            throws IOException {
        process.grant(CREDIT);
        StreamMessage.Scene scene = null;
        ExportContext swim = null;
        FrameWriter writer = null;
        int frames = 0;
        try {
            while (true) {
                StreamMessage message = process.next();
                if (message instanceof StreamMessage.Frame next) {
                    StreamFrame frame = next.decode();
                    if (writer == null) {
                        swim = ExportContext.of(next.scene(), frame, content, python);
                        writer = format.open(swim, path);
                    }
                    writer.frame(frame);
                    frames++;
                    onFrame.accept(frame.frame(), frame.distance());
                    process.grant(1);
                } else if (message instanceof StreamMessage.Scene first && scene == null) {
                    scene = first;
                } else if (message instanceof StreamMessage.Stop stop && stop.isEnd() && writer != null) {
                    writer.finish();
                    break;
                } else {
                    failUnlessGranted(message);
                }
            }
        } finally {
            if (writer != null) {
                writer.close();
            }
            if (swim != null && swim.hasWaterSurface()) {
                swim.waterSurface().close();
            }
        }
        ObjectNode metadata = metadata(scene, source, duration, frames);
        ArrayNode files = metadata.putArray(ExportFolder.FILES);
        ExportFolder.files(path).forEach(files::add);
        files.add(ExportFolder.METADATA);
        Files.writeString(path.resolve(ExportFolder.METADATA), Json.document(metadata));
        return new Written(frames, format.holdsParticles() && swim.hasWater() ? swim.water().size() : 0, swim.solids().size());
    }

    private static void failUnlessGranted(StreamMessage message) throws IOException {
        if (message instanceof StreamMessage.Answer answer && answer.ok()) {
            return;
        }
        throw new IOException(message == null ? "the simulator ended without a word"
                : message instanceof StreamMessage.Answer answer ? "the simulator refused: " + answer.error()
                : message instanceof StreamMessage.Stop stop ? "the simulation stopped: " + stop.json()
                : "the scene changed");
    }

    /** Where the swim comes from, what the numbers mean, and all that the simulator says of the scene. */
    private ObjectNode metadata(StreamMessage.Scene message, ObjectNode source, double duration, int frames) throws IOException {
        ObjectNode all = JsonNodeFactory.instance.objectNode();
        all.put("format", format.text()).setAll(source);
        all.put("frames", frames).put("water", content.water() && format.holdsParticles())
                .put("waterSurface", content.waterSurface());
        ObjectNode kinds = all.putObject("kinds");
        for (ParticleKind kind : ParticleKind.values()) {
            kinds.put("" + kind.ordinal(), kind.text());
        }
        JsonNode scene = Json.parse(message.json(), JsonNode.class);
        scene.properties().stream().filter(entry -> !NOT_METADATA.contains(entry.getKey()))
                .forEach(entry -> all.set(entry.getKey(), entry.getValue()));
        all.put("duration", duration);
        return all;
    }
}
