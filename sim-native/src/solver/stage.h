#pragma once

#include <array>
#include <cstddef>

namespace natator {

/// The stages of a substep, for hooks, profiles and messages. A backend that computes some of them together names what
/// it does together.
enum class Stage {
    load,
    predict,
    cells,
    fluid_neighbours,
    neighbours,
    density,
    density_and_fits,
    density_constraint,
    overlaps,
    divergence,
    viscosity,
    cohesion,
    contacts,
    springs,
    shape_matching,
    solids,
    relaxation,
    planes,
    corrections,
    iteration,  ///< ends with another stage
    walls,
    water_motion,
    velocities,
    dissipation,
    free_surface_drag,
    fluid_forces,
    adhesion,
    restitution,
    sleep,
    commit,
    measure,
    count
};

inline constexpr std::array<const char*, static_cast<std::size_t>(Stage::count)> stage_names{
    "load",
    "predict",
    "cells",
    "fluid neighbours",
    "neighbours",
    "density",
    "density and shape fit",
    "density constraint",
    "overlaps",
    "divergence",
    "viscosity",
    "cohesion",
    "contacts",
    "springs",
    "shape matching",
    "solids",
    "relaxation",
    "planes",
    "corrections and planes",
    "iteration",
    "walls",
    "water motion",
    "velocities",
    "dissipation",
    "free-surface drag",
    "fluid forces",
    "adhesion",
    "restitution",
    "sleep",
    "commit",
    "measure",
};

constexpr const char* name(Stage stage) {
    return stage_names[static_cast<std::size_t>(stage)];
}

}  // namespace natator
