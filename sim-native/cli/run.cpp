#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <sstream>

#include "base/text.h"
#include "commands.h"
#include "gait_argument.h"
#include "job.h"
#include "json_argument.h"
#include "natator/error.h"
#include "natator/evaluate.h"
#include "natator/record.h"
#include "options.h"
#include "output_file.h"
#include "protocol/protocol.h"
#include "scene/scene_json.h"

namespace natator::cli {
namespace {

using nlohmann::json;

struct RunOptions {
    std::string scene, gait, overrides, trajectory, snapshot, scheme;
    std::string precision = "float";
    std::optional<double> duration, snapshot_at;
    double perturbation = 0;
    std::string perturbation_seed = std::to_string(Perturbation{}.seed);
    bool particles = false, residuals = false;
    BackendChoice backend;
    ExecutionOptions execution;
};

/// Recordings are made on the CPU.
bool run_on_gpu(const RunOptions& options, const Scene& scene) {
    refuse_gpu_options_for_cpu(options.backend);
    if (options.trajectory.empty() && options.snapshot.empty() && !options.residuals)
        return on_gpu(options.backend, scene);
    if (options.backend.name == "cuda")
        throw InputError(
            "--backend = cuda: records no --trajectory, --snapshot and --residuals; must be cpu or auto with them");
    return false;
}

Scene load(const RunOptions& options) {
    json overrides = read_overrides_argument(options.overrides);
    if (options.duration) overrides["duration"] = *options.duration;
    if (!options.scheme.empty()) overrides["scheme"] = options.scheme;
    return load_scene(options.scene, overrides);
}

/// The gait asked for; without one the muscles rest.
Gait load_gait(const RunOptions& options, int actuators) {
    return options.gait.empty() ? resting_gait(actuators) : read_gait_argument(options.gait);
}

/// Within the limits of a request's.
Perturbation read_perturbation(const RunOptions& options) {
    const json seed = json::parse(options.perturbation_seed, nullptr, false);
    return {read_perturbation_amplitude(options.perturbation, {"", "--perturbation"}),
            read_perturbation_seed(seed.is_discarded() ? json(options.perturbation_seed) : seed,
                                   {"", "--perturbation-seed"})};
}

void check_outputs(const RunOptions& options, const Scene& scene) {
    if (!options.trajectory.empty() && !scene.creature)
        throw InputError("--trajectory = " + natator::quoted(options.trajectory) +
                         ": the scene has no creature; must be left out, or --snapshot");
    if (!options.trajectory.empty()) require_writable(options.trajectory);
    if (!options.snapshot.empty()) require_writable(options.snapshot);
    if (options.trajectory.empty() || options.snapshot.empty()) return;
    const auto whole = [](const std::string& file) {
        return std::filesystem::weakly_canonical(std::filesystem::absolute(file));
    };
    if (whole(options.trajectory) == whole(options.snapshot))
        throw InputError("--snapshot = " + quoted(options.snapshot) +
                         ": must be another file than that of --trajectory");
}

std::string swimming_line(const SwimmingNumbers& numbers) {
    std::ostringstream text;
    text << "tail       " << figure_text(numbers.tail_amplitude) << " units from side to side";
    if (numbers.strouhal) text << ", Strouhal number " << figure_text(*numbers.strouhal);
    if (numbers.reynolds) text << ", Reynolds number " << figure_text(*numbers.reynolds);
    if (numbers.swimming_number) text << ", swimming number " << figure_text(*numbers.swimming_number);
    constexpr double worth_telling = 0.01;
    if (numbers.cavities.value_or(0) >= worth_telling)
        text << ", cavities in the water " << figure_text(*numbers.cavities) << " body volumes";
    text << "\n";
    if (const std::string warning = warning_of_across(numbers.across); !warning.empty())
        text << "warning    " << warning << "\n";
    return text.str();
}

std::string goal_line(const GoalResult& goal) {
    std::ostringstream text;
    text << "goal       " << to_string(goal.measure) << ", score " << figure_text(goal.score);
    if (goal.arrived_at)
        text << ", reached at " << *goal.arrived_at << " s";
    else if (goal.left)
        text << ", " << figure_text(*goal.left) << (goal.measure == Goal::Measure::turn ? " degrees" : " units")
             << " left";
    text << "\n";
    return text.str();
}

/// What all substeps of a run have left.
struct AllResiduals {
    struct Kind {
        double max = 0, sum_of_means = 0;
        void add(const Residual& residual) {
            max = std::max(max, residual.max);
            sum_of_means += residual.mean;
        }
    };
    void add(const Residuals& residuals) {
        ++substeps;
        iterations += residuals.iterations;
        max_iterations = std::max(max_iterations, residuals.iterations);
        density.add(residuals.density);
        divergence.add(residuals.divergence);
        springs.add(residuals.springs);
        clusters.add(residuals.clusters);
    }
    std::string text() const {
        std::ostringstream text;
        const auto mean = [this](double sum) {
            return figure_text(substeps > 0 ? sum / static_cast<double>(substeps) : 0);
        };
        text << "residuals  of " << substeps << " substeps with " << mean(static_cast<double>(iterations))
             << " iterations, at most " << max_iterations << "\n";
        const auto add = [&](const char* name, const Kind& kind, const char* unit) {
            if (kind.max > 0)
                text << name << mean(kind.sum_of_means) << " on average, at most " << figure_text(kind.max) << " "
                     << unit << "\n";
        };
        add("density    ", density, "rest densities");
        add("divergence ", divergence, "rest densities in a substep");
        add("springs    ", springs, "of their length");
        add("shapes     ", clusters, "radii from the goals");
        return text.str();
    }

