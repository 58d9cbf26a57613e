package io.natator.protocol;

import com.fasterxml.jackson.annotation.JsonIgnoreProperties;
import com.fasterxml.jackson.annotation.JsonInclude;

/**
 * Dimensionless numbers of a swim in water with a viscosity, as {@code swimming} of a result has them.
 *
 * @param tailAmplitude  peak to peak, in scene units
 * @param strouhal       frequency times tail amplitude by the speed of the same beats; null at rest
 * @param reynolds       speed times body length by kinematic viscosity; null where that is 0
 * @param swimmingNumber angular frequency times tail amplitude times body length by kinematic viscosity; null likewise
 * @param cavities       water that does not follow the body, in volumes of the body; null without gravity
 * @param across         spacings of the water across the body's thickest slice; null in results of programs before it
 */
@JsonIgnoreProperties(ignoreUnknown = true)
@JsonInclude(JsonInclude.Include.NON_NULL)
public record SwimmingNumbers(Double tailAmplitude, Double strouhal, Double reynolds, Double swimmingNumber,
        Double cavities, Double across) {
}
