package io.natator.study.thesis;

import com.fasterxml.jackson.annotation.JsonProperty;
import com.fasterxml.jackson.core.JsonProcessingException;
import io.natator.config.InvalidInputException;
import io.natator.config.Json;
import io.natator.encoding.Gait;
import java.io.IOException;
import java.io.InputStream;
import java.io.UncheckedIOException;
import java.nio.charset.StandardCharsets;
import java.util.List;

/**
 * What the thesis published, and what NVIDIA Flex 1.2.0 was measured to do with its gaits; {@code thesis.json}.
 *
 * @param about          what the file holds and where it is from
 * @param eelBodyLengths speed of an eel in body lengths per second, for comparison
 * @param gaits          published gaits, and those of creature 2 with twice the phase step
 */
public record ThesisData(@JsonProperty(required = true) List<String> about,
        @JsonProperty(required = true) double eelBodyLengths,
        @JsonProperty(required = true) List<PublishedGait> gaits) {

    /**
     * A gait of the thesis.
     *
     * @param name       unique
     * @param creature   1 to 4
     * @param about      what it is, in words
     * @param gait       frequency, amplitudes and phases
     * @param published  what the thesis says of it; null for a gait that is not in the thesis
     * @param flex       what Flex 1.2.0 was measured to do with it; empty if it was not
     */
    public record PublishedGait(@JsonProperty(required = true) String name, @JsonProperty(required = true) int creature,
            @JsonProperty(required = true) String about, @JsonProperty(required = true) Gait gait, Published published,
            @JsonProperty(required = true) List<FlexSpeed> flex) {
    }

    /**
     * Published results.
     *
     * @param speed       in fluid, scene units per second (table 3.1)
     * @param vacuumSpeed the same in vacuum
     * @param errors      e against the anguilliform, carangiform and thunniform mode (table 3.2)
     */
    public record Published(double speed, double vacuumSpeed, List<Double> errors) {
    }

    /**
     * A measured mean speed of Flex 1.2.0 over 0 to 4 s.
     *
     * @param setting   {@code fluid}, {@code fluid-inverse-mass} or {@code vacuum}
     * @param mean      scene units per second
     * @param deviation standard deviation of equal runs, or null for a single run
     * @param runs      names of the runs in the measurements
     * @param errors    e of a recorded run by the present measure, or null
     */
    public record FlexSpeed(@JsonProperty(required = true) String setting, @JsonProperty(required = true) double mean,
            Double deviation, @JsonProperty(required = true) String runs, List<Double> errors) {
    }

    /** Reads the data that come with this program. */
    public static ThesisData load() {
        try (InputStream in = ThesisData.class.getResourceAsStream("thesis.json")) {
            return Json.parse(new String(in.readAllBytes(), StandardCharsets.UTF_8), ThesisData.class);
        } catch (JsonProcessingException e) {
            throw new IllegalStateException("thesis.json: " + Json.reason(e), e);
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    /**
     * The scene of a creature.
     *
     * @throws InvalidInputException if there is no such creature
     */
    public static String scene(int creature) {
        if (creature < 1 || creature > 4) {
            throw new InvalidInputException("--creature has " + creature + "; expected 1, 2, 3 or 4");
        }
        return "thesis/creature-" + creature;
    }

    /** The gait of the creature in one of the thesis' scenes, of several the last; null for any other scene. */
    public Gait gaitIn(String scene) {
        return gaits.stream().filter(one -> scene.replaceFirst("-vacuum$", "").equals(scene(one.creature())))
                .map(PublishedGait::gait).reduce((first, last) -> last).orElse(null);
    }

    /** The gait of a name. */
    public PublishedGait gait(String name) {
        return gaits.stream().filter(gait -> gait.name().equals(name)).findFirst().orElseThrow();
    }
}
