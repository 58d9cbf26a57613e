package io.natator.config;

import java.util.List;

/** Settings of an evolution that belong together; each can be given by itself too. */
public enum Preset {
    /**
     * Some 110 evaluations of 4 s in plane flow, or 90 of 2 s in a small pool of water in which only swimming pays: some two
     * minutes on two cores. Each gait swims once, or it would take four times as long; only the winner is run from fresh
     * starts.
     */
    QUICK(16, 3, "plane/loach", "pool", "pool", 2.0, 1) {
        @Override
        public int population(String inScene) {
            return inScene.equals(scene()) ? 20 : super.population(inScene);
        }

        /** Work has a price in plane flow, so that tails do not beat far wider than those of fish. */
        @Override
        public List<WeightedObjective> objectives(String inScene) {
            return inScene.equals(scene())
                    ? List.of(new WeightedObjective(Objective.DISTANCE, 1.0),
                            new WeightedObjective(Objective.WORK, 5e-5))
                    : null;
        }
    },
    /** The thesis' size (2.6): some 22 500 gaits in its tank, as the scene has it (scheme flex, 4 s), four runs each. */
    THESIS(150, 100, "thesis/creature-1", "thesis", "open-water", null, 4);

    private final int population;
    private final int generations;
    private final String scene;
    private final String scenes;
    private final String otherScenes;
    private final Double duration;
    private final int starts;

    Preset(int population, int generations, String scene, String scenes, String otherScenes, Double duration,
            int starts) {
        this.population = population;
        this.generations = generations;
        this.scene = scene;
        this.scenes = scenes;
        this.otherScenes = otherScenes;
        this.duration = duration;
        this.starts = starts;
    }

    /** Chromosomes in a scene at the start, and selected in each generation. */
    public int population(String inScene) {
        return population;
    }

    /** What is rewarded in a scene, as a weighted sum; null for the distance. */
    public List<WeightedObjective> objectives(String inScene) {
        return null;
    }

    /** Generations bred after the random one. */
    public int generations() {
        return generations;
    }

    /** Whether a word can be a creature: 1 to 4, or the name of another body. */
    public static boolean isCreature(String creature) {
        return creature.matches("[1-4]|[a-z][a-z0-9-]*");
    }

    /** Name of the scene that it is for where none is asked for. */
    public String scene() {
        return scene;
    }

    /**
     * Name of the scene of a creature: 1 to 4 are the thesis'; others, which its tank does not know, are in open water. That
     * of its own scene is there.
     *
     * @param creature for example {@code 2} or {@code eel}
     */
    public String sceneOf(String creature) {
        if (scene.endsWith("/" + creature)) {
            return scene;
        }
        if (creature.matches("[1-4]")) {
            return scenes + "/creature-" + creature;
        }
        return (creature.matches("creature-[1-4]") ? scenes : otherScenes) + "/" + creature;
    }

    /** Simulated time of an evaluation in a scene, s; null for the scene's own, as in {@link #scene()}. */
    public Double duration(String inScene) {
        return inScene.equals(scene) ? null : duration;
    }

    /** Runs of each new gait. */
    public int starts() {
        return starts;
    }
}
