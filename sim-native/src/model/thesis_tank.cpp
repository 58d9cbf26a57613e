#include "natator/scene.h"

namespace natator {

Scene thesis_tank() {
    Scene scene;
    scene.name = "thesis/tank";
    scene.scheme = Scheme::flex;
    SolverParameters& p = scene.solver;
    p.conserving.solid_iterations = 1;
    p.solid_rest_distance = 0.15;
    p.dynamic_friction = p.particle_friction = 0.2;
    p.damping = 1;
    scene.planes = {{{0, 1, 0}, 0}, {{0, 0, 1}, 0}, {{1, 0, 0}, 0}, {{-1, 0, 0}, 4.51}, {{0, 0, -1}, 1.54}};
    scene.fluid = FluidBlock{.count = {50, 7, 17},
                             .spacing = 0.09,
                             .gradient = MassGradient::mass_linear,
                             .bottom_mass = 2,
                             .top_mass = 1.0 / 14,
                             .clearance = 0.15};
    return scene;
}

}  // namespace natator
