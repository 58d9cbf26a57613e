#pragma once

namespace natator::cuda {

/// What a block's time is booked on when somebody asks for a profile. Stages without a barrier between them are one.
enum class Stage {
    load,
    predict,
    cells,
    neighbours,
    density,
    corrections,
    density_constraint,
    contacts,
    springs,
    clusters,
    planes,
    velocities,
    commit,
    measure,
    count
};

/// By Stage; names of step.h where they mean the same.
inline constexpr const char* stage_names[] = {"load",
                                              "predict",
                                              "cells",
                                              "neighbours",
                                              "density and shape fit",
                                              "corrections and planes",
                                              "density constraint",
                                              "contacts",
                                              "springs",
                                              "shape matching",
                                              "planes",
                                              "velocities",
                                              "commit",
                                              "measure"};

}  // namespace natator::cuda
