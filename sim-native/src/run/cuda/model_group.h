#pragma once

#include <map>
#include <vector>

#include "natator/batch.h"
#include "natator/model.h"

namespace natator::cuda {

/// Members whose Models differ in nothing but where their water begins.
struct ModelGroup {
    Model model;                                        ///< what the device knows of all of them
    std::map<int, std::vector<Eigen::Vector3d>> begin;  ///< places of the particles, by arrangement
    std::vector<BatchMember> members{};
    std::vector<std::size_t> numbers{};  ///< of the members among all
};

/// Of the member's water.
int arrangement_of(const BatchMember& member, const Scene& scene);

/// Where nothing but the water's places depends on its arrangement, the device gets the Model of the usual one whatever
/// the members', so that a member's bits do not depend on its group. An arrangement that asks for more substeps, say,
/// stays alone.
std::vector<ModelGroup> model_groups(const Scene& scene, const Model& model, const std::vector<BatchMember>& members);

}  // namespace natator::cuda
