package io.natator.evolution;

import io.natator.config.EvolutionSettings;
import io.natator.encoding.Encoding;
import io.natator.encoding.Gait;
import java.util.ArrayList;
import java.util.Collection;
import java.util.List;
import java.util.SortedMap;
import java.util.TreeMap;

/**
 * The best gait of each kind. A kind is a cell of two numbers that follow from the gait alone, so that no luck of a run
 * moves it to another: how many waves are on the body, and how often it beats.
 */
public final class EliteMap {

    /** Cells along each side. */
    public static final int SIDE = 12;
    private static final double LEAST_FREQUENCY = 0.5;
    private static final double MOST_FREQUENCY = 2.0;

    private final SortedMap<Cell, Individual> elites = new TreeMap<>();
    private final Encoding encoding;

    /**
     * A kind of gait.
     *
     * @param wave number of the cell by {@link EliteMap#waves}, from 0
     * @param beat number of the cell by frequency, from 0
     */
    public record Cell(int wave, int beat) implements Comparable<Cell> {
        @Override
        public int compareTo(Cell other) {
            return wave != other.wave ? Integer.compare(wave, other.wave) : Integer.compare(beat, other.beat);
        }
    }

    /** Of these individuals, the first of equals. */
    public EliteMap(EvolutionSettings settings, Collection<Individual> individuals) {
        this.encoding = settings.encoding().forActuators(settings.actuators());
        for (Individual one : individuals) {
            if (one.isMeasured()) {
                elites.merge(cell(one), one, (elite, other) -> other.score() > elite.score() ? other : elite);
            }
        }
    }

    private Cell cell(Individual one) {
        Gait gait = encoding.decode(one.genes());
        double most = mostWaves(gait.actuators());
        return new Cell(number((waves(gait) + most) / (2 * most)),
                number((gait.frequency() - LEAST_FREQUENCY) / (MOST_FREQUENCY - LEAST_FREQUENCY)));
    }

    private static int number(double share) {
        return Math.min(Math.max((int) (share * SIDE), 0), SIDE - 1);
    }

    /**
     * Waves on the body: the sum of the delays from each actuator to the next, each the shorter way round a period; above 0
     * where phases grow from head to tail.
     */
    public static double waves(Gait gait) {
        double sum = 0;
        for (int i = 1; i < gait.actuators(); i++) {
            double delay = gait.phase().get(i) - gait.phase().get(i - 1);
            sum += delay - Math.rint(delay);
        }
        return sum;
    }

    /** Half a period from each actuator to the next. */
    public static double mostWaves(int actuators) {
        return Math.max((actuators - 1) / 2.0, 0.5);
    }

    /** The best of each kind, by cells. */
    public SortedMap<Cell, Individual> elites() {
        return elites;
    }

    List<Individual> individuals() {
        return new ArrayList<>(elites.values());
    }
}
