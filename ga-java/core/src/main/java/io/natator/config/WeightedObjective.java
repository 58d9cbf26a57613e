package io.natator.config;

import com.fasterxml.jackson.annotation.JsonInclude;
import io.natator.base.InvalidInputException;
import io.natator.base.Numbers;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.stream.Collectors;

/**
 * An objective, and its weight in a sum.
 *
 * @param objective what is to be great
 * @param weight    in the sum; null for an objective of its own
 */
@JsonInclude(JsonInclude.Include.NON_NULL)
public record WeightedObjective(Objective objective, Double weight) {

    /**
     * Reads objectives as the user writes them: {@code distance,work}, or with weights {@code forward=1,straight=0.2}.
     *
     * @throws InvalidInputException if that is no such list
     */
    public static List<WeightedObjective> parse(String text) {
        List<WeightedObjective> all = new ArrayList<>();
        for (String part : text.split(",", -1)) {
            String[] sides = part.split("=", -1);
            Objective objective = objective(sides[0], part);
            if (all.stream().anyMatch(one -> one.objective == objective)) {
                throw new InvalidInputException("--objectives has " + sides[0] + " twice");
            }
            all.add(new WeightedObjective(objective, sides.length == 1 ? null : weight(sides, part)));
        }
        return all;
    }

    /** What generations and winners are told by: a sum, or of several without weights the first. */
    public static List<WeightedObjective> leading(List<WeightedObjective> objectives) {
        return objectives.get(0).weight == null ? objectives.subList(0, 1) : objectives;
    }

    /** Some as text, as {@link #parse} reads it. */
    public static String text(List<WeightedObjective> objectives) {
        return objectives.stream().map(one -> Json.name(one.objective)
                + (one.weight == null ? "" : "=" + one.weight)).collect(Collectors.joining(","));
    }

    private static Objective objective(String name, String part) {
        return Arrays.stream(Objective.values()).filter(one -> Json.name(one).equals(name)).findFirst()
                .orElseThrow(() -> new InvalidInputException("--objectives has '" + part
                        + "'; expected some of distance, net, forward, straight, work, efficiency, each with a weight or "
                        + "none: forward=1,straight=0.2"));
    }

    private static double weight(String[] sides, String part) {
        try {
            double weight = Numbers.parse(sides.length == 2 ? sides[1] : "");
            if (Double.isFinite(weight) && weight > 0) {
                return weight;
            }
        } catch (NumberFormatException e) {
            // Told below.
        }
        throw new InvalidInputException("--objectives has '" + part + "'; expected a weight above 0, as in forward=1");
    }
}
