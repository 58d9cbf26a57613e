#include "model/solver_fields.h"
#include "readers.h"

namespace natator::fields {
namespace {

/// Parameters that act on cloth only: there is no cloth, so they must be 0.
const std::vector<std::string_view> cloth_only = {"wind", "drag", "lift", "plasticThreshold", "plasticCreep"};

}  // namespace

SolverParameters read_solver(const json& value, const Place& place) {
    std::vector<std::string_view> also = cloth_only;
    also.emplace_back("relaxationMode");

    SolverParameters solver = thesis_tank().solver;
    read_object(value, place, solver_fields(), also, solver);
    for (const std::string_view key : cloth_only) {
        if (value.contains(key)) require_zero(value.at(std::string(key)), place.key(key), "0 (acts on cloth only)");
    }
    if (value.contains("relaxationMode")) {
        solver.relaxationMode =
            read_choice<RelaxationMode>(value.at("relaxationMode"), place.key("relaxationMode"),
                                        {{"local", RelaxationMode::local}, {"global", RelaxationMode::global}});
    }
    limit_to_float(solver);
    check_rest_distances(solver, place);
    return solver;
}

}  // namespace natator::fields
