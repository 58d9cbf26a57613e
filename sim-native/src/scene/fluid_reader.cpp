#include "readers.h"

namespace natator::fields {
namespace {

const std::vector<Field<FluidBlock>>& block_fields() {
    using F = FluidBlock;
    static const std::vector<Field<F>> fields = {
        {"count", &F::count, {1, 10000}},
        {"spacing", &F::spacing, {0, 1000, true, "length"}},
        {"origin", &F::origin, {-10000, 10000, false, "length"}},
        {"clearance", &F::clearance, {0, 1000, false, "length"}},
        {"disorder", &F::disorder, {0, 2147483647}},
        {"current", &F::current, {-1000, 1000, false, "length/s"}},
        {"smagorinsky", &F::smagorinsky, {0, 1}},
    };
    return fields;
}

const std::vector<Field<FluidBlock>>& mass_fields() {
    using F = FluidBlock;
    static const std::vector<Field<F>> fields = {
        {"bottom", &F::bottom_mass, {1e-6, 1e6, false, "mass"}},
        {"top", &F::top_mass, {1e-6, 1e6, false, "mass"}},
    };
    return fields;
}

}  // namespace

FluidBlock read_fluid(const json& value, const Place& place) {
    FluidBlock block = thesis_tank().fluid.value();
    read_object(value, place, block_fields(), {"mass"}, block);
    if (block.current.y() != 0)
        refuse(place.key("current").item(1), value.at("current")[1], "0: a current is horizontal");
    if (!value.contains("mass")) return block;

    const json& mass = value.at("mass");
    const Place at = place.key("mass");
    read_object(mass, at, mass_fields(), {"gradient"}, block);
    if (mass.contains("gradient")) {
        block.gradient = read_choice<MassGradient>(mass.at("gradient"), at.key("gradient"),
                                                   {{"mass-linear", MassGradient::mass_linear},
                                                    {"inverse-mass-linear", MassGradient::inverse_mass_linear},
                                                    {"uniform", MassGradient::uniform}});
    }
    return block;
}

}  // namespace natator::fields
