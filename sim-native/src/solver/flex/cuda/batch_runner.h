#pragma once

#include <algorithm>
#include <optional>
#include <string>

#include "batch_kernel.cuh"
#include "natator/error.h"
#include "natator/solver.h"
#include "solver/cuda/device.h"
#include "solver/cuda/device_states.h"
#include "solver/cuda/event.h"

namespace natator::cuda {

/// Launches batches of one Model on the current device and keeps what they need beside the States.
template <class Real>
class BatchRunner {
public:
    explicit BatchRunner(const Model& model) : model_(model) {}

    const DeviceModel<Real>& model() const { return model_; }

    /// A launch's description for these States, all optional parts left out.
    BatchView<Real> view_of(const DeviceStates<Real>& states, int updates) const {
        BatchView<Real> batch{};
        batch.model = model_.view();
        batch.states = states.count();
        batch.updates = updates;
        batch.position = states.position();
        batch.velocity = states.velocity();
        batch.fit = states.fit();
        batch.rest_length = states.rest_length();
        return batch;
    }

    /// Runs the updates to their end; States whose progress has stopped already stay as they are. Calls meanwhile()
    /// while they run.
    template <class Meanwhile>
    void run(BatchView<Real>& batch, const std::vector<Progress>& progress, StageProfile* profile,
             const Meanwhile& meanwhile) {
        if (!teams_ || states_of_teams_ != batch.states) {
            teams_ = best_teams(model_.view(), batch.states);
            states_of_teams_ = batch.states;
        }
        batch.layout = teams_->layout;
        const std::size_t bytes = std::size_t{batch.layout.scratch_bytes} * std::min(teams_->count, batch.states);
        if (scratch_.size() < bytes) scratch_ = DeviceBuffer<char>(bytes);
        batch.scratch = scratch_.data();
        progress_ = DeviceBuffer<Progress>(progress);
        path_ = DeviceBuffer<double>(static_cast<std::size_t>(batch.states) * (batch.updates + 1));
        DeviceBuffer<unsigned> next_ticket(1);
        DeviceBuffer<int> updates_done(batch.states);
        DeviceBuffer<unsigned> arrivals(static_cast<std::size_t>(arrivals_of_team) * teams_->count);
        arrivals.clear();
        batch.arrivals = arrivals.data();
        next_ticket.clear();
        updates_done.clear();
        batch.progress = progress_.data();
        batch.path = path_.data();
        batch.next_ticket = next_ticket.data();
        batch.updates_done = updates_done.data();
        DeviceBuffer<unsigned long long> cycles(profile ? static_cast<std::size_t>(Stage::count) : 0);
        cycles.clear();
        batch.profile = cycles.data();
        const Event start, end;
        start.record();
        launch_batch(batch, *teams_);
        end.record();
        meanwhile();
        check(cudaStreamSynchronize(nullptr), "run");
        seconds_ = end.seconds_since(start);
        if (profile) add_to(*profile, cycles.download());
    }
    void run(BatchView<Real>& batch, const std::vector<Progress>& progress) {
        run(batch, progress, nullptr, [] {});
    }

    /// Of the last run.
    std::vector<Progress> progress() const { return progress_.download(); }
    std::vector<double> path() const { return path_.download(); }
    double seconds() const { return seconds_; }  ///< between the kernel's start and end

private:
    /// The kernel's time, shared out in proportion to the cycles that its teams booked.
    void add_to(StageProfile& profile, const std::vector<unsigned long long>& cycles) const {
        double all = 0;
        for (const auto booked : cycles) all += static_cast<double>(booked);
        for (std::size_t k = 0; k < cycles.size(); ++k)
            if (cycles[k] > 0)
                profile.add(name(static_cast<Stage>(k)), seconds_ * static_cast<double>(cycles[k]) / all);
    }

    DeviceModel<Real> model_;
    std::optional<Teams> teams_;  ///< of the last run, which had so many States
    int states_of_teams_ = 0;
    DeviceBuffer<char> scratch_;
    DeviceBuffer<Progress> progress_;
    DeviceBuffer<double> path_;
    double seconds_ = 0;
};

}  // namespace natator::cuda
