// Evaluates a scene with a cache of settled starts in the folder that is named, and says how many are in it.
#include <cstdio>

#include "natator/natator.h"

int main(int, char** arguments) {
    const natator::SettledStateCache starts(arguments[1]);
    const natator::Scene scene = natator::load_scene(
        "bench/small-tank",
        {.overrides = R"({"duration": 0.02, "settling": {"updates": 2}})", .data = NATATOR_DATA_FOLDER});
    natator::evaluate(scene, natator::resting_gait(scene.creature->actuators()), {.execution = {.starts = &starts}});
    int kept = 0;
    if (std::filesystem::exists(starts.folder()))
        for ([[maybe_unused]] const auto& file : std::filesystem::directory_iterator(starts.folder())) ++kept;
    std::printf("kept: %d\n", kept);
}
