#pragma once

#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <vector>

#include "grid_memory.h"
#include "lattice_bodies.h"
#include "natator/model.h"
#include "solver/cuda/device_model.h"
#include "solver/cuda/host_buffer.h"
#include "solver/cuda/stream.h"
#include "substep.cuh"
#include "turns.h"

namespace natator::cuda {

/// Advances States of a Model side by side by kernels of the whole GPU. An update is a graph of kernels, launched at
/// once; the host waits for its end.
template <class Real>
class GridRunner {
public:
    /// Throws std::bad_alloc without memory for so many States.
    explicit GridRunner(const Model& model, int states = 1, const GridOptions& options = {});
    ~GridRunner();
    GridRunner(const GridRunner&) = delete;
    GridRunner& operator=(const GridRunner&) = delete;

    const DeviceModel<Real>& model() const { return device_model_; }
    int states() const { return base_.states; }
    bool keeps_forces() const { return base_.keeps_forces; }

    /// What lists have room for, and makes it for at least so much. An update that finds more does so by itself, but is
    /// done twice then.
    ListRoom room() const { return memory_.room(); }
    void make_room(ListRoom room);

    void upload(int k, const State<Real>& state);
    /// Time and spring rest lengths are those of `like`.
    State<Real> download(int k, const State<Real>& like) const { return memory_.download(k, like); }
    /// The same of the first States, all of them together, and their spring rest lengths.
    void download_all(const std::vector<State<Real>*>& states);

    /// What drives those of a State: asked for the update's start in scheme `flex`, else for the end of each substep.
    struct Muscles {
        Drive drive;
        double start_time = 0;  ///< s, of the update
    };
    struct Update {
        double time_step = 0;  ///< s
        int substeps = 1;
        std::vector<Muscles> muscles{};          ///< by State; without, they are left as they are
        bool settling = false;                   ///< velocities to 0 in the end
        std::vector<const State<Real>*> from{};  ///< the first States, uploaded before it; without, they are there
        TurnsOfGpu* turns = nullptr;
    };
    struct End {
        bool finite = true;
        int bad_substep = 0, bad_particle = 0;  ///< of one that is not; the State is that before this substep
        unsigned fault = fault_of_body;         ///< another one: the State is that behind it
        double mean_x = 0;                      ///< of the body
        double tail_z = 0;                      ///< of its last slice
        std::vector<double> muscle_work;  ///< in the update, by swimmer, see Solver::muscle_works; none in scheme flex
        bool touches_plane = false;
        physics::LawMeasures laws{};  ///< of particles by device number
    };
    /// Of scheme lattice: see LatticeBodies::set_water.
    void set_water(int k, lattice::WaterOnGpu* water) { lattice_->set_water(k, water); }
    /// States that updates leave as they are.
    void set_idle(const std::vector<bool>& idle) { memory_.set_idle(idle); }
    /// Makes ready what updates of this kind need, so that the first is as fast as the others.
    void prepare(const Update& update);
    /// Ends by State; those of idle ones mean nothing. `profile` gets the time of every stage; the stages are launched
    /// one by one then, as for a trace, which is of the first State.
    std::vector<End> run(const Update& update, StageProfile* profile = nullptr, const Trace<Real>& trace = {});

    /// A State of the model with the spring rest lengths of State k, and nothing else of it.
    State<Real> muscles(int k) const {
        State<Real> like = initial_state<Real>(host_model_);
        like.spring_rest_length = muscles_[k].spring_rest_length;
        return like;
    }
    /// Of the bodies as they are: mean x, and mean z of the last slice.
    struct Place {
        double mean_x = 0, tail_z = 0;
        physics::LawMeasures laws{};  ///< as in End
    };
    std::vector<Place> places();
    /// Places of the body's particles, in the order of Body::particles, one State after the other.
    std::vector<Vec4<Real>> body_places() const;
    /// As the last substep left them, by State and device number.
    std::vector<Real> densities();
    std::vector<int> neighbour_counts() const;
    /// Of the fluid in the last substep, of length h (s), likewise, mass/(length s^2); empty in scheme flex.
    std::vector<Real> pressures(Real h) const;
    /// What the water has given each solid in the last update, mass length/s, by State and device number; empty unless
    /// kept.
    std::vector<Vec4<Real>> impulses_on_solids() const;
    /// What a launch takes that only reads, for all States, what a pass over the pairs of the water reads; the least of
    /// some, s. For measurements, after an update.
    double fetch_seconds(Fetch what) const;

private:
    bool had_room();
    GridLaunch<Real> launch_of(const Update& update, int substep) const;
    void launch_substeps(const Update& update, int substeps, StageClock* clock, const Trace<Real>& trace) const;
    void launch(const Update& update, StageClock* clock, const Trace<Real>& trace) const;
    cudaGraphExec_t graph_of(const Update& update);
    void upload_all(const std::vector<const State<Real>*>& states);
    void set_muscles(const Update& update);
    physics::LawMeasures laws_of(int k) const;
    End end_of(int k) const;
    void go_to(int k, int substep, const Update& update);
    void wait() const;
    void wait_asleep() const;

    const Model& host_model_;
    DeviceModel<Real> device_model_;
    Stream stream_;
    GridLaunch<Real> base_;
    GridMemory<Real> memory_;
    std::unique_ptr<LatticeBodies<Real>> lattice_;
    std::vector<State<Real>> muscles_;  ///< only their spring rest lengths
    struct Graph;
    std::map<std::tuple<double, int, bool>, std::unique_ptr<Graph>> graphs_;
    // Of the host, where the device reads and writes them.
    /// [(state * (substeps + 1) + 1 + substep) * springs + spring]; 0 is before the update
    HostBuffer<Real> rest_lengths_;
    HostBuffer<GridShared<Real>> end_;  ///< by State
    DeviceBuffer<Real> device_rest_lengths_;
    DeviceBuffer<Real> device_densities_;  ///< room for `densities`
    HostBuffer<Real> densities_;
};

}  // namespace natator::cuda
