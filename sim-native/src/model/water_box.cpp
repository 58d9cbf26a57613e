#include "water_box.h"

#include <cmath>
#include <cstdint>
#include <random>
#include <string>

#include "base/text.h"
#include "natator/error.h"
#include "tank_ends.h"

namespace natator {
namespace {

[[noreturn]] void refuse_lattice(const Scene& scene, const std::string& what) {
    throw InputError("scene " + quoted(scene.name) + ": scheme lattice: " + what);
}

/// Puts a wall where the plane stands.
void add_wall(const Scene& scene, std::size_t plane, WaterBox& box) {
    constexpr double slant = 1e-3, tolerance = 0.01;  // of a right angle, of a cell
    const Eigen::Vector3d& normal = scene.planes[plane].normal;
    const std::string place = "planes[" + std::to_string(plane) + "]";
    int axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    const int end = normal[axis] > 0 ? 0 : 1;
    if (std::abs(normal[axis]) < 1 - slant) refuse_lattice(scene, place + ": must stand square across an axis");
    const double stands = -scene.planes[plane].offset / normal[axis];
    const double at = box.corner[axis] + end * box.cells[axis] * box.cell;
    if (std::abs(stands - at) > tolerance * box.cell)
        refuse_lattice(scene, place + " stands at " + number_text(stands) + ": must be at the fluid's end, " +
                                  number_text(at) + " (half a spacing from its last lattice points)");
    box.faces[axis][end] = WaterFace::no_slip;
}

/// In a substep stress goes to neighbouring cells alone.
void check_viscosity(const Scene& scene) {
    const double h = scene.time_step / scene.solver.substeps, most = scene.fluid->spacing * scene.fluid->spacing / h;
    if (scene.solver.conserving.kinematic_viscosity > most)
        refuse_lattice(scene, "solver.kinematicViscosity = " +
                                  number_text(scene.solver.conserving.kinematic_viscosity) + ": must be at most " +
                                  computed_text(most) + " (fluid.spacing^2 / substep), or solver.substeps more");
}

/// Opens the ends that the current crosses.
void add_current(const Scene& scene, WaterBox& box) {
    constexpr double max_cells_per_substep = 0.15;  // beside obstacles it goes twice as fast
    box.current = scene.fluid->current;
    const double cells = box.current.norm() * scene.time_step / scene.solver.substeps / box.cell;
    if (cells > max_cells_per_substep)
        refuse_lattice(scene, "fluid.current goes " + figure_text(cells) + " cells in a substep: must be at most " +
                                  number_text(max_cells_per_substep) + ", by more solver.substeps");
    for (int a = 0; a < 3; ++a) {
        if (box.current[a] == 0 || box.faces[a][0] == WaterFace::periodic) continue;
        for (WaterFace& face : box.faces[a]) {
            if (face == WaterFace::no_slip)
                refuse_lattice(scene, "fluid.current[" + std::to_string(a) + "] = " + number_text(box.current[a]) +
                                          ": must be 0 towards a plane, or the planes across it left out");
            face = WaterFace::open;
        }
    }
}

/// Of something in plane flow.
void check_middle(const Scene& scene, const std::string& place, const Eigen::Vector3d& at) {
    const double middle = scene.fluid->origin.y();
    if (std::abs(at.y() - middle) > 0.01 * scene.fluid->spacing)
        refuse_lattice(scene, place + "[1] = " + number_text(at.y()) + ": must be " + number_text(middle) +
                                  ", the middle (fluid.origin) of water that is one cell deep");
}

void check_plane_body(const Scene& scene, const std::string& place, const Creature& creature) {
    for (std::size_t i = 0; i < creature.slices.size(); ++i)
        if (const Slice& slice = creature.slices[i]; slice.height != 1 || slice.lift != 0)
            refuse_lattice(scene, place + ".slices[" + std::to_string(i) + "].height = " +
                                      std::to_string(slice.height) + ": must be 1 in water that is one cell deep");
    check_middle(scene, place + ".rearCentre", creature.rear_centre);
}

void check_obstacle(const Scene& scene, const std::string& place, const Obstacle& obstacle) {
    const double cell = scene.fluid->spacing;
    const bool plane = is_plane_flow(scene);
    if (plane) check_middle(scene, place + ".centre", obstacle.centre);
    const auto check = [&](const std::string& key, double extent, double least) {
        if (extent < least)
            refuse_lattice(scene, place + "." + key + " = " + number_text(extent) + ": must be at least " +
                                      number_text(least) + ", so that it is a cell (fluid.spacing) across");
    };
    if (obstacle.shape == Obstacle::Shape::sphere) check("radius", obstacle.radius, cell / 2);
    if (obstacle.shape == Obstacle::Shape::box)
        for (const int a : {0, 1, 2})
            if (a != 1 || !plane) check("size[" + std::to_string(a) + "]", obstacle.size[a], cell);
}

}  // namespace

WaterBox water_box(const Scene& scene) {
    const FluidBlock& fluid = *scene.fluid;
    if (fluid.gradient != MassGradient::uniform) refuse_lattice(scene, "fluid.mass.gradient: must be uniform");
    if (!(scene.solver.conserving.kinematic_viscosity > 0))
        refuse_lattice(scene, "solver.kinematicViscosity = " +
                                  number_text(scene.solver.conserving.kinematic_viscosity) + ": must be above 0");
    check_viscosity(scene);
    WaterBox box;
    box.cells = fluid.count;
    box.cell = fluid.spacing;
    box.corner = fluid.origin - Eigen::Vector3d::Constant(fluid.spacing / 2);
    box.viscosity = scene.solver.conserving.kinematic_viscosity;
    box.smagorinsky = fluid.smagorinsky;
    box.density = fluid.bottom_mass / std::pow(fluid.spacing, 3);
    for (auto& ends : box.faces) ends[0] = ends[1] = WaterFace::free_slip;
    for (std::size_t k = 0; k < scene.planes.size(); ++k) add_wall(scene, k, box);
    for (const PeriodicAxis& periodic : scene.periodic) {
        const double low = box.corner[periodic.axis], length = box.cells[periodic.axis] * box.cell;
        if (std::abs(periodic.low - low) > 0.01 * box.cell || std::abs(periodic.length() - length) > 0.01 * box.cell)
            refuse_lattice(scene, "periodic: must be from " + number_text(low) + " to " + number_text(low + length) +
                                      ", as the fluid is");
        box.faces[periodic.axis][0] = box.faces[periodic.axis][1] = WaterFace::periodic;
    }
    if (is_plane_flow(scene)) {
        box.faces[1][0] = box.faces[1][1] = WaterFace::periodic;
        if (const double gravity = scene.solver.gravity.y(); gravity != 0)
            refuse_lattice(
                scene, "solver.gravity[1] = " + number_text(gravity) + ": must be 0 in water that is one cell deep");
        if (scene.creature) check_plane_body(scene, "creature", *scene.creature);
        for (std::size_t k = 0; k < scene.companions.size(); ++k)
            check_plane_body(scene, "companions[" + std::to_string(k) + "].creature", scene.companions[k].creature);
    }
    for (std::size_t k = 0; k < scene.obstacles.size(); ++k)
        check_obstacle(scene, "obstacles[" + std::to_string(k) + "]", scene.obstacles[k]);
    add_current(scene, box);
    return box;
}

bool is_plane_flow(const Scene& scene) {
    return scene.scheme == Scheme::lattice && scene.fluid && scene.fluid->count.y() == 1 &&
           tank_ends(scene.planes, 1).none();
}

Eigen::Vector3d offset_in_cells(const Scene& scene) {
    Eigen::Vector3d offset = Eigen::Vector3d::Zero();
    if (scene.fluid->disorder == 0) return offset;
    std::mt19937_64 random(static_cast<std::uint64_t>(scene.fluid->disorder));
    for (double& part : offset) part = scene.fluid->spacing * (static_cast<double>(random() >> 11) * 0x1p-53 - 0.5);
    if (is_plane_flow(scene)) offset.y() = 0;
    return offset;
}

}  // namespace natator
