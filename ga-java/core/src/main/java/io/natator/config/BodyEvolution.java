package io.natator.config;

import com.fasterxml.jackson.annotation.JsonInclude;
import io.natator.base.InvalidInputException;
import io.natator.body.Genome;
import io.natator.body.ProfileBody;
import io.natator.encoding.Encoding;
import io.natator.encoding.Gait;

/**
 * What an evolution of bodies changes.
 *
 * @param what the body alone, or the gait too
 * @param body of the scene, around which bodies are evolved
 * @param gait that all bodies swim with, where they alone are evolved; else null
 */
@JsonInclude(JsonInclude.Include.NON_NULL)
public record BodyEvolution(Evolved what, ProfileBody body, Gait gait) {

    /**
     * Checks that all is there, and no more.
     *
     * @throws InvalidInputException naming what is missing
     */
    public BodyEvolution {
        if (what != Evolved.BODY && what != Evolved.BOTH || body == null) {
            throw new InvalidInputException("evolve is " + what + (body == null ? " without a body" : "")
                    + "; expected body or both, and the scene's body");
        }
        if ((gait == null) == (what == Evolved.BODY)) {
            throw new InvalidInputException(
                    gait == null ? "evolve body has no gait; expected one that the bodies are to swim with"
                            : "evolve both has a gait; expected none, since gaits are evolved");
        }
    }

    Genome genome(Encoding encoding) {
        return what == Evolved.BODY ? Genome.ofBody(gait, body) : Genome.ofBoth(encoding, body);
    }
}
