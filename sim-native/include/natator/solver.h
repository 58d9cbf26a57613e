#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "natator/gait.h"
#include "natator/instruction_set.h"
#include "natator/model.h"

namespace natator {

class SettledStateCache;

/// Wall time by stage of a step, see solver/step.h. For one thread at a time.
class StageProfile {
public:
    /// What one stage took.
    struct Entry {
        std::string stage;   ///< its name
        long calls = 0;      ///< how often it ran
        double seconds = 0;  ///< wall time of all calls, s
    };

    void add(const char* stage, double seconds);  ///< counts a call of a stage that took so long (s)
    /// Times by stage, in the order in which stages first ran.
    const std::vector<Entry>& entries() const { return entries_; }
    double seconds() const;  ///< of all stages together, s

private:
    std::vector<Entry> entries_;
};

/// Residual of constraints of one kind: 0 if there are none, or if they are met.
struct Residual {
    double max = 0;   ///< of one particle, spring or cluster
    double mean = 0;  ///< over all of the kind
};

/// Residuals of a substep's constraints (Execution::residuals).
struct Residuals {
    double time = 0;     ///< s, at the substep's start
    int iterations = 0;  ///< that it took
    /// Density error of the fluid's particles, in rest densities. Scheme `conserving`: what the velocities would still
    /// have to take off in the substep, of at most `max_excess` (docs/theory.md, section 4.4). Scheme `flex`: excess
    /// over rest density, as the last iteration found it.
    Residual density{};
    /// Density that the velocities would add to the fluid in a substep, after the pass on their divergence, in rest
    /// densities; scheme `conserving` alone.
    Residual divergence{};
    /// |C + alpha lambda| over rest length, C = length - rest length: of a stiff spring its stretch. In scheme `flex`
    /// |C| of all.
    Residual springs{};
    /// Way of a cluster's members from their goals, beyond what compliance leaves them, over the radius of particles.
    Residual clusters{};
};

/// What Solvers on a GPU share (Execution::shared): they take turns in the memory of as few States as compute at a
/// time, and those of equal Models can go on together (step_together). Any number of threads.
class SharedGpu {
public:
    SharedGpu();
    ~SharedGpu();
    SharedGpu(const SharedGpu&) = delete;
    SharedGpu& operator=(const SharedGpu&) = delete;

    struct Pools;                       ///< of the sources
    Pools& pools() { return *pools_; }  ///< likewise

private:
    std::unique_ptr<Pools> pools_;
};

/// Where and how something is computed. None of these but `gpu` and `shared` changes the result. What they point to
/// must live as long as what they are given to, and a profile is that of one thread.
struct Execution {
    StageProfile* profile = nullptr;            ///< where the time goes; null costs nothing
    const SettledStateCache* starts = nullptr;  ///< where settled starts are kept; null settles every time
    /// for scenes of many thousand particles, at most limits::threads; small ones use one all the same
    int threads = 1;
    /// called behind each substep with what it leaves; empty costs nothing
    std::function<void(const Residuals&)> residuals{};
    /// keeps what Solver::forces gives; schemes conserving and lattice, a per cent of their time
    bool forces = false;
    /// Computes on the GPU of this number (cuda_devices).
    /// Results agree with the CPU's to rounding. All else here, but `forces`, is the CPU's.
    std::optional<int> gpu{};
    /// With others on that GPU. In scheme `flex` by kernels of the whole GPU, whose last digits may differ (GpuPath);
    /// no pressures and, but in scheme lattice, no forces
    SharedGpu* shared = nullptr;
    bool skip = true;  ///< leaves out the stages that have nothing to do, see make_unskipped_plan
};

/// The stages that a Model needs, decided once: a stage that is false here does not run and owns no memory.
struct Plan {
    bool fluid = false;               ///< density constraint of scheme `flex`, fluid neighbour lists
    bool water = false;               ///< pressure solves of scheme `conserving`
    bool contacts = false;            ///< pairs that are not both fluid; in scheme `conserving` of solids alone
    bool mutual_contacts = false;     ///< a pair that one side feels is felt by both, so that momentum is kept
    bool solid_pressure = false;      ///< solids add to the fluid's density
    bool uniform_fluid = false;       ///< every fluid particle collides with every other: no test per pair
    bool springs = false;             ///< springs, muscles among them
    bool clusters = false;            ///< shape matching
    bool planes = false;              ///< contacts with planes
    bool particle_friction = false;   ///< SolverParameters::particle_friction
    bool plane_friction = false;      ///< SolverParameters::dynamic_friction and static_friction
    bool viscosity = false;           ///< FlexParameters::viscosity or ConservingParameters::kinematic_viscosity
    bool damping = false;             ///< SolverParameters::damping
    bool clamp_acceleration = false;  ///< SolverParameters::max_acceleration
    bool clamp_speed = false;         ///< SolverParameters::max_speed

