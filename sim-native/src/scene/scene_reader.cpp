#include <cmath>
#include <utility>

#include "base/text.h"
#include "model/check_scene.h"
#include "natator/limits.h"
#include "readers.h"
#include "scene/scene_json.h"

namespace natator {
namespace {

using fields::Field;
using fields::Place;
using nlohmann::json;

constexpr std::size_t max_planes = 32;

const std::vector<Field<Scene>>& scene_fields() {
    static const std::vector<Field<Scene>> table = {
        {"description", &Scene::description},
        {"duration", &Scene::duration, {0, 1e6, true, "s"}},
        {"timeStep", &Scene::time_step, {1e-6, 1, false, "s"}},
    };
    return table;
}

const std::vector<Field<Settling>>& settling_fields() {
    static const std::vector<Field<Settling>> table = {
        {"updates", &Settling::updates, {0, 1'000'000}},
        {"timeStep", &Settling::time_step, {1e-9, 1, false, "s"}},
        {"substeps", &Settling::substeps, {1, 1000}},
    };
    return table;
}

const std::vector<Field<Stopping>>& stopping_fields() {
    static const std::vector<Field<Stopping>> table = {
        {"planeContact", &Stopping::plane_contact},
        {"noProgressAfter", &Stopping::no_progress_after, {0, 1e6, false, "s"}},
    };
    return table;
}

/// [a, b, c, d] of the half space a x + b y + c z + d >= 0.
Plane read_plane(const json& value, const Place& place) {
    if (!value.is_array() || value.size() != 4) refuse(place, value, "an array [a, b, c, d] of 4 numbers");
    Plane plane;
    for (std::size_t i = 0; i < 3; ++i) {
        fields::read(value[i], place.item(i), {-1, 1}, plane.normal[static_cast<Eigen::Index>(i)]);
    }
    fields::read(value[3], place.item(3), {-10000, 10000, false, "length"}, plane.offset);
    fields::check_plane(plane, place);
    plane.normal.normalize();
    return plane;
}

std::vector<Plane> read_planes(const json& value, const Place& place) {
    const std::string limit = "an array of at most " + std::to_string(max_planes) + " planes";
    if (!value.is_array() || value.size() > max_planes) refuse(place, value, limit);
    std::vector<Plane> planes;
    for (std::size_t i = 0; i < value.size(); ++i) planes.push_back(read_plane(value[i], place.item(i)));
    return planes;
}

void check_frames(const Scene& scene, const Place& place) {
    const double frames = scene.duration / scene.time_step;
    if (frames > limits::time_steps) {
        fields::refuse(place.key("duration"), scene.duration, "at most 10 million time steps of timeStep");
    }
    if (frames < 0.5) fields::refuse(place.key("duration"), scene.duration, "at least one timeStep");
}

}  // namespace

Scene scene_from_json(const json& document, const std::string& name, const std::filesystem::path& data) {
    const Place place{"scene " + quoted(name), ""};
    Scene scene = thesis_tank();
    scene.name = name;
    scene.planes.clear();
    scene.fluid.reset();
    fields::read_object(document, place, scene_fields(),
                        {"base", "scheme", "solver", "planes", "periodic", "fluid", "creature", "settling", "stopping",
                         "movingTank", "goals", "companions", "obstacles"},
                        scene);
    if (document.contains("base"))
        fields::refuse(place.key("base"), document.at("base"),
                       "left out: a scene that builds on another is read by load_scene");
    if (document.contains("scheme")) {
        scene.scheme = fields::read_choice<Scheme>(
            document.at("scheme"), place.key("scheme"),
            {{"flex", Scheme::flex}, {"conserving", Scheme::conserving}, {"lattice", Scheme::lattice}});
    }
    if (document.contains("solver")) scene.solver = fields::read_solver(document.at("solver"), place.key("solver"));
    if (document.contains("planes")) scene.planes = read_planes(document.at("planes"), place.key("planes"));
    if (fields::has(document, "fluid")) scene.fluid = fields::read_fluid(document.at("fluid"), place.key("fluid"));
    if (fields::has(document, "creature")) {
        scene.creature = fields::read_creature(document.at("creature"), place.key("creature"), data);
    }
    if (document.contains("settling")) {
        fields::read_object(document.at("settling"), place.key("settling"), settling_fields(), {}, scene.settling);
    }
    if (document.contains("stopping")) {
        fields::read_object(document.at("stopping"), place.key("stopping"), stopping_fields(), {}, scene.stopping);
    }
    if (document.contains("companions"))
        scene.companions = fields::read_companions(document.at("companions"), place.key("companions"), data);
    if (document.contains("obstacles"))
        scene.obstacles = fields::read_obstacles(document.at("obstacles"), place.key("obstacles"), data);
    if (fields::has(document, "movingTank")) {
        scene.moving_tank = fields::read_moving_tank(document.at("movingTank"), place.key("movingTank"));
        if (!scene.fluid && scene.planes.empty()) scene.moving_tank.reset();  // nothing is left to go along
    }
    if (document.contains("goals")) scene.goals = fields::read_goals(document.at("goals"), place.key("goals"));
    check_frames(scene, place);
    fields::check_water(scene, place);
    fields::check_bodies(scene, place);
    if (fields::has(document, "periodic"))
        scene.periodic = fields::read_periodic(document.at("periodic"), place.key("periodic"), scene.fluid.has_value(),
                                               scene.planes);
    return scene;
}

}  // namespace natator
