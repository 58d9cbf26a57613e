package io.natator.picture;

import io.natator.stream.StreamFrame;
import io.natator.stream.StreamScene;
import java.util.List;
import java.util.function.IntPredicate;
import java.util.stream.IntStream;

/**
 * What of a scene is in a picture.
 *
 * @param tank  walls and the surface of the water; empty without them
 * @param shown what the picture must hold
 */
record Framing(Box tank, Box shown) {

    /** Of the length of a body: how much is shown before and behind it. */
    private static final double ROOM = 0.6;
    private static final double ROOM_IN_VACUUM = 0.2;
    /** A tank of which this share would be shown is shown whole. */
    private static final double NEARLY_ALL = 0.7;
    private static final double AXIS = 0.999;
    private static final double SIDES = 0.03;
    private static final double ABOVE = 0.04;
    private static final double LOWEST = 0.3;
    private static final double HIGHEST = 0.75;
    private static final double BELOW = 0.07;

    /** The swimmer with some of the tank around it; without one, all of the tank. */
    static Framing of(StreamScene scene, StreamFrame frame) {
        Box water = box(scene, frame, scene::isFluid);
        Box solids = box(scene, frame, particle -> !scene.isFluid(particle));
        Box tank = tank(scene.planes(), water.isEmpty() ? solids : water);
        if (scene.body().isEmpty()) {
            return new Framing(tank, tank.isEmpty() ? water.with(solids) : tank);
        }
        if (tank.isEmpty()) {
            return new Framing(tank, water.with(solids).wider(ROOM_IN_VACUUM * scene.bodyLength()));
        }
        Box body = Box.around(frame.position(), scene.body().stream().mapToInt(Integer::intValue).toArray());
        Box around = body.wider(ROOM * scene.bodyLength()).with(solids);
        for (int axis = 1; axis < Box.AXES; axis++) {
            around.low()[axis] = Double.NEGATIVE_INFINITY;
            around.high()[axis] = Double.POSITIVE_INFINITY;
        }
        Box part = around.within(tank);
        return new Framing(tank, part.size(0) < NEARLY_ALL * tank.size(0) ? part : tank);
    }

    private static Box box(StreamScene scene, StreamFrame frame, IntPredicate wanted) {
        return Box.around(frame.position(), IntStream.range(0, scene.particles()).filter(wanted).toArray());
    }

    /** Where walls face along the axes, they; else where the particles end. Empty without any wall. */
    private static Box tank(List<List<Double>> planes, Box particles) {
        if (planes.isEmpty()) {
            return Box.empty();
        }
        Box tank = particles.wider(0);
        for (List<Double> plane : planes) {
            for (int axis = 0; axis < Box.AXES; axis++) {
                if (plane.get(axis) > AXIS) {
                    tank.low()[axis] = -plane.get(Box.AXES);
                } else if (plane.get(axis) < -AXIS) {
                    tank.high()[axis] = plane.get(Box.AXES);
                }
            }
        }
        return tank;
    }

    /** Height in pixels that shows all without empty stripes. */
    int height(From from, int width) {
        double[] extent = extent(from);
        double scale = width * (1 - 2 * SIDES) / extent[0];
        double height = scale * extent[1] + (ABOVE + BELOW) * width;
        return (int) Math.round(Math.min(HIGHEST * width, Math.max(LOWEST * width, height)));
    }

    /** The projection that puts what is shown into so many pixels, above a stripe for the scale. */
    Projection projection(From from, int width, int height) {
        double[] extent = extent(from);
        double stripe = Math.min(width, height);
        double above = ABOVE * stripe;
        double below = BELOW * Math.max(stripe, width / 2.0);
        double scale = Math.min(width * (1 - 2 * SIDES) / extent[0], (height - above - below) / extent[1]);
        double[] centre = {shown.middle(0), shown.middle(1), shown.middle(2)};
        return new Projection(from, centre, scale, new double[] {width / 2.0, above + (height - above - below) / 2.0});
    }

    /** Width and height of what is shown, in the plane of the picture. */
    private double[] extent(From from) {
        Projection unit = new Projection(from, new double[Box.AXES], 1, new double[2]);
        double[] low = {Double.POSITIVE_INFINITY, Double.POSITIVE_INFINITY};
        double[] high = {Double.NEGATIVE_INFINITY, Double.NEGATIVE_INFINITY};
        for (int number = 0; number < 1 << Box.AXES; number++) {
            double[] corner = shown.corner(number);
            double[] place = {unit.x(corner[0], corner[1], corner[2]), unit.y(corner[0], corner[1], corner[2])};
            for (int i = 0; i < 2; i++) {
                low[i] = Math.min(low[i], place[i]);
                high[i] = Math.max(high[i], place[i]);
            }
        }
        return new double[] {Math.max(high[0] - low[0], 1e-6), Math.max(high[1] - low[1], 1e-6)};
    }
}
