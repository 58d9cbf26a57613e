#include <algorithm>

#include "body_cubes.h"
#include "coupling.h"
#include "gpu_water.h"
#include "solver/cuda/grid/lattice_bodies.h"

namespace natator::lattice {
namespace {

using cuda::DeviceBuffer;
using cuda::GridLaunch;
using cuda::ModelView;
using cuda::Slots;

/// A particle as its water pushes it.
struct PushedParticle {
    Vec3<double> weight;  ///< of the water in its place, mass length/s^2
    double inverse_mass;
    double kept;          ///< of the last impulse in the running mean, where the present one counts 1
    Vec3<double> handed;  ///< weight of what it hands on itself
    int begin, end;       ///< of those that hand on to it, see Bodies::given
};

/// The bodies of a Model in device memory.
struct Bodies {
    int particles, cubes;
    bool plane;
    const CubeAtRest* rest;
    const NearAtRest* near;
    const PushedParticle* pushed;
    const NearAtRest* given;  ///< by particle: who hands on what it is pushed by, by which weight
    const int* of_cube;       ///< behind the bodies': the obstacle's first particle
    CubeBox box;
};

template <class Real>
__device__ Vec3<double> of_particle(const Slots<Real>& slots, const cuda::Vec4<Real>* by_slot, int particle) {
    return physics::cast<double>(xyz(by_slot[slots.slot_of_solid()[particle]]));
}

template <class Real>
__device__ void push_bodies(const ModelView<Real>&, const Slots<Real>& slots, int p, const Bodies bodies,
                            const WaterOnGpu* waters) {
    const PushedParticle& pushed = bodies.pushed[p];
    Vec3<double> given = waters[blockIdx.y].impulses[p] - static_cast<double>(slots.h) * pushed.weight;
    if (bodies.plane) given.y = 0;  // not even rounding
    cuda::Vec4<Real>& velocity = slots.arrays.state_velocity[slots.slot_of_solid()[p]];
    velocity = cuda::quad(xyz(velocity) + physics::cast<Real>(pushed.inverse_mass * given), velocity.w);
}

/// Whether a State has become unstable, in this substep or before.
template <class Real>
__device__ bool is_over(const Slots<Real>& slots) {
    return static_cast<int>(slots.shared().bad >> 32 & 0x7fffffff) <= slots.substep;
}

/// Makes the cubes of the particles as they are now. The water of States that are over stays as it is.
template <class Real>
__device__ void lay_out_cubes(const ModelView<Real>&, const Slots<Real>& slots, int p, const Bodies bodies,
                              WaterOnGpu* waters) {
    WaterOnGpu& water = waters[blockIdx.y];
    if (*slots.arrays.idle) return;
    if (is_over(slots)) {
        if (p == 0) water.goes_on = 0;
        return;
    }
    if (p >= bodies.particles) return;
    const auto place = [&](int other) { return of_particle(slots, slots.arrays.state_position, other); };
    const auto velocity = [&](int other) { return of_particle(slots, slots.arrays.state_velocity, other); };
    const auto h = static_cast<double>(slots.h);
    water.cubes[p] = cube_of(bodies.rest[p], bodies.near, p, place, velocity, bodies.box, h);
    const auto speed = static_cast<float>(norm(velocity(p)) * h / bodies.box.cell);
    const unsigned long long fastest =
        static_cast<unsigned long long>(__float_as_uint(speed)) << 32 | ~static_cast<unsigned>(p);
    if (fastest > water.fastest) atomicMax(&water.fastest, fastest);
}

__device__ Vec3<double> impulse_of(const PushSums& push, double unit) {
    return {unit * push[0], unit * push[1], unit * push[2]};
}
/// What a cube hands on, of a weight.
__device__ Vec3<double> handed_on(const PushSums& push, double unit, const Vec3<double>& weight) {
    const auto row = [&](int a) {
        const auto of = [&](int b) { return unit * push[PushSums::moment(a, b)]; };
        return of(0) * weight.x + of(1) * weight.y + of(2) * weight.z;
    };
    return {row(0), row(1), row(2)};
}

inline constexpr int push_lanes = 8;

/// Takes what the cubes are pushed by to the particles, as Immersed::impulses and Coupling::follow do; and looks
/// whether the State can go on.
template <class Real>
__device__ void take_pushes(const ModelView<Real>&, const Slots<Real>& slots, int c, const Bodies bodies,
                            const WaterOnGpu* waters, double unit) {
    const WaterOnGpu& water = waters[blockIdx.y];
    if (!water.goes_on) return;
    const int lane = static_cast<int>(threadIdx.x) % push_lanes;
    const PushSums* const pushes = water.pushes;
    const unsigned long long now = static_cast<unsigned long long>(slots.substep) << 32;
    const bool of_obstacle = c >= bodies.particles;
    Vec3<double> given{};
    if (lane == 0) given = impulse_of(pushes[c], unit);
    if (!of_obstacle) {
        const PushedParticle& pushed = bodies.pushed[c];
        if (lane == 0) given -= handed_on(pushes[c], unit, pushed.handed);
        for (int k = pushed.begin + lane; k < pushed.end; k += push_lanes)
            given += handed_on(pushes[bodies.given[k].particle], unit, bodies.given[k].weight);
    }
    // The lanes of a particle are all there, or none.
    const unsigned together = ((1u << push_lanes) - 1) << (threadIdx.x % 32 / push_lanes * push_lanes);
    for (int other = push_lanes / 2; other > 0; other /= 2)
        given += {__shfl_xor_sync(together, given.x, other), __shfl_xor_sync(together, given.y, other),
                  __shfl_xor_sync(together, given.z, other)};
    if (lane != 0) return;
    if (of_obstacle) {
        if (!isfinite(given.x + given.y + given.z)) {
            atomicMin(&slots.shared().bad, now | static_cast<unsigned>(bodies.of_cube[c - bodies.particles]));
            atomicMin(&slots.shared().fault, cuda::fault_of_water);
        }
        if (water.forces) water.forces[c] += given;
        return;
    }
    const PushedParticle& pushed = bodies.pushed[c];
    Vec3<double>& impulse = water.impulses[c];
    impulse = running_mean(given, pushed.kept, impulse);
    if (water.forces) water.forces[c] += given - static_cast<double>(slots.h) * pushed.weight;
    if (c == 0 && __uint_as_float(static_cast<unsigned>(water.fastest >> 32)) > max_cells_per_substep) {
        atomicMin(&slots.shared().bad, now | ~static_cast<unsigned>(water.fastest));
        atomicMin(&slots.shared().fault, cuda::fault_mach);
    }
}

template <class Real>
class GpuBodies : public cuda::LatticeBodies<Real> {
public:
    GpuBodies(const Model& model, int states)
        : box_(*model.water_box), coupled_(model), waters_(states), staged_(states), of_state_(states) {
        const Immersed& immersed = coupled_.immersed();
        const int particles = immersed.particles();
        std::vector<PushedParticle> pushed(particles);
        std::vector<std::vector<NearAtRest>> given(particles);
        for (int p = 0; p < particles; ++p)
            for (int k = immersed.rest()[p].begin; k < immersed.rest()[p].end; ++k) {
                const auto& [other, weight] = immersed.near()[k];
                given[other].push_back({p, weight});
                pushed[p].handed += weight;
            }
        std::vector<NearAtRest> all_given;
        for (int p = 0; p < particles; ++p) {
            const Eigen::Vector3d weight = coupled_.displaced()[p] * model.parameters.gravity;
            const auto begin = static_cast<int>(all_given.size());
            all_given.insert(all_given.end(), given[p].begin(), given[p].end());
            pushed[p] = {
                {weight.x(), weight.y(), weight.z()}, model.inverse_mass[p], coupled_.kept(p), pushed[p].handed, begin,
                static_cast<int>(all_given.size())};
        }
        const std::vector<Eigen::Vector3d> rest(model.position.begin(), model.position.begin() + particles);
        at_rest_ = immersed.cubes(rest, std::vector<Eigen::Vector3d>(particles, Eigen::Vector3d::Zero()), box_, 1);
        const std::vector<Cube>& obstacles = coupled_.obstacle_cubes();
        at_rest_.insert(at_rest_.end(), obstacles.begin(), obstacles.end());
        std::vector<int> of_cube;
        int particle = particles;
        for (std::size_t k = 0; k < coupled_.cubes_of_obstacles().size(); ++k) {
            of_cube.insert(of_cube.end(), coupled_.cubes_of_obstacles()[k], particle);
            particle += box_.obstacles[k].particles;
        }
        rest_ = DeviceBuffer<CubeAtRest>(immersed.rest());
        near_ = DeviceBuffer<NearAtRest>(immersed.near());
        pushed_ = DeviceBuffer<PushedParticle>(pushed);
        given_ = DeviceBuffer<NearAtRest>(all_given);
        of_cube_ = DeviceBuffer<int>(of_cube);
        bodies_ = {particles,     coupled_.cubes(), box_.is_plane(),
                   rest_.data(),  near_.data(),     pushed_.data(),
                   given_.data(), of_cube_.data(),  cube_box(box_, immersed.extension())};
        cuda::wait_for_uploads();
    }

