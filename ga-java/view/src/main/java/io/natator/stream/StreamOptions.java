package io.natator.stream;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.config.Json;
import io.natator.config.Scheme;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.stream.Collectors;

/**
 * What {@code natator-sim stream} is started with.
 *
 * @param scene     name or path
 * @param overrides JSON Merge Patch on the scene, or null
 * @param gait      how the muscles move, or null
 * @param scheme    or null for the scene's own
 * @param precision {@code float}, {@code double}, or null for the program's default
 * @param fields    what frames hold; at least one
 * @param rate      simulated seconds per second of wall time, at most; 0 = as fast as possible
 * @param until     seconds after which the stream ends, or null for never
 * @param lossless  whether the simulation waits for credit instead of dropping a frame
 * @param paused    whether it waits for {@code run}
 * @param policy    file of a policy that drives the swimmer, or null
 */
public record StreamOptions(String scene, JsonNode overrides, JsonNode gait, Scheme scheme, String precision,
        List<StreamField> fields, double rate, Double until, boolean lossless, boolean paused, Path policy) {

    private static final List<StreamField> ALL = List.of(StreamField.values());

    /** A scene to be watched: all fields, in real time, without end. */
    public static StreamOptions live(String scene, JsonNode overrides, JsonNode gait, boolean paused) {
        return new StreamOptions(scene, overrides, gait, null, null, ALL, 1, null, false, paused, null);
    }

    /** Every frame from the settled start to {@code until} seconds, as fast as they are taken. */
    public static StreamOptions recording(String scene, JsonNode overrides, JsonNode gait, double until) {
        return new StreamOptions(scene, overrides, gait, null, null, ALL, 0, until, true, false, null);
    }

    /** These options with another scheme and precision; null leaves either to the scene and the program. */
    public StreamOptions with(Scheme newScheme, String newPrecision) {
        return new StreamOptions(scene, overrides, gait, newScheme, newPrecision, fields, rate, until, lossless,
                paused, policy);
    }

    /** These options with other fields. */
    public StreamOptions withFields(List<StreamField> newFields) {
        return new StreamOptions(scene, overrides, gait, scheme, precision, newFields, rate, until, lossless, paused,
                policy);
    }

    /** These options, waiting for {@code run}. */
    public StreamOptions waiting() {
        return new StreamOptions(scene, overrides, gait, scheme, precision, fields, rate, until, lossless, true,
                policy);
    }

    /** These options with another policy; null leaves the muscles to the gait. */
    public StreamOptions withPolicy(Path newPolicy) {
        return new StreamOptions(scene, overrides, gait, scheme, precision, fields, rate, until, lossless, paused,
                newPolicy);
    }

    /** The arguments after the program's name. */
    List<String> arguments() {
        List<String> arguments = new ArrayList<>(List.of("stream", scene));
        add(arguments, "--overrides", overrides);
        add(arguments, "--gait", policy == null ? gait : null);
        add(arguments, "--policy", policy);
        add(arguments, "--scheme", scheme == null ? null : Json.name(scheme));
        add(arguments, "--precision", precision);
        add(arguments, "--fields", fields.stream().sorted().map(StreamField::text).collect(Collectors.joining(",")));
        add(arguments, "--rate", rate);
        add(arguments, "--until", until);
        if (lossless) {
            arguments.add("--lossless");
        }
        if (paused) {
            arguments.add("--paused");
        }
        return arguments;
    }

    private static void add(List<String> arguments, String option, Object value) {
        if (value != null) {
            arguments.add(option);
            arguments.add(value.toString());
        }
    }
}
