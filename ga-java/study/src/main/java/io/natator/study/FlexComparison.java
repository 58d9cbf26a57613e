package io.natator.study;

import io.natator.simulator.Evaluator;
import io.natator.simulator.SimulationRequest;
import io.natator.simulator.SimulationResult;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.ListIterator;
import java.util.Locale;
import java.util.Map;
import java.util.stream.Collectors;
import java.util.stream.IntStream;
import java.util.stream.Stream;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * Runs each variant from the start as stated and several times from starts that differ invisibly, and sets the speeds
 * beside those of NVIDIA Flex. What is finished is kept on disk and not done again.
 */
final class FlexComparison {

    private static final Logger LOG = LoggerFactory.getLogger(FlexComparison.class);

    private final List<Variant> variants;
    private final List<StudyRun> studyRuns;
    private final Path logFile;
    private final String simulatorDigest;

    /**
     * A study whose evaluations are kept in {@code logFile}.
     *
     * @param runs            per variant and interval, with seeds 1, 2, …, beside the one from the start as stated
     * @param simulatorDigest SHA-256 of the native program; evaluations that another one made do not count
     */
    FlexComparison(List<Variant> variants, int runs, Path logFile, String simulatorDigest) {
        this.variants = variants;
        this.studyRuns = variants.stream()
                .flatMap(variant -> Arrays.stream(Interval.values())
                        .flatMap(interval -> IntStream.rangeClosed(0, runs)
                                .mapToObj(seed -> new StudyRun(variant, interval, seed))))
                .toList();
        this.logFile = logFile;
        this.simulatorDigest = simulatorDigest;
    }

    /**
     * Carries out the evaluations that are missing.
     *
     * @param only name of the one variant to evaluate, or null for all
     * @return one comparison for each interval of each variant that has results, in the order of the variants
     */
    List<Comparison> run(Evaluator evaluator, String only) throws InterruptedException {
        try (StudyLog log = new StudyLog(logFile, studyRuns, simulatorDigest)) {
            List<StudyRun> missing = studyRuns.stream()
                    .filter(run -> only == null || run.variant().name().equals(only))
                    .filter(run -> log.resultOf(run) == null)
                    .toList();
            evaluate(missing, evaluator, log);
            return variants.stream()
                    .flatMap(variant -> Arrays.stream(Interval.values()).map(interval -> compare(variant, interval, log)))
                    .filter(comparison -> comparison.ours().count() > 0)
                    .toList();
        }
    }

    private static void evaluate(List<StudyRun> missing, Evaluator evaluator, StudyLog log)
            throws InterruptedException {
        List<SimulationRequest> requests = new ArrayList<>();
        for (StudyRun run : missing) {
            requests.add(run.request(requests.size()));
        }
        ListIterator<StudyRun> next = missing.listIterator();
        evaluator.evaluateInOrder(requests, result -> {
            SimulationRequest request = requests.get(next.nextIndex());
            StudyRun run = next.next();
            log.append(run, request, result);
            LOG.info("{} of {}: {}, {}, seed {}: {}", next.nextIndex(), missing.size(), run.variant().name(),
                    run.interval().label(), run.seed(), outcome(result));
        });
    }

    private static String outcome(SimulationResult result) {
        return result.status() == SimulationResult.Status.OK ? String.format(Locale.ROOT, "%.4f units/s", result.speed())
                : result.status() + (result.error() == null ? "" : ", " + result.error());
    }

    private Comparison compare(Variant variant, Interval interval, StudyLog log) {
        Map<Boolean, List<Double>> speeds = studyRuns.stream()
                .filter(run -> run.variant() == variant && run.interval() == interval)
                .collect(Collectors.partitioningBy(run -> run.seed() == 0,
                        Collectors.flatMapping(run -> speed(log.resultOf(run)), Collectors.toList())));
        return Comparison.of(variant, interval, speeds.get(false), speeds.get(true));
    }

    private static Stream<Double> speed(SimulationResult result) {
        return Stream.ofNullable(result).filter(one -> one.status() == SimulationResult.Status.OK)
                .map(SimulationResult::speed);
    }
}
