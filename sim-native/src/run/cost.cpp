#include "natator/cost.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>

#include "base/system.h"
#include "base/text.h"
#include "model/max_iterations.h"
#include "natator/error.h"
#include "natator/limits.h"
#include "solver/cpu/cell_grid.h"
#include "solver/lattice/water.h"

namespace natator {
namespace {

using Grid = cpu::CellGrid<double>;

constexpr double gibibyte = 1024.0 * 1024 * 1024;

/// Bytes of memory that something takes: so many, and so many numbers of the solver's type.
struct Room {
    double bytes, numbers;

    double with(const Computing& computing) const {
        return bytes + numbers * (computing.doubles ? sizeof(double) : sizeof(float));
    }
};
// As measured, with the room that growing arrays leave.
constexpr Room of_program{7e6, 0}, of_particle{150, 48}, of_water_particle{40, 50}, of_ghost{60, 36}, of_contact{24, 1},
    of_spring{80, 4}, of_member{56, 6}, of_cell{28, 0}, of_neighbour{4, 0}, of_water_neighbour{4, 4};
constexpr double growth = 1.5;                      // of a list that gets too short
constexpr Room of_part{5, 0}, of_water_part{5, 1};  // of a list that several threads put together, an entry
constexpr double kept_distances = 1 << 20;          // scheme flex keeps those of so many neighbours at most
constexpr double raggedness = 1.12;                 // of lists of 16 particles, which are all as long as the longest
constexpr double of_bursting = 1.5;                 // the same of those that are denser at the start than at rest
constexpr double max_samples = 4096, max_looks = 2e7;
// In visits of a pair.
constexpr double work_of_lattice_cell = 25, work_of_particle = 4, work_of_cluster = 100, work_of_substep = 1000,
                 work_of_cell = 0.1;

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

/// Of particles in the planes and ends of periodic axes that they are nearer to than `distance`, as scheme `conserving`
/// has them: as if how near one is to a plane did not depend on the others.
double ghosts_at_start(const Model& model, double distance) {
    const double particles = model.particles();
    double with_ghosts = particles;
    for (const Plane& plane : model.planes) {
        double near = 0;
        for (const Eigen::Vector3d& place : model.position) near += plane.distance(place) < distance ? 1 : 0;
        with_ghosts *= 1 + near / particles;
    }
    for (const PeriodicAxis& periodic : model.periodic) {
        double near = 0;
        for (const Eigen::Vector3d& place : model.position) {
            const double at = place[periodic.axis];
            near += (at - periodic.low < distance ? 1 : 0) + (periodic.high - at < distance ? 1 : 0);
        }
        with_ghosts *= 1 + near / particles;
    }
    return with_ghosts - particles;
}

/// Mean over some fluid particles of how many are nearer than a distance, fluid ones or all.
double near_at_start(const Model& model, double distance, const Grid& grid, bool among_all) {
    const auto counts = [&](int i) { return among_all || model.is_fluid(i); };
    std::vector<std::vector<int>> in_cell(grid.cells());
    std::vector<int> asked;
    for (int i = 0; i < model.particles(); ++i) {
        if (!counts(i)) continue;
        const Eigen::Vector3d& x = model.position[i];
        in_cell[grid.cell(x.x(), x.y(), x.z())].push_back(i);
        asked.push_back(i);
    }
    if (asked.empty()) return 0;
    constexpr std::size_t stride = 999'983;  // a prime: samples that are few are not all of one corner
    const double wanted = std::min<double>(static_cast<double>(asked.size()), max_samples);
    double sum = 0, samples = 0, looks = 0;
    for (std::size_t k = 0; samples < wanted && looks < max_looks; k = (k + stride) % asked.size(), ++samples) {
        const Eigen::Vector3d& x = model.position[asked[k]];
        const int cell = grid.cell(x.x(), x.y(), x.z());
        const Grid::Rows rows = grid.rows_around(grid.row(cell));
        const Grid::Range range = grid.range_around(cell);
        for (int row = 0; row < rows.count; ++row)
            for (int c = rows.first_cell[row] + range.first; c <= rows.first_cell[row] + range.last; ++c) {
                for (const int j : in_cell[c])
                    sum += (model.position[j] - x).squaredNorm() < distance * distance && j != asked[k] ? 1 : 0;
                looks += static_cast<double>(in_cell[c].size());
            }
    }
    return sum / samples;
}

/// Number of particles in all cells before each.
using Counts = std::vector<int>;

struct Candidates {
    double fluid = 0;     ///< of fluid particles among fluid particles
    double contacts = 0;  ///< of solid particles among all
    double cells = 0;
    double near = 0;  ///< mean number of particles within the distance of a fluid particle, itself left out
};

Candidates candidates_at_start(const Model& model, double search_distance, bool among_all) {
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
    sum.near = near_at_start(model, search_distance, grid, among_all);
    return sum;
}

/// What a variable of the environment says instead of `usual`.
double from_environment(const char* name, double usual) {
    const char* const text = std::getenv(name);
    if (text == nullptr || *text == '\0') return usual;
    const std::optional<double> value = decimal_number(text);
    if (!value || *value <= 0)
        throw InputError("environment: " + std::string(name) + " = " + quoted(text) +
                         ": must be a decimal number above 0");
    return *value;
}

std::string in_gib(double bytes) {
    return figure_text(bytes / gibibyte) + " GiB";
}

/// In so much time, s, which is called `what`. Throws InputError when they are too many.
double time_steps_of(double time, const Scene& scene, const std::string& what) {
    const double steps = std::round(time / scene.time_step);
    if (!(steps <= limits::time_steps))
        throw InputError(what + " = " + number_text(time) +
                         ": must be at most 10 million time steps of timeStep = " + number_text(scene.time_step));
    return steps;
}

double substeps_of_settling(const Scene& scene) {
    return static_cast<double>(scene.settling.updates) * scene.settling.substeps;
}

}  // namespace

Cost cost_of(const Model& model, const Computing& computing) {
    Cost cost;
    const double particles = model.particles();
    const SolverParameters& p = model.parameters;
    if (model.water_box) {
        const Eigen::Vector3i& cells = model.water_box->cells;
        cost.cells = cells.cast<double>().prod();
        cost.per_substep = work_of_lattice_cell * cost.cells;
        cost.bytes = lattice::Water::bytes_on_cpu(cells, computing.several_threads);
    }
    if (model.position.empty()) return cost;
    const bool water = model.scheme == Scheme::conserving;
    const double support = p.conserving.kernel_support * p.fluid_rest_distance;
    const double reach = water ? support : p.radius;
    const Candidates start = candidates_at_start(model, water ? reach : reach + p.particle_collision_margin, water);
    double fluid = 0;
    for (int i = 0; i < model.particles(); ++i) fluid += water || model.is_fluid(i) ? 1 : 0;

    // Fluid at rest: sqrt(2) particles in a cube of its spacing at most; cells are searched to 20 cubes of the radius.
    const double ratio = p.fluid_rest_distance > 0 ? reach / p.fluid_rest_distance : 0;
    const double per_cube = std::numbers::sqrt2 * ratio * ratio * ratio;
    const double at_rest = 4 * std::numbers::pi / 3 * per_cube;
    double most = p.flex.maxNeighborsPerParticle;
    most = water ? fluid : std::min(most, fluid);
    cost.candidates = std::max(start.fluid, fluid * std::min(20.25 * per_cube, fluid)) + start.contacts;
    const double of_fluid = fluid > 0 ? std::max(start.fluid / fluid / 2, at_rest) : 0;  // half of the cells is near
    const double fluid_neighbours = fluid * std::min(of_fluid, most);
    const double ghosts = water ? ghosts_at_start(model, support) : 0;
    cost.neighbours = fluid_neighbours * (1 + ghosts / particles) + 2 * start.contacts;

    double members = 0;
    for (const Cluster& cluster : model.clusters) members += static_cast<double>(cluster.particles.size());
    const double springs = static_cast<double>(model.springs.size());
    const double of_solids = springs + members + work_of_cluster * static_cast<double>(model.clusters.size());
    const double per_iteration =
        cost.neighbours + (model.scheme == Scheme::flex ? 1 : p.conserving.solid_iterations) * of_solids +
        particles * (work_of_particle + static_cast<double>(model.planes.size())) + work_of_substep;
    cost.per_substep += cost.candidates + 2 * cost.neighbours + max_iterations(model) * per_iteration +
                        work_of_cell * start.cells + work_of_particle * particles + work_of_substep;

    const double resting = water ? at_rest / std::numbers::sqrt2 : at_rest;
    const double listed =
        fluid * std::min(raggedness * resting + of_bursting * std::max(start.near - resting, 0.0), most);
    const auto add = [&](double count, const Room& room) { cost.bytes += count * room.with(computing); };
    add(1, of_program);
    add(particles, of_particle);
    add(springs, of_spring);
    add(members, of_member);
    add(start.cells, of_cell);
    add(2 * start.contacts, of_contact);
    add(growth * listed, water ? of_water_neighbour : of_neighbour);
    if (computing.several_threads) add(listed, water ? of_water_part : of_part);
    if (!water) add(std::min(listed, kept_distances), {0, 1});
    if (water) add(particles, of_water_particle);
    if (water) add(ghosts, of_ghost);
    return cost;
}

Budget Budget::of_user() {
    const double memory = limits::part_of_memory * system::memory_of_machine() / gibibyte;
    return {from_environment("NATATOR_MOST_WORK", limits::work),
            gibibyte * from_environment("NATATOR_MOST_MEMORY", memory)};
}

void check_cost(const Model& model, double substeps, double more_bytes, const std::string& where,
                const Computing& computing) {
    const Cost cost = cost_of(model, computing);
    const Budget budget = Budget::of_user();
    std::string particles =
        std::to_string(model.particles()) + " particles with " + figure_text(cost.neighbours) + " neighbours";
    if (cost.cells > 0) particles += " in " + figure_text(cost.cells) + " cells of water";
    if (cost.neighbours > limits::neighbours)
        throw InputError(where + ": " + particles + ": must be at most " + figure_text(limits::neighbours) +
                         " neighbours together (radius, spacing, maxNeighborsPerParticle)");
    if (cost.bytes + more_bytes > budget.bytes)
        throw InputError(where + ": " + particles + " need about " + in_gib(cost.bytes + more_bytes) +
                         " of memory: must be at most " + in_gib(budget.bytes) + " (NATATOR_MOST_MEMORY)");
    const double work = substeps * cost.per_substep;
    if (work > budget.work)
        throw InputError(where + ": " + particles + " in " + figure_text(substeps) + " substeps of " +
                         std::to_string(model.parameters.iterations) + " iterations are about " + figure_text(work) +
                         " pair visits: must be at most " + figure_text(budget.work) + " (NATATOR_MOST_WORK)");
}

void check_evaluation_cost(const Scene& scene, const Model& model, const Computing& computing) {
    const double frames = time_steps_of(scene.duration, scene, "scene " + quoted(scene.name) + ": duration");
    check_cost(model, substeps_of_settling(scene) + frames * model.parameters.substeps, 2 * sizeof(double) * frames,
               "scene " + quoted(scene.name), computing);
}

void check_live_cost(const Scene& scene, const Model& model, std::optional<double> until, const Computing& computing) {
    const double frames =
        until ? time_steps_of(*until, scene, "scene " + quoted(scene.name) + ": until") : limits::live_frames;
    check_cost(model, substeps_of_settling(scene) + frames * model.parameters.substeps, 0,
               "scene " + quoted(scene.name), computing);
}

}  // namespace natator
