#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "natator/evaluate.h"

namespace natator {

/// A GPU that this library can compute on.
struct Device {
    int index = 0;            ///< its number, as Execution::gpu has it
    std::string name;         ///< as its driver gives it
    std::string capability;   ///< version of its instruction set, such as "9.0"
    std::size_t memory = 0;   ///< bytes
    int multiprocessors = 0;  ///< their number
};

/// All GPUs of this machine; empty without a driver, or if this library was built without CUDA.
std::vector<Device> cuda_devices();

/// Why the GPU's stages cannot do a scene, in one line; none if they can.
std::optional<std::string> gpu_refusal(const Scene& scene);

/// One evaluation of a batch.
struct BatchMember {
    Gait gait;                         ///< of the swimmer
    Perturbation perturbation;         ///< of all starting positions
    std::optional<int> arrangement{};  ///< seed in place of FluidBlock::disorder; schemes `conserving` and `lattice`
};

/// Where the time of a batch goes, and what memory it takes.
struct BatchTimes {
    double settling = 0;              ///< s between the start and the end of the kernels that settle the starts
    double kernel = 0;                ///< s of those that run the frames
    StageProfile* profile = nullptr;  ///< gets the kernel's time by stage, if there is one
    std::size_t memory = 0;           ///< bytes of device memory at most, beside those of other threads' batches
    int at_a_time = 0;                ///< members at most that were computed at a time
};

/// How a batch is computed.
struct BatchOptions {
    Precision precision = Precision::single_precision;  ///< what is computed in
    int device = 0;                                     ///< number of the GPU, see cuda_devices
    /// members by kernels of the whole GPU, some side by side; up to 20 000 particles with bits of its own
    bool whole_gpu = false;
    /// Search the water's neighbours in every pass in place of storing lists; scheme `conserving`. The same bits, less
    /// memory, slower. A scene whose lists do not fit into the device's memory is computed like that anyway.
    bool without_lists = false;
    BatchTimes* times = nullptr;  ///< gets the batch's times added, if there is one
    /// where settled starts are kept; null settles every time. The same bits
    const SettledStateCache* starts = nullptr;
};

/// Evaluates gaits in one scene on a GPU. Small scenes of scheme `flex` run in a block of threads each, or in several
/// blocks where members are few. Everything else runs side by side by kernels of the whole GPU: schemes `conserving`
/// and `lattice`, `options.whole_gpu`, more than 65 535 particles, and more than 20 000 in double or with effects.
/// Result k belongs to member k. The result of a member is the same, bit by bit, whatever the others and their number.
/// A batch that does not fit into the device's memory is computed in parts. For an unstable member the CPU repeats the
/// last substep, to name the stage that failed. May be called from several threads at once. Throws InputError when a
/// gait does not fit the scene or the scene needs what the GPU's stages do not do, NoDevice without that GPU or if this
/// library was built without CUDA.
std::vector<Evaluation> evaluate_on_gpu(const Scene& scene, const std::vector<BatchMember>& members,
                                        const BatchOptions& options = {});

/// A member's evaluation, or one line that says why there is none.
using MemberResult = std::variant<Evaluation, std::string>;

/// Evaluates members that fit the scene together, in one launch: result k belongs to member k.
using EvaluateTogether = std::function<std::vector<Evaluation>(const std::vector<BatchMember>&)>;

/// Evaluates members of one scene. Each is checked first, and only the valid ones are evaluated, together: a bad member
/// costs the others nothing. An error in the scene, or a scene that costs too much (cost.h), is the answer for every
/// member. Throws nothing but std::bad_alloc where there is no memory for the results.
std::vector<MemberResult> evaluate_members(const Scene& scene, const std::vector<BatchMember>& members,
                                           const EvaluateTogether& together);

}  // namespace natator
