package io.natator.report;

import io.natator.flow.FlowField;
import io.natator.flow.SlicePlane;
import java.awt.BasicStroke;
import java.awt.Color;
import java.awt.Font;
import java.awt.Graphics2D;
import java.awt.RenderingHints;
import java.awt.geom.Ellipse2D;
import java.awt.geom.Path2D;
import java.awt.geom.Rectangle2D;
import java.awt.image.BufferedImage;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Locale;
import javax.imageio.ImageIO;

/** The thesis' figures 3.5 and 3.6: velocity of the fluid as arrows over its vorticity, with the swimmer. */
public final class FlowPlot {

    private static final double SCALE = 180;
    private static final int MARGIN = 30;
    private static final int HEAD = 62;
    /** Below the field, for its scale. */
    private static final int FOOT = 16;
    /** For the text above the field. */
    private static final int LEAST_WIDTH = 520;
    /** Levels of colour to either side, so that few different colours make a small file. */
    private static final int LEVELS = 8;

    private final FlowField field;
    private final String title;
    private final double fastest;
    private final double strongest;
    private final int width;
    private final int height;

    private FlowPlot(String title, FlowField field) {
        this.title = title;
        this.field = field;
        double speed = 0;
        double vorticity = 0;
        for (int i = 0; i < field.columns(); i++) {
            for (int k = 0; k < field.rows(); k++) {
                double[] v = field.velocity()[i][k];
                speed = v == null ? speed : Math.max(speed, Math.hypot(v[0], v[1]));
                double here = Math.abs(field.vorticity(i, k));
                vorticity = here > vorticity ? here : vorticity;
            }
        }
        this.fastest = speed;
        this.strongest = vorticity;
        this.width = (int) Math.max(LEAST_WIDTH, 2 * MARGIN + SCALE * FlowField.CELL * field.columns());
        this.height = (int) (HEAD + 2 * MARGIN + FOOT + SCALE * FlowField.CELL * field.rows());
    }

    /**
     * Draws a PNG file.
     *
     * @param file path without extension
     * @return the PNG file
     */
    public static Path draw(String title, FlowField field, Path file) throws IOException {
        FlowPlot plot = new FlowPlot(title, field);
        Files.createDirectories(file.toAbsolutePath().getParent());
        BufferedImage image = new BufferedImage(plot.width, plot.height, BufferedImage.TYPE_INT_RGB);
        Graphics2D graphics = image.createGraphics();
        graphics.setRenderingHint(RenderingHints.KEY_ANTIALIASING, RenderingHints.VALUE_ANTIALIAS_ON);
        plot.draw(graphics);
        graphics.dispose();
        Path png = file.resolveSibling(file.getFileName() + ".png");
        ImageIO.write(image, "png", png.toFile());
        return png;
    }

    private void draw(Graphics2D graphics) {
        graphics.setColor(Color.WHITE);
        graphics.fill(new Rectangle2D.Double(0, 0, width, height));
        graphics.setColor(Color.BLACK);
        graphics.setFont(new Font(Font.SANS_SERIF, Font.BOLD, 14));
        graphics.drawString(String.format(Locale.ROOT, "%s, %s, at %.2f s", title, field.view().label(), field.time()),
                MARGIN, 20);
        graphics.setFont(new Font(Font.SANS_SERIF, Font.PLAIN, 12));
        graphics.drawString(String.format(Locale.ROOT, "longest arrow %.2f units/s; colour: vorticity, darkest %.1f 1/s", fastest,
                strongest), MARGIN, 38);
        graphics.drawString("red turns against the clock, blue with it; grey: the body", MARGIN, 54);
        drawScale(graphics);
        for (int i = 0; i < field.columns(); i++) {
            for (int k = 0; k < field.rows(); k++) {
                drawVorticity(graphics, i, k);
            }
        }
        graphics.setColor(new Color(0x999999));
        for (double[] place : field.body()) {
            graphics.fill(new Ellipse2D.Double(x(place[0]) - 3, y(place[1]) - 3, 6, 6));
        }
        drawArrows(graphics);
    }

    /** A bar of half a unit below the field. */
    private void drawScale(Graphics2D graphics) {
        int bottom = height - 10;
        graphics.fill(new Rectangle2D.Double(MARGIN, bottom - 4, SCALE / 2, 3));
        graphics.drawString("0.5 units", (int) (MARGIN + SCALE / 2 + 8), bottom);
    }

    private void drawVorticity(Graphics2D graphics, int column, int row) {
        double share = strongest > 0 ? field.vorticity(column, row) / strongest : 0;
        long level = Math.round(share * LEVELS);
        if (level == 0) {
            return;
        }
        int rest = (int) (255 - 190.0 * Math.abs(level) / LEVELS);
        graphics.setColor(level > 0 ? new Color(255, rest, rest) : new Color(rest, rest, 255));
        double size = SCALE * FlowField.CELL;
        graphics.fill(new Rectangle2D.Double(Math.rint(x(centre(0, column)) - size / 2),
                Math.rint(y(centre(1, row)) - size / 2), Math.ceil(size), Math.ceil(size)));
    }

    private void drawArrows(Graphics2D graphics) {
        graphics.setColor(Color.BLACK);
        graphics.setStroke(new BasicStroke(1f));
        double longest = 1.8 * SCALE * FlowField.CELL;
        Path2D arrows = new Path2D.Double();
        for (int i = 0; i < field.columns(); i++) {
            for (int k = 0; k < field.rows(); k++) {
                double[] v = field.velocity()[i][k];
                double speed = v == null ? 0 : Math.hypot(v[0], v[1]);
                if (speed > 0.03 * fastest) {
                    double length = longest * speed / fastest;
                    addArrow(arrows, x(centre(0, i)), y(centre(1, k)), v[0] / speed, downwards() * v[1] / speed, length);
                }
            }
        }
        graphics.draw(arrows);
    }

    private static void addArrow(Path2D path, double x, double y, double alongX, double alongY, double length) {
        double endX = tenth(x + alongX * length);
        double endY = tenth(y + alongY * length);
        double point = Math.min(4, length / 2);
        path.moveTo(tenth(x), tenth(y));
        path.lineTo(endX, endY);
        path.moveTo(tenth(endX - point * (alongX + 0.5 * alongY)), tenth(endY - point * (alongY - 0.5 * alongX)));
        path.lineTo(endX, endY);
        path.lineTo(tenth(endX - point * (alongX - 0.5 * alongY)), tenth(endY - point * (alongY + 0.5 * alongX)));
    }

    private static double tenth(double value) {
        return Math.rint(value * 10) / 10;
    }

    private double centre(int axis, int number) {
        return field.origin()[axis] + number * FlowField.CELL;
    }

    /** 1 where the picture's second axis points down (z from above), −1 where it points up (y). */
    private int downwards() {
        return field.view() == SlicePlane.ABOVE ? 1 : -1;
    }

    private double x(double place) {
        return MARGIN + SCALE * (place - field.origin()[0] + FlowField.CELL / 2);
    }

    private double y(double place) {
        double fromFirst = SCALE * (place - field.origin()[1] + FlowField.CELL / 2);
        return downwards() > 0 ? HEAD + MARGIN + fromFirst : height - FOOT - MARGIN - fromFirst;
    }
}
