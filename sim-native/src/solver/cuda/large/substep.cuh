#pragma once

#include "slots.cuh"
#include "stage_clock.h"

namespace natator::cuda {

/// What the stages of a large State are launched with.
template <class Real>
struct LargeLaunch {
    ModelView<Real> model;
    Slots<Real> slots;
    void* scan_room;
    std::size_t scan_bytes;
    cudaStream_t stream;
    cudaStream_t side;        ///< for stages of one block beside those of the stream, which would leave no room later
    cudaEvent_t fork, joint;  ///< where the two part and meet
    Trace<Real> trace;        ///< null where nobody looks
    StageClock* clock = nullptr;  ///< likewise

    void mark(const char* stage) const {
        if (clock) clock->mark(stage);
    }

    /// The stream for stages that run beside the next ones, until join(). With a clock they run before these.
    cudaStream_t part() const {
        if (clock) return stream;
        check(cudaEventRecord(fork, stream), "fork");
        check(cudaStreamWaitEvent(side, fork), "fork");
        return side;
    }
    void join() const {
        if (clock) return;
        check(cudaEventRecord(joint, side), "join");
        check(cudaStreamWaitEvent(stream, joint), "join");
    }
};

/// Launches the stages of substep `slots.substep`, in the order of step.h.
template <class Real>
void launch_substep(const LargeLaunch<Real>& launch);
template <class Real, Scheme scheme>
void launch_substep_of(const LargeLaunch<Real>& launch);

/// Predicts, numbers the slots and searches: the part that schemes share.
template <class Real, Scheme scheme>
void launch_search(const LargeLaunch<Real>& launch);

/// Writes positions of all slots, with the particles' numbers, to row `row` of an observer's view if there is one.
template <class Real>
void record_positions(const LargeLaunch<Real>& launch, Quad<Real>* to, int row);

/// Densities of the fluid and numbers of neighbours, by particle, as the last substep left them.
template <class Real>
void launch_densities(const LargeLaunch<Real>& launch, Real* density);
template <class Real>
void launch_neighbour_counts(const LargeLaunch<Real>& launch, int* counts);

/// Mean x of the body and whether it touches a plane, into what all share.
template <class Real>
void launch_measure(const LargeLaunch<Real>& launch);

/// Sets all velocities of the State to 0.
template <class Real>
void launch_rest(const LargeLaunch<Real>& launch);

/// Sets the slot far from all others.
template <class Real>
void launch_far_slot(const LargeLaunch<Real>& launch);

inline int blocks_for(int count, int threads_of_block) {
    return (count + threads_of_block - 1) / threads_of_block;
}

}  // namespace natator::cuda
