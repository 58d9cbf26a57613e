#include "roofline.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <numeric>
#include <stdexcept>

#include "bench_scenes.h"
#include "machine.h"
#include "natator/evaluate.h"
#include "natator/model.h"
#include "natator/solver.h"
#include "roof_kernels.h"
#include "run/settle.h"
#include "scene/scene_json.h"
#include "solver/cpu/aligned.h"
#include "solver/cpu/cell_grid.h"

namespace natator::bench {

RoofKernels roof_kernels() {
#if defined(NATATOR_X86_KERNELS)
    if (instruction_set() == InstructionSet::avx512) return avx512::roof_kernels();
    if (instruction_set() == InstructionSet::avx2) return avx2::roof_kernels();
#elif defined(NATATOR_ARM_KERNELS)
    if (instruction_set() == InstructionSet::neon) return neon::roof_kernels();
#endif
    return portable::roof_kernels();
}

namespace {

using cpu::AlignedVector;

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Best of some calls; each must take about a millisecond at least.
template <class Work>
double best_seconds(const Work& work) {
    double best = 1e9;
    for (int repeat = 0; repeat < 20; ++repeat) {
        const auto start = std::chrono::steady_clock::now();
        volatile float result = work();
        static_cast<void>(result);
        best = std::min(best, seconds_since(start));
    }
    return best;
}

struct Roof {
    const char* kind;
    std::string name;
    double rate;  ///< flops or bytes per second
};

double bandwidth(const RoofKernels& kernels, std::size_t bytes) {
    const AlignedVector<float> values(bytes / sizeof(float), 1.0f);
    const int count = static_cast<int>(values.size());
    const int rounds = std::max(1, static_cast<int>((std::size_t(1) << 26) / bytes));
    const double seconds = best_seconds([&] {
        float sum = 0;
        for (int k = 0; k < rounds; ++k) sum += kernels.sum(values.data(), count);
        return sum;
    });
    return static_cast<double>(bytes) * rounds / seconds;
}

/// Bytes per second of quadruples and their indices, from lists as local as a cell-ordered tank's are.
double quadruple_bandwidth(const RoofKernels& kernels) {
    constexpr int particles = 5600, nearby = 800, per_particle = 32;
    const AlignedVector<float> packed(4 * (particles + nearby), 1.0f);
    std::vector<std::int32_t> index;
    unsigned random = 1;
    for (int i = 0; i < particles * per_particle; ++i) {
        random = random * 1664525u + 1013904223u;
        index.push_back(i / per_particle + static_cast<int>((random >> 8) % nearby));
    }
    const int count = static_cast<int>(index.size());
    const double seconds = best_seconds([&] {
        float sum = 0;
        for (int k = 0; k < 10; ++k) sum += kernels.sum_quadruples(packed.data(), index.data(), count);
        return sum;
    });
    return 10.0 * count * (4 * sizeof(float) + sizeof(std::int32_t)) / seconds;
}

std::vector<Roof> measure_roofs() {
    const RoofKernels kernels = roof_kernels();
    constexpr int rounds = 1 << 20;
    const double flops = 2.0 * 12 * kernels.width * rounds;
    return {{"compute", "multiply-add", flops / best_seconds([&] { return kernels.multiply_add(rounds); })},
            {"bandwidth", "first-level cache", bandwidth(kernels, 16 << 10)},
            {"bandwidth", "second-level cache", bandwidth(kernels, 512 << 10)},
            {"bandwidth", "memory", bandwidth(kernels, std::size_t(256) << 20)},
            {"bandwidth", "quadruples by index", quadruple_bandwidth(kernels)}};
}

/// What a stage does per pair, counted in its kernel: additions, multiplications, divisions, roots and maxima count 1,
/// a fused multiply-add 2; bytes are those of the pair, in and out.
struct CountedStage {
    Scheme scheme;
    const char* stage;
    bool candidates;  ///< pairs are those that the search measures
    double flops, bytes;
};

constexpr std::array counted_stages = {
    // 3 differences, r^2, a comparison; three coordinates in, a fifth of the indices out
    CountedStage{Scheme::flex, "fluid neighbours", true, 9, 12.8},
    // difference 3, r^2 5, r 2, 1 - q 2, square 2, sum 1; index, quadruple, r out
    CountedStage{Scheme::flex, "density", false, 15, 24},
    // difference 3, r^2 5, 1/r 1, 1 - q 4, s 3, sums 6, count 1; index, quadruple, r in
    CountedStage{Scheme::flex, "density constraint", false, 23, 24},
    CountedStage{Scheme::conserving, "fluid neighbours", true, 9, 12.8},
    // impulse: difference of velocities 3, product 5, sum 1; push: sum of impulses 1, sums 6; twice index and gradient
    // in, a
    // quadruple and an impulse by index
    CountedStage{Scheme::conserving, "density constraint", false, 16, 52},
};

/// Pairs per substep: neighbours found, and candidates that were measured for them.
struct Pairs {
    double found = 0, candidates = 0;
};

Pairs count_pairs(const Model& model, const State<float>& state, const std::vector<int>& neighbours) {
    std::array<float, 3> low{1e9f, 1e9f, 1e9f}, high{-1e9f, -1e9f, -1e9f};
    for (int i = 0; i < model.particles(); ++i)
        for (int axis = 0; axis < 3 && model.is_fluid(i); ++axis) {
            low[axis] = std::min(low[axis], state.position[i][axis]);
            high[axis] = std::max(high[axis], state.position[i][axis]);
        }
    cpu::CellGrid<float> grid;
    const SolverParameters& p = model.parameters;
    const auto search =
        static_cast<float>(model.scheme == Scheme::conserving ? p.conserving.kernel_support * p.fluid_rest_distance
                                                              : p.radius + p.particle_collision_margin);
    grid.cover(low, high, search, 1 << 20);
    std::vector<int> in_cell(grid.cells(), 0);
    const auto cell_of = [&](int i) {
        const auto& x = state.position[i];
        return grid.cell(x.x(), x.y(), x.z());
    };
    for (int i = 0; i < model.particles(); ++i) in_cell[cell_of(i)] += model.is_fluid(i);
    Pairs pairs;
    for (int i = 0; i < model.particles(); ++i) {
        if (!model.is_fluid(i)) continue;
        pairs.found += neighbours[i];
        const auto rows = grid.rows_around(grid.row(cell_of(i)));
        const auto range = grid.range_around(cell_of(i));
        for (int k = 0; k < rows.count; ++k)
            pairs.candidates += std::accumulate(in_cell.begin() + rows.first_cell[k] + range.first,
                                                in_cell.begin() + rows.first_cell[k] + range.last + 1, 0.0);
    }
    return pairs;
}

void add_stages(const RooflineStudy& study, Scheme scheme, ResultTable& table, const std::function<void(Row)>& add) {
    Scene scene = load_scene("thesis/creature-1");
    scene.scheme = scheme;
    const auto missing = [&](const CountedStage& stage) {
        return stage.scheme == scheme &&
               !table.has({"stage", stage.stage, to_string(scheme), to_string(instruction_set()), machine_text()});
    };
    if (std::ranges::none_of(counted_stages, missing)) return;
    const Model model = build_model(scene);
    State<float> state = initial_state<float>(model);
    StageProfile profile;
    {
        Solver<float> settling(model);
        if (settle(scene.settling, settling, state)) throw std::runtime_error("roofline: the start is unstable");
    }
    Solver<float> solver(model, {.profile = &profile});
    Pairs pairs;
    for (int frame = 0; frame < study.frames; ++frame) {
        if (solver.frame(state, thesis_gait(1))) throw std::runtime_error("roofline: the run is unstable");
        const Pairs now = count_pairs(model, state, solver.neighbour_counts());
        pairs.found += now.found / study.frames;
        pairs.candidates += now.candidates / study.frames;
    }
    for (const CountedStage& stage : counted_stages) {
        if (!missing(stage)) continue;
        const auto entry = std::ranges::find(profile.entries(), stage.stage, &StageProfile::Entry::stage);
        if (entry == profile.entries().end()) throw std::runtime_error(std::string("no stage ") + stage.stage);
        const double calls = static_cast<double>(entry->calls) / study.frames, seconds = entry->seconds / study.frames;
        const double per_frame = calls * (stage.candidates ? pairs.candidates : pairs.found);
        add({"stage", stage.stage, to_string(scheme), to_string(instruction_set()), machine_text(),
             number_text(stage.flops), number_text(stage.bytes), measured_text(per_frame), measured_text(seconds),
             measured_text(1e-9 * stage.flops * per_frame / seconds),
             measured_text(1e-9 * stage.bytes * per_frame / seconds), measured_text(stage.flops / stage.bytes)});
    }
}

}  // namespace

Row roofline_columns() {
    return fields(
        "kind,name,scheme,instruction_set,machine,flops_per_pair,bytes_per_pair,pairs,seconds,gflops,"
        "gbytes_per_second,intensity");
}

void run_roofline_study(const RooflineStudy& study, ResultTable& table,
                        const std::function<void(const std::string&)>& report) {
    const auto add = [&](const Row& row) {
        table.add(row);
        report(joined(row, " "));
    };
    const Row first_roof{"compute", "multiply-add", "", to_string(instruction_set()), machine_text()};
    if (!table.has(first_roof))
        for (const Roof& roof : measure_roofs()) {
            const std::string rate = measured_text(1e-9 * roof.rate);
            const bool compute = roof.kind == std::string("compute");
            add({roof.kind, roof.name, "", to_string(instruction_set()), machine_text(), "", "", "", "",
                 compute ? rate : "", compute ? "" : rate, ""});
        }
    for (const Scheme scheme : study.schemes) add_stages(study, scheme, table, add);
}

}  // namespace natator::bench
