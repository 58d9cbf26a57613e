#include "backend.h"

#include <iostream>
#include <optional>
#include <set>

#include "natator/error.h"
#include "options.h"

namespace natator::cli {

namespace {

void add_backend_option(CLI::App* command, BackendChoice& choice, const std::string& more = {}) {
    command->add_option("--backend", choice.name, "cpu, cuda (a GPU), or auto (a GPU where there is one)." + more)
        ->check(one_of({"cpu", "cuda", "auto"}))
        ->capture_default_str();
}

void add_device_option(CLI::App* command, BackendChoice& choice) {
    command->add_option("--device", choice.device, "Number of the GPU, see natator-sim info.")
        ->check(whole_number_in(0, 1023))
        ->capture_default_str();
}

}  // namespace

void add_backend_options(CLI::App* command, BackendChoice& choice) {
    add_backend_option(command, choice);
    add_gpu_options(command, choice);
}

void add_stream_backend_options(CLI::App* command, BackendChoice& choice) {
    add_backend_option(command, choice,
                       " Swims on a GPU that are told to act by one message go on by the same kernels.");
    add_device_option(command, choice);
}

void add_gpu_options(CLI::App* command, BackendChoice& choice) {
    add_device_option(command, choice);
    command->add_flag("--whole-gpu", choice.whole_gpu,
                      "Compute by kernels of the whole GPU, however small the scene, whose last digits may differ: "
                      "what scheme conserving always "
                      "does, and scenes of more than 65 535 particles. Slower for others.");
    command->add_flag(
        "--without-lists", choice.without_lists,
        "Scheme conserving: search the neighbours of the water anew in each sum over them, as where lists do not "
        "fit into the GPU's memory. The same bits in less than a third of the memory, but slower.");
}

void refuse_gpu_options_for_cpu(const BackendChoice& choice) {
    if (choice.name != "cpu") return;
    std::string given;
    if (choice.device != 0) given = "--device = " + std::to_string(choice.device);
    if (choice.without_lists) given = "--without-lists";
    if (choice.whole_gpu) given = "--whole-gpu";
    if (given.empty()) return;
    throw InputError(given + ": the backend is cpu; must be left out, or beside --backend cuda or auto");
}

bool on_gpu(const BackendChoice& choice, const Scene& scene) {
    if (choice.name == "cpu") return false;
    const int devices = static_cast<int>(cuda_devices().size());
    if (choice.name == "cuda") {
        if (choice.device < devices) return true;
        throw NoDevice("backend = \"cuda\", device " + std::to_string(choice.device) + ": no such device here; " +
                       (devices == 0 ? "there is none, or this program was built without CUDA: must be backend \"cpu\""
                                     : "must be one that natator-sim info lists, or backend \"cpu\""));
    }
    std::optional<std::string> reason = "no GPU here";
    if (choice.device < devices) reason = gpu_refusal(scene);
    if (!reason) return true;
    static std::set<std::string> said;
    if (said.insert(*reason).second) std::cerr << "natator-sim: backend auto: " << *reason << "; using the CPU\n";
    return false;
}

}  // namespace natator::cli
