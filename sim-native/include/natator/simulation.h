#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "natator/gait.h"
#include "natator/model.h"
#include "natator/scene.h"
#include "natator/solver.h"

namespace natator {

class MovingFrame;

/// What a Simulation runs, where that is a scene by name.
struct SimulationSetup {
    std::string scene;             ///< name or path of the scene, see load_scene
    std::string overrides{};       ///< JSON merge patch (RFC 7386) on it, as text; empty changes nothing
    std::optional<Gait> gait{};    ///< none: muscles at rest
    std::optional<int> start{};    ///< number of the initial condition (choose_start); none: the scene's own
    std::filesystem::path data{};  ///< where the scene is looked up, as in SceneOptions
    /// s; how long it is to run, for what that may cost (cost.h); it goes on all the same. None: not known
    std::optional<double> until{};
    std::optional<Scene> made{};  ///< runs in place of a scene by name: one that a program has made
};

/// A scene that runs frame by frame, on the CPU or on a GPU (Execution::gpu), and can be changed in between:
/// `Simulation tank(load_scene("pool/eel")); while (tank.time() < 1) tank.step(gait);`. Until a change each frame is,
/// bit by bit, that of `evaluate`; it goes on past the scene's duration and past what would stop an evaluation early,
/// but for instability. Where a member throws InputError or std::bad_alloc nothing has changed. Real is float, or
/// double for reference runs.
///
/// Several threads may call const members of one Simulation as long as none calls another member; several Simulations
/// may run in as many threads.
template <class Real = float>
class Simulation {
public:
    /// Settles a scene, with muscles at rest. Throws InputError when it can't be used, NoDevice without the GPU that
    /// `execution` names. What `execution` points to must live as long as this.
    explicit Simulation(const Scene& scene, const Execution& execution = {});
    /// Settles a scene that is looked up by its name. Throws as for a scene.
    explicit Simulation(const SimulationSetup& setup, const Execution& execution = {});
    ~Simulation();
    Simulation(Simulation&&) noexcept;             ///< what is moved from may only be destroyed or assigned to
    Simulation& operator=(Simulation&&) noexcept;  ///< likewise

    /// Advances by one time step of the scene. False if it became unstable; then there are no more frames until it
    /// starts anew.
    bool step();
    /// Sets the gait and advances by one time step. Throws InputError when the gait does not fit (set_gait).
    bool step(const Gait& next);

    /// Starts another scene. Throws InputError.
    void load(const SimulationSetup& setup);
    // A swimmer is 0, the scene's creature, or 1 and so on, its companions. InputError, too, for one that is not there.

    /// Drives a swimmer's muscles by another gait from the next frame on; before the first frame as if the start had
    /// had it. A companion's is in force until the scene has another for it. Throws InputError when it does not fit,
    /// the steering in force included.
    void set_gait(const Gait& gait, int swimmer = 0);
    /// Steers from the next frame on, until told otherwise; each new start begins without. In scheme `flex` a frame is
    /// driven by the new steering as a whole; else the muscles go from the old to the new one over that frame, in a
    /// straight line, so that the water is not struck. Throws InputError when it does not fit.
    void steer(const Steering& steering, int swimmer = 0);
    /// Drives the actuators by these values, one in [-2, 2] for each, instead of the gait; as `steer` by
    /// steering_of_drive. They have no start ramp. Throws InputError as `steer`.
    void drive(const std::vector<double>& values, int swimmer = 0);
    /// Asked before anything changes: throws InputError for a Model that must not run here.
    using ModelCheck = std::function<void(const Model&)>;
    /// Merges a JSON merge patch, given as text, over the overrides in force. Goes on from the present state if
    /// particles and constraints stay the same, with other settings, masses, stiffnesses or planes; else, and after an
    /// instability, starts anew. True if it did. Throws InputError, also where the scene was made by the program.
    bool merge_overrides(const std::string& patch, const ModelCheck& check = {});
    /// Goes back to the settled start.
    void reset();
    /// Goes to another of the scene's starts, see choose_start. Throws InputError.
    void reset(int start);