    // Off in the thesis.
    bool restitution = false;        ///< SolverParameters::restitution
    bool adhesion = false;           ///< SolverParameters::adhesion
    bool sleep = false;              ///< SolverParameters::sleep_threshold
    bool shock_propagation = false;  ///< SolverParameters::shock_propagation
    bool dissipation = false;        ///< SolverParameters::dissipation
    bool cohesion = false;           ///< SolverParameters::cohesion
    bool surface_tension = false;    ///< SolverParameters::surface_tension
    bool vorticity = false;          ///< SolverParameters::vorticity_confinement
    bool free_surface_drag = false;  ///< SolverParameters::free_surface_drag
    /// any of these that acts on velocities beside the others: all four in scheme `conserving`, tension and vorticity
    /// in `flex`
    bool fluid_forces = false;

    /// Whether any effect acts after the velocities are computed.
    constexpr bool effects() const {
        return dissipation || (fluid && (free_surface_drag || fluid_forces)) || adhesion || restitution || sleep;
    }
};

/// The plan for a model: the stages that it needs.
Plan make_plan(const Model& model);

/// The plan with, on top of what the model needs, all stages that change no bit where there is nothing for them to do,
/// such as forces of strength 0: for measuring what skipping them saves. Fluid stays out where there is none, and so do
/// restitution and the acceleration clamp, which act at any coefficient.
Plan make_unskipped_plan(const Model& model);

/// One line per stage in the order of a substep, as `natator-sim info` prints it.
std::vector<std::string> describe_plan(const Model& model);

/// Where a State stopped being finite.
struct Instability {
    int particle = 0;  ///< lowest index with a value that is not finite, or the particle that broke a law most
    /// first stage whose output was not finite; of the other laws, which look at ends: "settling" or "frame"
    std::string stage;
    double time = 0;  ///< s: start of the substep; of the other laws the end of the frame
    /// or the law of LawWatch that is broken: "tank", "particle-energy", "energy", "shape", "compression", "mach"
    std::string law = "finite";
};

/// What is wrong, as a sentence goes on that begins with "unstable: ".
std::string sentence_of(const Instability& instability);

/// Sees the particles at fixed points of a substep; used for traces and tests. Positions are in the Model's order.
template <class Real>
class StepObserver {
public:
    virtual ~StepObserver() = default;
    /// before the first iteration, length
    virtual void predicted(const std::vector<Vector3<Real>>& positions) = 0;
    virtual void iterated(const std::vector<Vector3<Real>>& positions) = 0;        ///< after each iteration, length
    virtual void substep_ended(const std::vector<Vector3<Real>>& velocities) = 0;  ///< those of its end, length/s
};

template <class Real>
class GpuSolver;

/// Advances States of one Model, on the CPU or with Execution::gpu on a GPU. There the State travels to the device and
/// back with every update, so many whole evaluations are faster by evaluate_on_gpu, whose bits are the same. Members
/// that take a State throw InputError if it is not of so many particles, clusters and springs as the Model; on a GPU
/// they throw std::bad_alloc when its memory is insufficient and std::runtime_error, naming the call, when it fails.
///
/// One thread at a time may use a Solver; several Solvers, also of one Model, may run in as many threads.
template <class Real>
class Solver {
public:
    /// Keeps a reference to `model`, which must live, unchanged, as long as the Solver; so must `execution.profile`, if
    /// there is one. A temporary Model is refused by the compiler. Throws InputError unless the Model's lists belong
    /// together: of as many particles, and of particles, springs and actuators that are there; or if it needs what the
    /// GPU's stages do not do. Throws NoDevice without that GPU, or in a library built without CUDA.
    explicit Solver(const Model& model, const Execution& execution = {});
    explicit Solver(const Model&& model, const Execution& execution = {}) = delete;
    ~Solver();
    Solver(Solver&&) noexcept;             ///< what is moved from may only be destroyed or assigned to
    Solver& operator=(Solver&&) noexcept;  ///< likewise

    /// Advances `state` by `time_step` (s) in `substeps` equal substeps, with the rest lengths it holds.
    /// Returns where the state stopped being finite; `state` then keeps its values from before that substep. Throws
    /// InputError unless the time step is above 0 and there is a substep.
    std::optional<Instability> update(State<Real>& state, double time_step, int substeps,
                                      StepObserver<Real>* observer = nullptr);

