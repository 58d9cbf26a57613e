#pragma once

#include <memory>
#include <mutex>
#include <new>
#include <vector>

#include "grid_runner.h"
#include "solver/cuda/device.h"

namespace natator::cuda {

/// GridRunners of a Model, lent to whoever computes. Any number of threads.
template <class Real>
class GridPool {
public:
    GridPool(Model model, const GridOptions& options, int device)
        : host_model_(std::move(model)), options_(options), device_(device), model_(host_model_, true) {}
    GridPool(const GridPool&) = delete;
    GridPool& operator=(const GridPool&) = delete;

    const Model& host_model() const { return host_model_; }
    /// Of which there is one more: runners have their own.
    const DeviceModel<Real>& model() const { return model_; }

    /// For updates of runners that others use, too.
    TurnsOfGpu& turns() { return turns_; }

    /// Makes its device the current one of this thread.
    void choose() const { choose_device(device_); }

    /// A runner until this ends.
    class Loan {
    public:
        Loan(GridPool& pool, std::unique_ptr<GridRunner<Real>> runner) : pool_(&pool), runner_(std::move(runner)) {}
        Loan(Loan&&) noexcept = default;
        Loan& operator=(Loan&&) = delete;
        ~Loan() {
            if (runner_) pool_->give_back(std::move(runner_));
        }
        GridRunner<Real>* operator->() const { return runner_.get(); }
        GridRunner<Real>& operator*() const { return *runner_; }

    private:
        GridPool* pool_;
        std::unique_ptr<GridRunner<Real>> runner_;
    };

    /// One of so many States, or a few more, all but the first `states` idle; on the current device of this thread from
    /// then on. Throws std::bad_alloc.
    Loan lend(int states) {
        choose();
        std::unique_ptr<GridRunner<Real>> runner = free_one(states);
        if (!runner) runner = make(states);
        std::vector<bool> idle(runner->states(), true);
        std::fill_n(idle.begin(), states, false);
        runner->set_idle(idle);
        return {*this, std::move(runner)};
    }

private:
    std::unique_ptr<GridRunner<Real>> free_one(int states) {
        const std::lock_guard lock(mutex_);
        for (auto& runner : free_) {
            if (runner->states() < states || runner->states() > 2 * states) continue;
            std::swap(runner, free_.back());
            std::unique_ptr<GridRunner<Real>> found = std::move(free_.back());
            free_.pop_back();
            return found;
        }
        return nullptr;
    }

    /// In the place of the free ones, if there is no more memory.
    std::unique_ptr<GridRunner<Real>> make(int states) {
        try {
            return std::make_unique<GridRunner<Real>>(host_model_, states, options_);
        } catch (const std::bad_alloc&) {
            const std::lock_guard lock(mutex_);
            free_.clear();
        }
        return std::make_unique<GridRunner<Real>>(host_model_, states, options_);
    }

    void give_back(std::unique_ptr<GridRunner<Real>> runner) {
        const std::lock_guard lock(mutex_);
        free_.push_back(std::move(runner));
    }

    Model host_model_;
    GridOptions options_;
    int device_;
    DeviceModel<Real> model_;
    TurnsOfGpu turns_;
    std::mutex mutex_;
    std::vector<std::unique_ptr<GridRunner<Real>>> free_;
};

}  // namespace natator::cuda
