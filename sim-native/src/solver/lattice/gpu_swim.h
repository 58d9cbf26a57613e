#pragma once

#include <memory>
#include <vector>

#include "coupling.h"
#include "gpu_water.h"

namespace natator::lattice {

/// What a swim of scheme `lattice` on a GPU keeps from one update to the next: Coupling's part there, whose steps
/// cuda::LatticeBodies makes.
class GpuSwim {
public:
    /// `forces`: keeps what `forces` gives. The Model must outlive it.
    GpuSwim(const Model& model, int device, bool forces);

    /// The water for an update in substeps of so long, s, of a State of this time: a new one where that does not go on
    /// from the last.
    WaterOnGpu* begin(double time, double h);
    /// The update has come to this time, s.
    void end(double time, double h);

    /// As Coupling's.
    void shift(const Eigen::Vector3d& by);
    WaterField field() const { return field_of(*model_.water_box, water_.get(), exchange_.step); }
    double fastest() const { return exchange_.fastest; }
    void save(ByteWriter& to) const;
    void restore(ByteReader from);
    template <class Real>
    std::vector<Vector3<Real>> forces() const {
        return mean_forces<Real>(model_, bodies_, forces_.size() > 0 ? numbers_of(forces_) : Numbers{}, force_time_);
    }

private:
    using Numbers = std::vector<Eigen::Vector3d>;
    using OnDevice = cuda::DeviceBuffer<physics::Vec3<double>>;
    static Numbers numbers_of(const OnDevice& buffer);
    GpuWater& water();

    const Model& model_;
    int device_;
    CoupledBodies bodies_;
    std::unique_ptr<GpuWater> water_;  ///< null until there is one
    Exchange exchange_;                ///< but for the impulses
    OnDevice impulses_, forces_;
    double force_time_ = 0;  ///< s
};

}  // namespace natator::lattice
