#pragma once

#include <cstdint>
#include <vector>

#include "natator/model.h"
#include "slots.cuh"
#include "solver/cuda/device_model.h"
#include "solver/cuda/host_buffer.h"
#include "substep.cuh"

namespace natator::cuda {

/// Whether the water's neighbours are listed.
enum class WaterLists { always, where_they_fit, never };

/// Options of the memory for the States of a grid.
struct GridOptions {
    ContactRoom room{32, 256};
    bool keeps_forces = false;  ///< the impulses on solids
    WaterLists lists = WaterLists::where_they_fit;
};

/// The device memory of States of a Model side by side, and the way of States to it and back.
template <class Real>
class GridMemory {
public:
    /// `device_model` is the copy of `model`; both must outlive it. All copies are asked of `stream`. Throws
    /// std::bad_alloc without memory for so many States.
    GridMemory(const Model& model, const DeviceModel<Real>& device_model, int states, const GridOptions& options,
               cudaStream_t stream);

    /// Pointers to all arrays; valid until the next make_room.
    const Slots<Real>& slots() const { return slots_; }
    void* scan_room() const { return scan_room_.data(); }

    /// Room in the lists.
    ListRoom room() const { return view_.plan.water ? slots_.water_room : ListRoom{.lists = 4 * slots_.chunks}; }
    bool has_room(ListRoom needed) const {
        return (needed.lists <= room().lists || !has_lists()) && needed.copies <= room().copies;
    }
    /// Makes it for at least so much; lists that grow lie elsewhere then, and are empty.
    void make_room(ListRoom needed);

    /// Keeps all States as they are before an update.
    void keep_before() const;
    /// Of scheme lattice, whose water does not go back: keeps those that go on as they are before a substep.
    void keep_running(const GridLaunch<Real>& launch) const;
    /// Takes State k back to that; what else there is of it is made anew in every substep.
    void restore_before(int k) const;

    /// Waits until it is done.
    void upload(int k, const State<Real>& state) const;
    /// Likewise. Time and spring rest lengths are those of `like`.
    State<Real> download(int k, const State<Real>& like) const;

    /// Takes the first States to these, by one copy of each array. Waits until it is done.
    void upload_all(const std::vector<const State<Real>*>& states);
    /// Likewise takes these to the first States. Their time and spring rest lengths stay.
    void download_all(const std::vector<State<Real>*>& states);

    /// States that updates leave as they are; none at first.
    void set_idle(const std::vector<bool>& idle);
    bool is_idle(int k) const { return idle_[k] != 0; }
    std::vector<bool> idle() const { return {idle_.begin(), idle_.end()}; }

private:
    bool has_lists() const { return !view_.plan.water || lists_ != WaterLists::never; }
    void allocate(bool keeps_forces);
    void share_places();
    void make_room_for_rows(int rows);
    void list_water(int rows);
    void make_room_for_copies(int copies);
    void make_room_in_fluid(int neighbours);
    void wait() const;
    void stage();
    void to_rows(const State<Real>& state, Vec4<Real>* position, Vec4<Real>* velocity, ClusterFit<Real>* fits) const;
    void from_rows(const Vec4<Real>* position, const Vec4<Real>* velocity, const ClusterFit<Real>* fits,
                   State<Real>& state) const;

    const Model& model_;
    const DeviceModel<Real>& device_model_;
    const ModelView<Real>& view_;
    int states_;
    WaterLists lists_;
    cudaStream_t stream_;
    Slots<Real> slots_{};
    DeviceBuffer<char> memory_, scan_room_;
    DeviceBuffer<GridShared<Real>> shared_;
    DeviceBuffer<uint4> chunk_room_;
    DeviceBuffer<std::uint64_t> key_room_;
    DeviceBuffer<Vec4<Real>> candidate_room_;
    DeviceBuffer<unsigned> neighbour_room_;
    DeviceBuffer<PairGradient<Real>> pair_room_;
    struct {
        DeviceBuffer<Vec4<Real>> position, velocity;
        DeviceBuffer<ClusterFit<Real>> fit;
    } before_;  ///< the States at an update's start
    struct {
        HostBuffer<Vec4<Real>> position, velocity;
        HostBuffer<ClusterFit<Real>> fit;
        HostBuffer<int> slot_of_solid;
    } staged_;  ///< rows of all States on their way, once they go together
    std::vector<int> idle_;
    DeviceBuffer<int> device_idle_;
};

}  // namespace natator::cuda
