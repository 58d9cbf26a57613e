#include "io/protocol.h"
#include "readers.h"

namespace natator::fields {
namespace {

constexpr std::size_t max_companions = 64, max_obstacles = 1000;

const json& checked_array(const json& value, const Place& place, std::size_t most, const char* what) {
    if (!value.is_array() || value.size() > most)
        refuse(place, value, "an array of at most " + std::to_string(most) + " " + what);
    return value;
}

/// Keys of an obstacle's extent, by its shape; the first is given for spheres and boxes, and all belong to a mesh.
std::vector<std::string_view> extent_keys(Obstacle::Shape shape) {
    switch (shape) {
        case Obstacle::Shape::sphere:
            return {"radius"};
        case Obstacle::Shape::box:
            return {"size"};
        case Obstacle::Shape::mesh:
            break;
    }
    return {"file", "digest", "unit", "length", "forward", "up"};
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
    const std::vector<std::string_view> extent = extent_keys(obstacle.shape);
    std::vector<std::string_view> others = extent;
    others.push_back("shape");
    read_object(value, place, table, others, obstacle);
    required(value, place, "centre");
    const json& size = required(value, place, extent.front().data());
    const Range length{0, 10000, true, "length"};
    if (obstacle.shape == Obstacle::Shape::sphere)
        read(size, place.key(extent.front().data()), length, obstacle.radius);
    else if (obstacle.shape == Obstacle::Shape::box)
        read(size, place.key(extent.front().data()), length, obstacle.size);
    else
        obstacle.points = read_mesh_points(value, place, data, obstacle.spacing);
    return obstacle;
}

}  // namespace

std::vector<Companion> read_companions(const json& value, const Place& place, const std::filesystem::path& data) {
    std::vector<Companion> companions;
    for (const json& one : checked_array(value, place, max_companions, "companions")) {
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
    for (const json& one : checked_array(value, place, max_obstacles, "obstacles"))
        obstacles.push_back(read_obstacle(one, place.item(obstacles.size()), data));
    return obstacles;
}

}  // namespace natator::fields
