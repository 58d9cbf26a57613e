package io.natator.config;

/** Settings of an evolution that belong together; each can be given by itself too. */
public enum Preset {
    /** Some 90 evaluations of 2 s in a small pool of water in which only swimming pays: some two minutes on two cores. */
    QUICK(16, 3, "pool", 2.0),
    /** The thesis' size (2.6): some 22 500 evaluations in its tank, as the scene has it (scheme flex, 4 s). */
    THESIS(150, 100, "thesis", null);

    private final int population;
    private final int generations;
    private final String scenes;
    private final Double duration;

    Preset(int population, int generations, String scenes, Double duration) {
        this.population = population;
        this.generations = generations;
        this.scenes = scenes;
        this.duration = duration;
    }

    /** Chromosomes at the start, and selected in each generation. */
    public int population() {
        return population;
    }

    /** Generations bred after the random one. */
    public int generations() {
        return generations;
    }

    /** Name of the scene of a creature, 1 to 4. */
    public String sceneOf(int creature) {
        return scenes + "/creature-" + creature;
    }

    /** Simulated time of an evaluation in seconds, or null for the scene's own. */
    public Double duration() {
        return duration;
    }
}
