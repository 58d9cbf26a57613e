#include "model_group.h"

#include "natator/model.h"
#include "run/model_on_gpu.h"

namespace natator::cuda {

int arrangement_of(const BatchMember& member, const Scene& scene) {
    return scene.fluid ? member.arrangement.value_or(scene.fluid->disorder) : 0;
}

namespace {

/// `model`: the scene's own.
Model arranged(Scene scene, const Model& model, int arrangement) {
    if (arrangement == scene.fluid->disorder) return model;
    scene.fluid->disorder = arrangement;
    return build_model(scene);
}

}  // namespace

std::vector<ModelGroup> model_groups(const Scene& scene, const Model& model, const std::vector<BatchMember>& members) {
    std::vector<ModelGroup> all;
    std::map<int, std::size_t> group_of;
    const bool arranges = model.scheme == Scheme::conserving && scene.fluid;
    const int usual = arranges ? FluidBlock{}.disorder : 0;
    all.push_back({arranges ? arranged(scene, model, usual) : model, {}});
    for (std::size_t k = 0; k < members.size(); ++k) {
        const int arrangement = arrangement_of(members[k], scene);
        if (!group_of.contains(arrangement)) {
            const Model own =
                arranges && arrangement != usual ? arranged(scene, model, arrangement) : all.front().model;
            const Model& first = all.front().model;
            const bool alike = differ_in_places_alone(own, first);
            if (!alike) all.push_back({own, {}});
            group_of[arrangement] = alike ? 0 : all.size() - 1;
            all[group_of[arrangement]].begin[arrangement] = own.position;
        }
        ModelGroup& group = all[group_of[arrangement]];
        group.members.push_back(members[k]);
        group.numbers.push_back(k);
    }
    return all;
}

}  // namespace natator::cuda
