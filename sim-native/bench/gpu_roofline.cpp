#include "gpu_roofline.h"

#include <nlohmann/json.hpp>
#include <vector>

#include "scene/scene_json.h"
#include "solver/cuda/grid/fetch_roof.h"
#include "throughput.h"
#include "timed_batch.h"

namespace natator::bench {
namespace {

/// Of a pair, as the lists keep it in floats: its place, its gradient, packed; of the neighbour: its velocity, its
/// impulse.
constexpr double bytes_of_entry = 4 + 8, bytes_of_velocity = 16, bytes_of_impulse = 4;

struct Crowd {
    std::string name;
    Scene scene;
    int evaluations;
};

std::vector<Crowd> crowds(bool quick) {
    std::vector<Crowd> all{{"thesis/creature-1", load_scene("thesis/creature-1"), quick ? 4 : 150},
                           {"47000 particles", throughput_scene(47'000), quick ? 2 : 16}};
    for (Crowd& crowd : all) crowd.scene.scheme = Scheme::conserving;
    return all;
}

Row row_of(const Row& key, double bytes_of_pair, double pairs, double seconds, const std::string& share) {
    return joined_rows(
        key, {number_text(bytes_of_pair), measured_text(pairs), measured_text(seconds),
              measured_text(1e-6 * pairs / seconds), measured_text(1e-9 * bytes_of_pair * pairs / seconds), share});
}

}  // namespace

Row gpu_roofline_columns() {
    return fields(
        "kind,name,scene,evaluations,device,bytes_per_pair,pairs,seconds,million_pairs_per_second,"
        "gbytes_per_second,share");
}

void run_gpu_roofline_study(const GpuRooflineStudy& study, ResultTable& table,
                            const std::function<void(const std::string&)>& report) {
    const std::string device = gpu_name(study.device);
    const auto add = [&](const Row& row) {
        if (table.has(Row(row.begin(), row.begin() + gpu_roofline_key_columns))) return;
        table.add(row);
        report(joined(row, " "));
    };
    if (const Row copy{"bandwidth", "memory copied", "", "", device}; !table.has(copy)) {
        const double bandwidth = cuda::measure_copy_bandwidth(study.device);
        add(joined_rows(copy, {"", "", "", "", measured_text(1e-9 * bandwidth), ""}));
    }
    for (const Crowd& crowd : crowds(study.quick)) {
        const auto key = [&](const char* kind, const char* name) {
            return Row{kind, name, crowd.name, std::to_string(crowd.evaluations), device};
        };
        const Row stage = key("stage", "density constraint");
        if (table.has(stage)) continue;
        std::vector<Gait> gaits;
        for (const BatchMember& member : batch_members(crowd.scene, crowd.evaluations)) gaits.push_back(member.gait);
        const cuda::FetchRoof roof =
            cuda::measure_fetch_roof(crowd.scene, gaits, study.quick ? 2 : study.frames, study.device);
        constexpr double of_velocities = bytes_of_entry + bytes_of_velocity,
                         of_impulses = bytes_of_entry + bytes_of_impulse;
        add(row_of(key("fetch", "velocities by index"), of_velocities, roof.pairs, roof.velocities, ""));
        add(row_of(key("fetch", "impulses by index"), of_impulses, roof.pairs, roof.impulses, ""));
        add(row_of(stage, (of_velocities + of_impulses) / 2, 2 * roof.pairs, roof.density_constraint,
                   measured_text((roof.velocities + roof.impulses) / roof.density_constraint)));
    }
}

}  // namespace natator::bench
