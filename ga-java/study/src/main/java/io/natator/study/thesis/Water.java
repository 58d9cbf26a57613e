package io.natator.study.thesis;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.config.EvolutionSettings;
import io.natator.config.InvalidInputException;
import io.natator.config.Scheme;
import java.util.Arrays;
import java.util.Locale;
import java.util.stream.DoubleStream;

/**
 * What the study's creatures swim in: scenes of one kind, simulated by one scheme. The thesis' tank in scheme
 * {@code conserving} is none of them: its bodies are heavier than the water that they displace and lie on the floor within half a
 * second, which {@link ExperimentCatalogue#sinking} measures; nor does anything swim that evolves there
 * ({@code results/thesis/sinking.py}).
 */
public enum Water {
    /** The thesis' tank as the thesis has it. */
    FLEX(Scheme.FLEX, "thesis"),
    /**
     * Incompressible water, wide and deep against the creatures, which are as heavy as the water that they displace. A
     * simulated second costs some twenty times as much as in the thesis' tank; so evolutions are smaller and search at half of the scene's
     * substeps, in less water and for less time. What they find is judged in the scene as it is.
     */
    OPEN_WATER(Scheme.CONSERVING, "open-water");

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
    record Evolving(int population, int generations, int starts, Double duration, JsonNode overrides) {

        static Evolving of(EvolutionSettings settings) {
            return new Evolving(settings.population(), settings.generations(), settings.starts(), settings.duration(), settings.overrides());
        }

        /** The same over so many generations. */
        Evolving over(int number) {
            return new Evolving(population, number, starts, duration, overrides);
        }
    }

    private final Scheme scheme;
    private final String scenes;

    Water(Scheme scheme, String scenes) {
        this.scheme = scheme;
        this.scenes = scenes;
    }

    /**
     * How gaits of one of the thesis' creatures are searched for, where nothing else is asked for. Creature 2 swims furthest and swings
     * widest: its tank is narrower, so that what touches no wall there keeps clear of them in the scene as it is, for longer. Of
     * creature 3 such a tank orders gaits less well ({@code results/thesis/search_steps.py}).
     */
    Evolving evolving(int creature) {
        if (this == FLEX) {
            return new Evolving(150, 25, 2, null, null);
        }
        return creature == 2 ? new Evolving(60, 25, 2, 2.5, search(4.5, 1, 1.2)) : new Evolving(60, 25, 2, 1.75, search(4, 1, 1.6));
    }

    /**
     * An eighth of the passes over the water, as many iterations of the body in a frame, and a tank that is shorter and shallower than the
     * scene's 6 × 1.6 × 1.6, under as much more gravity: at the swimmer, halfway up, the water's pressure is the scene's. Gaits come in the
     * same order ({@code results/thesis/search_steps.py}).
     */
    private static ObjectNode search(double length, double height, double width) {
        double spacing = 0.1;
        ObjectNode overrides = JsonNodeFactory.instance.objectNode();
        overrides.putObject("solver").put("substeps", 2).put("numIterations", 1).put("solidIterations", 128)
                .set("gravity", array(0, -4.8 / height, 0));
        overrides.putArray("planes").add(array(0, 1, 0, 0)).add(array(1, 0, 0, 0)).add(array(-1, 0, 0, length))
                .add(array(0, 0, 1, 0)).add(array(0, 0, -1, width));
        ArrayNode count = overrides.putObject("fluid").putArray("count");
        DoubleStream.of(length, height, width).forEach(side -> count.add((int) Math.round(side / spacing)));
        overrides.putObject("creature").set("rearCentre", array(0.5, height / 2, width / 2));
        return overrides;
    }

    private static ArrayNode array(double... values) {
        ArrayNode array = JsonNodeFactory.instance.arrayNode();
        Arrays.stream(values).forEach(array::add);
        return array;
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
}
