#include "workspace.h"

#include "physics/constants.h"

namespace natator::cpu {

template <class Real>
Workspace<Real>::Workspace(const Model& model) : particles(model.particles()) {
    for (int i = 0; i < particles; ++i) (model.is_fluid(i) ? fluid_ids : solid_ids).push_back(i);
    fluid = static_cast<int>(fluid_ids.size());
    solid_begin = round_up_to_block(fluid);
    slots = solid_begin + static_cast<int>(solid_ids.size());

    slot_of.resize(particles);
    particle_of.assign(slots, -1);
    unsorted_position.resize(particles);
    unsorted_velocity.resize(particles);
    cell_of.resize(particles);

    constexpr Real far_away = Real(physics::far_away);
    const std::size_t all = round_up_to_block(slots + 1) + lanes;  // what searches may read behind the last slot
    for (auto* array : {&position, &start}) array->resize(all, far_away);
    for (auto* array : {&predicted_velocity, &correction, &velocity}) array->resize(all);
    constraint_count.resize(all);
    inverse_mass.resize(all);
    for (auto* array : {&solid_density, &density, &compression}) array->resize(fluid > 0 ? all : 0);
    packed.resize(fluid > 0 ? 4 * all : 0);
    packed_velocity.resize(packed.size());
    row_begin.assign(blocks() + 1, 0);
    neighbour_count.assign(fluid > 0 ? solid_begin : 0, 0);

    // The order before the first sort, and for good in a scene that needs none.
    for (int k = 0; k < fluid; ++k) slot_of[fluid_ids[k]] = k;
    for (std::size_t k = 0; k < solid_ids.size(); ++k) slot_of[solid_ids[k]] = solid_begin + static_cast<int>(k);
    for (int i = 0; i < particles; ++i) particle_of[slot_of[i]] = i;
}

template struct Workspace<float>;
template struct Workspace<double>;

}  // namespace natator::cpu
