package io.natator.study.optimizer;

import io.natator.checkpoint.RunFolder;
import io.natator.checkpoint.StoredRun;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.config.InvalidInputException;
import io.natator.evolution.EvaluationRecord;
import io.natator.evolution.EvolutionListener;
import io.natator.evolution.EvolutionStoppedException;
import io.natator.run.EvolutionRun;
import io.natator.simulator.Evaluator;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.Future;
import java.util.concurrent.TimeUnit;
import java.util.function.Supplier;

/**
 * Optimizers side by side: each runs on each scene with each seed, and all take the same number of evaluations. Every
 * run has a run folder of its own, {@code SCENE/OPTIMIZER/seed-S}, so the study continues wherever it was stopped.
 */
public final class OptimizerStudy {

    private final Path directory;
    private final List<OptimizerRun> runs = new ArrayList<>();

    /**
     * What is to be compared.
     *
     * @param scenes         settings by short name of a scene; its size is that of JGAP and random search, its number
     *                       of evaluations what every run takes
     * @param contestants    at least one
     * @param seeds          runs of each with seeds 1, 2, …; at least 1
     * @param cmaEsPopulation evaluations in a generation of CMA-ES, or null for its inventor's 4 + ⌊3 ln n⌋ with n genes
     * @param directory      where the run folders and results go
     */
    public OptimizerStudy(Map<String, EvolutionSettings> scenes, List<Contestant> contestants, int seeds,
            Integer cmaEsPopulation, Path directory) {
        if (seeds < 1) {
            throw new InvalidInputException("--seeds is " + seeds + "; expected a whole number from 1");
        }
        this.directory = directory;
        for (int seed = 1; seed <= seeds; seed++) {
            for (Map.Entry<String, EvolutionSettings> scene : scenes.entrySet()) {
                for (Contestant contestant : contestants) {
                    EvolutionSettings settings = contestant.in(scene.getValue().withSeed(seed));
                    if (contestant.isCmaEs()) {
                        settings = settings.withSize(cmaEsPopulation != null ? cmaEsPopulation : usualSize(settings),
                                settings.generations());
                    }
                    runs.add(new OptimizerRun(scene.getKey(), contestant, settings,
                            directory.resolve(scene.getKey()).resolve(contestant.label()).resolve("seed-" + seed)));
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
        return runs.stream().filter(run -> StoredRun.exists(run.directory()))
                .mapToLong(run -> StoredRun.evaluations(run.directory()).size()).sum();
    }

    /** How many runs are finished. */
    public int finished() {
        return finishedRuns().size();
    }

    private List<OptimizerRun> finishedRuns() {
        return runs.stream().filter(run -> StoredRun.isFinished(run.directory())).toList();
    }

    /** Follows the study; called from several threads. */
    public interface Watcher {

        /** An evaluation has ended that was not recorded before. */
        void evaluated();

        /** A run has reached its end. */
        void finished(Path run, double bestDistance);

        /** An own listener for a run that is about to begin or to continue. */
        EvolutionListener forRun();
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
    public boolean run(ExecutionSettings execution, Evaluator evaluator, int atOnce, Watcher watcher)
            throws InterruptedException {
        ConcurrentLinkedQueue<OptimizerRun> waiting = new ConcurrentLinkedQueue<>(
                runs.stream().filter(run -> !StoredRun.isFinished(run.directory())).toList());
        ExecutorService threads = Executors.newFixedThreadPool(atOnce);
        try {
            List<Future<Boolean>> lanes = new ArrayList<>();
            for (int i = 0; i < atOnce; i++) {
                lanes.add(threads.submit(() -> work(waiting::poll, execution, evaluator, watcher)));
            }
            boolean all = true;
            for (Future<Boolean> lane : lanes) {
                all &= lane.get();
            }
            return all;
        } catch (ExecutionException e) {
            evaluator.close();
            if (e.getCause() instanceof RuntimeException cause) {
                throw cause;
            }
            throw new IllegalStateException(e.getCause());
        } finally {
            threads.shutdown();
            threads.awaitTermination(1, TimeUnit.MINUTES);
        }
    }

    private static boolean work(Supplier<OptimizerRun> waiting, ExecutionSettings execution, Evaluator evaluator,
            Watcher watcher) throws InterruptedException {
        try {
            for (OptimizerRun run = waiting.get(); run != null; run = waiting.get()) {
                carryOut(run, execution, evaluator, watcher);
            }
            return true;
        } catch (EvolutionStoppedException | InterruptedException e) {
            return false;
        } catch (RuntimeException e) {
            evaluator.close();
            throw e;
        }
    }

    private static void carryOut(OptimizerRun run, ExecutionSettings execution, Evaluator evaluator, Watcher watcher)
            throws InterruptedException {
        try (RunFolder folder = run.open()) {
            int before = folder.recorded().size();
            EvolutionListener counter = new EvolutionListener() {
                @Override
                public void evaluated(EvaluationRecord evaluation) {
                    if (evaluation.result().id() >= before) {
                        watcher.evaluated();
                    }
                }
            };
            EvolutionRun.Outcome outcome = new EvolutionRun(folder).run(execution, evaluator, counter,
                    watcher.forRun());
            watcher.finished(run.directory(),
                    outcome.state().best() == null ? 0 : outcome.state().best().result().score());
        }
    }

    /**
     * Writes table and pictures of the finished runs.
     *
     * @param command what the study was started by
     * @return the page with the results
     */
    public Path report(String command) {
        return OptimizerReport.write(finishedRuns(), runs.size(), command, directory);
    }
}
