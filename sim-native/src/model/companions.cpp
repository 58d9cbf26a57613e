#include "companions.h"

#include <cmath>
#include <map>
#include <sstream>
#include <tuple>

#include "base/text.h"
#include "natator/error.h"

namespace natator {
namespace {

using Cell = std::tuple<long, long, long>;

/// Names of the bodies and the particles that are theirs: the creature first.
struct NamedBody {
    std::string name;
    const Body* body;
};

std::vector<NamedBody> bodies_of(const Model& model) {
    std::vector<NamedBody> bodies;
    if (!model.body.particles.empty()) bodies.push_back({"creature", &model.body});
    for (std::size_t k = 0; k < model.companions.size(); ++k)
        bodies.push_back({"companions[" + std::to_string(k) + "]", &model.companions[k].body});
    return bodies;
}

[[noreturn]] void refuse(const Scene& scene, const std::string& one, const std::string& other,
                         const Eigen::Vector3d& where) {
    std::ostringstream text;
    text << "scene " << quoted(scene.name) << ": " << one << " overlaps " << other << " at (" << where.x() << ", "
         << where.y() << ", " << where.z() << "): must be apart";
    throw InputError(text.str());
}

}  // namespace

void add_companion(const Model& own, const Gait& gait, Model& model) {
    const int first = model.particles(), springs = static_cast<int>(model.springs.size());
    CompanionBody companion{own.body, gait, model.actuators, springs};
    if (!model.companions.empty()) {
        const CompanionBody& before = model.companions.back();
        companion.first_actuator = before.first_actuator + static_cast<int>(before.gait.amplitude.size());
    }
    const auto group = static_cast<std::uint32_t>(model.companions.size()) + 2;  // the body's is 1
    for (int i = 0; i < own.particles(); ++i) {
        model.position.push_back(own.position[i]);
        model.velocity.push_back(own.velocity[i]);
        model.inverse_mass.push_back(own.inverse_mass[i]);
        model.phase.push_back((own.phase[i] & ~phase::group_mask) | group);
    }
    for (int& particle : companion.body.particles) particle += first;
    for (std::vector<int>& slice : companion.body.slices)
        for (int& particle : slice) particle += first;
    for (Spring spring : own.springs) {
        spring.a += first;
        spring.b += first;
        model.springs.push_back(spring);
    }
    for (Cluster cluster : own.clusters) {
        for (int& particle : cluster.particles) particle += first;
        model.clusters.push_back(std::move(cluster));
    }
    for (Muscle muscle : own.muscles) {
        muscle.spring += springs;
        muscle.actuator += companion.first_actuator;
        model.muscles.push_back(muscle);
    }
    model.companions.push_back(std::move(companion));
}

void check_apart(const Scene& scene, const Model& model) {
    const double near = scene.solver.solid_rest_distance;
    const auto cell_of = [near](const Eigen::Vector3d& x) {
        return Cell{std::lround(std::floor(x.x() / near)), std::lround(std::floor(x.y() / near)),
                    std::lround(std::floor(x.z() / near))};
    };
    std::map<Cell, std::vector<std::pair<int, std::size_t>>> cells;  // particles of earlier bodies, and which body
    const std::vector<NamedBody> bodies = bodies_of(model);
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        for (const int i : bodies[b].body->particles) {
            const Eigen::Vector3d& x = model.position[i];
            for (std::size_t k = 0; k < scene.obstacles.size(); ++k)
                if (scene.obstacles[k].holds(x))
                    refuse(scene, bodies[b].name, "obstacles[" + std::to_string(k) + "]", x);
            if (b == 0) continue;
            const auto [cx, cy, cz] = cell_of(x);
            for (long n = 0; n < 27; ++n) {
                const auto found = cells.find({cx + n % 3 - 1, cy + n / 3 % 3 - 1, cz + n / 9 - 1});
                if (found == cells.end()) continue;
                for (const auto& [other, owner] : found->second)
                    if ((model.position[other] - x).norm() < near) refuse(scene, bodies[b].name, bodies[owner].name, x);
            }
        }
        if (bodies.size() > 1)
            for (const int i : bodies[b].body->particles) cells[cell_of(model.position[i])].push_back({i, b});
    }
}

}  // namespace natator
