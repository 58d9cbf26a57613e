#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "base/field.h"
#include "natator/scene.h"

/// One reader per part of a scene. Each throws InputError and leaves what is absent at its default.
namespace natator::fields {

SolverParameters read_solver(const json& value, const Place& place);
FluidBlock read_fluid(const json& value, const Place& place);
/// `data` as in SceneOptions.
Creature read_creature(const json& value, const Place& place, const std::filesystem::path& data);
std::vector<Companion> read_companions(const json& value, const Place& place, const std::filesystem::path& data);
std::vector<Obstacle> read_obstacles(const json& value, const Place& place, const std::filesystem::path& data);
MovingTank read_moving_tank(const json& value, const Place& place);
/// The axes that a scene says its tank is periodic along, each between the two planes across it, which are no more
/// then. Where the scene has no water and no planes there, nothing is left to be periodic.
std::vector<PeriodicAxis> read_periodic(const json& value, const Place& place, bool water, std::vector<Plane>& planes);
std::vector<Goal> read_goals(const json& value, const Place& place);

/// Gives a creature whose spacing is known the slices and joints of a profile.
void read_profile(const json& value, const Place& place, Creature& creature);

/// Keys of a mesh's file, its scale and its axes.
inline const std::vector<std::string_view> mesh_keys{"file", "digest", "unit", "length", "forward", "up"};

/// Gives a creature whose spacing is known the slices, the joints or regions, and the skin of a mesh. `bends`: how
/// muscles between regions bend.
void read_mesh_body(const json& value, const Place& place, const std::filesystem::path& data,
                    const std::vector<Bend>& bends, Creature& creature);

/// Places of particles inside a mesh, from the middle of its box, length.
std::vector<Eigen::Vector3d> read_mesh_points(const json& value, const Place& place, const std::filesystem::path& data,
                                              double spacing);

/// What tells a mesh's file from others: 16 hexadecimal digits.
std::string mesh_digest(const std::string& file, const Place& place, const std::filesystem::path& data);

/// The slices that hold the given parts of a body's length.
std::vector<int> read_joint_parts(const json& value, const Place& place, int slices);

}  // namespace natator::fields
