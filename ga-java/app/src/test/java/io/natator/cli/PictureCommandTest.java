package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import java.awt.image.BufferedImage;
import java.io.IOException;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import javax.imageio.ImageIO;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import picocli.CommandLine;

/** {@code natator picture} with the real simulator. */
class PictureCommandTest {

    @TempDir
    private Path folder;
    private final StringWriter out = new StringWriter();
    private final StringWriter err = new StringWriter();

    private int picture(Path file, String... arguments) {
        List<String> all = new ArrayList<>(List.of("picture", "--simulator-path",
                Path.of(System.getProperty("natator.simulator")).normalize().toString(), "-o", file.toString()));
        all.addAll(List.of(arguments));
        return Main.commandLine().setOut(new PrintWriter(out, true)).setErr(new PrintWriter(err, true))
                .execute(all.toArray(String[]::new));
    }

    private static int different(BufferedImage one, BufferedImage other) {
        int count = 0;
        for (int y = 0; y < one.getHeight(); y++) {
            for (int x = 0; x < one.getWidth(); x++) {
                count += one.getRGB(x, y) == other.getRGB(x, y) ? 0 : 1;
            }
        }
        return count;
    }

    @Test
    void aSwimIsDrawnAtItsTime() throws IOException {
        Path gait = Files.writeString(folder.resolve("gait.json"),
                "{\"frequency\":2,\"amplitude\":[1,1],\"phase\":[0,0.75]}");
        BufferedImage[] pictures = new BufferedImage[2];
        for (int i = 0; i < 2; i++) {
            Path file = folder.resolve(i + ".png");
            assertThat(picture(file, "bench/small-tank", "--gait", gait.toString(), "--at", i == 0 ? "0" : "0.2", "--size",
                    "320x200")).as(err.toString()).isZero();
            pictures[i] = ImageIO.read(file.toFile());
            assertThat(List.of(pictures[i].getWidth(), pictures[i].getHeight())).isEqualTo(List.of(320, 200));
        }
        assertThat(out.toString().lines()).containsExactly(folder.resolve("0.png") + ": 320 x 200 pixels, at 0.00 s",
                folder.resolve("1.png") + ": 320 x 200 pixels, at 0.20 s");
        assertThat(different(pictures[0], pictures[1])).isGreaterThan(100);
    }

    /** What is drawn and exported is the swim in the scene as it is; that it is another one is told. */
    @Test
    void aSceneThatWasChangedIsToldWithThePictureAndTheExport() throws IOException {
        Path scene = Files.writeString(folder.resolve("scene.json"), "{\"base\":\"bench/small-tank\"}");
        Path run = folder.resolve("run");
        String simulator = Path.of(System.getProperty("natator.simulator")).normalize().toString();
        Commands.natator("evolve", "--simulator-path", simulator, "--scene", scene.toString(), "--population", "2",
                "--generations", "0", "--duration", "0.1", "--output-dir", run.toString());
        Path file = folder.resolve("run.png");
        assertThat(picture(file, run.toString(), "--at", "0.05")).as(err.toString()).isZero();
        assertThat(err.toString()).isEmpty();

        Files.writeString(scene, "{\"base\":\"bench/small-tank\",\"solver\":{\"substeps\":2}}");
        String changed = "warning: scene " + scene + " was changed after " + run + " was begun: ";
        assertThat(picture(file, run.toString(), "--at", "0.05")).as(err.toString()).isZero();
        assertThat(err.toString()).startsWith("natator picture: " + changed).hasLineCount(1);
        err.getBuffer().setLength(0);
        assertThat(Main.commandLine().setOut(new PrintWriter(out, true)).setErr(new PrintWriter(err, true)).execute("export",
                "--simulator-path", simulator, "--format", "csv", "--duration", "0.05", run.toString())).isZero();
        assertThat(err.toString()).startsWith("natator export: " + changed).hasLineCount(1);
    }

    @Test
    void aBodyAtRestIsDrawnAtTheStartAsHighAsItTakes() throws IOException {
        Path file = folder.resolve("rest.png");

        assertThat(picture(file, "thesis/creature-1-vacuum", "--from", "three-quarter")).as(err.toString()).isZero();
        assertThat(out.toString()).endsWith("at 0.00 s" + System.lineSeparator());
        assertThat(ImageIO.read(file.toFile()).getWidth()).isEqualTo(1600);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', value = {
        "no/such|no/such is neither a run folder nor a scene",
        "none.json|none.json is neither a run folder nor a scene: there is no such file",
        "bench/small-tank --size 10x10|--size is 10x10; expected pixels as 1200x800, each from 64 to 4096",
        "bench/small-tank --size 5000x800|--size is 5000x800; expected pixels",
        "bench/small-tank --size big|--size is big; expected pixels",
        "bench/small-tank --at 1.5|--at is 1.5; expected a time of the swim, 0 to 1.0 s",
        "bench/small-tank --at -1|--at is -1.0; expected a time of the swim",
        "bench/small-tank --from behind|expected side, top, front or three-quarter but was 'behind'",
        "bench/small-tank --output x.jpg|--output is x.jpg; expected a name that ends in .png",
        "bench/small-tank --generation 2|--generation: bench/small-tank is not a run folder"})
    void refusals(String arguments, String message) {
        Path file = folder.resolve("x.png");
        String[] words = arguments.split(" ");

        int status = arguments.contains("--output") ? Main.commandLine().setErr(new PrintWriter(err, true))
                .execute(("picture " + arguments).split(" ")) : picture(file, words);
        assertThat(status).isEqualTo(CommandLine.ExitCode.USAGE);
        assertThat(err.toString()).startsWith("natator picture: ").contains(message).hasLineCount(1);
        assertThat(file).doesNotExist();
    }
}
