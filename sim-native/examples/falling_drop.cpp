// A cube of water falls on a floor and spreads. The scene is made here, and run frame by frame.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "natator/natator.h"

int main() {
    natator::Scene scene;
    scene.planes = {{.normal = {0, 1, 0}, .offset = 0}};
    scene.fluid = natator::FluidBlock{.count = {8, 8, 8}, .origin = {-0.35, 0.5, -0.35}};
    natator::Simulation drop(scene);

    std::puts("time (s)   height of the centre   radius");
    for (;;) {
        double height = 0, radius = 0;
        for (const auto& x : drop.state().position) {
            height += x.y() / static_cast<float>(drop.model().particles());
            radius = std::max<double>(radius, std::hypot(x.x(), x.z()));
        }
        if (drop.frames() % 6 == 0) std::printf("%8.1f   %20.3f   %6.3f\n", drop.time(), height, radius);
        if (drop.frames() == 60) return 0;
        if (!drop.step()) {
            std::fprintf(stderr, "falling_drop: unstable: %s\n", sentence_of(*drop.instability()).c_str());
            return 1;
        }
    }
}
