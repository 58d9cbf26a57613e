package io.natator.plot;

import java.io.IOException;
import java.math.BigDecimal;
import java.math.RoundingMode;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.regex.Pattern;
import org.knowm.xchart.BitmapEncoder;
import org.knowm.xchart.VectorGraphicsEncoder;
import org.knowm.xchart.internal.chartpart.Chart;

/** A chart as SVG and PNG. */
public final class Picture {

    private static final Pattern LONG_FRACTION = Pattern.compile("\\d+\\.\\d{3,}(?:E-?\\d+)?");

    private Picture() {
    }

    /**
     * Writes both files.
     *
     * @param file path without extension
     * @return the PNG file
     * @throws IOException if that fails
     */
    public static Path save(Chart<?, ?> chart, Path file) throws IOException {
        Files.createDirectories(file.toAbsolutePath().getParent());
        VectorGraphicsEncoder.saveVectorGraphic(chart, file.toString(), VectorGraphicsEncoder.VectorGraphicsFormat.SVG);
        shorten(file.resolveSibling(file.getFileName() + ".svg"));
        BitmapEncoder.saveBitmap(chart, file.toString(), BitmapEncoder.BitmapFormat.PNG);
        return file.resolveSibling(file.getFileName() + ".png");
    }

    /** Rounds all places to hundredths of a pixel, finer than shows: the file is half as large. */
    private static void shorten(Path svg) throws IOException {
        Files.writeString(svg, LONG_FRACTION.matcher(Files.readString(svg))
                .replaceAll(number -> new BigDecimal(number.group()).setScale(2, RoundingMode.HALF_EVEN)
                        .stripTrailingZeros().toPlainString()));
    }
}
