package io.natator.run;

import io.natator.checkpoint.RunReader;
import io.natator.checkpoint.RunWriter;
import io.natator.checkpoint.VacuumRecord;
import io.natator.config.EvolutionSettings;
import io.natator.evolution.EvolutionListener;
import io.natator.evolution.EvolutionState;
import io.natator.evolution.EvolutionStoppedException;
import io.natator.evolution.Individual;
import io.natator.process.Evaluator;
import io.natator.protocol.RequestRejectedException;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import java.util.ArrayList;
import java.util.List;

/** Runs the best gait after each generation that found a better one in vacuum too, for as long as it swam. */
final class VacuumCheck implements EvolutionListener {

    private final RunWriter folder;
    private final Evaluator evaluator;
    private final List<VacuumRecord> records;

    /** A check that knows what an interrupted run has checked. */
    VacuumCheck(RunWriter folder, Evaluator evaluator) {
        this.folder = folder;
        this.evaluator = evaluator;
        this.records = new ArrayList<>(RunReader.vacuumRecords(folder.directory()));
        if (folder.checkpoint() != null) {
            // A run that was killed between its checkpoint and the check that belongs to it.
            generationFinished(folder.checkpoint());
        }
    }

    @Override
    public void generationFinished(EvolutionState state) {
        Individual best = state.best();
        if (best == null || records.stream().anyMatch(known -> known.evaluation() == best.result().id())) {
            return;
        }
        try {
            SimulationResult vacuum = drift(best, folder.settings(), best.result().simulated(), evaluator);
            records.add(new VacuumRecord(state.generation(), best.result().id(), best.result().distance(),
                    best.result().simulated(), vacuum.distance()));
            folder.write(records);
        } catch (InterruptedException e) {
            throw new EvolutionStoppedException("stopped in the vacuum check after generation " + state.generation());
        }
    }

    /** What an individual does without water. */
    static SimulationResult drift(Individual individual, EvolutionSettings settings, Double duration,
            Evaluator evaluator) throws InterruptedException {
        SimulationRequest request = SimulationRequest.of(individual.result().id(), settings,
                settings.problem().genome().decode(individual.genes()));
        try {
            return evaluator.evaluate(request.inVacuum(duration));
        } catch (RequestRejectedException e) {
            e.throwUnlessBadInput();
            return SimulationResult.failed(request.id(), e.getMessage());
        }
    }
}
