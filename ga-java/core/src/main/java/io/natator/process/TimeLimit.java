package io.natator.process;

import java.time.Duration;

/** How long an evaluation may take before it is taken to hang. */
public final class TimeLimit {

    /** Seconds for a slow start of the program on a busy machine. */
    private static final double FLOOR_SECONDS = 30;
    /**
     * Particles stepped through an iteration in a second, at the least: some seventieth of what one core does with
     * scheme {@code flex}.
     */
    private static final double PARTICLE_ITERATIONS_PER_SECOND = 5e5;
    /** Iterations that cost as much as the part of a substep that does not depend on their number. */
    private static final int FIXED_ITERATIONS = 4;

    private TimeLimit() {
    }

    /**
     * A generous limit that follows from the cost of a scene.
     *
     * @param duration simulated time in seconds, or null for the scene's own
     */
    public static Duration of(SceneInfo scene, Double duration) {
        double frames = (duration == null ? scene.duration() : duration) / scene.timeStep();
        double particleIterations = frames * scene.particles() * scene.substeps()
                * (scene.iterations() + FIXED_ITERATIONS);
        double seconds = FLOOR_SECONDS + particleIterations / PARTICLE_ITERATIONS_PER_SECOND;
        return Duration.ofSeconds(Math.round(Math.min(seconds, Integer.MAX_VALUE)));
    }
}
