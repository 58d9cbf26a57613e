package io.natator.study.optimizer;

import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.config.Limits;
import io.natator.run.RunQueue;
import io.natator.simulator.Evaluator;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

/**
 * Optimizers side by side: each runs on each scene with each seed, and all take the same number of evaluations. Every
 * run has a run folder of its own, {@code SCENE/OPTIMIZER/seed-S}, so the study continues wherever it was stopped; of
 * finished ones it can keep a line in {@code SCENE.jsonl} instead.
 */
public final class OptimizerStudy {

    private final Path directory;
    private final List<OptimizerRun> runs = new ArrayList<>();
    private final Map<String, RunSummaries> kept = new LinkedHashMap<>();

    /**
     * What is to be compared.
     *
     * @param scenes         settings by short name of a scene; its size is that of JGAP and random search, its number
     *                       of evaluations what every run takes
     * @param variants    at least one
     * @param seeds          runs of each with seeds 1, 2, …; at least 1
     * @param cmaEsPopulation evaluations in a generation of CMA-ES, or null for its inventor's 4 + ⌊3 ln n⌋ with n genes
     * @param directory      where the run folders and results go
     */
    public OptimizerStudy(Map<String, EvolutionSettings> scenes, List<OptimizerVariant> variants, int seeds,
            Integer cmaEsPopulation, Path directory) {
        Limits.checkCount("--seeds", seeds, Limits.REPETITIONS);
        this.directory = directory;
        scenes.keySet().forEach(scene -> kept.put(scene, new RunSummaries(directory, scene)));
        for (int seed = 1; seed <= seeds; seed++) {
            for (Map.Entry<String, EvolutionSettings> scene : scenes.entrySet()) {
                for (OptimizerVariant variant : variants) {
                    EvolutionSettings settings = variant.in(scene.getValue().withSeed(seed));
                    if (variant.isCmaEs()) {
                        settings = settings.withSize(cmaEsPopulation != null ? cmaEsPopulation : usualSize(settings),
                                settings.generations());
                    }
                    runs.add(new OptimizerRun(scene.getKey(), variant, settings,
                            directory.resolve(scene.getKey()).resolve(variant.label()).resolve("seed-" + seed),
                            kept.get(scene.getKey()).find(variant, settings)));
                }
            }
        }
    }

    private static int usualSize(EvolutionSettings settings) {
        int genes = settings.encoding().forActuators(settings.actuators()).genes().size();
        return 4 + (int) Math.floor(3 * Math.log(genes));
    }

    /** How many runs there are. */
    public int size() {
        return runs.size();
    }

    /** How many evaluations they take together. */
    public long evaluations() {
        return runs.stream().mapToLong(run -> run.settings().evaluations()).sum();
    }

    /** How many evaluations are recorded already. */
    public long recorded() {
        return runs.stream().mapToLong(OptimizerRun::recorded).sum();
    }

    /** How many runs are finished. */
    public int finished() {
        return finishedRuns().size();
    }

    private List<OptimizerRun> finishedRuns() {
        return runs.stream().filter(OptimizerRun::isFinished).toList();
    }

    /**
     * Carries out what is missing.
     *
     * @param execution how the evaluator works, for the record
     * @param evaluator carries out the evaluations; closed if a run fails
     * @param atOnce    runs under way at the same time, at least 1
     * @return whether all runs are finished; false if the evaluator was closed meanwhile
     * @throws InterruptedException if the calling thread is interrupted
     */
    public boolean run(ExecutionSettings execution, Evaluator evaluator, int atOnce, RunQueue.Watcher watcher)
            throws InterruptedException {
        return new RunQueue(runs.stream().filter(run -> run.summary() == null).map(OptimizerRun::plan).toList())
                .run(execution, evaluator, atOnce, watcher);
    }

    /** Keeps a line of every finished run in {@code SCENE.jsonl}, and removes its folder. */
    public void compact() {
        runs.replaceAll(run -> run.isFinished() ? run.summarised() : run);
        kept.forEach((scene, summaries) -> summaries.keep(
                finishedRuns().stream().filter(run -> run.scene().equals(scene)).toList()));
    }

    /**
     * Writes table and pictures of the finished runs.
     *
     * @param command what the study was started by
     * @return the page with the results
     */
    public Path report(String command) {
        return OptimizerReport.write(finishedRuns().stream().map(OptimizerRun::summarised).toList(), runs.size(), command,
                directory);
    }
}
