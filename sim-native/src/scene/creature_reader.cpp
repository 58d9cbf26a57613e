#include "natator/strict_json.h"
#include "readers.h"

namespace natator::fields {
namespace {

constexpr std::size_t max_slices = 10000;

const std::vector<Field<Creature>>& creature_fields() {
    using C = Creature;
    static const std::vector<Field<C>> fields = {
        {"name", &C::name},
        {"description", &C::description},
        {"spacing", &C::spacing, {0, 1000, true, "length"}},
        {"clusterStiffness", &C::cluster_stiffness, {0, 1}},
        {"particleMass", &C::particle_mass, {1e-6, 1e6, false, "mass"}},
        {"springStiffness", &C::spring_stiffness, {0, 1}},
        {"springsPerParticle", &C::springs_per_particle, {1, 64}},
        {"rearCentre", &C::rear_centre, {-10000, 10000, false, "length"}},
    };
    return fields;
}

/// A run of equal slices, as the JSON gives them.
struct SliceRun {
    int height = 0, width = 0, count = 1;
};

const std::vector<Field<SliceRun>>& slice_fields() {
    static const std::vector<Field<SliceRun>> fields = {
        {"height", &SliceRun::height, {1, 1000, false, "particles along y"}},
        {"width", &SliceRun::width, {1, 1000, false, "particles along z"}},
        {"count", &SliceRun::count, {1, max_slices, false, "slices"}},
    };
    return fields;
}

std::vector<Slice> read_slices(const json& value, const Place& place) {
    if (!value.is_array() || value.empty()) refuse(place, value, "an array of at least one slice");
    std::vector<Slice> slices;
    for (std::size_t i = 0; i < value.size(); ++i) {
        SliceRun run;
        read_object(value[i], place.item(i), slice_fields(), {}, run);
        required(value[i], place.item(i), "height");
        required(value[i], place.item(i), "width");
        slices.insert(slices.end(), static_cast<std::size_t>(run.count), Slice{run.height, run.width});
        if (slices.size() > max_slices) refuse(place, "more than " + std::to_string(max_slices) + " slices");
    }
    return slices;
}

/// Joints lie inside the body and ascend.
std::vector<int> read_joints(const json& value, const Place& place, int slices) {
    if (!value.is_array()) refuse(place, value, "an array of slice indices");
    std::vector<int> joints;
    for (std::size_t i = 0; i < value.size(); ++i) {
        const int lowest = joints.empty() ? 1 : joints.back() + 1;
        const int highest = slices - 2;
        const Place at = place.item(i);
        if (lowest > highest) refuse(at, value[i], "left out (no slice before the last is left for it)");
        const Range range{static_cast<double>(lowest), static_cast<double>(highest), false,
                          "slice index, ascending, neither first nor last slice"};
        read(value[i], at, range, joints.emplace_back());
    }
    return joints;
}

}  // namespace

Creature read_creature(const json& value, const Place& place) {
    Creature creature;
    read_object(value, place, creature_fields(), {"slices", "joints"}, creature);
    creature.slices = read_slices(required(value, place, "slices"), place.key("slices"));
    creature.joints =
        read_joints(required(value, place, "joints"), place.key("joints"), static_cast<int>(creature.slices.size()));
    return creature;
}

}  // namespace natator::fields
