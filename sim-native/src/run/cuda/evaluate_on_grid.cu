#include "evaluate_on_grid.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>

#include "base/side_by_side.h"
#include "grid_scene.h"
#include "solver/cuda/grid/parts.h"

namespace natator::cuda {
namespace {

/// Side by side. While one waits for what takes long but is little, such as the solids of its States, the water of the
/// others fills the GPU.
constexpr int max_streams = 3;
/// Of all streams together: so many fill a GPU; more at a time only take more memory.
constexpr int particles_at_a_time = 2'000'000;

/// The parts of a group that are computed one after another, side by side with those of other streams.
template <class Real>
class Stream {
public:
    Stream(const Scene& scene, const ModelGroup& group, SettledStarts<Real>& starts, const Parts& parts, int number,
           WaterLists lists, const BatchOptions& options)
        : parts_(parts),
          number_(number),
          times_{.profile = options.times ? options.times->profile : nullptr},
          grid_scene_(scene, group, starts, parts.size(), lists, options.starts, &times_) {}

    void evaluate() {
        for (int part = number_; part < parts_.count; part += parts_.streams)
            grid_scene_.evaluate(parts_.first(part), parts_.size_of(part), evaluations_.emplace_back());
    }
    std::vector<Evaluation>& evaluations_of(int part) { return evaluations_[part / parts_.streams]; }
    const BatchTimes& times() const { return times_; }
    const std::vector<Span>& busy() const { return grid_scene_.busy(); }

private:
    const Parts& parts_;
    int number_;
    BatchTimes times_;
    GridScene<Real> grid_scene_;
    std::vector<std::vector<Evaluation>> evaluations_;  ///< by part, of its own
};

/// The streams run side by side, more or less.
template <class Real>
void add_times(const std::vector<std::unique_ptr<Stream<Real>>>& streams, BatchTimes& times) {
    BatchTimes all;
    std::vector<Span> busy;
    for (const auto& stream : streams) {
        all.settling = std::max(all.settling, stream->times().settling);
        busy.insert(busy.end(), stream->busy().begin(), stream->busy().end());
        all.at_a_time += stream->times().at_a_time;
    }
    times.settling += all.settling;
    times.kernel += busy_seconds(std::move(busy));
    times.at_a_time = std::max(times.at_a_time, all.at_a_time);
}

template <class Real>
std::vector<Evaluation> evaluate_in_parts(const Scene& scene, const ModelGroup& group, const Parts& parts,
                                          WaterLists lists, const BatchOptions& options) {
    int device = 0;
    check(cudaGetDevice(&device), "device");
    SettledStarts<Real> starts(starts_of(scene, group.members));
    std::vector<std::unique_ptr<Stream<Real>>> streams;
    for (int k = 0; k < parts.streams; ++k)
        streams.push_back(std::make_unique<Stream<Real>>(scene, group, starts, parts, k, lists, options));
    side_by_side(
        streams.size(),
        [&](std::size_t k) {
            check(cudaSetDevice(device), "choose device");
            streams[k]->evaluate();
        },
        streams.size(), streams.size());
    if (options.times) add_times(streams, *options.times);
    std::vector<Evaluation> evaluations;
    for (int part = 0; part < parts.count; ++part)
        std::ranges::move(streams[part % parts.streams]->evaluations_of(part), std::back_inserter(evaluations));
    return evaluations;
}

/// Where there is not the memory for it, fewer at a time, and one by itself without lists. Stages are timed in one
/// stream, as those of two overlap.
template <class Real>
std::vector<Evaluation> evaluate_group(const Scene& scene, const ModelGroup& group, const BatchOptions& options) {
    const int members = static_cast<int>(group.members.size());
    int streams = options.times && options.times->profile ? 1 : max_streams;
    int most = particles_at_a_time / streams / group.model.particles() + 1;
    WaterLists lists = options.without_lists ? WaterLists::never : WaterLists::always;
    for (;;) {
        const Parts parts(members, most, streams);
        try {
            return evaluate_in_parts<Real>(scene, group, parts, lists, options);
        } catch (const std::bad_alloc&) {
            const bool one = parts.size() == 1 && parts.streams == 1;
            if (one && lists == WaterLists::never) throw;
            if (one) lists = WaterLists::never;
            if (parts.size() == 1) streams = 1;
            most = (parts.size() + 1) / 2;
        }
    }
}

}  // namespace

template <class Real>
std::vector<Evaluation> evaluate_on_grid(const Scene& scene, const Model& model,
                                         const std::vector<BatchMember>& members, const BatchOptions& options) {
    std::vector<Evaluation> evaluations(members.size());
    for (const ModelGroup& group : model_groups(scene, model, members)) {
        if (group.members.empty()) continue;
        const std::vector<Evaluation> own = evaluate_group<Real>(scene, group, options);
        for (std::size_t k = 0; k < own.size(); ++k) evaluations[group.numbers[k]] = own[k];
    }
    return evaluations;
}

template std::vector<Evaluation> evaluate_on_grid<float>(const Scene&, const Model&, const std::vector<BatchMember>&,
                                                         const BatchOptions&);
template std::vector<Evaluation> evaluate_on_grid<double>(const Scene&, const Model&, const std::vector<BatchMember>&,
                                                          const BatchOptions&);

}  // namespace natator::cuda
