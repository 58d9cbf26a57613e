#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "natator/batch.h"

namespace natator::cli {

/// Where a command computes.
struct BackendChoice {
    std::string name = "cpu";    ///< cpu, cuda or auto
    int device = 0;              ///< number of the GPU
    bool whole_gpu = false;      ///< also for scenes that a block can do
    bool without_lists = false;  ///< of the neighbours of water
};

/// Adds --backend, --device, --whole-gpu and --without-lists.
void add_backend_options(CLI::App* command, BackendChoice& choice);
/// Adds the first two, for streams.
void add_stream_backend_options(CLI::App* command, BackendChoice& choice);
/// Adds the last three, for what only GPUs do.
void add_gpu_options(CLI::App* command, BackendChoice& choice);

/// Refuses them, other than they are without being given, where all is computed on the CPU: not of `serve`,
/// whose requests may choose.
void refuse_gpu_options_for_cpu(const BackendChoice& choice);

/// True if the scene is to be computed on the GPU. `auto` takes the GPU where there is one that does the whole scene,
/// else says on standard error, once for each reason, why it takes the CPU. Throws NoDevice for `cuda` without a GPU.
bool on_gpu(const BackendChoice& choice, const Scene& scene);

}  // namespace natator::cli
