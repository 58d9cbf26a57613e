#include "gait_json.h"
#include "natator/limits.h"
#include "readers.h"

namespace natator::fields {
namespace {

constexpr std::size_t max_obstacles = 1000;

const json& checked_array(const json& value, const Place& place, std::size_t max_size, const char* what) {
    if (!value.is_array() || value.size() > max_size)
        refuse(place, value, "an array of at most " + std::to_string(max_size) + " " + what);
    return value;
}

Obstacle read_obstacle(const json& value, const Place& place, const std::filesystem::path& data) {
    static const std::vector<Field<Obstacle>> table = {
        {"centre", &Obstacle::centre, {-10000, 10000, false, "length"}},
        {"spacing", &Obstacle::spacing, {0, 1000, true, "length"}},
    };
    Obstacle obstacle;
    if (!value.is_object()) refuse(place, value, "an object with `shape`");
    obstacle.shape = read_choice<Obstacle::Shape>(
        required(value, place, "shape"), place.key("shape"),
        {{"sphere", Obstacle::Shape::sphere}, {"box", Obstacle::Shape::box}, {"mesh", Obstacle::Shape::mesh}});
    const bool is_mesh = obstacle.shape == Obstacle::Shape::mesh;
    const char* extent = is_mesh ? "file" : obstacle.shape == Obstacle::Shape::sphere ? "radius" : "size";
    std::vector<std::string_view> others = is_mesh ? mesh_keys : std::vector<std::string_view>{extent};
    others.emplace_back("shape");
    read_object(value, place, table, others, obstacle);
    required(value, place, "centre");
    const json& size = required(value, place, extent);
    const Range length{0, 10000, true, "length"};
    if (is_mesh)
        obstacle.points = read_mesh_points(value, place, data, obstacle.spacing);
    else if (obstacle.shape == Obstacle::Shape::sphere)
        read(size, place.key(extent), length, obstacle.radius);
    else
        read(size, place.key(extent), length, obstacle.size);
    return obstacle;
}

/// Whether two fill the same place; a mesh that is sampled otherwise is another one.
bool coincide(const Obstacle& a, const Obstacle& b) {
    return a.shape == b.shape && a.centre == b.centre && a.radius == b.radius && a.size == b.size &&
           a.points == b.points;
}

/// Refuses an obstacle that is one before it once more: its particles would lie in each other.
void check_alone(const std::vector<Obstacle>& obstacles, const json& last, const Place& all) {
    for (std::size_t k = 0; k + 1 < obstacles.size(); ++k)
        if (coincide(obstacles[k], obstacles.back()))
            refuse(all.item(obstacles.size() - 1), last,
                   "elsewhere than " + all.item(k).path + ", whose place and shape it has, or left out");
}

}  // namespace

std::vector<Companion> read_companions(const json& value, const Place& place, const std::filesystem::path& data) {
    std::vector<Companion> companions;
    for (const json& one : checked_array(value, place, limits::companions, "companions")) {
        const Place at = place.item(companions.size());
        check_keys(one, at, {"creature", "gait"});
        Companion companion;
        companion.creature = read_creature(required(one, at, "creature"), at.key("creature"), data);
        companion.gait = one.contains("gait") ? parse_gait(one.at("gait"), at.document + ": " + at.key("gait").path)
                                              : resting_gait(companion.creature.actuators());
        companions.push_back(std::move(companion));
    }
    return companions;
}

std::vector<Obstacle> read_obstacles(const json& value, const Place& place, const std::filesystem::path& data) {
    std::vector<Obstacle> obstacles;
    for (const json& one : checked_array(value, place, max_obstacles, "obstacles")) {
        obstacles.push_back(read_obstacle(one, place.item(obstacles.size()), data));
        check_alone(obstacles, one, place);
    }
    return obstacles;
}

}  // namespace natator::fields
