package io.natator.view;

import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.body.Genome;
import io.natator.body.Swimmer;
import io.natator.checkpoint.RunReader;
import io.natator.config.EvolutionSettings;
import io.natator.config.FitnessKind;
import io.natator.config.Json;
import io.natator.encoding.Gait;
import io.natator.evolution.EliteMap;
import io.natator.evolution.Individual;
import java.util.IntSummaryStatistics;
import java.util.List;
import java.util.stream.Collectors;
import java.util.stream.IntStream;

/**
 * The best gait of every kind that a run of MAP-Elites found.
 *
 * @param worth what a gait is worth by
 * @param beats ends of the columns, in beats for a body length: one more than there are columns
 * @param costs ends of the rows by cost of transport, in mass times length by seconds squared
 * @param elites the kinds that were found
 */
record MapResponse(String worth, List<Double> beats, List<Double> costs, List<Elite> elites) {

    /**
     * The best gait of a kind.
     *
     * @param column by beats, from 0
     * @param row    by cost, from 0
     * @param worth  by all its runs
     * @param runs   how many these are
     * @param beats  for a body length, measured
     * @param cost   of transport, measured
     * @param overrides that give the run's scene this body too, as in {@link RunResponse.Best}
     */
    record Elite(int column, int row, double worth, int runs, double beats, double cost, Gait gait,
            ObjectNode overrides) {
    }

    /** The map of a run; null without one, or while it is empty. */
    static MapResponse of(RunReader run) {
        EliteMap map = run.elites();
        if (map == null || map.moving().isEmpty()) {
            return null;
        }
        IntSummaryStatistics beats = map.beats();
        IntSummaryStatistics costs = map.costs();
        Genome genome = run.settings().problem().genome();
        List<Elite> elites = map.moving().entrySet().stream().map(entry -> {
            Individual one = entry.getValue();
            Swimmer swimmer = genome.decode(one.genes());
            return new Elite(entry.getKey().beats() - beats.getMin(), entry.getKey().cost() - costs.getMin(),
                    one.score(),
                    one.runs(), one.effort().beatsPerLength(), one.effort().costOfTransport(), swimmer.gait(),
                    RunResponse.overrides(run.settings(), swimmer));
        }).toList();
        return new MapResponse(worth(run.settings()), edges(beats), edges(costs), elites);
    }

    private static List<Double> edges(IntSummaryStatistics cells) {
        return IntStream.rangeClosed(cells.getMin(), cells.getMax() + 1).mapToObj(EliteMap::edge).toList();
    }

    private static String worth(EvolutionSettings settings) {
        if (settings.problem().objectives() == null) {
            return settings.problem().fitness() == FitnessKind.NET ? "distance less drift in vacuum, length units"
                    : "distance, length units";
        }
        return settings.problem().objectives().stream().map(one -> Json.name(one.objective())
                + (one.weight() == null ? "" : " × " + one.weight())).collect(Collectors.joining(" + "));
    }
}
