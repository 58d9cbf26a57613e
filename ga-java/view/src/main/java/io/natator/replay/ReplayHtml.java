package io.natator.replay;

import io.natator.base.InvalidInputException;
import io.natator.base.Numbers;
import io.natator.file.OutputFile;
import java.io.UncheckedIOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.stream.Collectors;

/**
 * One HTML file that replays swims: scripts, styles and data are all in it, and it makes no request.
 *
 * @param title of the page
 * @param swims at least one
 * @param water whether the water is shown too
 */
public record ReplayHtml(String title, List<Replay> swims, boolean water) {

    private static final int[] EVERY = {1, 2, 3, 4, 5, 6, 8, 10, 12};
    private static final double MEGABYTE = 1e6;

    /**
     * What was written.
     *
     * @param bytes           of the file
     * @param framesPerSecond of simulated time that are in it; less than were recorded if all would have been too much
     * @param isReduced       whether they are
     * @param largestError    of a coordinate of any water particle, in length units; 0 without water
     */
    public record Written(long bytes, double framesPerSecond, boolean isReduced, double largestError) {
    }

    /** A page of these swims as they are now. */
    public ReplayHtml {
        swims = List.copyOf(swims);
    }

    /**
     * Writes the page with as many frames as fit.
     *
     * @param maxBytes what the file may have
     * @throws InvalidInputException if too few frames would fit to be watched, or no file can be of that name
     * @throws UncheckedIOException  if the file cannot be written
     */
    public Written write(Path file, long maxBytes) {
        OutputFile.check(file);
        byte[] html = null;
        for (int every : EVERY) {
            html = html(every).getBytes(StandardCharsets.UTF_8);
            if (html.length <= maxBytes) {
                OutputFile.write(file, html);
                return new Written(html.length, framesPerSecond(every), every > 1, largestError());
            }
        }
        int last = EVERY[EVERY.length - 1];
        throw new InvalidInputException(String.format(Locale.ROOT,
                "the page has %.1f MB even with %.0f frames a second; "
                        + "expected at most %s: a larger --max-size, fewer swims, a shorter --duration, or --no-water",
                html.length / MEGABYTE, framesPerSecond(last), size(maxBytes)));
    }

    /** A size in bytes, kB or MB, whichever does not round to 0. */
    private static String size(long bytes) {
        return bytes >= 100_000 ? String.format(Locale.ROOT, "%.1f MB", bytes / MEGABYTE)
                : bytes >= 1000 ? String.format(Locale.ROOT, "%.1f kB", bytes / 1000.0) : Numbers.count(bytes, "byte");
    }

    private double framesPerSecond(int every) {
        return swims.stream().mapToDouble(swim -> 1 / (every * swim.scene().timeStep())).min().orElseThrow();
    }

    private double largestError() {
        double largest = 0;
        for (Replay swim : swims) {
            for (double error : new SwimCode(swim, water).largestErrors()[0]) {
                largest = Math.max(largest, water && swim.scene().fluidCount() > 0 ? error : 0);
            }
        }
        return largest;
    }

    private String html(int every) {
        String swimText = swims.stream().map(swim -> "<script type=\"text/plain\" class=\"swim\" data-title=\""
                + PageHtml.escaped(swim.title()) + "\">" + PageHtml.base64(new SwimCode(swim, water).compressed(every))
                + "</script>")
                .collect(Collectors.joining("\n"));
        return PageHtml.of("natator/replay.html", "natator/replay.js", title, Map.of("swims", swimText));
    }
}
