package io.natator.picture;

import java.awt.BasicStroke;
import java.awt.Color;
import java.awt.Font;
import java.awt.FontMetrics;
import java.awt.Graphics2D;
import java.awt.RenderingHints;
import java.awt.geom.Area;
import java.awt.geom.Line2D;
import java.awt.geom.Path2D;
import java.awt.geom.Rectangle2D;
import java.awt.image.BufferedImage;
import java.math.BigDecimal;
import java.math.MathContext;
import java.util.Locale;

/** What is drawn by lines: the ground, the edges of the tank, the scale and the time. */
final class Surroundings {

    private static final Color GROUND = new Color(0xee, 0xf0, 0xf2);
    private static final Color GRID = new Color(0xd9, 0xdf, 0xe4);
    private static final Color EDGE = new Color(0x9f, 0xae, 0xbb);
    private static final Color NEAR_EDGE = new Color(0x9f, 0xae, 0xbb, 0x70);
    private static final Color LABEL_GROUND = new Color(0xff, 0xff, 0xff, 0xc0);
    private static final Color INK = new Color(0x26, 0x32, 0x3d);
    /** Of the picture's width: about how long the scale is. */
    private static final double SCALE = 0.14;
    /** Corners of the tank's sides, the floor's first. */
    private static final int[][] SIDES = {{0, 1, 5, 4}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 5, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
    private static final double[] ROUND = {1, 2, 5, 10};

    private final Projection projection;
    private final Box tank;
    private final boolean[] open;
    private final int width;
    private final int height;

    /** {@code open}: axes that the tank has no ends along. */
    Surroundings(Projection projection, Box tank, boolean[] open, int width, int height) {
        this.projection = projection;
        this.tank = tank;
        this.open = open;
        this.width = width;
        this.height = height;
    }

    /** Ground with a grid and the edges of the tank, which water is laid over. */
    void behind(BufferedImage image) {
        Graphics2D pen = pen(image);
        pen.setColor(Color.WHITE);
        pen.fillRect(0, 0, width, height);
        if (!tank.isEmpty()) {
            if (projection.from().axis(2)[1] > 0) {
                ground(pen);
            }
            edges(pen, false);
        }
        pen.dispose();
    }

    /** Edges of the tank before the water, scale and time. */
    void before(BufferedImage image, double time) {
        Graphics2D pen = pen(image);
        if (!tank.isEmpty()) {
            edges(pen, true);
        }
        scale(pen, time);
        pen.dispose();
    }

    /** Which part of each pixel the tank covers; all of it where there is none. */
    float[] inside() {
        BufferedImage cover = new BufferedImage(width, height, BufferedImage.TYPE_BYTE_GRAY);
        Graphics2D pen = pen(cover);
        pen.setColor(Color.WHITE);
        if (tank.isEmpty()) {
            pen.fillRect(0, 0, width, height);
        } else {
            Area sides = new Area();
            for (int[] side : SIDES) {
                sides.add(new Area(side(side)));
            }
            pen.fill(sides);
        }
        pen.dispose();
        float[] shares = new float[width * height];
        for (int at = 0; at < shares.length; at++) {
            shares[at] = cover.getRaster().getSample(at % width, at / width, 0) / 255f;
        }
        return shares;
    }

    /** A side of the tank, by its corners. */
    private Path2D side(int[] corners) {
        Path2D side = new Path2D.Double();
        for (int number : corners) {
            double[] corner = tank.corner(number);
            double x = projection.x(corner[0], corner[1], corner[2]);
            double y = projection.y(corner[0], corner[1], corner[2]);
            if (side.getCurrentPoint() == null) {
                side.moveTo(x, y);
            } else {
                side.lineTo(x, y);
            }
        }
        side.closePath();
        return side;
    }

    private void ground(Graphics2D pen) {
        pen.setColor(GROUND);
        pen.fill(side(SIDES[0]));
        pen.setColor(GRID);
        pen.setStroke(new BasicStroke((float) Math.max(1, width / 1400.0)));
        double step = roundLength(Math.min(tank.size(0), tank.size(2)) / 4);
        double y = tank.low()[1];
        for (double x = Math.ceil(tank.low()[0] / step) * step; x <= tank.high()[0]; x += step) {
            line(pen, new double[] {x, y, tank.low()[2]}, new double[] {x, y, tank.high()[2]});
        }
        for (double z = Math.ceil(tank.low()[2] / step) * step; z <= tank.high()[2]; z += step) {
            line(pen, new double[] {tank.low()[0], y, z}, new double[] {tank.high()[0], y, z});
        }
    }

    /** Those that meet in the corner nearest to the viewer, or the others. */
    private void edges(Graphics2D pen, boolean nearest) {
        int near = 0;
        for (int number = 1; number < 1 << Box.AXES; number++) {
            if (depth(number) > depth(near) + 1e-6) {
                near = number;
            }
        }
        pen.setColor(nearest ? NEAR_EDGE : EDGE);
        pen.setStroke(new BasicStroke((float) Math.max(1, width / 1000.0)));
        for (int number = 0; number < 1 << Box.AXES; number++) {
            for (int axis = 0; axis < Box.AXES; axis++) {
                int other = number | 1 << axis;
                if (other != number && !isOfAnEnd(axis) && (number == near || other == near) == nearest) {
                    line(pen, tank.corner(number), tank.corner(other));
                }
            }
        }
    }

    /** Whether edges along this axis are where an axis without ends is cut off. */
    private boolean isOfAnEnd(int axis) {
        for (int other = 0; other < Box.AXES; other++) {
            if (other != axis && open[other]) {
                return true;
            }
        }
        return false;
    }

    private double depth(int corner) {
        double[] place = tank.corner(corner);
        return projection.depth(place[0], place[1], place[2]);
    }

    private void line(Graphics2D pen, double[] a, double[] b) {
        pen.draw(new Line2D.Double(projection.x(a[0], a[1], a[2]), projection.y(a[0], a[1], a[2]),
                projection.x(b[0], b[1], b[2]), projection.y(b[0], b[1], b[2])));
    }

    private void scale(Graphics2D pen, double time) {
        double length = roundLength(SCALE * width / projection.scale());
        double pixels = length * projection.scale();
        double left = 0.03 * width;
        float size = (float) Math.max(10, Math.min(width, 2 * height) / 55.0);
        double base = height - 0.9 * size;
        pen.setColor(INK);
        double thick = Math.max(2, size / 7);
        pen.fill(new Rectangle2D.Double(left, base - size / 3 - thick / 2, pixels, thick));
        pen.setFont(new Font(Font.SANS_SERIF, Font.PLAIN, 1).deriveFont(size));
        label(pen, text(length) + (length == 1 ? " unit" : " units"), left + pixels + 0.6 * size, base);
        String seconds = String.format(Locale.ROOT, "t = %.2f s", time);
        label(pen, seconds, width - left - pen.getFontMetrics().stringWidth(seconds), base);
    }

    /** Text on a white ground, which an edge of the tank may cross. */
    private static void label(Graphics2D pen, String text, double x, double base) {
        FontMetrics metrics = pen.getFontMetrics();
        pen.setColor(LABEL_GROUND);
        pen.fill(new Rectangle2D.Double(x - 2, base - metrics.getAscent(), metrics.stringWidth(text) + 4.0,
                metrics.getAscent() + metrics.getDescent()));
        pen.setColor(INK);
        pen.drawString(text, (float) x, (float) base);
    }

    /** The nearest of 1, 2 and 5 times a power of ten. */
    static double roundLength(double length) {
        double power = Math.pow(10, Math.floor(Math.log10(length)));
        double best = power;
        for (double times : ROUND) {
            if (Math.abs(Math.log(times * power / length)) < Math.abs(Math.log(best / length))) {
                best = times * power;
            }
        }
        return best;
    }

    private static String text(double length) {
        return new BigDecimal(length).round(new MathContext(1)).stripTrailingZeros().toPlainString();
    }

    private static Graphics2D pen(BufferedImage image) {
        Graphics2D pen = image.createGraphics();
        pen.setRenderingHint(RenderingHints.KEY_ANTIALIASING, RenderingHints.VALUE_ANTIALIAS_ON);
        pen.setRenderingHint(RenderingHints.KEY_STROKE_CONTROL, RenderingHints.VALUE_STROKE_PURE);
        pen.setRenderingHint(RenderingHints.KEY_TEXT_ANTIALIASING, RenderingHints.VALUE_TEXT_ANTIALIAS_ON);
        return pen;
    }
}
