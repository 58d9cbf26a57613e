package io.natator.study.optimizer;

import io.natator.checkpoint.StoredRun;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.config.InvalidInputException;
import io.natator.config.Limits;
import io.natator.config.Numbers;
import io.natator.file.GeneratedPage;
import io.natator.run.Lanes;
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
    private final Map<String, FreshResults> again = new LinkedHashMap<>();
    private final int rankStarts;

    /**
     * What is to be compared.
     *
     * @param scenes          settings by short name of a scene; its size is that of JGAP and random search, its number
     *                        of evaluations what every run takes
     * @param variants        at least one
     * @param seeds           runs of each with seeds 1, 2, …; at least 1
     * @param cmaEsPopulation evaluations in a generation of CMA-ES, or null for its inventor's 4 + ⌊3 ln n⌋ with n genes
     * @param rankStarts      fresh starts by which the gaits of each run's last generation are ranked; 0: they are not
     * @param directory       where the run folders and results go
     * @throws InvalidInputException if the folder is a run's or has a page of somebody's own, or if the last generation of
     *                               a run that is only a line is to be ranked
     */
    public OptimizerStudy(Map<String, EvolutionSettings> scenes, List<OptimizerVariant> variants, int seeds,
            Integer cmaEsPopulation, int rankStarts, Path directory) {
        Limits.checkCount("--seeds", seeds, Limits.REPETITIONS);
        GeneratedPage.check(directory);
        if (StoredRun.exists(directory)) {
            throw new InvalidInputException("output folder " + directory + " is the folder of a run; choose another by --output-dir");
        }
        this.directory = directory;
        this.rankStarts = rankStarts;
        scenes.keySet().forEach(scene -> again.put(scene, new FreshResults(directory, scene)));
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
        runs.stream().filter(run -> run.summary() == null).forEach(run -> run.plan().check());  // a finished one is not opened any more
        long unknown = runs.stream().filter(run -> run.summary() != null && !isRanked(run)
                && !StoredRun.exists(run.directory())).count();
        if (unknown > 0) {
            throw new InvalidInputException("--rank-starts is " + rankStarts + "; the last generation of " + unknown
                    + " runs, which --compact left only a line of, can no longer be ranked from so many");
        }
    }

    private boolean isRanked(OptimizerRun run) {
        return FreshWork.isRanked(run, rankStarts, again.get(run.scene()));
    }

    private static int usualSize(EvolutionSettings settings) {
        int genes = settings.genome().genes().size();
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
     * Carries out what is missing: the runs, then what they are compared by from fresh starts.
     *
     * @param execution how the evaluator works, for the record
     * @param evaluator carries out the evaluations; closed if a run fails
     * @param atOnce    runs under way at the same time, at least 1
     * @return whether all is done; false if the evaluator was closed meanwhile
     * @throws InterruptedException if the calling thread is interrupted
     */
    public boolean run(ExecutionSettings execution, Evaluator evaluator, int atOnce, RunQueue.Watcher watcher)
            throws InterruptedException {
        boolean all = new RunQueue(runs.stream().filter(run -> run.summary() == null).map(OptimizerRun::plan).toList(),
                execution.simulator()).run(execution, evaluator, atOnce, watcher);
        return all && runAgain(execution, evaluator, atOnce, watcher);
    }

    private boolean runAgain(ExecutionSettings execution, Evaluator evaluator, int atOnce, RunQueue.Watcher watcher)
            throws InterruptedException {
        List<FreshWork> missing = missing();
        if (!missing.isEmpty()) {
            watcher.said("running " + Numbers.count(missing.stream().mapToInt(one -> one.genomes().size()).sum(), "gait")
                    + " again from fresh starts" + (rankStarts == 0 ? "" : ", and ranking the last generations of "
                    + Numbers.count(missing.stream().filter(one -> one.rankStarts() > 0).count(), "run")));
        }
        try {
            return Lanes.carryOut(missing.stream().map(one -> one.with(evaluator, execution.simulator())).toList(), evaluator,
                    atOnce);
        } finally {
            again.values().forEach(FreshResults::close);
        }
    }

    /** What is still to be run from fresh starts, once all runs are finished. */
    private List<FreshWork> missing() {
        runs.replaceAll(run -> run.isFinished() ? run.summarised() : run);
        List<FreshWork> missing = new ArrayList<>();
        for (OptimizerRun run : finishedRuns()) {
            List<RunSummary> all = runs.stream().filter(other -> other.scene().equals(run.scene()) && other.isFinished())
                    .map(OptimizerRun::summary).toList();
            FreshWork work = FreshWork.of(run, all, rankStarts, again.get(run.scene()));
            if (!work.isDone()) {
                missing.add(work);
            }
        }
        return missing;
    }

    /** How many runs are finished and compared from fresh starts as far as that is to be. */
    public int compared() {
        return finished() - missing().size();
    }

    /**
     * Keeps a line of every finished run in {@code SCENE.jsonl}, and removes its folder; not of those whose last generation is
     * still to be ranked.
     */
    public void compact() {
        runs.replaceAll(run -> run.isFinished() ? run.summarised() : run);
        kept.forEach((scene, summaries) -> summaries.keep(finishedRuns().stream()
                .filter(run -> run.scene().equals(scene) && isRanked(run)).toList()));
    }

    /**
     * Writes table and pictures of the finished runs.
     *
     * @param command what the study was started by
     * @return the page with the results
     */
    public Path report(String command) {
        return OptimizerReport.write(finishedRuns().stream().map(OptimizerRun::summarised).toList(), runs.size(), command,
                directory, again);
    }
}
