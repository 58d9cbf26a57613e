package io.natator.spark;

import io.natator.protocol.SimulationRequest;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;

/**
 * Divides evaluations into parts, of which Spark does one at a time in each of its slots. A part costs the driver some milliseconds
 * whatever is in it, so parts are large; but what an executor does not finish is lost, and at the end of a generation all wait
 * for the last part. So a part takes half of what is left for each slot (guided self-scheduling, Polychronopoulos and Kuck
 * 1987), and at most {@value #MAX_SECONDS} s, by the time that such evaluations took before.
 */
final class Partitioner {

    /** Time of the longest parts, s. */
    static final double MAX_SECONDS = 2;
    /** Time below which a part is not made shorter, s: ten times what it costs. */
    static final double MIN_SECONDS = 0.05;
    /** A part takes this fraction (1/n) of what is left for each slot. */
    private static final int SHARES = 2;
    /** Parts for each slot at most while it is not known how long evaluations take. */
    private static final int UNKNOWN = 256;
    /** A time that a clock can tell from none, s. */
    private static final double MIN_MEASURED = 1e-6;
    /** Weight of the latest part in the mean. */
    private static final double LATEST = 0.2;

    /** Mean time of an evaluation of each kind, s. */
    private final Map<List<Object>, Double> seconds = new ConcurrentHashMap<>();

    /** What evaluations have in common that take about the same time; bodies may differ. */
    private static List<Object> kind(SimulationRequest request) {
        List<String> changed = new ArrayList<>();
        if (request.overrides() != null) {
            request.overrides().fieldNames().forEachRemaining(changed::add);
        }
        return Arrays.asList(request.scene(), request.duration(), request.scheme(), changed);
    }

    /** Takes note of how long a part took. */
    void took(List<SimulationRequest> part, double time) {
        double each = Math.max(time, MIN_MEASURED) / part.size();
        seconds.merge(kind(part.get(0)), each, (mean, latest) -> mean + LATEST * (latest - mean));
    }

    /**
     * Parts of evaluations, in their order; all of a part are of one kind.
     *
     * @param slots parts that are done at the same time, at least 1
     */
    List<List<SimulationRequest>> of(List<SimulationRequest> requests, int slots) {
        int evenly = (requests.size() + UNKNOWN * slots - 1) / (UNKNOWN * slots);
        double left = requests.stream().mapToDouble(one -> seconds.getOrDefault(kind(one), 0.0)).sum();
        List<List<SimulationRequest>> parts = new ArrayList<>();
        for (int first = 0; first < requests.size();) {
            List<Object> kind = kind(requests.get(first));
            Double each = seconds.get(kind);
            int most = each == null ? evenly : size(left, each, slots);
            int end = first + 1;
            while (end < requests.size() && end - first < most && kind(requests.get(end)).equals(kind)) {
                end++;
            }
            parts.add(requests.subList(first, end));
            left -= each == null ? 0 : each * (end - first);
            first = end;
        }
        return parts;
    }

    /**
     * Evaluations of the next part, at least 1.
     *
     * @param left time that all evaluations take which are in no part yet, s
     * @param each time that one takes, s, above 0
     */
    static int size(double left, double each, int slots) {
        double time = Math.max(MIN_SECONDS, Math.min(MAX_SECONDS, left / (SHARES * slots)));
        return (int) Math.max(1, Math.min(time / each, Integer.MAX_VALUE));
    }

    /** Parts of equal size, as many as are done at the same time. */
    static List<List<SimulationRequest>> evenly(List<SimulationRequest> requests, int slots) {
        int count = Math.min(slots, requests.size());
        List<List<SimulationRequest>> parts = new ArrayList<>();
        for (int i = 0; i < count; i++) {
            parts.add(requests.subList((int) ((long) i * requests.size() / count),
                    (int) ((i + 1L) * requests.size() / count)));
        }
        return parts;
    }
}
