// A cube of water falls on a floor and spreads. The scene is made here, and run frame by frame.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "natator/natator.h"

int main() {
    natator::Scene scene;
    scene.scheme = natator::Scheme::conserving;
    scene.solver.damping = 0;
    scene.planes = {{.normal = {0, 1, 0}, .offset = 0}};
    scene.fluid = natator::FluidBlock{.count = {8, 8, 8}, .spacing = 0.1, .origin = {-0.35, 0.5, -0.35}};
    scene.fluid->gradient = natator::MassGradient::uniform;

    const natator::Model model = natator::build_model(scene);
    natator::Solver<float> solver(model);  // refers to the model, which must outlive it
    natator::State<float> state = natator::initial_state<float>(model);

    std::puts("time (s)   height of the centre   radius");
    for (int frame = 0; frame <= 60; ++frame) {
        if (frame > 0) {
            const natator::Gait no_muscles;
            if (const auto bad = solver.frame(state, no_muscles)) {
                std::fprintf(stderr, "falling_drop: unstable at %g s, stage %s\n", bad->time, bad->stage.c_str());
                return 1;
            }
        }
        double height = 0, radius = 0;
        for (const auto& x : state.position) {
            height += x.y() / static_cast<float>(model.particles());
            radius = std::max<double>(radius, std::hypot(x.x(), x.z()));
        }
        if (frame % 6 == 0) std::printf("%8.1f   %20.3f   %6.3f\n", state.time, height, radius);
    }
}