    long substeps = 0, iterations = 0;
    int max_iterations = 0;
    Kind density{}, divergence{}, springs{}, clusters{};
};

/// Figures have three digits: another start of the same swim mostly changes the second.
std::string summary(const RunOptions& options, const Scene& scene, const Evaluation& result, double wall_seconds) {
    std::ostringstream text;
    text << "scene      " << scene.name << "\n";
    if (scene.creature) {
        const int actuators = scene.creature->actuators();
        text << "creature   " << (scene.creature->name.empty() ? "of the scene" : scene.creature->name) << ", "
             << actuators << " actuators"
             << (actuators == 0         ? ", it cannot move by itself (an actuator needs two joints)"
                 : options.gait.empty() ? ", muscles at rest (no --gait)"
                                        : "")
             << "\n";
    }
    text << "simulated  " << result.simulated << " s in " << result.frames
         << (result.frames == 1 ? " frame, " : " frames, ") << to_string(result.stopped) << "\n";
    if (result.smagorinsky > 0)
        text << "eddies     by Smagorinsky's constant " << figure_text(result.smagorinsky) << "\n";
    if (result.cells_per_step > 0)
        text << "fastest    " << figure_text(result.cells_per_step)
             << " cells a substep (above 0.1 more substeps may change the distance much)\n";
    if (result.instability) {
        text << "unstable   " << sentence_of(*result.instability) << "\n";
    } else if (scene.creature) {
        const double length = scene.creature->length();
        const double speed = result.simulated > 0 ? result.distance / result.simulated : 0;
        text << "distance   " << figure_text(result.distance) << " units\n";
        text << "speed      " << figure_text(speed) << " units/s";
        if (length > 0) text << ", " << figure_text(speed / length) << " body lengths/s";
        text << "\n";
        if (result.swimming && !options.gait.empty())
            text << swimming_line(*result.swimming);  // a resting tail has no beat
        for (const GoalResult& goal : result.goals) text << goal_line(goal);
        for (const CompanionResult& one : result.companions)
            text << "beside it  " << one.creature << ", " << figure_text(one.distance) << " units\n";
        if (result.work) text << "work       " << figure_text(*result.work) << " by the muscles\n";
    }
    text << "hash       " << hash_text(result.hash) << "\n";
    text << "wall time  " << figure_text(wall_seconds) << " s\n";
    return text.str();
}

int run_scene(RunOptions& options) {
    const Scene scene = load(options);
    const Gait gait = load_gait(options, scene.creature ? scene.creature->actuators() : 0);
    const Precision precision = precision_named(options.precision);
    const Perturbation perturbation = read_perturbation(options);
    check_outputs(options, scene);
    EvaluationOptions evaluation{.precision = precision, .perturbation = perturbation};
    std::optional<TrajectoryCsv> trajectory;
    std::exception_ptr trajectory_failure, snapshot_failure;  // the run goes on, and its summary is not lost
    const auto or_fail_later = [](std::exception_ptr& failure, const auto& work) {
        if (failure) return;
        try {
            work();
        } catch (...) {
            failure = std::current_exception();
        }
    };
    if (!options.trajectory.empty()) {
        evaluation.on_frame = [&](double time, const auto& positions) {
            or_fail_later(trajectory_failure, [&] {
                using Rows = TrajectoryCsv::Rows;
                if (!trajectory)
                    trajectory.emplace(options.trajectory,
                                       scene.creature ? scene.creature->slices : std::vector<Slice>{},
                                       options.particles ? Rows::particles : Rows::slices);
                trajectory->add_frame(time, positions);
            });
        };
    }

    bool snapshot_taken = false;
    SnapshotRequest& snapshot = evaluation.snapshot;
    if (!options.snapshot.empty()) {
        snapshot.at = options.snapshot_at;
        const double end = std::round(scene.duration / scene.time_step) *
                           scene.time_step;  // of the last frame, which may not be the duration
        if (snapshot.at && !(end > *snapshot.at - scene.time_step / 1000))
            throw InputError("--at = " + number_text(*snapshot.at) + ": must be at most " + number_text(end) +
                             ", the end of the last frame");
        snapshot.take = [&](const Model& model, const Snapshot& taken) {
            snapshot_taken = true;
            or_fail_later(snapshot_failure, [&] { write_snapshot(options.snapshot, model, taken); });
        };
    }

    const auto start = std::chrono::steady_clock::now();
    evaluation.execution = options.execution.execution();
    AllResiduals residuals;
    if (options.residuals) evaluation.execution.residuals = [&](const Residuals& substep) { residuals.add(substep); };
    const Evaluation result = run_on_gpu(options, scene) ? evaluate_one_on_gpu(scene, {gait, perturbation}, precision,
                                                                               options.backend, evaluation.execution)
                                                         : evaluate(scene, gait, evaluation);
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    if (trajectory) or_fail_later(trajectory_failure, [&] { trajectory->finish(); });
    print(summary(options, scene, result, wall.count()) + (options.residuals ? residuals.text() : ""));
    for (const std::exception_ptr& failure : {trajectory_failure, snapshot_failure})
        if (failure) std::rethrow_exception(failure);
    if (result.instability) return unstable;
    if (snapshot.at && snapshot.take && !snapshot_taken) {
        throw std::runtime_error("no snapshot: the run ended at " + number_text(result.simulated) + " s, before --at " +
                                 number_text(*snapshot.at));
    }
    return ok;
}

}  // namespace

void add_run(CLI::App& app, int& status) {
    CLI::App* command = app.add_subcommand("run", "Run a scene once and print a summary.");
    const auto options = std::make_shared<RunOptions>();
    command->add_option("scene", options->scene, "Name or path of the scene.")->required();
    command->add_option("--gait", options->gait,
                        R"(File or JSON text: {"frequency":1.861,"amplitude":[0.973,0.69],"phase":[0,0.648]}. )"
                        "Default: muscles at rest.");
    command->add_option("--duration", options->duration,
                        "Simulated time, s, to the nearest whole number of frames. Default: the scene's.");
    command->add_option("--scheme", options->scheme, "Update rule: flex, conserving or lattice. Default: the scene's.");
    command->add_option("--precision", options->precision, "float or double.")
        ->check(precision_name())
        ->capture_default_str();
    command->add_option("--overrides", options->overrides, "File or JSON text merged into the scene (RFC 7386).");
    auto* trajectory =
        command->add_option("--trajectory", options->trajectory,
                            "CSV file for the centre of every slice in every frame: frame,time,slice,x,y,z.");
    command
        ->add_flag("--particles", options->particles,
                   "In the trajectory, every body particle instead of slice centres.")
        ->needs(trajectory);
    auto* snapshot = command->add_option(
        "--snapshot", options->snapshot,
        "CSV file for all particles at one time: time,kind,mass,x,y,z,vx,vy,vz,density (fluid too).");
    command
        ->add_option("--at", options->snapshot_at,
                     "Time of the snapshot, s. Default: the end of the run, wherever that is.")
        ->needs(snapshot)
        ->check(seconds());
    command->add_flag("--residuals", options->residuals,
                      "Also measure what the iterations leave of density, divergence, springs and "
                      "shapes in each substep: on the CPU, at up to twice the time.");
    command->add_option("--perturbation", options->perturbation,
                        "Random shift of all starting positions, at most this along each axis, 0 to 1.");
    command->add_option("--perturbation-seed", options->perturbation_seed, "The same seed gives the same shifts.")
        ->capture_default_str();
    add_backend_options(command, options->backend);
    add_execution_options(command, options->execution);
    command->callback([options, &status] { status = run_scene(*options); });
}

}  // namespace natator::cli
