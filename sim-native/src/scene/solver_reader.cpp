#include "model/solver_fields.h"
#include "readers.h"

namespace natator::fields {
namespace {

/// Parameters that act on cloth only: there is no cloth, so they must be 0.
const std::vector<std::string_view> cloth_only = {"wind", "drag", "lift", "plasticThreshold", "plasticCreep"};

template <class T>
void add_keys(const std::vector<Field<T>>& table, std::vector<std::string_view>& keys) {
    for (const Field<T>& field : table) keys.emplace_back(field.key);
}

}  // namespace

SolverParameters read_solver(const json& value, const Place& place) {
    std::vector<std::string_view> allowed = cloth_only;
    allowed.emplace_back("relaxationMode");
    add_keys(solver_fields(), allowed);
    add_keys(flex_fields(), allowed);
    add_keys(conserving_fields(), allowed);
    check_keys(value, place, allowed);

    SolverParameters solver = thesis_tank().solver;
    read_fields(value, place, solver_fields(), solver);
    read_fields(value, place, flex_fields(), solver.flex);
    read_fields(value, place, conserving_fields(), solver.conserving);
    for (const std::string_view key : cloth_only) {
        if (value.contains(key)) require_zero(value.at(std::string(key)), place.key(key), "0 (acts on cloth only)");
    }
    if (value.contains("relaxationMode")) {
        solver.flex.relaxationMode =
            read_choice<RelaxationMode>(value.at("relaxationMode"), place.key("relaxationMode"),
                                        {{"local", RelaxationMode::local}, {"global", RelaxationMode::global}});
    }
    limit_to_float(solver);
    check_rest_distances(solver, place);
    return solver;
}

}  // namespace natator::fields
