package io.natator.checkpoint;

import com.fasterxml.jackson.annotation.JsonInclude;
import io.natator.base.InvalidInputException;
import io.natator.encoding.Gait;
import io.natator.protocol.SimulationResult;
import io.natator.protocol.SwimmingNumbers;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.TreeMap;
import java.util.function.Function;

/**
 * One gait's runs from several starts. Distances are those reached in the full duration: a run that ended early is not
 * made faster by dividing by a shorter time, and one that was unstable or failed went nowhere.
 *
 * @param substeps  of a frame
 * @param runs      how many
 * @param completed share of them that lasted to the end
 * @param stopped   how many ended how
 * @param distance  signed, in scene units
 * @param speed     distance over the full duration, in scene units per second
 * @param bodyLengths speed in body lengths per second; null where the length is unknown
 * @param perBeat   body lengths in a period of the gait; null likewise
 * @param reynolds  mean; null where no run has it
 * @param strouhal  mean; null where no run has it
 * @param cavities  at the end, in volumes of the body, mean; null where no run has it
 * @param work      of the muscles, mean, in mass times length squared by seconds squared; null where no run has it
 * @param costOfTransport mean work by mean distance, in mass times length by seconds squared; null without work, and for
 *                  what does not come forwards
 * @param goals     score by the scene's goals; null where it has none
 */
@JsonInclude(JsonInclude.Include.NON_NULL)
public record SwimSample(int substeps, int runs, double completed, Map<String, Integer> stopped, Spread distance,
        Spread speed, Spread bodyLengths, Spread perBeat, Double reynolds, Double strouhal, Double cavities,
        Double work, Double costOfTransport, Spread goals) {

    /**
     * Has to have a distance and a speed, and with body lengths those per beat.
     *
     * @throws InvalidInputException if it does not say how its runs ended
     */
    public SwimSample {
        Objects.requireNonNull(distance, "distance");
        Objects.requireNonNull(speed, "speed");
        if (bodyLengths != null) {
            Objects.requireNonNull(perBeat, "perBeat");
        }
        if (stopped == null || stopped.isEmpty() || stopped.containsValue(null)) {
            throw new InvalidInputException("stopped is " + stopped + "; expected how many runs ended how");
        }
    }

    /**
     * Sums up at least one result.
     *
     * @param duration   in seconds, of a run that nothing ends early
     * @param bodyLength in scene units, or null
     */
    public static SwimSample of(List<SimulationResult> results, int substeps, Gait gait, double duration,
            Double bodyLength) {
        Map<String, Integer> stopped = new TreeMap<>();
        results.forEach(one -> stopped.merge(one.stopped() == null ? "failed" : one.stopped(), 1, Integer::sum));
        Spread distance = Spread.of(results.stream().map(SimulationResult::distanceOrZero).toList());
        Spread speed = distance.times(1 / duration);
        Spread lengths = bodyLength == null || bodyLength <= 0 ? null : speed.times(1 / bodyLength);
        Double work = mean(results, SimulationResult::work);
        return new SwimSample(substeps, results.size(), stopped.getOrDefault("completed", 0) / (double) results.size(),
                stopped, distance, speed, lengths, lengths == null ? null : lengths.times(1 / gait.frequency()),
                meanNumber(results, SwimmingNumbers::reynolds), meanNumber(results, SwimmingNumbers::strouhal),
                meanNumber(results, SwimmingNumbers::cavities), work,
                work == null || distance.mean() <= 0 ? null : work / distance.mean(),
                results.stream().allMatch(one -> one.goals() == null) ? null
                        : Spread.of(results.stream().map(SimulationResult::goalScore).toList()));
    }

    private static Double meanNumber(List<SimulationResult> results, Function<SwimmingNumbers, Double> number) {
        return mean(results, one -> one.swimming() == null ? null : number.apply(one.swimming()));
    }

    private static Double mean(List<SimulationResult> results, Function<SimulationResult, Double> figure) {
        List<Double> known = results.stream().map(figure).filter(Objects::nonNull).toList();
        return known.isEmpty() ? null : Spread.of(known).mean();
    }

    /** Number of runs that broke a law of mechanics. */
    public int unstable() {
        return stopped.getOrDefault("unstable", 0);
    }

    /** Whether most of its runs ended by touching a wall. */
    public boolean endsAtWall() {
        return mostlyStopped().equals(SimulationResult.AT_WALL);
    }

    /** How most runs ended. */
    public String mostlyStopped() {
        return stopped.entrySet().stream().max(Map.Entry.comparingByValue()).orElseThrow().getKey();
    }
}