    /// One frame of the model: sets the muscles for the state's time, then updates by the model's time step. The gait
    /// must fit the model (check_gait): throws InputError if it has not one value for each actuator.
    std::optional<Instability> frame(State<Real>& state, const Gait& gait);
    /// One frame of the model with muscles that `drive` drives: it is asked for the frame's start in scheme `flex`,
    /// else for the end of each substep. Throws InputError unless its values are in [-2, 2], one for each actuator, or
    /// for each of all swimmers, whose companions follow their own gaits else.
    std::optional<Instability> frame(State<Real>& state, const Drive& drive);
    /// A frame of one of several Solvers.
    struct Frame {
        Solver* solver;      ///< that computes it
        State<Real>* state;  ///< that it advances
        Drive drive;         ///< of its muscles
    };
    /// Frames of several, side by side in as many threads as there are processors, at most `max_threads`, or where they
    /// share a GPU by the same kernels. What became unstable, by frame; each has the bits that it has alone.
    static std::vector<std::optional<Instability>> frames(std::vector<Frame> all, int max_threads);

    /// Work that the muscles of all frames so far did by their changes of rest length, mass length^2/s^2: for each
    /// spring and substep the force at its end, lambda / h^2, times the change. It goes into motion and springs; what
    /// the time step takes off as numerical damping is part of it. 0 in scheme flex (has_muscle_work).
    double muscle_work() const;
    /// The same by swimmer: the body's, then the companions'.
    const std::vector<double>& muscle_works() const;
    /// Sets muscle_work() to 0.
    void clear_muscle_work();

    /// What goes from one frame to the next beside the State, as bytes: the work of the muscles, and in scheme lattice
    /// the water. Its densities, pressures, forces and neighbours are not among it.
    std::string save() const;
    /// Takes what `save` gave, of a Solver of the same Model on the same kind of processor. Throws InputError when it
    /// is none of that, and then nothing has changed.
    void restore(std::string_view saved);

    /// Scheme lattice: moves the water by -by, length, a whole number of cells, as the State's particles have been
    /// moved. Does nothing in the other schemes, whose water is particles.
    void shift_water(const Eigen::Vector3d& by);

    /// Scheme lattice: the greatest speed of a body's particle in a substep since its water began, cells; else 0.
    double cells_per_step() const;
    /// The lattice's cells, of scheme `lattice`; at rest before the first update. In the other schemes it has no cells:
    /// water_field.
    WaterField lattice_water() const;
    /// Calls visit(density, in rest densities; velocity, length/s) for all its cells, one after the other.
    void visit_lattice_cells(const std::function<void(double, const Eigen::Vector3d&)>& visit) const;
    /// Density of each particle in units of rest density, 0 for solids: in scheme flex at the last update's final
    /// positions, in conserving at those of the start of its last substep.
    std::vector<Real> densities();
    /// Pressure of each fluid particle in the last substep, mass/(length s^2): in scheme conserving the sum of the
    /// substep's pressure impulses over h plus the carried pressure (modified_pressure). Right inside the fluid, too
    /// low where a wall takes part of the load. Empty in scheme flex.
    std::vector<Real> pressures() const;
    /// Mean force of the water on each particle over the last update, mass length/s^2: pressure, buoyancy with it, and
    /// viscosity, of the water before walls and of its ghosts behind them. Summed over a body's particles, or over
    /// any part of them, it is the force on that; particles of infinite mass feel it too, though they do not move. What
    /// solids do to each other is not in it; 0 for fluid. In scheme lattice what an obstacle feels is shared evenly by
    /// its particles, and is without buoyancy. Empty without Execution::forces, and in scheme flex.
    std::vector<Vector3<Real>> forces() const;
    /// Number of fluid and contact neighbours of each particle in the last substep.
    std::vector<int> neighbour_counts() const;

    /// Whether a GPU computes.
    bool on_gpu() const;
    /// What settles a Model alike, for a cache of starts: a GPU's name and which kernels; empty on a CPU.
    std::string device() const;

private:
    Drive checked_drive(const Drive& drive) const;

    class Implementation;
    std::unique_ptr<Implementation> implementation_;  ///< of the CPU; null on a GPU
    std::unique_ptr<GpuSolver<Real>> gpu_;
};

/// Whether Solver::muscle_work means something: the model has muscles, and a scheme with forces.
inline bool has_muscle_work(const Model& model) {
    return model.scheme != Scheme::flex && !model.muscles.empty();
}

extern template class Solver<float>;
extern template class Solver<double>;

/// Why an evaluation ended.
enum class StopReason { completed, touched_plane, no_progress, unstable, reached };

}  // namespace natator
