#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <tuple>

#include "natator/gait.h"
#include "natator/state.h"
#include "solver/cuda/device_model.h"
#include "substep.cuh"

namespace natator::cuda {

/// Advances one State of a Model by kernels of the whole GPU. An update is a graph of kernels, launched at once; the
/// host waits for its end.
template <class Real>
class LargeRunner {
public:
    static constexpr ContactRoom usual_room{32, 256};

    /// Throws std::bad_alloc without memory for it.
    explicit LargeRunner(const Model& model, ContactRoom room = usual_room);
    ~LargeRunner();
    LargeRunner(const LargeRunner&) = delete;
    LargeRunner& operator=(const LargeRunner&) = delete;

    const DeviceModel<Real>& model() const { return device_model_; }

    void upload(const State<Real>& state);
    /// Time and spring rest lengths are those of `like`.
    State<Real> download(const State<Real>& like) const;

    struct Update {
        double start_time = 0;
        double time_step = 0;
        int substeps = 1;
        const Gait* gait = nullptr;  ///< null leaves the muscles as they are
        bool settling = false;       ///< velocities to 0 in the end
    };
    struct End {
        bool finite = true;
        int bad_substep = 0, bad_particle = 0;  ///< of one that is not; the State is that before this substep
        double mean_x = 0;                      ///< of the body
        bool touches_plane = false;
    };
    /// Makes ready what updates of this kind need, so that the first is as fast as the others.
    void prepare(const Update& update);
    /// `profile` gets the time of every stage; the stages are launched one by one then, as for a trace.
    End run(const Update& update, StageProfile* profile = nullptr, const Trace<Real>& trace = {});

    /// Of the State as it is.
    double mean_x();
    /// As the last substep left them, by device number.
    std::vector<Real> densities() const;
    std::vector<int> neighbour_counts() const;

private:
    struct Copy {
        DeviceBuffer<Quad<Real>> position, velocity;
        DeviceBuffer<ClusterFit<Real>> fit;
    };
    template <class T>
    void give(T*& array, std::size_t size);
    void allocate();
    void allocate_water();
    void make_room(int neighbours);
    Copy room_for_copy() const;
    void copy_to(const Copy& copy) const;
    void copy_back(const Copy& copy) const;
    LargeLaunch<Real> launch_of(const Update& update, int substep) const;
    void launch(const Update& update, int substeps, StageClock* clock, const Trace<Real>& trace) const;
    cudaGraphExec_t graph_of(const Update& update);
    void set_muscles(const Update& update);
    void wait() const;

    const Model& host_model_;
    DeviceModel<Real> device_model_;
    LargeLaunch<Real> base_{};
    std::vector<DeviceBuffer<char>> memory_;
    DeviceBuffer<unsigned> neighbour_room_;
    std::array<DeviceBuffer<Real>, 3> gradient_room_;
    Copy before_;
    State<Real> muscles_;  ///< only its spring rest lengths
    struct Graph;
    std::map<std::tuple<double, int, bool>, std::unique_ptr<Graph>> graphs_;
    // Of the host, where the device reads and writes them.
    Real* rest_lengths_ = nullptr;  ///< [substep * springs + spring]
    std::size_t rest_lengths_size_ = 0;
    LargeShared<Real>* end_ = nullptr;
    DeviceBuffer<Real> device_rest_lengths_;
};

}  // namespace natator::cuda
