package io.natator.plot;

import io.natator.file.AtomicFile;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import org.knowm.xchart.BitmapEncoder;
import org.knowm.xchart.internal.chartpart.Chart;

/** A chart as a PNG file. */
public final class Picture {

    private Picture() {
    }

    /**
     * Writes the file, which is a whole one at every moment, and its folder where there is none.
     *
     * @param file path without extension
     * @return the PNG file
     * @throws IOException if that fails
     */
    public static Path save(Chart<?, ?> chart, Path file) throws IOException {
        Files.createDirectories(file.toAbsolutePath().getParent());
        Path picture = file.resolveSibling(file.getFileName() + ".png");
        byte[] content = BitmapEncoder.getBitmapBytes(chart, BitmapEncoder.BitmapFormat.PNG);
        try {
            AtomicFile.write(picture, content);
        } catch (UncheckedIOException e) {
            throw e.getCause();
        }
        return picture;
    }
}
