#include "io/strict_json.h"
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
        {"refinement", &C::refinement, {1, 8}},
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

/// Slices of the body in ascending order, from `first` to `last` at most. `what` says which, for messages.
std::vector<int> read_ascending(const json& value, const Place& place, int first, int last, const char* what) {
    if (!value.is_array()) refuse(place, value, "an array of slice indices");
    std::vector<int> chosen;
    for (std::size_t i = 0; i < value.size(); ++i) {
        const int lowest = chosen.empty() ? first : chosen.back() + 1;
        const Place at = place.item(i);
        if (lowest > last) {
            refuse(at, value[i],
                   first > 0 ? "left out (no slice before the last is left for it)" : "left out (no slice is left for it)");
        }
        const Range range{static_cast<double>(lowest), static_cast<double>(last), false, what};
        read(value[i], at, range, chosen.emplace_back());
    }
    return chosen;
}

}  // namespace

Creature read_creature(const json& value, const Place& place) {
    Creature creature;
    read_object(value, place, creature_fields(), {"slices", "joints", "muscleSlices"}, creature);
    creature.slices = read_slices(required(value, place, "slices"), place.key("slices"));
    const auto last = static_cast<int>(creature.slices.size()) - 1;
    creature.joints = read_ascending(required(value, place, "joints"), place.key("joints"), 1, last - 1,
                                     "slice index, ascending, neither first nor last slice");
    if (value.contains("muscleSlices")) {
        creature.muscle_slices =
            read_ascending(value.at("muscleSlices"), place.key("muscleSlices"), 0, last, "slice index, ascending");
        if (creature.muscle_slices.size() == 1)
            refuse(place.key("muscleSlices"), value.at("muscleSlices"), "two slices or more, or left out");
    }
    return creature;
}

}  // namespace natator::fields
