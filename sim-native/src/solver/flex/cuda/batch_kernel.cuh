#pragma once

#include "natator/solver.h"
#include "physics/laws.h"
#include "solver/cuda/state_team.cuh"

namespace natator::cuda {

/// Progress of a State from frame to frame, beside its particles.
struct Progress {
    int stopped = -1;  ///< a value of StopReason, or -1 while it runs
    int frames = 0;
    int bad_particle = 0;  ///< of an unstable one: device number
    double bad_time = 0;   ///< start of the substep that made it; of a broken law the end of the frame
    physics::Law broken = physics::Law::finite;  ///< by an unstable one
};

/// The gaits of a batch, row by row; without frequencies the muscles stay as they are.
struct GaitView {
    const double* frequency = nullptr;
    const double* power = nullptr;
    const double* amplitude = nullptr;  ///< [state * actuators + actuator]
    const double* phase = nullptr;
    const double* offset = nullptr;  ///< likewise; null = 0
};

/// Work of the teams of a launch: `updates` updates of each of `states` States.
template <class Real>
struct BatchView {
    ModelView<Real> model;
    int states, updates;
    double start_time;  ///< of the first update, s
    double time_step;
    int substeps;
    bool settling;  ///< velocities to 0 after each update, no measurement

    // By State.
    Vec4<Real>* position;  ///< [state * particles + slot], w = the particle's number
    Vec4<Real>* velocity;
    ClusterFit<Real>* fit;    ///< [state * clusters + cluster]
    const Real* rest_length;  ///< of the springs: [state * springs + spring]; null: the Model's
    Progress* progress;
    GaitView gait;
    /// Of the muscles, as the host set them: [(state * updates + update) * muscles + muscle]; null: by the gaits.
    const Real* muscle_length;
    double* path;       ///< mean x of the body: [state * (updates + 1) + frame]
    Real* density;      ///< after the last update: [state * fluid + particle]; null if nobody asks
    int* neighbours;    ///< of each particle in the last substep: [state * particles + particle]; likewise
    Trace<Real> trace;  ///< of the only State's last update
    const physics::LawLimits* limits;  ///< by State; null if nobody asks
    bool stop_at_planes;
    int no_progress_frames;  ///< 0 = never

    // By team.
    Layout layout;
    char* scratch;
    unsigned* arrivals;  ///< [team * arrivals_of_team], 0 at first

    unsigned long long* profile;  ///< cycles by Stage, of all teams; null if nobody asks

    // The queue: tickets are handed out update by update, and within an update State by State.
    unsigned* next_ticket;
    int* updates_done;  ///< by State
};

/// How States are computed.
struct Teams {
    TeamKind kind;
    int blocks;     ///< of a team
    Layout layout;  ///< of what a team works on
    int count = 0;  ///< that are on the device at a time
};

/// The fastest for so many States on the current device; all give the same bits. Throws InputError where there are
/// none.
template <class Real>
Teams best_teams(const ModelView<Real>& model, int states);

/// Advances all States; returns at once.
template <class Real>
void launch_batch(const BatchView<Real>& batch, const Teams& teams);

/// The kernel that launch_batch starts, with the code of effects (Plan::effects) or without; each in a source of its
/// own. Null where there is none, as it takes long to compile: for one block with effects, which are rare, for many
/// blocks with them or in double.
template <class Real, bool effects>
const void* batch_kernel(TeamKind kind);

}  // namespace natator::cuda
