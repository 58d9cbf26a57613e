package io.natator.body;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.encoding.Encoding;
import io.natator.encoding.Gait;
import io.natator.encoding.GeneRange;
import java.util.ArrayList;
import java.util.List;

/** What the genes of a run stand for: a gait, a body, or a gait and after it a body. */
public final class Genome {

    private final Encoding encoding;
    private final Gait held;
    private final BodyGenome body;
    private final List<GeneRange> genes;

    private Genome(Encoding encoding, Gait held, BodyGenome body) {
        this.encoding = encoding;
        this.held = held;
        this.body = body;
        List<GeneRange> all = new ArrayList<>(encoding == null ? List.of() : encoding.genes());
        all.addAll(body == null ? List.of() : body.genes());
        this.genes = List.copyOf(all);
    }

    /** Gaits of the scene's own body. */
    public static Genome ofGait(Encoding encoding) {
        return new Genome(encoding, null, null);
    }

    /** Bodies around the scene's that all swim with the same gait. */
    public static Genome ofBody(Gait gait, ProfileBody scene) {
        return new Genome(null, gait, new BodyGenome(scene));
    }

    /** Gaits, and bodies around the scene's. */
    public static Genome ofBoth(Encoding encoding, ProfileBody scene) {
        return new Genome(encoding, null, new BodyGenome(scene));
    }

    /** Names and ranges, in chromosome order. */
    public List<GeneRange> genes() {
        return genes;
    }

    /**
     * What these genes stand for.
     *
     * @param values as many as {@link #genes()}, each within its range
     * @throws IllegalArgumentException if there are too few or too many, or one is outside its range
     */
    public Swimmer decode(List<Double> values) {
        GeneRange.check(genes, values);
        Gait gait = encoding == null ? held : encoding.decode(values.subList(0, gaitGenes()));
        return new Swimmer(gait, body(values));
    }

    /** The body alone: a JSON Merge Patch on the scene, or null where that of the scene is not changed. */
    public JsonNode body(List<Double> values) {
        return body == null ? null : body.decode(values.subList(gaitGenes(), values.size())).patch();
    }

    private int gaitGenes() {
        return encoding == null ? 0 : encoding.genes().size();
    }

    /** What stands in the middle of all ranges. */
    public Swimmer middle() {
        return decode(genes.stream().map(range -> (range.lower() + range.upper()) / 2).toList());
    }
}
