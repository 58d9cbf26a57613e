package io.natator.plot;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import org.knowm.xchart.BitmapEncoder;
import org.knowm.xchart.internal.chartpart.Chart;

/** A chart as a PNG file. */
public final class Picture {

    private Picture() {
    }

    /**
     * Writes the file, and its folder where there is none.
     *
     * @param file path without extension
     * @return the PNG file
     * @throws IOException if that fails
     */
    public static Path save(Chart<?, ?> chart, Path file) throws IOException {
        Files.createDirectories(file.toAbsolutePath().getParent());
        BitmapEncoder.saveBitmap(chart, file.toString(), BitmapEncoder.BitmapFormat.PNG);
        return file.resolveSibling(file.getFileName() + ".png");
    }
}
