#pragma once

#include "natator/model.h"
#include "physics/number.h"

namespace natator {

/// Work of muscles, mass length^2/s^2 (Solver::muscle_work): of the swimmer's, and of all bodies'.
struct MuscleWork {
    double own = 0, all = 0;

    NATATOR_HD MuscleWork& operator+=(const MuscleWork& more) {
        own += more.own;
        all += more.all;
        return *this;
    }
};

/// How many springs the swimmer has: the first ones of Model::springs.
inline int own_springs(const Model& model) {
    return model.companions.empty() ? static_cast<int>(model.springs.size()) : model.companions.front().first_spring;
}

}  // namespace natator
