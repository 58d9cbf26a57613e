#include "gpu_swim.h"

#include <bit>
#include <cmath>

namespace natator::lattice {

GpuSwim::GpuSwim(const Model& model, int device, bool forces) : model_(model), device_(device), bodies_(model) {
    cuda::choose_device(device);
    impulses_ = OnDevice(bodies_.immersed().particles());
    if (forces) forces_ = OnDevice(bodies_.cubes());
}

GpuWater& GpuSwim::water() {
    if (water_) return *water_;
    auto made = std::make_unique<GpuWater>(*model_.water_box, device_);
    made->make_room(bodies_.cubes(), bodies_.obstacle_cubes());
    made->on_gpu().impulses = impulses_.data();
    made->on_gpu().forces = forces_.data();
    water_ = std::move(made);
    return *water_;
}

WaterOnGpu* GpuSwim::begin(double time, double h) {
    if (!water_ || exchange_.step == 0 || std::abs(time - exchange_.time) > h / 2) {
        if (water_) water_->begin();
        const Box& box = *model_.water_box;
        if (!box.current.isZero(0)) water().set_cells({0, box.current * h / box.cell});
        water();
        impulses_.clear();
        cuda::wait_for_uploads();
    }
    if (forces_.size() > 0) {
        forces_.clear();
        cuda::wait_for_uploads();
    }
    exchange_.time = time;
    exchange_.step = 0;  // until the update has been made
    water_->on_gpu().goes_on = 1;
    return &water_->on_gpu();
}

void GpuSwim::end(double time, double h) {
    const unsigned long long fastest = water_->on_gpu().fastest;
    exchange_.fastest = std::bit_cast<float>(static_cast<unsigned>(fastest >> 32));
    exchange_.fastest_particle = static_cast<int>(~static_cast<unsigned>(fastest));
    if (fastest == 0) exchange_.fastest_particle = 0;
    force_time_ = time - exchange_.time;
    exchange_.time = time;
    exchange_.step = h;
}

void GpuSwim::shift(const Eigen::Vector3d& by) {
    if (water_) water_->shift(whole_cells(by, *model_.water_box));
}

GpuSwim::Numbers GpuSwim::numbers_of(const OnDevice& buffer) {
    Numbers numbers;
    for (const auto& [x, y, z] : buffer.download()) numbers.emplace_back(x, y, z);
    return numbers;
}

void GpuSwim::save(ByteWriter& to) const {
    Exchange all = exchange_;
    if (water_) all.impulses = numbers_of(impulses_);
    all.save(to, water_.get());
}

void GpuSwim::restore(ByteReader from) {
    const bool had_water = water_ != nullptr;
    try {
        if (!exchange_.restore(from, bodies_.immersed().particles(), [&]() -> Water& { return water(); })) {
            water_.reset();
            exchange_ = {};
            return;
        }
    } catch (...) {
        if (!had_water) water_.reset();
        throw;
    }
    std::vector<physics::Vec3<double>> impulses;
    for (const Eigen::Vector3d& one : exchange_.impulses) impulses.push_back({one.x(), one.y(), one.z()});
    exchange_.impulses.clear();
    impulses_.upload(impulses);
    cuda::wait_for_uploads();
    water_->on_gpu().fastest =
        static_cast<unsigned long long>(std::bit_cast<unsigned>(static_cast<float>(exchange_.fastest))) << 32 |
        ~static_cast<unsigned>(exchange_.fastest_particle);
}

}  // namespace natator::lattice
