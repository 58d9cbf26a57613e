#include "natator/model.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/text.h"
#include "body.h"
#include "check_scene.h"
#include "companions.h"
#include "disorder_fluid.h"
#include "fit_to_water.h"
#include "fluid_block.h"
#include "muscles.h"
#include "natator/error.h"
#include "natator/limits.h"
#include "obstacles.h"
#include "periodic.h"
#include "refine_body.h"
#include "water_box.h"

namespace natator {
namespace {

[[noreturn]] void refuse(const Scene& scene, const std::string& what) {
    throw InputError("scene " + quoted(scene.name) + ": " + what);
}

/// What a creature's shape was given by.
std::string shape_key(const Creature& creature) {
    return creature.skin ? "mesh" : creature.of_profile ? "profile" : "slices";
}

/// A number that cannot overflow.
double particles_of(const Creature& creature) {
    double particles = 0;
    for (const Slice& slice : creature.slices)
        for (int iy = 0; iy < slice.height; ++iy) particles += slice.row(iy);
    return particles * std::pow(creature.refinement, 3);
}

/// Checked before anything is allocated.
void check_size(const Scene& scene) {
    double sum = scene.creature ? particles_of(*scene.creature) : 0;
    for (const Companion& companion : scene.companions) sum += particles_of(companion.creature);
    for (std::size_t k = 0; k < scene.obstacles.size(); ++k) {
        const double most = max_particles(scene.obstacles[k]);
        if (most > limits::particles)
            refuse(scene, "obstacles[" + std::to_string(k) + "]: up to " + number_text(most) +
                              " particles: must be at most " + std::to_string(limits::particles));
        sum += most;
    }
    if (scene.fluid && scene.scheme != Scheme::lattice) sum += scene.fluid->count.cast<double>().prod();
    constexpr double countable = 1e18;  // of what a program asks for; files are held to less
    const auto particles = static_cast<std::int64_t>(std::min(sum, countable));
    const std::string body = scene.creature ? shape_key(*scene.creature) : "slices";
    std::string parts = "creature." + body;
    if (!scene.companions.empty()) parts += ", companions";
    if (!scene.obstacles.empty()) parts += ", obstacles";
    const bool two = scene.companions.empty() && scene.obstacles.empty();
    const std::string found =
        std::to_string(particles) + " particles (fluid.count" + (two ? " and " : ", ") + parts + " together)";
    if (particles == 0 && !(scene.fluid && scene.scheme == Scheme::lattice))
        refuse(scene, "0 particles: needs a creature or fluid");
    if (particles > limits::particles) refuse(scene, found + ": must be at most " + std::to_string(limits::particles));
}

/// Springs that the muscles may have, see muscles.h: those of the smaller slice of each actuator.
void check_springs(const Scene& scene, const Creature& creature, const std::string& place) {
    if (creature.regions) {
        const auto fibres = static_cast<std::int64_t>(creature.regions->fibres.size());
        const std::int64_t springs = fibres * creature.springs_per_particle * creature.parts();
        if (springs > limits::springs)
            refuse(scene, std::to_string(springs) + " springs (" + place + ".mesh.points and springsPerParticle " +
                              "together): must be at most " + std::to_string(limits::springs));
        return;
    }
    const std::vector<int>& ends = creature.muscle_ends();
    const auto size = [&](int slice) { return std::int64_t{creature.slices[slice].particles()}; };
    std::int64_t springs = 0;
    for (const Actuator& one : creature.actuator_list())
        springs +=
            std::min(size(ends[one.gap]), size(ends[one.gap + 1])) * creature.springs_per_particle * creature.parts();
    if (springs > limits::springs)
        refuse(scene, std::to_string(springs) + " springs (" + place +
                          ".slices, joints and springsPerParticle together): " + "must be at most " +
                          std::to_string(limits::springs));
}

/// Lattice points that are looked at around the body's particles, see fluid_block.cpp.
void check_clearance(const Scene& scene, int body_particles) {
    const FluidBlock& fluid = *scene.fluid;
    const double across = 2 * fluid.clearance / fluid.spacing + 3;
    double points = body_particles;
    for (const int count : fluid.count) points *= std::min<double>(count, across);
    if (points > limits::clearance_points)
        refuse(scene, "fluid.clearance = " + nlohmann::json(fluid.clearance).dump() + ": " +
                          nlohmann::json(points).dump() +
                          " lattice points to be looked at around the body; must be at most " +
                          nlohmann::json(limits::clearance_points).dump());
}

void check_muscles(const Scene& scene, const Creature& creature, const std::string& place, const Model& model) {
    if (creature.regions) return;  // which have no actuator without
    std::vector<int> count(static_cast<std::size_t>(model.actuators));
    for (const Muscle& muscle : model.muscles) ++count[muscle.actuator];
    const std::vector<Actuator> actuators = creature.actuator_list();
    for (int i = 0; i < model.actuators; ++i) {
        if (count[i] > 0) continue;
        const auto [gap, bend] = actuators[static_cast<std::size_t>(i)];
        const std::vector<int>& ends = creature.muscle_ends();
        const std::string shape = shape_key(creature);
        const bool by_part = shape != "slices";  // joints are given in parts of the length
        std::ostringstream text;
        text << place
             << (!creature.muscle_slices.empty() ? ".muscleSlices["
                 : by_part                       ? "." + shape + ".joints["
                                                 : ".joints[")
             << gap << "], [" << gap + 1 << "] = " << (by_part ? "slices " : "") << ends[gap] << ", " << ends[gap + 1]
             << ": no muscle " << (bend == Bend::vertical ? "that bends up and down " : "")
             << "fits between these slices (actuator " << i << "); both must be at least 2 "
             << (bend == Bend::vertical ? "high" : "wide") << " and the slices between them not thinner";
        refuse(scene, text.str());
    }
}

/// What sets where a particle begins.
std::string place_of(const Model& model, int particle) {
    if (model.is_fluid(particle)) return "fluid.origin";
    if (particle < static_cast<int>(model.body.particles.size())) return "creature.rearCentre";
    for (std::size_t k = 0; k < model.companions.size(); ++k)
        if (particle <= model.companions[k].body.particles.back())
            return "companions[" + std::to_string(k) + "].creature.rearCentre";
    return "obstacles";
}

/// Each reaches into the water of scheme `lattice`, which has no other.
void check_obstacles_in_water(const Scene& scene, const Model& model) {
    const WaterBox& box = *model.water_box;
    const Eigen::AlignedBox3d water(box.corner, box.corner + box.cell * box.cells.cast<double>());
    auto end = model.position.rbegin();
    for (std::size_t k = box.obstacles.size(); k-- > 0;) {
        const auto begin = end;
        end += box.obstacles[k].particles;
        if (begin == end ||
            std::any_of(begin, end, [&](const Eigen::Vector3d& place) { return water.contains(place); }))
            continue;
        refuse(scene, "obstacles[" + std::to_string(k) + "] is outside the water; must reach into it");
    }
}

void check_inside_tank(const Scene& scene, const Model& model) {
    constexpr double rounding = 1e-12;  // what stands on a wall may be behind it by so much
    for (int i = 0; i < model.particles(); ++i) {
        for (std::size_t k = 0; k < model.planes.size(); ++k) {
            const Eigen::Vector3d& p = model.position[i];
            const double distance = model.planes[k].distance(p);
            if (distance >= -rounding * (1 + p.norm())) continue;
            std::ostringstream text;
            text << place_of(model, i) << ": particle at (" << p.x() << ", " << p.y() << ", " << p.z()
                 << ") is outside the tank, " << -distance << " beyond planes[" << k << "]; must be inside all planes";
            refuse(scene, text.str());
        }
    }
}

/// What a model has of its scene before there is a particle.
Model empty_model(const Scene& scene) {
    Model model;
    model.scheme = scene.scheme;
    model.parameters = scene.solver;
    model.time_step = scene.time_step;
    model.planes = scene.planes;
    model.periodic = scene.periodic;
    return model;
}

/// A creature alone: its particles, clusters and muscles.
Model model_of(const Scene& scene, const Creature& creature, const std::string& place) {
    check_springs(scene, creature, place);
    Model model = empty_model(scene);
    const BodyLayout layout(creature);
    add_body(creature, layout, model);
    add_muscles(creature, layout, model);
    check_muscles(scene, creature, place, model);
    refine_body(creature, is_plane_flow(scene), model);
    return model;
}

}  // namespace

Model build_model(const Scene& scene) {
    check_scene(scene);
    check_size(scene);
    Model model = scene.creature ? model_of(scene, *scene.creature, "creature") : empty_model(scene);
    for (std::size_t k = 0; k < scene.companions.size(); ++k) {
        const Companion& companion = scene.companions[k];
        const std::string place = "companions[" + std::to_string(k) + "]";
        try {
            check_gait(companion.gait, companion.creature.actuators());
        } catch (const InputError& error) {
            refuse(scene, place + "." + error.what());
        }
        add_companion(model_of(scene, companion.creature, place + ".creature"), companion.gait, model);
    }
    check_apart(scene, model);
    if (scene.scheme == Scheme::lattice && scene.fluid) {
        model.water_box = water_box(scene);
        const Eigen::Vector3d offset = offset_in_cells(scene);
        for (Eigen::Vector3d& position : model.position) position += offset;
        for (Cluster& cluster : model.clusters) cluster.centre += offset;
    }
    const std::vector<int> of_obstacles = add_obstacles(scene.obstacles, model);
    if (model.water_box) {
        for (std::size_t k = 0; k < of_obstacles.size(); ++k)
            model.water_box->obstacles.push_back({scene.obstacles[k], of_obstacles[k]});
        check_obstacles_in_water(scene, model);
    } else if (scene.fluid) {
        if (!scene.fluid->current.isZero(0))
            refuse(scene, "fluid.current: must be [0, 0, 0] in schemes flex and conserving; lattice has a current");
        if (scene.fluid->smagorinsky != 0)
            refuse(scene, "fluid.smagorinsky: must be 0 in schemes flex and conserving; lattice adds eddies");
        check_clearance(scene, model.particles());
        add_fluid(*scene.fluid, model);
    }
    check_inside_tank(scene, model);
    check_periodic(scene, model);
    if (scene.scheme == Scheme::conserving && scene.fluid) {
        disorder_fluid(std::min(scene.fluid->spacing, scene.solver.fluid_rest_distance), model, scene.fluid->disorder);
        fit_to_water(model);
    }
    return model;
}

}  // namespace natator
