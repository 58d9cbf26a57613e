package io.natator.protocol;

import com.fasterxml.jackson.annotation.JsonIgnoreProperties;

/**
 * Where a body went and how it lies at the end, as {@code course} of a result has it.
 *
 * @param forward way along its own heading, in scene units
 * @param yaw     of its heading in the horizontal plane, in radians
 * @param roll    of its back about its heading, in radians
 */
@JsonIgnoreProperties(ignoreUnknown = true)
public record Course(double forward, double yaw, double roll) {
}
