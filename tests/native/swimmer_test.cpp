// Bodies of imposed motion: how they bend, how they move by the forces on them, and their files.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "natator/error.h"
#include "refusal_of.h"
#include "water/lattice_swim.h"
#include "water/swimmer_study.h"

namespace natator::bench {
namespace {

using Places = std::vector<Eigen::Vector3d>;

constexpr double length = 2, thinnest = 0.05;

Swimmer swimmer(const std::string& name, const std::string& variant = "") {
    const SwimCase one = read_swim_case(name);
    for (const auto& [found, body] : one.variants)
        if (found == variant) return body;
    return one.base;
}

/// Of the straight body.
Places midline(int parts = 100) {
    Places places;
    for (int k = 0; k <= parts; ++k) places.emplace_back(-length * k / parts, 0, 0);
    return places;
}

Places body(const Swimmer& of) {
    Places places;
    for (double x = -length; x <= 0; x += 0.1)
        for (double y = -0.2; y <= 0.2; y += 0.1)
            for (double z = -0.2; z <= 0.2; z += 0.1)
                if (of.holds({x, y, z}, length, thinnest)) places.emplace_back(x, y, z);
    return places;
}

/// The smallest file that can be read.
nlohmann::json plain() {
    return nlohmann::json::parse(R"({"source": "a test", "outline": [[0, 0.05, 0.1], [1, 0.05, 0.1]], "viscosity": 0.01,
        "midline": {"by": "displacement", "amplitude": [0.1], "waves": 1}})");
}

TEST(Swimmer, IsAsItsOutlineSays) {
    const Swimmer larva = swimmer("larva");
    const auto half_width = [&](double x) {
        double z = 0;
        while (larva.holds({x, 0, z + 0.001}, length, thinnest)) z += 0.001;
        return z;
    };
    EXPECT_NEAR(half_width(-0.3), 0.13, 0.01);
    EXPECT_NEAR(half_width(-1.99), 0.06, 0.01);
    EXPECT_FALSE(larva.holds({0.01, 0, 0}, length, thinnest));
    EXPECT_FALSE(larva.holds({-2.01, 0, 0}, length, thinnest));
    EXPECT_FALSE(larva.holds({-1, 0.16, 0}, length, thinnest));
    EXPECT_TRUE(swimmer("eel-2d").holds({-1, 7, 0}, length, thinnest)) << "a slab spans the box";
    EXPECT_TRUE(larva.holds({-1.99, 0, 0.19}, length, 0.2)) << "not thinner than that";
}

TEST(Swimmer, SquareSectionsHaveCorners) {
    nlohmann::json document = plain();
    EXPECT_FALSE(swim_case_from_json(document, "file").base.holds({-1, 0.19, 0.09}, length, thinnest));
    document["square"] = true;
    EXPECT_TRUE(swim_case_from_json(document, "file").base.holds({-1, 0.19, 0.09}, length, thinnest));
    EXPECT_FALSE(swim_case_from_json(document, "file").base.holds({-1, 0.21, 0.09}, length, thinnest));
}

TEST(Swimmer, PhasesThatRiseEvenlyAreAWave) {
    nlohmann::json document = plain();
    document["midline"]["by"] = "curvature";
    const Swimmer wave = swim_case_from_json(document, "file").base;
    document["midline"]["phase"] = {{0, 0}, {1, 1}};
    document["midline"]["waves"] = 5;
    const Places expected = wave.bent(midline(), length, 2.3),
                 places = swim_case_from_json(document, "file").base.bent(midline(), length, 2.3);
    for (std::size_t k = 0; k < places.size(); ++k) EXPECT_TRUE(places[k].isApprox(expected[k], 1e-12)) << k;
}

/// Whatever its wave is of, the midline keeps its length and sections their shape; they stand upright on it.
TEST(Swimmer, MidlineKeepsItsLengthAndSectionsTurnWithIt) {
    for (const std::string& name : swim_case_names())
        for (const auto& [variant, one] : read_swim_case(name).variants)
            for (const double beats : {0.0, 0.2, 3.1, 4.25, 5.55, 6.8}) {
                if (!one.deformation.terms.empty() || one.endless) continue;
                const Places line = one.bent(midline(400), length, beats);
                double sum = 0;
                for (std::size_t k = 1; k < line.size(); ++k) {
                    const double part = (line[k] - line[k - 1]).norm();
                    EXPECT_NEAR(part, length / 400, 3e-4 * length / 400) << name << variant << beats << " " << k;
                    sum += part;
                }
                EXPECT_NEAR(sum, length, 1e-4 * length) << name;
                const Places section =
                    one.bent({{-1.48, 0, 0}, {-1.5, 0.1, -0.05}, {-1.5, -0.1, 0.05}, {-1.52, 0, 0}}, length, beats);
                EXPECT_NEAR((section[2] - section[1]).norm(), std::hypot(0.2, 0.1), 1e-12);
                EXPECT_NEAR((section[2] - section[1]).normalized().dot((section[3] - section[0]).normalized()), 0, 2e-2)
                    << name << variant;
            }
}

/// Of lateral displacement it is what the formula says, by the distance along the midline or along the axis.
TEST(Swimmer, DisplacementIsKept) {
    nlohmann::json document = plain();
    for (const char* by : {"displacement", "axial displacement"}) {
        document["midline"]["by"] = by;
        const Swimmer one = swim_case_from_json(document, "test").base;
        const Places line = one.bent(midline(), length, 3.3);
        for (std::size_t k = 0; k < line.size(); ++k) {
            const double s = std::string(by) == "displacement" ? 0.01 * static_cast<double>(k) : -line[k].x() / length;
            EXPECT_NEAR(line[k].z() / length, 0.1 * std::sin(2 * std::numbers::pi * (3.3 - s)), 2e-4) << by << " " << k;
        }
    }
}

/// A plate that is the same from both ends: with the wave reversed it takes the mirrored shape, seen from the other
/// end.
TEST(Swimmer, WaveReversedIsMirrored) {
    const Swimmer tail = swimmer("plate", "to the tail"), head = swimmer("plate", "to the head");
    for (const double beats : {2.0, 2.3, 2.85}) {
        const Places a = tail.bent(midline(), length, beats), b = head.bent(midline(), length, beats);
        for (std::size_t k = 0; k < a.size(); ++k) {
            const Eigen::Vector3d from_head = a[k] - a[0], from_tail = b[b.size() - 1 - k] - b.back();
            EXPECT_NEAR(from_head.x(), -from_tail.x(), 2e-3 * length);
            EXPECT_NEAR(from_head.z(), from_tail.z(), 2e-3 * length);
        }
    }
}

TEST(Swimmer, LarvaBendsByAWaveTowardsItsTail) {
    const Swimmer larva = swimmer("larva");
    const Places straight = midline();
    for (const double beats : {0.4, 3.0, 3.15}) {
        const Places line = larva.bent(straight, length, beats);
        for (std::size_t k = 0; k <= 20; ++k) EXPECT_LE((line[k] - straight[k]).norm(), 1e-12) << beats;
    }
    // Where it bends most to one side: the wave is there so much later.
    const auto bending_at = [&](std::size_t k, double beats) {
        const Places line = larva.bent(straight, length, beats);
        return (line[k - 1] - line[k]).cross(line[k] - line[k + 1]).y();
    };
    const double later = 0.4 / 1.2;  // from 0.4 to 0.8 of the length
    for (const double beats : {3.0, 3.25, 3.55}) {
        const double early = bending_at(40, beats), follows = bending_at(80, beats + later);
        EXPECT_GT(std::abs(early), 5e-6);
        EXPECT_GT(follows / early, 1) << beats;
        EXPECT_LT(follows / early, 1.5) << beats;
    }
}

/// One line: which file and field, what was expected.
/// T_2(1 + 2x) y to the side as the cosine of once a beat, and x once more along it as the sine of twice.
TEST(Swimmer, DeformsAsItsFileSays) {
    nlohmann::json document = plain();
    document.erase("midline");
    document["deformation"] = {{2, 1, 0, 0, 0, 0, 0, 0, 0.3, 0, 0, 0, 0, 0, 0, 0, 0, 0},
                               {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.1, 0, 0}};
    const Swimmer body = swim_case_from_json(document, "test").base;
    const Places straight{{-0.5, 0.1, 0.05}};
    const double t = 1.3, once = 2 * std::numbers::pi * t, xi = 1 + 2 * -0.25;
    const Eigen::Vector3d moved = body.bent(straight, length, t)[0] - straight[0];
    EXPECT_NEAR(moved.x(), length * 0.1 * std::sin(2 * once), 1e-12);
    EXPECT_NEAR(moved.y(), 0, 1e-12);
    EXPECT_NEAR(moved.z(), length * 0.3 * (2 * xi * xi - 1) * 0.05 * std::cos(once), 1e-12);
    EXPECT_EQ(body.bent(straight, length, 0)[0], straight[0]) << "it grows from rest";
}

/// Out of a cone, a bar and a slab.
TEST(Swimmer, NormalsPointOutward) {
    nlohmann::json document = plain();
    document["outline"] = {{0, 0.1, 0.1}, {1, 0.3, 0.3}};
    const double wider = 0.01;
    const Eigen::Vector3d cone = swim_case_from_json(document, "test").base.normal({-1, 0.41, 0}, length, wider);
    EXPECT_NEAR((cone - Eigen::Vector3d(0.2, 1, 0).normalized()).norm(), 0, 1e-3);
    document["square"] = true;
    const Swimmer bar = swim_case_from_json(document, "test").base;
    EXPECT_NEAR(bar.normal({-1, 0.1, -0.41}, length, wider).y(), 0, 1e-9);
    EXPECT_LT(bar.normal({-1, 0.1, -0.41}, length, wider).z(), -0.9);
    EXPECT_EQ(bar.normal({-1, 0, 0}, length, wider).y(), 0);
}

TEST(Swimmer, FilesThatAreWrongAreRefused) {
    const auto refused = [](const char* patch) {
        nlohmann::json document = plain();
        document.merge_patch(nlohmann::json::parse(patch));
        return test::refusal_of([&] { swim_case_from_json(document, "eel"); });
    };
    const std::pair<const char*, const char*> wrong[] = {
        {R"({"source": null})", "eel: source"},
        {R"({"viscosity": null})", "eel: viscosity"},
        {R"({"viscosity": 0})", "eel: viscosity = 0: must be"},
        {R"({"endless": true})", "eel: endless: is for a slab with a midline by axial displacement"},
        {R"({"outline": null})", "eel: outline"},
        {R"({"outline": [[0, 0.1, 0.1]]})", "eel: outline = [[0,0.1,0.1]]: must be an array of two rows or more"},
        {R"({"outline": [[0, 0.1], [1, 0.1]]})", "eel: outline[0] = [0,0.1]: must be an array of 3 numbers"},
        {R"({"outline": [[0.5, 0.1, 0.1], [0.2, 0.1, 0.1]]})",
         "eel: outline[1][0] = 0.2: must be in [0, 1] and more than in the row before"},
        {R"({"outline": [[0, "x", 0.1], [1, 0.1, 0.1]]})", "eel: outline[0][1] = \"x\": must be"},
        {R"({"slab": true})", "eel: outline[0] = [0,0.05,0.1]: must be an array of 2 numbers"},
        {R"({"midline": null})", "eel: midline"},
        {R"({"midline": {"by": "force"}})", "eel: midline.by = \"force\": must be \"curvature\""},
        {R"({"midline": {"ramp": "cos"}})", "eel: midline.ramp = \"cos\": must be"},
        {R"({"midline": {"amplitude": []}})", "eel: midline.amplitude = []: must be"},
        {R"({"midline": {"amplitude": [1, "x"]}})", "eel: midline.amplitude[1] = \"x\": must be"},
        {R"({"midline": {"amplitude": [0.3]}})", "eel: midline: rises by more than its length at s = "},
        {R"({"midline": {"wave": 2}})", "eel: midline.wave: unknown"},
        {R"({"deformation": []})", "eel: deformation = []: must be an array of rows of 18 numbers"},
        {R"({"deformation": [[1, 2]]})", "eel: deformation[0] = [1,2]: must be an array of 18 numbers"},
        {R"({"deformation": [[0, 1.5, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]]})",
         "eel: deformation[0][1] = 1.5: must be a whole number in [0, 20]"},
        {R"({"towed": -1})", "eel: towed = -1: must be"},
        {R"({"variants": [1]})", "eel: variants = [1]: must be an object"},
        {R"({"variants": {"fast": {"viscosity": "low"}}})", "eel (fast): viscosity = \"low\": must be"},
        {R"({"variants": {"a,b": {}}})", "eel: variants = \"a,b\": must be without a comma"},
        {R"({"variants": {"fast": 3}})", "eel (fast)"},
        {R"({"colour": 3})",
         "eel: colour: unknown key (= 3); allowed: source, outline, midline, deformation, towed, variants, targets"},
        {R"({"targets": 3})", "eel: targets = 3: must be an array"},
        {R"({"targets": [{"quantity": "sped", "confirmed": true, "source": "x", "least": 0}]})",
         "eel: targets[0].quantity = \"sped\": must be one of speed"},
        {R"({"targets": [{"quantity": 3, "confirmed": true, "source": "x", "least": 0}]})",
         "eel: targets[0].quantity = 3: must be"},
        {R"({"targets": [{"quantity": "speed", "confirmed": true, "source": "x"}]})",
         "eel: targets[0]: needs reference and within, least or greatest"},
        {R"({"targets": [{"quantity": "speed", "confirmed": true, "source": "x", "reference": 1}]})",
         "eel: targets[0].within"},
        {R"({"targets": [{"quantity": "speed", "source": "x", "least": 1}]})", "eel: targets[0].confirmed"},
        {R"({"targets": [{"quantity": "speed", "variant": "slow", "confirmed": true, "source": "x", "least": 1}]})",
         "eel: targets[0].variant = \"slow\": must be the name of a variant"},
    };
    for (const auto& [patch, message] : wrong) {
        const std::string said = refused(patch);
        EXPECT_EQ(said.find(message), 0U) << patch << " gave: " << said;
        EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    }
}

/// Forwards and back: the walls keep their coordinates, and no water is left outside.
TEST(Swim, BoxMovesBothWays) {
    for (const double distance : {0.3, -0.3}) {
        WaterTank<double> tank({10, 2, 2},
                               {.solver = {.scheme = Scheme::conserving, .precision = Precision::double_precision}});
        const std::vector<Eigen::Vector3d> before = tank.state().position;
        tank.shift(distance);
        int moved = 0;
        for (std::size_t i = 0; i < before.size(); ++i) {
            const double x = tank.state().position[i].x();
            EXPECT_TRUE(0 <= x && x <= 1) << x << " after " << distance;
            moved += std::abs(before[i].x() - distance - x) > 0.5;
        }
        EXPECT_NEAR(moved, 0.3 * static_cast<double>(before.size()), 2);
    }
}

/// A slab in water so viscous that nothing of its disorder is left; in thinner water it wanders, see "at rest" of
/// plate.json.
TEST(Swim, StaysAtRestWithoutMotion) {
    nlohmann::json document = plain();
    document.merge_patch(
        {{"slab", true}, {"outline", {{0, 0.05}, {1, 0.05}}}, {"viscosity", 0.1}, {"midline", {{"scale", 0}}}});
    Swim<float> still(swim_case_from_json(document, "test").base, {.box = {2.3, 0.25, 1.2}},
                      {.solver = {.scheme = Scheme::conserving}, .resolution = 12});
    const Eigen::Vector3d start = still.body().centre();
    ASSERT_TRUE(still.set_kinematic_viscosity(0.1 * water_length * water_length / 2));
    for (long k = 0; k < still.body().frames_per_beat(); ++k) ASSERT_TRUE(still.frame());
    EXPECT_LE((still.body().centre() - start).norm(), 2e-3 * water_length);
    const double mass =
        std::pow(water_length / still.spacing(), 3) * 0.25;  // of a length of water, cubic but for its height
    EXPECT_NEAR(still.body().power() / mass, 0, 1e-4);
}

/// It goes where it is led, whatever the water does, and the water holds it back.
TEST(Swim, TowedBodyGoesAtItsSpeed) {
    nlohmann::json document = plain();
    document["midline"]["scale"] = 0;
    document["towed"] = 0.5;
    document.merge_patch({{"slab", true}, {"outline", {{0, 0.05}, {1, 0.05}}}});
    Swim<float> towed(swim_case_from_json(document, "test").base, {.box = {2.3, 0.25, 1.2}},
                      {.solver = {.scheme = Scheme::conserving}, .resolution = 12});
    const double start = towed.body().centre().x();
    double force = 0;
    for (long k = 0; k < 2 * towed.body().frames_per_beat(); ++k) {
        ASSERT_TRUE(towed.frame());
        force += towed.body().force();
    }
    EXPECT_NEAR((towed.body().centre().x() - start) / water_length, 0.5 * 1.5, 0.01);
    EXPECT_LT(force, 0);
}

/// Means over the last of some beats on a lattice, in lengths and beats.
struct LatticeBeat {
    double speed = 0, lateral = 0, force = 0, power = 0;
};
LatticeBeat last_beat(const Swimmer& swimmer, int beats, double mach = 0.15, int resolution = 32) {
    SwimScene scene;
    scene.box = {4, 1, 2};
    LatticeSwim swim(swimmer, scene, resolution, mach, {});
    const SwimBody& body = swim.body();
    const double frames = static_cast<double>(body.frames_per_beat()),
                 mass = std::pow(resolution, 2);  // of a square length
    LatticeBeat last;
    for (int k = 1; k <= beats; ++k) {
        const Eigen::Vector3d from = body.centre();
        last = {};
        for (long f = 0; f < body.frames_per_beat(); ++f) {
            EXPECT_TRUE(swim.frame());
            last.force += body.force() / frames / mass * scene.beat * scene.beat / scene.length;
            last.power += body.power() / frames / mass * std::pow(scene.beat, 3) / (scene.length * scene.length);
        }
        const Eigen::Vector3d way = (body.centre() - from) / scene.length;
        last.speed = way.x(), last.lateral = way.z();
    }
    return last;
}

Swimmer slab(const nlohmann::json& patch) {
    nlohmann::json document = plain();
    document.merge_patch({{"slab", true}, {"outline", {{0, 0.05}, {1, 0.05}}}});
    document.merge_patch(patch);
    return swim_case_from_json(document, "test").base;
}

TEST(LatticeSwim, StaysAtRestWithoutMotion) {
    const LatticeBeat still = last_beat(slab({{"midline", {{"scale", 0}}}}), 1);
    EXPECT_NEAR(still.speed, 0, 1e-6);
    EXPECT_NEAR(still.lateral, 0, 1e-6);
    EXPECT_NEAR(still.power, 0, 1e-9);
}

/// What is gained by a wave to the tail is lost by one to the head, to the target of standing plates, and motion costs
/// power.
TEST(LatticeSwim, PlatesMirrorEachOther) {
    const LatticeBeat tail = last_beat(swimmer("plate", "to the tail"), 3, 0.15, 64),
                      head = last_beat(swimmer("plate", "to the head"), 3, 0.15, 64);
    EXPECT_GT(tail.speed, 0.05);
    EXPECT_NEAR(head.speed, -tail.speed, 0.005);
    EXPECT_GT(tail.power, 0.05);
    EXPECT_NEAR(head.power / tail.power, 1, 0.03);
    EXPECT_NEAR(last_beat(swimmer("plate", "standing"), 3, 0.15, 64).speed, 0, 0.01);
}

/// A cylinder across its way at Reynolds number 100: three quarters of its drag are pressure (of 1.35, 0.34 is
/// friction: Park, Kwon, Choi 1998). Few cells have too much friction: 0.43 of 20 across, more of 40.
TEST(LatticeSwim, PressureAndFrictionAreToldApart) {
    nlohmann::json outline = nlohmann::json::array();
    for (int k = 0; k <= 40; ++k) outline.push_back({k / 40.0, std::sqrt(k / 40.0 * (1 - k / 40.0))});
    const auto part = [&](int resolution) {
        SwimScene scene;
        scene.box = {8, 0, 8};
        LatticeSwim swim(slab({{"outline", outline}, {"midline", {{"scale", 0}}}, {"towed", 1}}), scene, resolution,
                         0.15, {});
        double force = 0, pressure = 0;
        for (long f = 0; f < 4 * swim.body().frames_per_beat(); ++f) {
            EXPECT_TRUE(swim.frame());
            if (f < 2 * swim.body().frames_per_beat()) continue;
            force += swim.body().force();
            pressure += swim.pressure();
        }
        EXPECT_LT(force, 0);
        return pressure / force;
    };
    const double coarse = part(20), fine = part(40);
    EXPECT_GT(coarse, 0.35);
    EXPECT_GT(fine, coarse + 0.05);
    EXPECT_LT(fine, 0.8);
}

/// Taylor's sheet with sections that turn: its speed is known (references/swimmers/endless-sheet.json), a wave the
/// other way reverses it, and it neither drifts nor turns.
TEST(LatticeSwim, EndlessSheetGoesAsTheoryHas) {
    Swimmer sheet = swimmer("endless-sheet", "kd 0.2");
    const LatticeBeat one = last_beat(sheet, 2, 0.15, 64);
    EXPECT_NEAR(one.speed, 0.00884, 0.1 * 0.00884);
    EXPECT_NEAR(one.lateral, 0, 1e-5);
    sheet.waves = -2;
    EXPECT_NEAR(last_beat(sheet, 2, 0.15, 64).speed, -one.speed, 1e-5);
}

/// It goes where it is led, the water holds it back, and all that it gives the water is what that takes.
TEST(LatticeSwim, TowedBodyIsHeldBack) {
    const Swimmer towed = slab({{"midline", {{"scale", 0}}}, {"towed", 0.5}});
    const LatticeBeat one = last_beat(towed, 3), fine = last_beat(towed, 3, 0.075);
    EXPECT_NEAR(one.speed, 0.5, 1e-3);
    EXPECT_LT(one.force, -0.01);
    EXPECT_NEAR(one.power, -0.5 * one.force, 0.01 * one.power);
    EXPECT_NEAR(fine.force / one.force, 1, 0.05);
}

/// The same in three dimensions; half the step changes little.
TEST(LatticeSwim, MachNumberHardlyMatters) {
    nlohmann::json document = plain();
    document["midline"] = {{"by", "displacement"}, {"amplitude", {0.02, 0.08}}, {"waves", 1}};
    const Swimmer eel = swim_case_from_json(document, "test").base;
    const LatticeBeat one = last_beat(eel, 2, 0.3, 24), fine = last_beat(eel, 2, 0.15, 24);
    EXPECT_NEAR(fine.speed, one.speed, 0.01);
    EXPECT_NEAR(fine.power / one.power, 1, 0.1);
}

/// Without forces it bends but neither goes nor turns, whatever its shape's own frame does.
TEST(FreeMotion, BendingAloneHasNoMomentum) {
    const Swimmer larva = swimmer("larva");
    const Places straight = body(larva);
    FreeMotion motion(straight, kept_among_particles);
    const Eigen::Vector3d start = motion.centre();
    constexpr double h = 0.005;
    double most = 0, size = 0;
    for (int k = 1; k <= 800; ++k) {
        const Places before = motion.places();
        const Places velocities = motion.set_off(larva.bent(straight, length, k * h / 2), h);
        Eigen::Vector3d momentum = Eigen::Vector3d::Zero(), spin = momentum;
        double all = 0;
        for (std::size_t i = 0; i < before.size(); ++i) {
            momentum += velocities[i];
            spin += (before[i] - motion.centre()).cross(velocities[i]);
            all += (before[i] - motion.centre()).cross(velocities[i]).norm();
        }
        EXPECT_LE(momentum.norm(), 1e-9 * static_cast<double>(before.size()));
        most = std::max(most, spin.norm());
        size = std::max(size, all);
        motion.arrive(Places(before.size(), Eigen::Vector3d::Zero()), h);
    }
    EXPECT_GT(size, 10);
    EXPECT_LE(most, 0.02 * size);
    EXPECT_LE((motion.centre() - start).norm(), 1e-9);
}

/// F = m a and M = I alpha of a stiff body; what lifts or tilts it does nothing.
TEST(FreeMotion, ForcesMoveAndTurnIt) {
    Places bar;
    for (int k = 0; k <= 20; ++k) bar.emplace_back(0.1 * k - 1, 0, 0);
    FreeMotion motion(bar, kept_among_particles);
    constexpr double h = 0.001, time = 1;
    for (int k = 0; k < time / h; ++k) {
        motion.set_off(bar, h);
        Places forces;
        for (const auto& x : motion.places()) {
            const Eigen::Vector3d arm = x - motion.centre();
            forces.push_back(Eigen::Vector3d(0.3, 5, 0) + 0.2 * Eigen::Vector3d::UnitY().cross(arm));
        }
        motion.arrive(forces, h);
    }
    EXPECT_NEAR(motion.velocity().x(), 0.3 * time, 1e-3);
    EXPECT_EQ(motion.velocity().y(), 0);
    EXPECT_NEAR(motion.centre().x(), 0.15 * time * time, 1e-3);
    const Eigen::Vector3d end = motion.places().back() - motion.centre();
    EXPECT_NEAR(std::atan2(-end.z(), end.x()), 0.1 * time * time, 1e-3);
    EXPECT_NEAR(end.norm(), 1, 1e-9);
}

/// Whatever momentum it has.
TEST(FreeMotion, ItIsSteered) {
    const Places bar{{-1, 0, 0}, {1, 0, 0}};
    FreeMotion motion(bar, kept_among_particles);
    motion.steer(0.2);
    for (int k = 0; k < 100; ++k) {
        motion.set_off(bar, 0.01);
        motion.arrive(Places(2, Eigen::Vector3d::Zero()), 0.01);
    }
    EXPECT_NEAR(motion.angle(), 0.2, 1e-12);
    EXPECT_LE((motion.places()[1] - Eigen::Vector3d(std::cos(0.2), 0, -std::sin(0.2))).norm(), 1e-12);
}

/// Water that goes along with four times the body's mass, and shows it a step late.
TEST(FreeMotion, BearsAddedMassOfWater) {
    FreeMotion motion({{-1, 0, 0}, {1, 0, 0}}, kept_among_particles);
    constexpr double h = 0.01, added = 4, push = 0.7;
    double before = 0;
    for (int k = 0; k < 400; ++k) {
        motion.set_off({{-1, 0, 0}, {1, 0, 0}}, h);
        const double acceleration = (motion.velocity().x() - before) / h;
        before = motion.velocity().x();
        motion.arrive(Places(2, Eigen::Vector3d(push - added * acceleration, 0, 0)), h);
    }
    EXPECT_NEAR(motion.velocity().x(), push / (1 + added) * 400 * h, 0.02);
}

TEST(Larvae, HaveTheStrouhalNumbersOfTheirReynoldsNumbers) {
    EXPECT_NEAR(strouhal_of_larvae(60), 2.5, 1e-12);
    EXPECT_NEAR(strouhal_of_larvae(1400), 0.72, 1e-12);
    for (const double reynolds : {60.0, 300.0, 1400.0})
        EXPECT_NEAR(reynolds_of_larvae(reynolds * strouhal_of_larvae(reynolds)), reynolds, 1e-9 * reynolds);
}

}  // namespace
}  // namespace natator::bench
