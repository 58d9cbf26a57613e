package io.natator.evolution;

import io.natator.protocol.Effort;
import java.util.ArrayList;
import java.util.Collection;
import java.util.IntSummaryStatistics;
import java.util.List;
import java.util.SortedMap;
import java.util.TreeMap;

/**
 * The best gait of each kind. A kind is a cell of two numbers that are measured on the swim: beats for a body length, and
 * cost of transport. Cells are half an octave wide, from 1 upwards and downwards, so that the map needs no bounds that
 * would suit one creature and not another.
 */
public final class EliteMap {

    /** What beats more often for a body length gets nowhere, which is a kind by itself. */
    public static final double MAX_BEATS = 128;
    /** Cells in an octave. */
    private static final int PER_OCTAVE = 2;

    private final SortedMap<Cell, Individual> elites = new TreeMap<>();

    /**
     * A kind of gait. Cell n is from {@link EliteMap#edge edge(n)} up to edge(n + 1).
     *
     * @param beats cell by beats for a body length
     * @param cost  cell by cost of transport
     */
    public record Cell(int beats, int cost) implements Comparable<Cell> {

        /** The kind of all gaits that get nowhere, at whatever cost. */
        public static final Cell NOWHERE = new Cell(Integer.MAX_VALUE, 0);

        @Override
        public int compareTo(Cell other) {
            return beats != other.beats ? Integer.compare(beats, other.beats) : Integer.compare(cost, other.cost);
        }
    }

    /**
     * The map of individuals; of equals it keeps the first.
     *
     * @throws EvolutionFailedException if it is not known what a swim took
     */
    public EliteMap(Collection<Individual> individuals) {
        for (Individual one : individuals) {
            if (one.isMeasured()) {
                if (one.effort() == null) {
                    throw new EvolutionFailedException(
                            "the run's gaits are not told apart by beats per length and cost of "
                                    + "transport: another version made it; expected a new run");
                }
                elites.merge(cell(one.effort()), one, (elite, other) -> other.score() > elite.score() ? other : elite);
            }
        }
    }

    /** The kind of what took this. Without any work, as with muscles that are pushed, it is of the kind that gets nowhere. */
    static Cell cell(Effort effort) {
        return moves(effort) ? new Cell(number(effort.beatsPerLength()), number(effort.costOfTransport()))
                : Cell.NOWHERE;
    }

    /** Whether what took this gets anywhere, by work of its muscles. */
    static boolean moves(Effort effort) {
        return effort.beatsPerLength() < MAX_BEATS && effort.work() > 0;
    }

    /** Number of a cell; the same on every machine, since the course of a run depends on it. */
    private static int number(double value) {
        return (int) Math.floor(PER_OCTAVE * StrictMath.log(value) / StrictMath.log(2));
    }

    /** Lower end of a cell. */
    public static double edge(int number) {
        return StrictMath.pow(2, number / (double) PER_OCTAVE);
    }

    /** The best of each kind, by cells. */
    public SortedMap<Cell, Individual> elites() {
        return elites;
    }

    /** The best of each kind that gets somewhere, by cells. */
    public SortedMap<Cell, Individual> moving() {
        return elites.headMap(Cell.NOWHERE);
    }

    /** The columns that these are in. */
    public IntSummaryStatistics beats() {
        return moving().keySet().stream().mapToInt(Cell::beats).summaryStatistics();
    }

    /** The rows that these are in. */
    public IntSummaryStatistics costs() {
        return moving().keySet().stream().mapToInt(Cell::cost).summaryStatistics();
    }

    List<Individual> individuals() {
        return new ArrayList<>(elites.values());
    }
}
