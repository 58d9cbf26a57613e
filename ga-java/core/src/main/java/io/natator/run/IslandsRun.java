package io.natator.run;

import io.natator.checkpoint.Archipelago;
import io.natator.checkpoint.RunFolder;
import io.natator.checkpoint.StoredRun;
import io.natator.config.Backend;
import io.natator.config.ExecutionSettings;
import io.natator.config.Migration;
import io.natator.evolution.Departure;
import io.natator.evolution.Exchange;
import io.natator.simulator.Evaluator;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Consumer;
import java.util.stream.IntStream;

/** Carries out the evolutions of all islands at the same time, from wherever they stand to their end. */
public final class IslandsRun {

    private final List<PlannedRun> islands;

    /** Of these islands, whose folders need not be there yet. */
    public IslandsRun(Archipelago archipelago) {
        this.islands = islands(archipelago);
    }

    private static List<PlannedRun> islands(Archipelago archipelago) {
        return IntStream.rangeClosed(1, archipelago.plan().islands())
                .mapToObj(i -> new PlannedRun(archipelago.plan().settings(i), archipelago.folder(i))).toList();
    }

    /** How many of the islands have come to the end that is planned. */
    public static int finished(Archipelago archipelago) {
        return (int) islands(archipelago).stream().filter(PlannedRun::isFinished).count();
    }

    /**
     * Writes what the islands are to have in common from here on, while nobody computes any of them.
     *
     * @throws io.natator.config.InvalidInputException if one of them cannot go on by that; nothing is written then
     */
    public static void change(Archipelago planned) {
        withUnfinished(islands(planned), folders -> planned.write());
    }

    /** Does something with the folders of all islands that have begun and not ended, if each can go on. */
    private static void withUnfinished(List<PlannedRun> islands, Consumer<List<RunFolder>> what) {
        List<RunFolder> folders = new ArrayList<>();
        try {
            islands.stream().filter(run -> StoredRun.exists(run.directory()) && !run.isFinished())
                    .forEach(run -> folders.add(run.openAsItIs()));
            what.accept(folders);
        } finally {
            folders.forEach(RunFolder::close);
        }
    }

    /**
     * Carries out what is missing. The outcome depends on the settings alone, not on which thread is faster.
     *
     * @param execution how the evaluator works, for the record
     * @param evaluator carries out the evaluations of all; closed if an island fails
     * @return whether all islands are finished; false if the evaluator was closed meanwhile
     * @throws InterruptedException if the calling thread is interrupted
     */
    public boolean run(ExecutionSettings execution, Evaluator evaluator, RunQueue.Watcher watcher) throws InterruptedException {
        withUnfinished(islands, folders -> folders.forEach(this::takeOverBackend));
        Ring ring = new Ring(islands.size());
        List<List<Departure>> departures = islands.stream().map(run -> StoredRun.departures(run.directory())).toList();
        List<Lanes.Work> all = new ArrayList<>();
        for (int i = 0; i < islands.size(); i++) {
            int island = i + 1;
            PlannedRun run = islands.get(i);
            departures.get(i).forEach(one -> ring.leave(island, one));
            List<Departure> before = departures.get(Migration.before(island, islands.size()) - 1);
            all.add(() -> carryOut(run, island, before, ring, execution, evaluator, watcher));
        }
        return Lanes.carryOut(all, evaluator, islands.size());
    }

    /** An island that is not finished computes as all do, also where a change of the backend was interrupted. */
    private void takeOverBackend(RunFolder folder) {
        Backend backend = islands.get(0).settings().backend();
        if (folder.settings().backend() != backend) {
            folder.changeBackend(backend);
        }
    }

    private static void carryOut(PlannedRun run, int island, List<Departure> before, Ring ring, ExecutionSettings execution,
            Evaluator evaluator, RunQueue.Watcher watcher) throws InterruptedException {
        boolean isFinished = false;
        try {
            if (run.isFinished()) {
                watcher.foundFinished(run.directory());
            } else {
                RunQueue.carryOut(run, execution, evaluator, watcher, folder -> exchange(folder, ring, before));
            }
            isFinished = true;
        } finally {
            if (isFinished) {
                ring.end(island);
            } else {
                ring.stop();
            }
        }
    }

    private static Exchange exchange(RunFolder folder, Ring ring, List<Departure> before) {
        return folder.settings().migration() == null ? Exchange.NONE : new Island(folder, ring, before);
    }
}