    void set_water(int k, WaterOnGpu* water) override { of_state_[k] = water; }
    void stage() override {
        for (std::size_t k = 0; k < of_state_.size(); ++k) staged_[k] = of_state_[k] ? *of_state_[k] : WaterOnGpu{};
    }
    void take_back() override {
        for (std::size_t k = 0; k < of_state_.size(); ++k)
            if (of_state_[k]) *of_state_[k] = staged_[k];
    }
    void launch_upload(const GridLaunch<Real>& launch) const override {
        copy(waters_.data(), staged_.data(), launch.stream);
    }
    void launch_download(const GridLaunch<Real>& launch) const override {
        copy(staged_.data(), waters_.data(), launch.stream);
    }
    void launch_push(const GridLaunch<Real>& launch) const override {
        launch.template each_slot<push_bodies<Real>>(bodies_.particles, bodies_,
                                                     static_cast<const WaterOnGpu*>(waters_.data()));
    }
    void launch_follow(const GridLaunch<Real>& launch) const override {
        const auto h = static_cast<double>(launch.slots.h);
        // At least by one thread, which looks whether the State is over.
        launch.template report_slots<lay_out_cubes<Real>>(std::max(1, bodies_.particles), bodies_, waters_.data());
        launch_step(lattice_step(box_, h, at_rest_), waters_.data(), launch.states, launch.stream);
        launch.template each_slot<take_pushes<Real>, push_lanes>(
            bodies_.cubes, bodies_, static_cast<const WaterOnGpu*>(waters_.data()), impulse_unit(box_, h));
        cuda::check(cudaGetLastError(), "launch");
    }

private:
    void copy(WaterOnGpu* to, const WaterOnGpu* from, cudaStream_t stream) const {
        cuda::check(cudaMemcpyAsync(to, from, waters_.size() * sizeof *to, cudaMemcpyDefault, stream), "copy");
    }

    Box box_;
    CoupledBodies coupled_;
    std::vector<Cube> at_rest_;
    DeviceBuffer<WaterOnGpu> waters_;
    cuda::HostBuffer<WaterOnGpu> staged_;
    std::vector<WaterOnGpu*> of_state_;
    DeviceBuffer<CubeAtRest> rest_;
    DeviceBuffer<NearAtRest> near_, given_;
    DeviceBuffer<PushedParticle> pushed_;
    DeviceBuffer<int> of_cube_;
    Bodies bodies_{};
};

}  // namespace
}  // namespace natator::lattice

namespace natator::cuda {

template <class Real>
std::unique_ptr<LatticeBodies<Real>> LatticeBodies<Real>::of(const Model& model, int states) {
    return model.water_box ? std::make_unique<lattice::GpuBodies<Real>>(model, states) : nullptr;
}

template class LatticeBodies<float>;
template class LatticeBodies<double>;

}  // namespace natator::cuda
