package io.natator.study.thesis;

import io.natator.simulator.SimulationResult;
import io.natator.study.Sample;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;

/** The winners of the evolutions: of each the finalist that goes furthest by all its runs, less a standard error, and is unstable in none. */
final class Winners {

    private final Path directory;
    private final ExperimentCatalogue catalogue;
    private final MeasurementLog measurements;
    private final List<EvolvedRun> runs;
    private final Map<EvolvedRun, List<Experiment>> finalists = new HashMap<>();
    /** What is known stays: a finalist's runs are measured once. */
    private final Map<EvolvedRun, Subject> known = new HashMap<>();

    /**
     * Those of a study.
     *
     * @param directory of the study
     * @param runs      finished evolutions
     */
    Winners(Path directory, ExperimentCatalogue catalogue, MeasurementLog measurements, List<EvolvedRun> runs) {
        this.directory = directory;
        this.catalogue = catalogue;
        this.measurements = measurements;
        this.runs = List.copyOf(runs);
    }

    List<EvolvedRun> runs() {
        return runs;
    }

    /** What has to be measured for them to be known. */
    List<Experiment> experiments() {
        List<Experiment> all = new ArrayList<>();
        runs.forEach(run -> all.addAll(finalists(run)));
        return all;
    }

    /** Those that are known. */
    List<Subject> all() {
        return runs.stream().map(this::of).flatMap(Optional::stream).toList();
    }

    private List<Experiment> finalists(EvolvedRun run) {
        return finalists.computeIfAbsent(run, one -> catalogue.finalists(one, directory));
    }

    private Optional<Subject> of(EvolvedRun run) {
        if (!known.containsKey(run) && finalists(run).stream().allMatch(measurements::has)) {
            finalists(run).stream().max(Comparator.comparingDouble(this::sureWay))
                    .ifPresent(best -> known.put(run, ExperimentCatalogue.subject(run, best.request().gait(), directory)));
        }
        return Optional.ofNullable(known.get(run));
    }

    private double sureWay(Experiment experiment) {
        List<SimulationResult> results = measurements.results(experiment);
        if (results.stream().anyMatch(one -> one.status() == SimulationResult.Status.UNSTABLE)) {
            return Double.NEGATIVE_INFINITY;
        }
        Sample ways = Sample.of(results.stream().map(SimulationResult::distanceOrZero).toList());
        return ways.mean() - ways.standardError();
    }
}
