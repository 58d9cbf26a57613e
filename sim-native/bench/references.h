#pragma once

#include <string>
#include <vector>

#include "front_error.h"

namespace natator::bench {

/// Front of a collapsing column of water as Martin and Moyce measured it (1952): `height_over_base` is n^2, times are
/// T = t sqrt(n^2 g / a), positions Z = x / a, a = base of the column. From references/martin-moyce-1952.json.
/// Throws InputError when there is no such column.
FrontCurve measured_front(int height_over_base);

/// What another simulator did in the thesis' tank.
struct PeerRun {
    std::string name;
    double run_time = 0;  ///< wall time of 4 s, s
    double density_error_mean = 0;
    double density_error_max = 0;
};

/// From references/thesis-tank-peers.json.
std::vector<PeerRun> peer_runs();

}  // namespace natator::bench
