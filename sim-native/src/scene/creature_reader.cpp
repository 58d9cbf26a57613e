#include "curve.h"
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
        {"particleMass", &C::particle_mass, {1e-6, 1e6, false, "mass"}},
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
                   first > 0 ? "left out (no slice before the last is left for it)"
                             : "left out (no slice is left for it)");
        }
        const Range range{static_cast<double>(lowest), static_cast<double>(last), false, what};
        read(value[i], at, range, chosen.emplace_back());
    }
    return chosen;
}

constexpr Range stiffness{0, 1};

/// A curve's values halfway between the ends of each stretch of the body. `ends` are slices.
std::vector<double> halfway(const Curve& curve, const std::vector<int>& ends, std::size_t slices) {
    std::vector<double> values;
    for (std::size_t i = 1; i < ends.size(); ++i)
        values.push_back(curve.at(((ends[i - 1] + ends[i]) / 2.0 + 0.5) / static_cast<double>(slices)));
    return values;
}

/// A stiffness: one number for all stretches, or a curve along the body.
void read_stiffness(const json& creature, const Place& place, const char* key, const std::vector<int>& ends,
                    std::size_t slices, double& all, std::vector<double>& each) {
    const auto found = creature.find(key);
    if (found == creature.end()) return;
    if (found->is_number())
        read(*found, place.key(key), stiffness, all);
    else
        each = halfway(read_curve(*found, place.key(key), stiffness), ends, slices);
}

void read_slices_and_joints(const json& value, const Place& place, Creature& creature) {
    creature.slices = read_slices(required(value, place, "slices"), place.key("slices"));
    creature.joints = read_ascending(required(value, place, "joints"), place.key("joints"), 1,
                                     static_cast<int>(creature.slices.size()) - 2,
                                     "slice index, ascending, neither first nor last slice");
}

/// Ways to bend: one word for all gaps between muscle slices, or one for each.
std::vector<std::vector<Bend>> read_bends(const json& value, const Place& place, int gaps) {
    const std::vector<std::pair<std::string_view, std::vector<Bend>>> words = {
        {"sideways", {Bend::sideways}}, {"vertical", {Bend::vertical}}, {"both", {Bend::sideways, Bend::vertical}}};
    const auto count = static_cast<std::size_t>(gaps);
    if (!value.is_array()) return std::vector<std::vector<Bend>>(count, read_choice(value, place, words));
    if (value.size() != count)
        refuse(place, value,
               "one word, or one for each of the " + std::to_string(gaps) + " gaps between neighbouring muscle slices");
    std::vector<std::vector<Bend>> bends;
    for (std::size_t i = 0; i < count; ++i) bends.push_back(read_choice(value[i], place.item(i), words));
    return bends;
}

/// How muscles between the regions of `mesh.points` bend, for all of them.
std::vector<Bend> read_region_bends(const json& value, const Place& place) {
    const std::vector<std::pair<std::string_view, std::vector<Bend>>> words = {
        {"sideways", {Bend::sideways}},
        {"vertical", {Bend::vertical}},
        {"both", {Bend::sideways, Bend::vertical}},
        {"contract", {Bend::contract}}};
    return read_choice(value, place, words);
}

/// Whether the body has control points instead of joints; refuses what belongs to joints alone.
bool has_points(const json& value, const Place& place) {
    if (!value.contains("mesh") || !value.at("mesh").is_object() || !has(value.at("mesh"), "points")) return false;
    for (const char* key : {"joint", "muscleSlices"})
        if (value.contains(key))
            refuse(place.key(key), value.at(key), "left out beside mesh.points, which has no joints");
    for (const char* key : {"clusterStiffness", "springStiffness"})
        if (value.contains(key) && value.at(key).is_array())
            refuse(place.key(key), value.at(key), "a number beside mesh.points");
    return true;
}

/// Slices and joints, by the one of three keys that makes them.
void read_shape(const json& value, const Place& place, const std::filesystem::path& data, Creature& creature) {
    const char* const maker = value.contains("mesh") ? "mesh" : value.contains("profile") ? "profile" : nullptr;
    if (!maker) return read_slices_and_joints(value, place, creature);
    for (const char* key : {"slices", "joints", "profile"})
        if (key != std::string_view(maker) && value.contains(key))
            refuse(place.key(key), value.at(key), std::string("left out beside ") + maker + ", which makes them");
    if (maker == std::string_view("profile")) return read_profile(value.at("profile"), place.key("profile"), creature);
    std::vector<Bend> bends;
    if (has_points(value, place))
        bends = value.contains("bend") ? read_region_bends(value.at("bend"), place.key("bend"))
                                       : std::vector<Bend>{Bend::sideways};
    read_mesh_body(value.at("mesh"), place.key("mesh"), data, bends, creature);
}

}  // namespace

Creature read_creature(const json& value, const Place& place, const std::filesystem::path& data) {
    Creature creature;
    read_object(
        value, place, creature_fields(),
        {"slices", "joints", "muscleSlices", "profile", "mesh", "joint", "bend", "clusterStiffness", "springStiffness"},
        creature);
    read_shape(value, place, data, creature);
    const auto last = static_cast<int>(creature.slices.size()) - 1;
    if (value.contains("muscleSlices")) {
        creature.muscle_slices =
            read_ascending(value.at("muscleSlices"), place.key("muscleSlices"), 0, last, "slice index, ascending");
        if (creature.muscle_slices.size() == 1)
            refuse(place.key("muscleSlices"), value.at("muscleSlices"), "two slices or more, or left out");
    }
    if (value.contains("joint"))
        creature.joint =
            read_choice<Joint>(value.at("joint"), place.key("joint"), {{"slice", Joint::slice}, {"line", Joint::line}});
    if (value.contains("bend") && !creature.regions)
        creature.bends = read_bends(value.at("bend"), place.key("bend"), creature.gaps());
    std::vector<int> ends = creature.joints;
    ends.insert(ends.begin(), 0);
    ends.push_back(last);
    read_stiffness(value, place, "clusterStiffness", ends, creature.slices.size(), creature.cluster_stiffness,
                   creature.cluster_stiffnesses);
    read_stiffness(value, place, "springStiffness", creature.muscle_ends(), creature.slices.size(),
                   creature.spring_stiffness, creature.spring_stiffnesses);
    return creature;
}

}  // namespace natator::fields
