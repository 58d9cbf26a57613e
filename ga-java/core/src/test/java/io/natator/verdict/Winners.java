package io.natator.verdict;

import io.natator.checkpoint.BestGait;
import io.natator.checkpoint.Controls;
import io.natator.checkpoint.ControlsBuilder;
import io.natator.checkpoint.FreshRuns;
import io.natator.checkpoint.SwimSample;
import io.natator.config.Aggregate;
import io.natator.encoding.Gait;
import io.natator.protocol.Results;
import io.natator.protocol.SimulationResult;
import java.util.Arrays;
import java.util.List;

/** Winners of runs, and what was measured of them. */
public final class Winners {
    /** Of the winner. */
    public static final Gait GAIT = new Gait(2, List.of(0.1), List.of(0.0));
    /** Of its body, in scene units. */
    public static final double LENGTH = 1.25;

    private Winners() {
    }

    /** One that got 2.5 in the run that is shown. */
    public static BestGait best(FreshRuns fresh, double vacuum) {
        return best("pool/creature-1", Results.ok(2.5), LENGTH, Results.ok(vacuum), fresh);
    }

    /** One with this result in water and without. */
    public static BestGait best(String scene, SimulationResult water, Double length, SimulationResult vacuum,
            FreshRuns fresh) {
        return new BestGait(scene, List.of(1.0), GAIT, null, water.distanceOrZero(), water.speed(), water, length,
                vacuum, 2.5, 1, fresh);
    }

    /** Runs of 4 s that got so far. */
    public static SwimSample sample(double... distances) {
        return sample(Arrays.stream(distances).mapToObj(Results::ok).toList());
    }

    /** Runs of 4 s. */
    public static SwimSample sample(List<SimulationResult> runs) {
        return SwimSample.of(runs, 4, GAIT, 4.0, LENGTH);
    }

    /** Fresh runs of a winner that was worth so much by one run. */
    public static FreshRuns fresh(SwimSample base, SwimSample half, double selected, Double... worths) {
        return FreshRuns.of(4.0, base, half, Aggregate.MEAN, selected, 1, List.of(worths));
    }

    /** Controls in which a dead body drifts by -0.01 and all else is as in water. */
    public static Controls controls(SwimSample water) {
        return ControlsBuilder.builder().gait(GAIT).scheme("conserving").duration(4.0).bodyLength(LENGTH).water(water)
                .resting(sample(-0.01)).vacuum(sample(0.0)).halfStep(water).mirrored(water).build();
    }
}
