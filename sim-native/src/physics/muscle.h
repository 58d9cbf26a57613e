// Muscles: thesis 2.5, eq. (2.6) to (2.8); the power is that of 4.2.
#pragma once

#include "constants.h"
#include "number.h"

namespace natator::physics::inline NATATOR_SET {

NATATOR_HD double sine_of_turns(double turns) {
#if defined(__CUDA_ARCH__)
    return sinpi(2 * turns);
#else
    return std::sin(2 * 3.141592653589793 * turns);
#endif
}

/// u(t) = sin 2 pi (f t + phase), from -1 to 1; another power than 1 shapes its half waves.
NATATOR_HD double activation(double frequency, double power, double phase, double time) {
    const double sine = sine_of_turns(frequency * time + phase);
    return power == 1 ? sine : pow((sine + 1) / 2, power) * 2 - 1;
}

/// d: amplitude times activation, and an offset if there is one.
NATATOR_HD double muscle_drive(double amplitude, double activation, const double* offset) {
    double drive = amplitude * activation;
    if (offset) drive += *offset;
    return drive;
}

/// Schemes `conserving` and `lattice` start their muscles softly: 0 to 1 with no kink (smoothstep).
NATATOR_HD double start_ramp(double time) {
    const double part = time / start_ramp_time;
    const double s = part < 0 ? 0 : part < 1 ? part : 1;
    return s * s * (3 - 2 * s);
}

/// l = l_rest (1 + epsilon z d), z = side of the muscle (-1 to 1), d = muscle_drive.
NATATOR_HD double muscle_length(double rest_length, double lateral, double drive) {
    return rest_length * (1 + muscle_strain * lateral * drive);
}

}  // namespace natator::physics::inline NATATOR_SET
