package io.natator.study.thesis;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.config.InvalidInputException;
import io.natator.config.Scheme;
import java.util.Locale;

/**
 * What the study's creatures swim in: scenes of one kind, simulated by one scheme. The thesis' tank in scheme
 * {@code conserving} is none of them: its bodies are heavier than the water that they displace and lie on the floor within half a
 * second, which {@link ExperimentCatalogue#sinking} measures.
 */
public enum Water {
    /** The thesis' tank as the thesis has it. */
    FLEX(Scheme.FLEX, "thesis", new Evolving(150, 25, 2, null, null)),
    /**
     * Incompressible water, wide and deep against the creatures, which are as heavy as the water that they displace. A
     * simulated second costs some twenty times as much as in the tank; so evolutions are smaller and search at half of the scene's
     * substeps, with as many iterations of the body in a frame. What they find is judged in the scene as it is.
     */
    OPEN_WATER(Scheme.CONSERVING, "open-water", new Evolving(60, 25, 2, 2.5, steps(2, 32)));

    /** Of a frame, in the scenes as they are. */
    static final int SUBSTEPS = 4;

    /**
     * How gaits are searched for, where nothing else is asked for.
     *
     * @param population  chromosomes
     * @param generations after the random one
     * @param starts      runs of a new gait
     * @param duration    of a run in seconds, or null for the scene's own
     * @param overrides   on the scene, or null
     */
    record Evolving(int population, int generations, int starts, Double duration, ObjectNode overrides) {
    }

    private final Scheme scheme;
    private final String scenes;
    private final Evolving evolving;

    Water(Scheme scheme, String scenes, Evolving evolving) {
        this.scheme = scheme;
        this.scenes = scenes;
        this.evolving = evolving;
    }

    private static ObjectNode steps(int substeps, int solidIterations) {
        ObjectNode overrides = JsonNodeFactory.instance.objectNode();
        overrides.putObject("solver").put("substeps", substeps).put("solidIterations", solidIterations);
        return overrides;
    }

    /** What simulates it. */
    public Scheme scheme() {
        return scheme;
    }

    /** In options and in the names of folders. */
    public String label() {
        return name().toLowerCase(Locale.ROOT).replace('_', '-');
    }

    /** In sentences and tables. */
    String words() {
        return label().replace('-', ' ');
    }

    /**
     * The scene of one of the thesis' creatures in it.
     *
     * @throws InvalidInputException if there is no such creature
     */
    public String scene(int creature) {
        return ThesisData.scene(creature).replaceFirst("^thesis", scenes);
    }

    Water other() {
        return this == FLEX ? OPEN_WATER : FLEX;
    }

    Evolving evolving() {
        return evolving;
    }
}
