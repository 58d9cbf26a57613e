#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

#include "base/fnv1a.h"
#include "base/text.h"
#include "data_files.h"
#include "model/mesh/check_mesh.h"
#include "model/mesh/mesh_points.h"
#include "model/mesh/mesh_slices.h"
#include "model/mesh/regions.h"
#include "natator/error.h"
#include "natator/limits.h"
#include "readers.h"

namespace natator::fields {
namespace {

/// The bytes of a mesh's file. Throws InputError.
std::string mesh_bytes(const std::string& file, const std::filesystem::path& data) {
    if (!is_obj(file) && !is_stl(file)) throw InputError("must be a path ending in .obj or .stl");
    const std::filesystem::path path = mesh_path(file, data);
    std::error_code failed;
    const auto status = std::filesystem::status(path, failed);
    if (!std::filesystem::exists(status)) throw InputError("there is no such file");
    if (!std::filesystem::is_regular_file(status)) throw InputError("is no regular file; must be one");
    const auto size = std::filesystem::file_size(path, failed);
    if (failed || size > limits::mesh_bytes)
        throw InputError("has " + std::to_string(size) + " bytes; must be at most " +
                         std::to_string(limits::mesh_bytes));
    std::string bytes(static_cast<std::size_t>(size), '\0');
    std::ifstream in(path, std::ios::binary);
    if (!in.read(bytes.data(), static_cast<std::streamsize>(size))) throw InputError("cannot be read");
    return bytes;
}

std::string digest_of(const std::string& bytes) {
    Fnv1a digest;
    digest.add(std::span<const char>(bytes));
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(digest.value()));
    return text;
}

/// A direction along an axis of the file: "x", "-x" and so on.
Eigen::Vector3d read_direction(const json& value, const Place& place) {
    std::vector<std::pair<std::string_view, int>> choices{{"x", 1},   {"-x", -1}, {"y", 2},
                                                          {"-y", -2}, {"z", 3},   {"-z", -3}};
    const int axis = read_choice<int>(value, place, choices);
    Eigen::Vector3d direction = Eigen::Vector3d::Zero();
    direction[std::abs(axis) - 1] = axis > 0 ? 1 : -1;
    return direction;
}

/// Rows: what is forward, up and right in the file.
Eigen::Matrix3d read_axes(const json& value, const Place& place) {
    Eigen::Vector3d forward = Eigen::Vector3d::UnitX(), up = Eigen::Vector3d::UnitY();
    if (value.contains("forward")) forward = read_direction(value.at("forward"), place.key("forward"));
    if (value.contains("up")) up = read_direction(value.at("up"), place.key("up"));
    if (forward.dot(up) != 0)
        refuse(place.key(value.contains("up") ? "up" : "forward"), value.at(value.contains("up") ? "up" : "forward"),
               "at a right angle to the other of forward and up");
    Eigen::Matrix3d axes;
    axes << forward.transpose(), up.transpose(), forward.cross(up).transpose();
    return axes;
}

/// Scene lengths of one unit of the file.
double read_unit(const json& value, const Place& place, const TriangleMesh& mesh) {
    constexpr Range range{0, 1e6, true, "length"};
    double unit = 1;
    if (value.contains("unit")) {
        if (value.contains("length")) refuse(place.key("length"), value.at("length"), "left out beside unit");
        read(value.at("unit"), place.key("unit"), range, unit);
    } else if (value.contains("length")) {
        double length = 0;
        read(value.at("length"), place.key("length"), range, length);
        double low = mesh.vertices[0].x(), high = low;
        for (const Eigen::Vector3d& vertex : mesh.vertices)
            low = std::min(low, vertex.x()), high = std::max(high, vertex.x());
        unit = length / (high - low);
    }
    return unit;
}

/// Refuses what a mesh's functions do, with the place of the file in the scene before it.
template <class F>
auto of_file(const Place& place, const std::string& file, const F& function) {
    try {
        return function();
    } catch (const InputError& error) {
        refuse(place, natator::quoted(file) + ": " + error.what());
    }
}

/// A mesh as its file has it but for its axes, and what a Skin says of the file.
struct TurnedMesh {
    TriangleMesh mesh;  ///< x forward, y up, z right, in units of the file
    Skin skin;          ///< without vertices, triangles, origin and volume
};

TurnedMesh read_turned_mesh(const json& value, const Place& place, const std::filesystem::path& data) {
    TurnedMesh turned;
    auto& [mesh, skin] = turned;
    const Place at = place.key("file");
    read(required(value, place, "file"), at, {}, skin.file);
    mesh = of_file(at, skin.file, [&file = skin.file, &digest = skin.digest, &data] {
        const std::string bytes = mesh_bytes(file, data);
        digest = digest_of(bytes);
        TriangleMesh read = natator::read_mesh(bytes, file);
        check_mesh(read);
        return read;
    });
    if (value.contains("digest") && value.at("digest") != skin.digest)
        refuse(place.key("digest"), value.at("digest"),
               skin.digest + ", that of " + natator::quoted(skin.file) + ", which has changed; or left out");
    skin.axes = read_axes(value, place);
    for (Eigen::Vector3d& vertex : mesh.vertices) vertex = skin.axes * vertex;
    skin.unit = read_unit(value, place, mesh);
    return turned;
}

/// Control points of a body whose skin is known: a number, or places in the file.
void read_points(const json& value, const Place& place, const std::vector<Bend>& bends, Creature& creature) {
    const Skin& skin = *creature.skin;
    ControlPoints points{0, {}, bends};
    if (value.is_array()) {
        if (value.empty() || value.size() > max_control_points)
            refuse(place, value,
                   "1 to " + std::to_string(max_control_points) + " places in the file, or a number of points");
        for (std::size_t i = 0; i < value.size(); ++i) {
            Eigen::Vector3d at = skin.origin;
            read(value[i], place.item(i), {-1e9, 1e9, false, "unit of the file"}, at);
            points.places.push_back(skin.axes * (at - skin.origin) * skin.unit / creature.spacing);
        }
    } else {
        read(value, place, {min_control_points, max_control_points, false, "points"}, points.count);
    }
    std::vector<Eigen::Vector3d> vertices;
    for (const Eigen::Vector3d& vertex : skin.vertices) vertices.push_back(vertex / creature.spacing);
    try {
        creature.regions = make_regions(creature.slices, points, vertices);
    } catch (const InputError& error) {
        refuse(place, error.what());
    }
}

}  // namespace

