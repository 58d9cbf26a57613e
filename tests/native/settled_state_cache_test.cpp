#include "natator/settled_state_cache.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "natator/evaluate.h"
#include "natator/model.h"
#include "scene/scene_json.h"

namespace natator {
namespace {

namespace fs = std::filesystem;

Gait short_swimmer_gait() {
    Gait gait;
    gait.frequency = 1.861;
    gait.amplitude = {0.973, 0.69};
    gait.phase = {0, 0.648};
    return gait;
}

class SettledStateCacheTest : public testing::Test {
protected:
    SettledStateCacheTest()
        : cache_(fs::path(testing::TempDir()) /
                 (std::string("natator-starts-") + testing::UnitTest::GetInstance()->current_test_info()->name())) {
        fs::remove_all(cache_.folder());
    }
    ~SettledStateCacheTest() override { fs::remove_all(cache_.folder()); }

    static Scene scene(const std::string& overrides = "{}") {
        nlohmann::json all = {{"duration", 0.02}, {"settling", {{"updates", 5}}}};
        all.merge_patch(nlohmann::json::parse(overrides));
        return load_scene("bench/small-tank", all);
    }
    std::uint64_t hash(const Scene& scene, const SettledStateCache* starts,
                       Precision precision = Precision::single_precision) {
        return evaluate(scene, short_swimmer_gait(), {.precision = precision, .execution = {.starts = starts}}).hash;
    }
    std::size_t files() const {
        std::size_t count = 0;
        if (fs::exists(cache_.folder()))
            for ([[maybe_unused]] const auto& entry : fs::directory_iterator(cache_.folder())) ++count;
        return count;
    }
    fs::path only_file() const { return fs::directory_iterator(cache_.folder())->path(); }

    SettledStateCache cache_;
};

TEST_F(SettledStateCacheTest, ResultsAreTheSameBitByBitWithAndWithout) {
    for (const char* scheme : {R"({"scheme":"flex"})", R"({"scheme":"conserving"})"}) {
        for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
            const std::uint64_t settled = hash(scene(scheme), nullptr, precision);
            EXPECT_EQ(hash(scene(scheme), &cache_, precision), settled);
            EXPECT_EQ(hash(scene(scheme), &cache_, precision), settled);
        }
    }
    EXPECT_EQ(files(), 4u);
}

TEST_F(SettledStateCacheTest, TheSecondEvaluationReadsWhatTheFirstWrote) {
    const Model model = build_model(scene());
    EXPECT_FALSE(cache_.find<float>(model, scene().settling));
    hash(scene(), &cache_);
    const auto found = cache_.find<float>(model, scene().settling);
    ASSERT_TRUE(found);
    const State<float> bare = initial_state<float>(model);
    EXPECT_EQ(found->position.size(), bare.position.size());
    EXPECT_NE(found->position, bare.position);
    EXPECT_EQ(found->time, 0);
}

TEST_F(SettledStateCacheTest, WhatSettledItMakesAnotherStart) {
    const Model model = build_model(scene());
    cache_.keep(model, scene().settling, initial_state<float>(model), "a GPU");
    EXPECT_FALSE(cache_.find<float>(model, scene().settling));
    EXPECT_FALSE(cache_.find<float>(model, scene().settling, "another GPU"));
    EXPECT_TRUE(cache_.find<float>(model, scene().settling, "a GPU"));
}

TEST_F(SettledStateCacheTest, AnythingThatSettlingDependsOnMakesAnotherStart) {
    hash(scene(), &cache_);
    std::size_t expected = 1;
    for (const char* other : {R"({"solver":{"viscosity":7}})", R"({"solver":{"modifiedPressure":true}})",
                              R"({"solver":{"maxNeighborsPerParticle":95}})", R"({"settling":{"updates":99}})",
                              R"({"creature":{"clusterStiffness":0.3}})", R"({"planes":[[0,1,0,0.001]]})"}) {
        EXPECT_NE(hash(scene(other), &cache_), 0u);
        EXPECT_EQ(files(), ++expected) << other;
    }
}

TEST_F(SettledStateCacheTest, TheWaterOfALatticeMakesAnotherStart) {
    const auto lattice = [](const char* overrides) {
        nlohmann::json all = {
            {"scheme", "lattice"}, {"duration", 0.02}, {"settling", {{"updates", 5}}}, {"fluid", {{"disorder", 0}}}};
        all.merge_patch(nlohmann::json::parse(overrides));
        return load_scene("open-water/creature-2", all);
    };
    const auto of = [](const Scene& scene, const SettledStateCache* starts) {
        const std::vector<double> rest(scene.creature->actuator_list().size());
        return evaluate(scene, {1, rest, rest}, {.execution = {.starts = starts}}).hash;
    };
    of(lattice("{}"), &cache_);
    std::size_t expected = 1;
    for (const char* other : {R"({"fluid":{"mass":{"bottom":0.5}}})", R"({"solver":{"kinematicViscosity":0.01}})"}) {
        EXPECT_EQ(of(lattice(other), &cache_), of(lattice(other), nullptr)) << other;
        EXPECT_EQ(files(), ++expected) << other;
    }
}

TEST_F(SettledStateCacheTest, DamagedFilesAreSettledAnew) {
    const std::uint64_t settled = hash(scene(), &cache_);
    const fs::path file = only_file();
    const auto size = fs::file_size(file);
    for (const std::uintmax_t part : {std::uintmax_t{0}, size / 2, size - 1}) {
        fs::resize_file(file, part);
        EXPECT_EQ(hash(scene(), &cache_), settled) << part;
        EXPECT_EQ(fs::file_size(file), size) << "written anew";
    }
    std::fstream(file, std::ios::in | std::ios::out | std::ios::binary)
        .seekp(static_cast<std::streamoff>(size) - 100)
        .put('x');
    EXPECT_EQ(hash(scene(), &cache_), settled);
}

TEST_F(SettledStateCacheTest, AFolderThatCannotBeMadeChangesNothing) {
    const SettledStateCache nowhere("/dev/null/starts");
    EXPECT_EQ(hash(scene(), &nowhere), hash(scene(), nullptr));
}

TEST_F(SettledStateCacheTest, ShiftedStartsAreNotKept) {
    evaluate(scene(), short_swimmer_gait(), {.perturbation = {1e-4, 3}, .execution = {.starts = &cache_}});
    EXPECT_EQ(files(), 0u);
}

TEST_F(SettledStateCacheTest, TheOldestFilesGiveWay) {
    Model model;
    model.position = {{0, 0, 0}};
    model.velocity = {{0, 0, 0}};
    model.inverse_mass = {1};
    model.phase = {1};
    for (int updates = 1; updates <= SettledStateCache::max_files + 5; ++updates)
        cache_.keep<float>(model, {.updates = updates, .time_step = 1e-4, .substeps = 1}, initial_state<float>(model));
    EXPECT_EQ(files(), static_cast<std::size_t>(SettledStateCache::max_files));
    const Settling last{.updates = SettledStateCache::max_files + 5, .time_step = 1e-4, .substeps = 1};
    EXPECT_TRUE(cache_.find<float>(model, last));
    EXPECT_FALSE(cache_.find<float>(model, {.updates = 1, .time_step = 1e-4, .substeps = 1}));
}

}  // namespace
}  // namespace natator
