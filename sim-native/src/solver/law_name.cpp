#include "law_name.h"

#include <algorithm>
#include <iterator>
#include <sstream>

#include "natator/solver.h"

namespace natator {
namespace {

using physics::Law;

/// as Law has them
constexpr const char* law_names[] = {"", "finite", "particle-energy", "energy", "tank", "shape", "compression", "mach"};

}  // namespace

std::string sentence_of(const Instability& instability) {
    const std::string particle = "particle " + std::to_string(instability.particle);
    std::ostringstream at;
    at << " at " << instability.time << " s";
    if (instability.stage == "settling") at << ", after settling";
    if (instability.law == "tank") return particle + " is behind a plane" + at.str() + " (law tank)";
    if (instability.law == "particle-energy")
        return particle + " has more energy than gravity and muscles can give it" + at.str() + " (law particle-energy)";
    if (instability.law == "energy")
        return "energy has grown by more than the muscles' work" + at.str() + ", most of it has " + particle +
               " (law energy)";
    if (instability.law == "shape")
        return "the body is stretched to several times its length" + at.str() + ", by " + particle + " (law shape)";
    if (instability.law == "compression")
        return "the fluid is compressed to a fraction of its volume" + at.str() + " (law compression)";
    if (instability.law == "mach")
        return particle + " goes more than 0.3 cells in a substep" + at.str() + " (law mach: needs more substeps)";
    return particle + " is not finite after stage " + instability.stage + at.str();
}

const char* name(Law law) {
    return law_names[static_cast<int>(law)];
}

Law law_named(const std::string& text) {
    const auto found = std::find(std::begin(law_names), std::end(law_names), text);
    return found == std::end(law_names) ? Law::none : static_cast<Law>(found - std::begin(law_names));
}

}  // namespace natator
