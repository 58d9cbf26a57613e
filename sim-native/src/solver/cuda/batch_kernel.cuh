#pragma once

#include "block.cuh"
#include "natator/evaluate.h"

namespace natator::cuda {

/// What a State carries from frame to frame beside its particles.
struct Progress {
    int stopped = -1;  ///< a value of Stopped, or -1 while it runs
    int frames = 0;
    int bad_particle = 0;  ///< of an unstable one: device number
    double bad_time = 0;   ///< start of the substep that made it
};

/// The gaits of a batch, row by row.
struct GaitView {
    const double* frequency;
    const double* power;
    const double* amplitude;  ///< [state * actuators + actuator]
    const double* phase;
};

/// What the blocks of a launch work on: `updates` updates of each of `states` States.
template <class Real>
struct BatchView {
    ModelView<Real> model;
    int states, updates;
    double time_step;
    int substeps;
    bool settling;  ///< muscles at rest, velocities to 0 after each update, no measurement

    // By State.
    Quad<Real>* position;  ///< [state * particles + slot], w = the particle's number
    Quad<Real>* velocity;
    ClusterFit<Real>* fit;  ///< [state * clusters + cluster]
    Progress* progress;
    GaitView gait;
    double* path;   ///< mean x of the body: [state * (updates + 1) + frame]
    Real* density;  ///< after the last update: [state * fluid + particle]; null if nobody asks
    bool stop_at_planes;
    int no_progress_frames;  ///< 0 = never

    // By block.
    char* scratch;
    std::size_t scratch_bytes;

    // The queue: tickets are handed out update by update, and within an update State by State.
    unsigned* next_ticket;
    int* updates_done;  ///< by State
};

/// Bytes on the chip and in device memory that a block needs; `on_chip` says where positions are kept.
template <class Real>
std::size_t chip_bytes(const ModelView<Real>& model, bool on_chip);
template <class Real>
std::size_t scratch_bytes(const ModelView<Real>& model, bool on_chip);

/// Advances all States; returns at once. `blocks` are resident at the same time.
template <class Real>
void launch_batch(const BatchView<Real>& batch, bool on_chip, int blocks);

/// Blocks that the current device can hold at a time; 0 if a block does not fit on its chip.
template <class Real>
int resident_blocks(const ModelView<Real>& model, bool on_chip);

}  // namespace natator::cuda
