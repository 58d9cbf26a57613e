#include <exception>

#include "natator/batch.h"
#include "natator/cost.h"
#include "natator/error.h"
#include "natator/model.h"

namespace natator {
namespace {

using Indices = std::vector<std::size_t>;

/// Evaluates the chosen members together. What is wrong with one of them is known already, so an InputError is about
/// the scene or the device, and all have it. After any other failure halves are tried: memory may do for them.
void evaluate_chosen(const std::vector<BatchMember>& members, const Indices& chosen, const EvaluateTogether& together,
                     std::vector<MemberResult>& results) {
    if (chosen.empty()) return;
    std::vector<BatchMember> group;
    for (const std::size_t k : chosen) group.push_back(members[k]);
    const auto all_fail = [&](const std::exception& error) {
        for (const std::size_t k : chosen) results[k] = message_of(error);
    };
    try {
        const std::vector<Evaluation> evaluations = together(group);
        for (std::size_t i = 0; i < chosen.size(); ++i) results[chosen[i]] = evaluations.at(i);
        return;
    } catch (const InputError& error) {
        return all_fail(error);
    } catch (const NoDevice& error) {
        return all_fail(error);
    } catch (const std::exception& error) {
        if (chosen.size() == 1) return all_fail(error);
    }
    const auto middle = chosen.begin() + static_cast<std::ptrdiff_t>(chosen.size() / 2);
    evaluate_chosen(members, {chosen.begin(), middle}, together, results);
    evaluate_chosen(members, {middle, chosen.end()}, together, results);
}

}  // namespace

std::vector<MemberResult> evaluate_members(const Scene& scene, const std::vector<BatchMember>& members,
                                           const EvaluateTogether& together) {
    std::vector<MemberResult> results(members.size());
    Indices good;
    for (std::size_t k = 0; k < members.size(); ++k) {
        try {
            check_gait(members[k].gait, scene.creature ? scene.creature->actuators() : 0);
            good.push_back(k);
        } catch (const InputError& error) {
            results[k] = error.what();
        }
    }
    if (good.empty()) return results;
    try {
        check_evaluation_cost(scene, build_model(scene));
    } catch (const std::exception& error) {
        for (const std::size_t k : good) results[k] = message_of(error);
        return results;
    }
    evaluate_chosen(members, good, together, results);
    return results;
}

}  // namespace natator
