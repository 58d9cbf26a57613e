#pragma once

#include <vector>

#include "device_buffer.h"
#include "model_view.h"
#include "natator/model.h"

namespace natator::cuda {

/// Owns the device's copy of a Model.
template <class Real>
class DeviceModel {
public:
    /// At most `max_planes` planes; a grid of at most so many cells as suit blocks, or, with `whole_gpu` and for what
    /// goes either way, the whole GPU. Throws InputError for springs or clusters of fluid, std::bad_alloc without
    /// memory.
    explicit DeviceModel(const Model& model, bool whole_gpu = false);

    const ModelView<Real>& view() const { return view_; }
    /// Device number of each particle of the Model.
    const std::vector<int>& number_of() const { return number_of_; }
    /// Particle of the Model by device number.
    const std::vector<int>& particle_of() const { return particle_of_; }

private:
    template <class T>
    const T* keep(DeviceBuffer<T>& buffer, const std::vector<T>& values) {
        buffer = DeviceBuffer<T>(values);
        return buffer.data();
    }
    void set_constants(const Model& model);
    void number_particles(const Model& model);
    void upload_particles(const Model& model);
    void set_conserving(const Model& model);
    void upload_solids(const Model& model);
    void set_water(const Model& model);
    /// Over the box of the start positions, extended to the planes that face an axis, and by `margin` then; along a
    /// periodic axis over the tank.
    GridView<Real> grid_over(const Model& model, Real distance, Real margin, int max_cells) const;
    int cells_on_chip(const Model& model) const;

    ModelView<Real> view_{};
    std::vector<int> number_of_, particle_of_;
    DeviceBuffer<Real> inverse_mass_, member_mass_, volume_;
    DeviceBuffer<GhostTransform<Real>> ghost_transform_;
    DeviceBuffer<std::uint32_t> phase_;
    DeviceBuffer<Vec3<Real>> rest_position_, offset_;
    DeviceBuffer<SpringView<Real>> spring_;
    DeviceBuffer<MuscleView> muscle_;
    DeviceBuffer<ClusterView<Real>> cluster_;
    DeviceBuffer<int> swimmer_springs_begin_, member_, spring_incidences_begin_, cluster_incidences_begin_,
        body_particle_, free_body_begin_, free_body_particle_;
    DeviceBuffer<Incidence> spring_incidence_, cluster_incidence_;
};

}  // namespace natator::cuda
