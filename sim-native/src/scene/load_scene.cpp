#include "base/field.h"
#include "base/strict_json.h"
#include "base/text.h"
#include "data_files.h"
#include "merge_patches.h"
#include "natator/error.h"
#include "readers.h"
#include "scene_json.h"

namespace natator {
namespace {

using fields::Place;
using nlohmann::json;

constexpr int max_bases = 8;

/// A mesh that a file names is beside that file, whatever the working directory; a plain name that is not there may be
/// a bundled mesh. `mesh`: what has the key `file`.
void place_mesh(json& mesh, const std::string& name, const std::filesystem::path& data) {
    if (!name.ends_with(".json") || !mesh.is_object() || !mesh.contains("file") || !mesh.at("file").is_string()) return;
    const std::filesystem::path file = mesh.at("file").get<std::string>(),
                                folder = std::filesystem::path(name).parent_path();
    if (file.is_absolute()) return;
    const std::filesystem::path beside = (folder.empty() ? "." : folder) / file;
    std::error_code failed;
    const bool bundled = mesh_path(file.string(), data) != file;
    if (!bundled || std::filesystem::exists(beside, failed)) mesh["file"] = beside.string();
}

/// The path of a scene or a creature that a file names is from where that file is; of one that is not there, from the
/// working directory.
std::string relative_to(const std::string& file, const std::string& path) {
    constexpr std::string_view ending = ".json";
    const std::filesystem::path folder = std::filesystem::path(file).parent_path();
    if (!file.ends_with(ending) || !path.ends_with(ending) || folder.empty()) return path;
    std::error_code failed;
    const std::filesystem::path there = folder / path;  // `path` itself if it is absolute
    return std::filesystem::exists(there, failed) ? there.string() : path;
}

/// The array under a key of a document; null if there is none. The readers refuse what is something else.
json* array_in(json& document, const char* key) {
    return document.contains(key) && document.at(key).is_array() ? &document.at(key) : nullptr;
}

/// Places the file of a creature, and the mesh of one that is written in the scene itself. `holder`: the scene, or one
/// of its companions.
void place_creature(json& holder, const std::string& name, const std::filesystem::path& data) {
    if (!holder.is_object() || !holder.contains("creature") || !holder.at("creature").is_object()) return;
    json& creature = holder.at("creature");
    if (creature.contains("name") && creature.at("name").is_string())
        creature["name"] = relative_to(name, creature.at("name").get<std::string>());
    if (creature.contains("mesh")) place_mesh(creature.at("mesh"), name, data);
}

/// Whether a scene's creature is a change of the creature file that its `name` names: it is not if it brings its own
/// `slices`, or a `profile` or `mesh` and no name.
bool is_of_file(const json& creature) {
    const bool shaped = fields::has(creature, "profile") || fields::has(creature, "mesh");
    return !fields::has(creature, "slices") && (!shaped || fields::has(creature, "name"));
}

/// Merges a patch onto a scene. What it removes from a creature whose file still has it stays null, for the file.
void patch_scene(json& scene, const json& patch) {
    const json before = scene.value("creature", json::object());
    scene.merge_patch(patch);
    if (!patch.contains("creature") || !patch.at("creature").is_object()) return;
    json& creature = scene.at("creature");
    if (is_of_file(creature)) {
        creature = merge_patches(before, patch.at("creature"));
    } else {
        json whole = json::object();
        whole.merge_patch(creature);  // without nulls
        creature = std::move(whole);
    }
}

/// The data file that a key of a document names. What is wrong with it is told with that key.
json read_named(const std::string& kind, const std::string& name, const Place& key, const std::filesystem::path& data) {
    try {
        return read_data_file(kind, name, data);
    } catch (const InputError& error) {
        fields::refuse(key, error.what());
    }
}

/// What a scene's file holds merged onto the scene that its `base` names, and so on.
json with_bases(const std::string& name, json document, const std::filesystem::path& data, int level) {
    const Place place{"scene " + quoted(name), ""};
    if (!document.is_object()) fields::refuse(place, document, "an object");
    fields::drop_schema_key(document, place);
    if (json* const obstacles = array_in(document, "obstacles"))
        for (json& obstacle : *obstacles) place_mesh(obstacle, name, data);
    place_creature(document, name, data);
    if (json* const companions = array_in(document, "companions"))
        for (json& companion : *companions) place_creature(companion, name, data);
    if (!document.contains("base")) return document;

    const json base = document.at("base");
    document.erase("base");
    if (!base.is_string()) fields::refuse(place.key("base"), base, "the name of a scene");
    if (level == max_bases)
        fields::refuse(place.key("base"), base, "part of a chain of at most 8 scenes without a loop");
    const std::string base_name = relative_to(name, base.get<std::string>());
    json merged = with_bases(base_name, read_named("scenes", base_name, place.key("base"), data), data, level + 1);
    patch_scene(merged, document);
    return merged;
}

/// Of unit and length, and of joints and points, a mesh has one: what the scene gives takes the place of what the file
/// has.
void replace_alternatives(json& of_file, const json& of_scene) {
    for (const json* creature : {static_cast<const json*>(&of_file), &of_scene})
        if (!creature->contains("mesh") || !creature->at("mesh").is_object()) return;
    for (const auto& [given, other] : {std::pair{"unit", "length"}, std::pair{"length", "unit"},
                                       std::pair{"joints", "points"}, std::pair{"points", "joints"}})
        if (fields::has(of_scene.at("mesh"), given) && !of_scene.at("mesh").contains(other))
            of_file["mesh"].erase(other);
}

/// Merges a scene's `creature` onto the file that it is a change of, if it is of any. Of slices, profile and mesh each
/// takes the place of the others that the file may have. `holder`: the scene, or one of its companions.
void resolve_creature(json& holder, const Place& place, const std::filesystem::path& data) {
    if (!holder.contains("creature")) return;
    json& creature = holder.at("creature");
    if (creature.is_string()) fields::refuse(place, creature, "an object, such as {\"name\": " + shown(creature) + "}");
    if (!creature.is_object() || !is_of_file(creature)) return;
    const json name = fields::required(creature, place, "name");
    if (!name.is_string()) fields::refuse(place.key("name"), name, "the name of a creature");
    json merged = read_named("creatures", name.get<std::string>(), place.key("name"), data);
    if (!merged.is_object()) fields::refuse(place.key("name"), merged, "the name of a file that holds an object");
    fields::drop_schema_key(merged, place);
    if (merged.contains("mesh")) place_mesh(merged.at("mesh"), name.get<std::string>(), data);
    for (const char* kind : {"profile", "mesh"}) {
        if (!fields::has(creature, kind) || merged.contains(kind)) continue;
        for (const char* key : {"slices", "joints", "muscleSlices", "profile", "mesh"}) merged.erase(key);
    }
    replace_alternatives(merged, creature);
    merged.merge_patch(creature);
    creature = std::move(merged);
}

/// Adds what tells the file of a mesh from others, so that a definition says all that a simulation depends on.
void add_digest(json& mesh, const Place& place, const std::filesystem::path& data) {
    if (!mesh.is_object() || mesh.contains("digest") || !mesh.contains("file") || !mesh.at("file").is_string()) return;
    mesh["digest"] = fields::mesh_digest(mesh.at("file").get<std::string>(), place.key("file"), data);
}

/// `holder`: the scene, or one of its companions.
void add_mesh_digest(json& holder, const Place& creature, const std::filesystem::path& data) {
    if (!holder.contains("creature") || !holder.at("creature").is_object() || !holder.at("creature").contains("mesh"))
        return;
    add_digest(holder.at("creature").at("mesh"), creature.key("mesh"), data);
}

}  // namespace

json scene_definition(const std::string& name, const json& overrides, const std::filesystem::path& data) {
    const Place place{"scene " + quoted(name), ""};
    if (!overrides.is_object()) fields::refuse(place.key("overrides"), overrides, "an object");
    if (fields::has(overrides, "base"))
        fields::refuse(place.key("overrides").key("base"), overrides.at("base"),
                       "left out: the scene is chosen before it is changed");
    json document = with_bases(name, read_data_file("scenes", name, data), data, 0);
    patch_scene(document, overrides);
    resolve_creature(document, place.key("creature"), data);
    add_mesh_digest(document, place.key("creature"), data);
    if (json* const companions = array_in(document, "companions"))
        for (std::size_t k = 0; k < companions->size(); ++k) {
            json& companion = companions->at(k);
            if (!companion.is_object()) continue;
            const Place at = place.key("companions").item(k).key("creature");
            resolve_creature(companion, at, data);
            add_mesh_digest(companion, at, data);
        }
    if (json* const obstacles = array_in(document, "obstacles"))
        for (std::size_t k = 0; k < obstacles->size(); ++k)
            if (json& one = obstacles->at(k); one.is_object() && one.value("shape", json()) == "mesh")
                add_digest(one, place.key("obstacles").item(k), data);
    return document;
}

Scene load_scene(const std::string& name, const json& overrides, const std::filesystem::path& data) {
    return scene_from_json(scene_definition(name, overrides, data), name, data);
}

Scene load_scene(const std::string& name, const SceneOptions& options) {
    const std::string source = "scene " + quoted(name) + ": overrides";
    return load_scene(name, options.overrides.empty() ? json::object() : parse_json(options.overrides, source),
                      options.data);
}

Scene parse_scene(const std::string& text, const std::string& name) {
    const std::string source = "scene " + quoted(name);
    json document = parse_json(text, source);
    fields::drop_schema_key(document, {source, ""});
    return scene_from_json(document, name);
}

std::vector<std::string> scene_names(const std::filesystem::path& data) {
    return data_file_names("scenes", data);
}

}  // namespace natator