    /// The present moment with all that what follows depends on, as bytes: in any process of the same version, on the
    /// same kind of processor, what `restore` makes of them goes on bit by bit as this does. They name the scene, and
    /// hold its overrides, start and gait. They are of this version, and for the one that reads them to trust no more
    /// than a scene. Throws InputError after an instability.
    std::string save();
    /// Goes to a saved moment of the same scene, whose overrides, start, gait and steering come with it; what `reset`
    /// goes back to is that start. True if overrides, start or gait are others than before. Throws InputError when the
    /// bytes are damaged, or of another scene, scheme, precision or version.
    bool restore(std::string_view saved, const ModelCheck& check = {});

    /// What runs now; its gait is always there.
    const SimulationSetup& setup() const { return setup_; }
    const Gait& gait() const { return *setup_.gait; }    ///< that drives the muscles of the creature
    const Gait& gait(int swimmer) const;                 ///< that drives a swimmer's
    const Scene& scene() const;                          ///< with all overrides
    const Model& model() const;                          ///< of that scene
    const State<Real>& state() const { return state_; }  ///< of this moment
    double time() const { return state_.time; }          ///< s since the start
    /// Frames since the start, which was frame 0.
    int frames() const { return frames_; }
    /// What the next frame is steered to.
    const Steering& steering(int swimmer = 0) const { return check_swimmer(swimmer), steering_[swimmer]; }
    /// What drives each actuator now: the gait's drive, steered.
    std::vector<double> driven(int swimmer = 0) const;
    /// Work that a swimmer's muscles did since the start (Solver::muscle_works), mass length^2/s^2.
    double muscle_work(int swimmer = 0) const;
    /// Change of the body's mean x over ground since the start, length.
    double distance(int swimmer = 0) const;
    /// Density of each particle in units of rest density, 0 for solids: of the present state at the start and in scheme
    /// flex; after a step in conserving at the positions of the start of its last substep.
    std::vector<Real> densities();
    /// The water on a grid: the cells of scheme `lattice`, the particles of the others as water_field has them. Throws
    /// InputError as that.
    WaterField water() const;
    /// Mean force of the water on each particle over the last frame (Solver::forces), mass length/s^2; 0 before the
    /// first frame. Empty without Execution::forces, and in scheme flex.
    std::vector<Vector3<Real>> forces() const;
    const std::optional<Instability>& instability() const { return instability_; }  ///< none: it is stable

private:
    struct Run;
    struct Moment;

    std::uint64_t digest(Run& run) const;
    Moment read(std::string_view saved) const;
    std::unique_ptr<Run> make_run(const SimulationSetup& setup) const;
    void follow(MovingFrame& follower);
    void check_swimmer(int swimmer) const;
    void watch_company();
    void start(std::unique_ptr<Run> run);  ///< null: the present one anew
    Drive next_drive() const;
    bool end_step(std::optional<Instability> found);
    template <class Number>
    friend std::vector<bool> step_together(const std::vector<Simulation<Number>*>& simulations, int max_threads);

    Execution execution_;
    SimulationSetup setup_;
    std::unique_ptr<Run> run_;
    State<Real> state_;
    bool updated_ = false;  ///< whether the state is what run_'s solver has left
    /// of a restored state, until the next step; none: the solver has them
    std::optional<std::vector<Real>> restored_densities_;
    int frames_ = 0;
    int base_frame_ = 0;    ///< since when the time step is what it is
    double base_time_ = 0;  ///< s, of base_frame_
    // By swimmer:
    std::vector<double> start_x_;
    std::vector<double> earlier_work_;  ///< of the muscles from the start to run_'s solver, mass length^2/s^2
    std::vector<Steering> steering_;    ///< what the next frame is steered to
    std::vector<Steering> applied_;     ///< what the last frame ended with
    std::vector<Gait> company_;         ///< gaits of the companions
    std::optional<Instability> instability_;
};

/// Advances each by one frame, with the bits of Simulation::step: side by side in at most so many threads, those that
/// share a GPU (Execution::shared) by the same kernels. False for each that is unstable or has become so. Throws what
/// `step` does; then what each has done is not known.
template <class Real>
std::vector<bool> step_together(const std::vector<Simulation<Real>*>& simulations, int max_threads);

extern template std::vector<bool> step_together(const std::vector<Simulation<float>*>&, int);
extern template std::vector<bool> step_together(const std::vector<Simulation<double>*>&, int);
extern template class Simulation<float>;
extern template class Simulation<double>;

}  // namespace natator
