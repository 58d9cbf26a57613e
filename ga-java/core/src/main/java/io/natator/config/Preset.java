package io.natator.config;

/** Settings of an evolution that belong together; each can be given by itself too. */
public enum Preset {
    /** Some 90 evaluations of 2 s, by the scheme in which only swimming pays: about a minute on two cores. */
    QUICK(16, 3, Scheme.CONSERVING, 2.0),
    /** The thesis' size (2.6): some 22 500 evaluations, as the scene has it (in the thesis' own: scheme flex, 4 s). */
    THESIS(150, 100, null, null);

    private final int population;
    private final int generations;
    private final Scheme scheme;
    private final Double duration;

    Preset(int population, int generations, Scheme scheme, Double duration) {
        this.population = population;
        this.generations = generations;
        this.scheme = scheme;
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

    /** How to solve, or null for the scene's own scheme. */
    public Scheme scheme() {
        return scheme;
    }

    /** Simulated time of an evaluation in seconds, or null for the scene's own. */
    public Double duration() {
        return duration;
    }
}
