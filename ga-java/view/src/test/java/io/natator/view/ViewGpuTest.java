package io.natator.view;

import static org.assertj.core.api.Assertions.assertThat;

import com.microsoft.playwright.Download;
import java.awt.image.BufferedImage;
import java.io.IOException;
import java.util.concurrent.TimeUnit;
import javax.imageio.ImageIO;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** The picture with WebGPU, which a program computes here. */
@Timeout(value = 30, unit = TimeUnit.MINUTES)
@Chromium.WithWebGpu
class ViewGpuTest extends ViewBrowserTest {

    /** A browser that says it has a graphics card; its device is {@code window.device}. */
    private static final String CARD = """
            const parameter = WebGL2RenderingContext.prototype.getParameter;
            WebGL2RenderingContext.prototype.getParameter = function(name) {
              const value = parameter.call(this, name);
              return /swiftshader/i.test(value) ? 'A card' : value;
            };
            Object.defineProperty(GPUAdapterInfo.prototype, 'isFallbackAdapter', {get: () => false});
            const requestDevice = GPUAdapter.prototype.requestDevice;
            GPUAdapter.prototype.requestDevice = async function() {
              window.device = await requestDevice.call(this);
              return window.device;
            };""";

    /** The refined picture: its samples lie in the same places whatever draws. */
    private BufferedImage refined(String drawing, String name) {
        get("drawing").selectOption(drawing);
        await("natator.drawing() === '" + name + "' && natator.samples() === 16");
        return picture(get("picture-a"));
    }

    /** How far apart two pictures are: the mean of their bytes' differences, 0 to 255. */
    private static double distance(BufferedImage one, BufferedImage other) {
        long sum = 0;
        for (int y = 0; y < one.getHeight(); y++) {
            for (int x = 0; x < one.getWidth(); x++) {
                for (int shift = 0; shift < 24; shift += 8) {
                    sum += Math.abs((one.getRGB(x, y) >> shift & 255) - (other.getRGB(x, y) >> shift & 255));
                }
            }
        }
        return sum / (3.0 * one.getWidth() * one.getHeight());
    }

    /** Water and skin, and then all that they hide: particles of both, joints, muscles, lines. */
    @Test
    void itIsThatOfWebGl() {
        useSmallWindow();
        open(water, FEW_PIXELS);
        pauseAt(3);
        for (String shown : new String[] {"surface", "spheres"}) {
            choose("water-" + shown);
            BufferedImage webGl = refined("webgl", "WebGL");
            BufferedImage webGpu = refined("webgpu", "WebGPU");
            keepPicture("ViewGpuTest-" + shown);

            assertThat(colours(webGpu)).as("colours of %s", shown).isGreaterThan(500);
            assertThat(distance(webGl, webGpu)).as("distance of %s", shown).isLessThan(0.3);
            choose("body-particles");
        }
    }

    @Test
    void aCardIsUsedUntilItIsLost() throws IOException {
        page.addInitScript(CARD);
        useSmallWindow();
        open(water, FEW_PIXELS);
        await("natator.drawing() === 'WebGPU'");
        get("run").click();
        Download download = page.waitForDownload(() -> get("picture-save").click());
        assertThat(colours(ImageIO.read(download.path().toFile()))).as("of what is saved").isGreaterThan(500);

        page.evaluate("() => window.device.destroy()");

        await("natator.drawing() === 'WebGL' && natator.samples() >= 1");
        assertThat(colours(picture(get("picture-a")))).isGreaterThan(500);
    }

    @Test
    void theAddressForcesAWayToDraw() {
        page.addInitScript(CARD);
        open(vacuum, "?drawing=plain");

        assertThat(page.evaluate("() => natator.drawing()")).isEqualTo("processor");
    }
}