std::string mesh_digest(const std::string& file, const Place& place, const std::filesystem::path& data) {
    return of_file(place, file, [&] { return digest_of(mesh_bytes(file, data)); });
}

void read_mesh_body(const json& value, const Place& place, const std::filesystem::path& data,
                    const std::vector<Bend>& bends, Creature& creature) {
    std::vector<std::string_view> keys = mesh_keys;
    keys.insert(keys.end(), {"joints", "points"});
    check_keys(value, place, keys);
    if (has(value, "points") && has(value, "joints"))
        refuse(place.key("points"), value.at("points"), "left out beside joints");
    auto [mesh, read_skin] = read_turned_mesh(value, place, data);
    auto skin = std::make_shared<Skin>(std::move(read_skin));
    const MeshSlices body = of_file(place.key("file"), skin->file,
                                    [&, &mesh = mesh] { return slice_mesh(mesh, creature.spacing / skin->unit); });
    skin->origin = skin->axes.transpose() * body.rear_centre;
    skin->volume = body.volume * skin->unit * skin->unit * skin->unit;
    for (const Eigen::Vector3d& vertex : mesh.vertices)
        skin->vertices.push_back((vertex - body.rear_centre) * skin->unit);
    skin->triangles = mesh.triangles;
    creature.slices = body.slices;
    creature.skin = std::move(skin);
    if (has(value, "points")) return read_points(value.at("points"), place.key("points"), bends, creature);
    creature.joints = read_joint_parts(required(value, place, "joints"), place.key("joints"),
                                       static_cast<int>(creature.slices.size()));
}

std::vector<Eigen::Vector3d> read_mesh_points(const json& value, const Place& place, const std::filesystem::path& data,
                                              double spacing) {
    const auto [mesh, skin] = read_turned_mesh(value, place, data);
    std::vector<Eigen::Vector3d> points = of_file(place.key("file"), skin.file, [&mesh = mesh, &skin = skin, spacing] {
        return points_inside(mesh, spacing / skin.unit);
    });
    for (Eigen::Vector3d& point : points) point *= skin.unit;
    return points;
}

}  // namespace natator::fields
