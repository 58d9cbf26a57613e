package io.natator.body;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import io.natator.base.InvalidInputException;
import java.util.ArrayList;
import java.util.List;
import java.util.function.UnaryOperator;

/**
 * A smooth curve along a body, as the simulator has it: cubic between its points, with slopes that keep it monotone wherever
 * they are (Fritsch and Butland 1984), a straight line through two points, a constant through one.
 *
 * @param points one or more, ascending in {@code at}
 */
public record Curve(List<Point> points) {

    /**
     * A point of a curve.
     *
     * @param at    part of the body's length, from 0 at the nose to 1 at the end of the tail
     * @param value there
     */
    public record Point(double at, double value) {
    }

    /** Copies the points. */
    public Curve {
        points = List.copyOf(points);
    }

    /**
     * Reads what the scene has: points {@code [part of the length, value]}, or a number.
     *
     * @param name what it is, for the message
     * @throws InvalidInputException if it is neither
     */
    static Curve of(JsonNode node, String name) {
        if (node.isNumber()) {
            return new Curve(List.of(new Point(0, node.doubleValue())));
        }
        List<Point> points = new ArrayList<>();
        for (JsonNode point : node) {
            boolean ascends = points.isEmpty() || point.path(0).doubleValue() > points.get(points.size() - 1).at;
            if (!point.path(0).isNumber() || !point.path(1).isNumber() || !ascends) {
                throw new InvalidInputException(
                        name + " has " + point + "; expected points [part of the length, value], "
                                + "ascending in the first");
            }
            points.add(new Point(point.get(0).doubleValue(), point.get(1).doubleValue()));
        }
        if (points.isEmpty()) {
            throw new InvalidInputException(name + " is " + node + "; expected a number or a curve");
        }
        return new Curve(points);
    }

    /** The JSON form: points, or a number for a single one. */
    JsonNode json() {
        if (points.size() == 1) {
            return JsonNodeFactory.instance.numberNode(points.get(0).value);
        }
        ArrayNode json = JsonNodeFactory.instance.arrayNode();
        points.forEach(point -> json.addArray().add(point.at).add(point.value));
        return json;
    }

    /** A curve with the same places and other values. */
    Curve map(UnaryOperator<Point> change) {
        return new Curve(points.stream().map(change).toList());
    }

    /** Value at a place; before the first and behind the last point theirs. */
    public double at(double place) {
        int last = points.size() - 1;
        if (!(place > points.get(0).at)) {
            return points.get(0).value;
        }
        if (!(place < points.get(last).at)) {
            return points.get(last).value;
        }
        int i = 0;
        while (place >= points.get(i + 1).at) {
            i++;
        }
        double h = length(i);
        double t = (place - points.get(i).at) / h;
        double before = points.get(i).value;
        double behind = points.get(i + 1).value;
        double value = (1 + 2 * t) * (1 - t) * (1 - t) * before + t * t * (3 - 2 * t) * behind
                + h * t * (1 - t) * ((1 - t) * slopeAt(i) - t * slopeAt(i + 1));
        return Math.min(Math.max(value, Math.min(before, behind)), Math.max(before, behind));  // against rounding
    }

    private double length(int stretch) {
        return points.get(stretch + 1).at - points.get(stretch).at;
    }

    private double mean(int stretch) {
        return (points.get(stretch + 1).value - points.get(stretch).value) / length(stretch);
    }

    private double slopeAt(int point) {
        int stretches = points.size() - 1;
        if (stretches == 1) {
            return mean(0);
        }
        if (point == 0) {
            return slopeAtEnd(0, 1);
        }
        if (point == stretches) {
            return slopeAtEnd(stretches - 1, stretches - 2);
        }
        double before = mean(point - 1);
        double behind = mean(point);
        if (!(before * behind > 0)) {
            return 0;
        }
        double first = length(point - 1) + 2 * length(point);
        double second = 2 * length(point - 1) + length(point);
        return (first + second) / (first / before + second / behind);
    }

    /** Slope at an end, beside the stretch {@code near}, behind which is {@code far}. */
    private double slopeAtEnd(int near, int far) {
        double own = mean(near);
        double slope = ((2 * length(near) + length(far)) * own - length(near) * mean(far))
                / (length(near) + length(far));
        if (!(slope * own > 0)) {
            return 0;
        }
        return own * mean(far) < 0 && Math.abs(slope) > 3 * Math.abs(own) ? 3 * own : slope;
    }
}
