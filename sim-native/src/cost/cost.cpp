#include "natator/cost.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <optional>

#include "io/decimal_number.h"
#include "io/strict_json.h"
#include "natator/error.h"
#include "natator/limits.h"
#include "solver/cpu/cell_grid.h"

namespace natator {
namespace {

using Grid = cpu::CellGrid<double>;

constexpr double gibibyte = 1024.0 * 1024 * 1024;

// Bytes, with the larger type of numbers and the room that growing arrays leave.
constexpr double bytes_of_particle = 500, bytes_of_neighbour = 16, bytes_of_contact = 32, bytes_of_spring = 100,
                 bytes_of_member = 80, bytes_of_cell = 16, bytes_of_image = 200, bytes_of_gradient = 32;
// In visits of a pair.
constexpr double work_of_particle = 4, work_of_cluster = 100, work_of_substep = 1000, work_of_cell = 0.1;

/// The solver's grid over the start, see Substep::sort_into_cells.
Grid grid_over(const Model& model, double search_distance) {
    Eigen::Array3d low = model.position.front(), high = low;
    for (const Eigen::Vector3d& place : model.position) {
        low = low.min(place.array());
        high = high.max(place.array());
    }
    Grid grid;
    grid.cover({low.x(), low.y(), low.z()}, {high.x(), high.y(), high.z()}, search_distance,
               4096 + 16 * model.particles());
    return grid;
}

/// Of particles in the planes and ends of periodic axes that they are nearer to than `distance`, as scheme `conserving` has
/// them: as if how near one is to a plane did not depend on the others.
double images_at_start(const Model& model, double distance) {
    const double particles = model.particles();
    double with_images = particles;
    for (const Plane& plane : model.planes) {
        double near = 0;
        for (const Eigen::Vector3d& place : model.position) near += plane.distance(place) < distance ? 1 : 0;
        with_images *= 1 + near / particles;
    }
    for (const PeriodicAxis& periodic : model.periodic) {
        double near = 0;
        for (const Eigen::Vector3d& place : model.position) {
            const double at = place[periodic.axis];
            near += (at - periodic.low < distance ? 1 : 0) + (periodic.high - at < distance ? 1 : 0);
        }
        with_images *= 1 + near / particles;
    }
    return with_images - particles;
}

/// Number of particles in all cells before each.
using Counts = std::vector<int>;

struct Candidates {
    double fluid = 0;     ///< of fluid particles among fluid particles
    double contacts = 0;  ///< of solid particles among all
    double cells = 0;
};

Candidates candidates_at_start(const Model& model, double search_distance) {
    const Grid grid = grid_over(model, search_distance);
    Counts fluid(static_cast<std::size_t>(grid.cells()) + 1), solid = fluid;
    const auto cell_of = [&](int i) {
        const Eigen::Vector3d& place = model.position[i];
        return grid.cell(place.x(), place.y(), place.z());
    };
    for (int i = 0; i < model.particles(); ++i) ++(model.is_fluid(i) ? fluid : solid)[cell_of(i) + 1];
    for (std::size_t cell = 1; cell < fluid.size(); ++cell) {
        fluid[cell] += fluid[cell - 1];
        solid[cell] += solid[cell - 1];
    }
    Candidates sum;
    sum.cells = grid.cells();
    for (int cell = 0; cell < grid.cells(); ++cell) {
        const int fluid_here = fluid[cell + 1] - fluid[cell], solid_here = solid[cell + 1] - solid[cell];
        if (fluid_here + solid_here == 0) continue;
        const Grid::Rows rows = grid.rows_around(grid.row(cell));
        const Grid::Range range = grid.range_around(cell);
        double fluid_near = 0, solid_near = 0;
        for (int k = 0; k < rows.count; ++k) {
            const int first = rows.first_cell[k] + range.first, end = rows.first_cell[k] + range.last + 1;
            fluid_near += fluid[end] - fluid[first];
            solid_near += solid[end] - solid[first];
        }
        sum.fluid += fluid_here * fluid_near;
        sum.contacts += solid_here * (fluid_near + solid_near);
    }
    return sum;
}

/// What a variable of the environment says instead of `usual`.
double from_environment(const char* name, double usual) {
    const char* const text = std::getenv(name);
    if (text == nullptr || *text == '\0') return usual;
    const std::optional<double> value = decimal_number(text);
    if (!value || *value <= 0)
        throw InputError("environment: " + std::string(name) + " = " + quoted(text) + ": must be a decimal number above 0");
    return *value;
}

double memory_of_machine() {
    const double pages = static_cast<double>(sysconf(_SC_PHYS_PAGES)), page = static_cast<double>(sysconf(_SC_PAGESIZE));
    return pages > 0 && page > 0 ? pages * page : std::numeric_limits<double>::max();
}

std::string in_gib(double bytes) {
    return figure_text(bytes / gibibyte) + " GiB";
}

double substeps_of_settling(const Scene& scene) {
    return static_cast<double>(scene.settling.updates) * scene.settling.substeps;
}

}  // namespace

Cost cost_of(const Model& model) {
    Cost cost;
    const double particles = model.particles();
    const SolverParameters& p = model.parameters;
    if (model.position.empty()) return cost;
    const bool water = model.scheme == Scheme::conserving;
    const double support = p.kernelSupport * p.fluidRestDistance;
    const double reach = water ? support : p.radius;
    const Candidates start = candidates_at_start(model, water ? reach : reach + p.particleCollisionMargin);
    double fluid = 0;
    for (int i = 0; i < model.particles(); ++i) fluid += water || model.is_fluid(i) ? 1 : 0;

    // Fluid at rest: sqrt(2) particles in a cube of its spacing at most; cells are searched to 20 cubes of the radius.
    const double ratio = p.fluidRestDistance > 0 ? reach / p.fluidRestDistance : 0;
    const double per_cube = std::numbers::sqrt2 * ratio * ratio * ratio;
    const double at_rest = 4 * std::numbers::pi / 3 * per_cube;
    double most = p.maxNeighborsPerParticle;
    most = water ? fluid : std::min(most, fluid);
    cost.candidates = std::max(start.fluid, fluid * std::min(20.25 * per_cube, fluid)) + start.contacts;
    const double of_fluid = fluid > 0 ? std::max(start.fluid / fluid / 2, at_rest) : 0;  // half of the cells is near
    const double fluid_neighbours = fluid * std::min(of_fluid, most);
    const double images = water ? images_at_start(model, support) : 0;
    cost.neighbours = fluid_neighbours * (1 + images / particles) + 2 * start.contacts;

    double members = 0;
    for (const Cluster& cluster : model.clusters) members += static_cast<double>(cluster.particles.size());
    const double springs = static_cast<double>(model.springs.size());
    const double of_solids = springs + members + work_of_cluster * static_cast<double>(model.clusters.size());
    const double per_iteration = cost.neighbours + (water ? p.solidIterations : 1) * of_solids +
                                 particles * (work_of_particle + static_cast<double>(model.planes.size())) +
                                 work_of_substep;
    cost.per_substep = cost.candidates + 2 * cost.neighbours + p.numIterations * per_iteration + work_of_cell * start.cells +
                       work_of_particle * particles + work_of_substep;
    cost.bytes = bytes_of_particle * particles + bytes_of_neighbour * fluid_neighbours +
                 bytes_of_contact * 2 * start.contacts + bytes_of_spring * springs + bytes_of_member * members +
                 bytes_of_cell * start.cells;
    if (water) cost.bytes += bytes_of_image * images + bytes_of_gradient * cost.neighbours;
    return cost;
}

Budget Budget::of_user() {
    const double memory = limits::part_of_memory * memory_of_machine() / gibibyte;
    return {from_environment("NATATOR_MOST_WORK", limits::work),
            gibibyte * from_environment("NATATOR_MOST_MEMORY", memory)};
}

void check_cost(const Model& model, double substeps, double more_bytes, const std::string& where) {
    const Cost cost = cost_of(model);
    const Budget budget = Budget::of_user();
    const std::string particles =
        std::to_string(model.particles()) + " particles with " + figure_text(cost.neighbours) + " neighbours";
    if (cost.neighbours > limits::neighbours)
        throw InputError(where + ": " + particles + ": must be at most " + figure_text(limits::neighbours) +
                         " neighbours together (radius, spacing, maxNeighborsPerParticle)");
    if (cost.bytes + more_bytes > budget.bytes)
        throw InputError(where + ": " + particles + " need about " + in_gib(cost.bytes + more_bytes) +
                         " of memory: must be at most " + in_gib(budget.bytes) + " (NATATOR_MOST_MEMORY)");
    const double work = substeps * cost.per_substep;
    if (work > budget.work)
        throw InputError(where + ": " + particles + " in " + figure_text(substeps) + " substeps of " +
                         std::to_string(model.parameters.numIterations) + " iterations are about " + figure_text(work) +
                         " pair visits: must be at most " + figure_text(budget.work) + " (NATATOR_MOST_WORK)");
}

void check_evaluation_cost(const Scene& scene, const Model& model) {
    const double frames = std::round(scene.duration / scene.time_step);
    check_cost(model, substeps_of_settling(scene) + frames * model.parameters.substeps, 2 * sizeof(double) * frames,
               "scene " + quoted(scene.name));
}

void check_live_cost(const Scene& scene, const Model& model) {
    check_cost(model, substeps_of_settling(scene) + limits::live_frames * model.parameters.substeps, 0,
               "scene " + quoted(scene.name));
}

}  // namespace natator
