package io.natator.plot;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;

/** The settings worth choosing: no other one is both as fast and as accurate, and better in one of the two. */
final class ParetoFront {

    private ParetoFront() {
    }

    /**
     * One setting.
     *
     * @param cost  run time in s
     * @param error path error, length
     */
    record Point(double cost, double error) {
    }

    /** The points on the front, cheapest first; of equal points one. */
    static List<Point> of(List<Point> points) {
        List<Point> front = new ArrayList<>();
        double best = Double.POSITIVE_INFINITY;
        Comparator<Point> cheapestFirst = Comparator.comparingDouble(Point::cost).thenComparingDouble(Point::error);
        for (Point point : points.stream().sorted(cheapestFirst).toList()) {
            if (point.error() < best) {
                best = point.error();
                front.add(point);
            }
        }
        return front;
    }
}
