package io.natator.config;

/** Sizes of an evolution that belong together. */
public enum Preset {
    /** Some 350 evaluations: a few minutes on two cores. */
    QUICK(24, 8),
    /** The thesis' size (2.6): some 22 500 evaluations. */
    THESIS(150, 100);

    private final int population;
    private final int generations;

    Preset(int population, int generations) {
        this.population = population;
        this.generations = generations;
    }

    /** Chromosomes at the start, and selected in each generation. */
    public int population() {
        return population;
    }

    /** Generations bred after the random one. */
    public int generations() {
        return generations;
    }
}
