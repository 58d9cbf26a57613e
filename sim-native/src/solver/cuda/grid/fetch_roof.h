#pragma once

#include <vector>

#include "natator/gait.h"
#include "natator/scene.h"

namespace natator::cuda {

/// How fast a GPU fetches what the density constraint of scheme conserving reads of pairs, beside how fast it solves
/// it. A pass of it goes over all pairs twice: for the impulses it reads a pair's place in the list, its gradient, and
/// the neighbour's velocity; for the push the neighbour's impulse instead.
struct FetchRoof {
    double pairs = 0;               ///< in the lists of all States, mean of the frames
    double velocities = 0;          ///< s: fetches what the impulses need, unpacks and sums it
    double impulses = 0;            ///< s: likewise for the push
    double density_constraint = 0;  ///< s: a pass of a run, mean of its frames
};

/// Of so many States of a scene as there are gaits, side by side, in floats: settled, then run for so many frames and
/// one before; the fetches at the end, from the lists as the last substep left them, by as many threads in the same
/// places. Throws what evaluate_on_gpu does; std::runtime_error for an unstable run.
FetchRoof measure_fetch_roof(const Scene& scene, const std::vector<Gait>& gaits, int frames, int device);

/// Bytes that a GPU's memory gives and takes in a second while much of it is copied.
double measure_copy_bandwidth(int device);

}  // namespace natator::cuda
