// natator-sim evaluate: what a caller on the other end of the pipes relies on.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "child_process.h"

namespace natator::test {
namespace {

using nlohmann::json;

json request(const std::string& scene, double duration) {
    return {{"id", 42},
            {"scene", scene},
            {"gait", {{"frequency", 1.861}, {"amplitude", {0.973, 0.69}}, {"phase", {0, 0.648}}}},
            {"duration", duration}};
}

json result_of(const json& asked) {
    const Outcome outcome = run_simulator({"evaluate"}, asked.dump());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_EQ(lines(outcome.out), 1);
    return json::parse(outcome.out);
}

TEST(EvaluateProtocolTest, AResultHasExactlyTheDocumentedFields) {
    const json result = result_of(request("thesis/creature-1", 0.1));
    std::vector<std::string> keys;
    for (const auto& [key, value] : result.items()) keys.push_back(key);
    EXPECT_EQ(keys, (std::vector<std::string>{"course", "distance", "fitness", "frames", "hash", "id", "laws",
                                              "precision", "scheme", "simulated", "status", "stopped"}));
    for (const char* figure : {"linearMomentum", "angularMomentum", "densityErrorMean", "densityErrorMax"}) {
        EXPECT_GT(result["laws"].at(figure).get<double>(), 0) << figure;
        EXPECT_LT(result["laws"].at(figure).get<double>(), 1) << figure;
    }
    EXPECT_EQ(result["id"], 42);
    EXPECT_EQ(result["status"], "ok");
    EXPECT_EQ(result["stopped"], "completed");
    EXPECT_EQ(result["scheme"], "flex");
    EXPECT_EQ(result["precision"], "float");
    EXPECT_EQ(result["frames"], 6);
    EXPECT_NEAR(result["simulated"].get<double>(), 0.1, 1e-12);
    EXPECT_EQ(result["fitness"], result["distance"]);
    const std::string hash = result["hash"];
    EXPECT_EQ(hash.size(), 16u);
    EXPECT_EQ(hash.find_first_not_of("0123456789abcdef"), std::string::npos) << hash;
}

TEST(EvaluateProtocolTest, ASwimmerInWaterHasItsNumbers) {
    json asked = request("bench/small-tank", 0.6);
    asked["scheme"] = "conserving";
    asked["overrides"] = {{"solver", {{"substeps", 2}, {"kinematicViscosity", 0.01}}},
                          {"stopping", {{"planeContact", false}}}};
    const json result = result_of(asked), numbers = result.at("swimming");
    const double speed = std::abs(result["distance"].get<double>()) / result["simulated"].get<double>(), length = 0.6;
    const double amplitude = numbers.at("tailAmplitude");
    EXPECT_GT(amplitude, 0.01);
    EXPECT_NEAR(numbers.at("reynolds").get<double>(), speed * length / 0.01, 1e-6);
    EXPECT_GT(numbers.at("strouhal").get<double>(), 0);
    EXPECT_NEAR(numbers.at("swimmingNumber").get<double>(), 2 * 3.14159265358979 * 1.861 * amplitude * length / 0.01,
                1e-6);
    EXPECT_GE(numbers.at("cavities").get<double>(), 0);
    EXPECT_GT(result.at("work").get<double>(), 0);
}

TEST(EvaluateProtocolTest, TheSameRequestGivesTheSameAnswer) {
    const json asked = request("thesis/creature-1", 0.05);
    EXPECT_EQ(result_of(asked), result_of(asked));
}

TEST(EvaluateProtocolTest, WhereAnEditorFindsTheSchemaHasNoEffect) {
    json asked = request("thesis/creature-1-vacuum", 0.05);
    const json plain = result_of(asked);
    asked["$schema"] = "request.schema.json";
    EXPECT_EQ(result_of(asked), plain);
}

/// Messages about a file name it.
TEST(EvaluateProtocolTest, ARequestMayBeAFileOrText) {
    const json asked = request("thesis/creature-1-vacuum", 0.05), expected = result_of(asked);
    const std::filesystem::path file =
        std::filesystem::path(testing::TempDir()) / ("request-" + std::to_string(getpid()) + ".json");
    const auto write = [&file](const std::string& text) { std::ofstream(file) << text; };
    write(asked.dump(2));
    for (const auto& [argument, input] :
         {std::pair(file.string(), std::string("no request")), {asked.dump(), ""}, {"-", asked.dump()}}) {
        const Outcome outcome = run_simulator({"evaluate", argument}, input);
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(json::parse(outcome.out), expected);
    }
    const auto refused = [&file]() {
        const Outcome outcome = run_simulator({"evaluate", file.string()});
        EXPECT_EQ(outcome.exit_code, 2);
        EXPECT_EQ("natator-sim: " + json::parse(outcome.out).at("error").get<std::string>() + "\n", outcome.err);
        return outcome.err;
    };
    json wrong = asked;
    wrong.erase("gait");
    write(wrong.dump());
    EXPECT_EQ(refused().find("natator-sim: request " + file.string() + ": gait: missing"), 0u) << refused();
    wrong["speed"] = 9;
    write(wrong.dump());
    EXPECT_EQ(refused().find("natator-sim: request " + file.string() + ": speed: unknown key"), 0u) << refused();
    write("{");
    EXPECT_EQ(refused().find("natator-sim: file \"" + file.string() + "\": not valid JSON"), 0u) << refused();
    std::filesystem::remove(file);
    EXPECT_EQ(refused(), "natator-sim: file \"" + file.string() + "\": cannot be read: No such file or directory\n");
}

TEST(EvaluateProtocolTest, EveryOptionalFieldHasItsEffect) {
    const json plain = request("thesis/creature-1-vacuum", 0.5);
    const json base = result_of(plain);
    const auto with = [&](const char* patch) {
        json asked = plain;
        asked.merge_patch(json::parse(patch));
        return result_of(asked);
    };
    EXPECT_EQ(with(R"({"backend":"cpu","scheme":"flex","precision":"float","perturbation":{"amplitude":0,"seed":9}})"),
              base);
    EXPECT_EQ(with(R"({"precision":"double"})")["precision"], "double");
    EXPECT_NEAR(with(R"({"precision":"double"})")["distance"].get<double>(), base["distance"].get<double>(), 1e-2);
    EXPECT_NE(with(R"({"perturbation":{"amplitude":1e-5,"seed":1}})")["hash"], base["hash"]);
    EXPECT_NE(with(R"({"perturbation":{"amplitude":1e-5,"seed":2}})")["hash"],
              with(R"({"perturbation":{"amplitude":1e-5,"seed":1}})")["hash"]);
    EXPECT_NE(with(R"({"gait":{"power":2}})")["hash"], base["hash"]);
    EXPECT_EQ(with(R"({"gait":{"power":1}})"), base);
    EXPECT_EQ(with(R"({"duration":0.25})")["frames"], 15);
    EXPECT_EQ(with(R"({"overrides":{"timeStep":0.008333333333333333}})")["frames"], 60);
    // Without the acceleration clamp there is no motion in vacuum.
    const json free = with(R"({"overrides":{"solver":{"maxAcceleration":3.4028234663852886e38}}})");
    EXPECT_LT(std::abs(free["distance"].get<double>()), std::abs(base["distance"].get<double>()) / 5);
}

/// What chooses a GPU is refused where the request, too, leaves it at the CPU.
TEST(EvaluateProtocolTest, OptionsOfGpusAreRefusedOnTheCpu) {
    json asked = request("thesis/creature-1-vacuum", 0.1);
    const Outcome refused = run_simulator({"evaluate", "--device", "1023"}, asked.dump());
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_EQ(refused.err,
              "natator-sim: --device = 1023: the backend is cpu; must be left out, or beside --backend cuda or auto\n");
    EXPECT_EQ(json::parse(refused.out)["status"], "error");
    asked["backend"] = "cuda";
    EXPECT_EQ(run_simulator({"evaluate", "--device", "1023"}, asked.dump()).exit_code, 4);
}

/// In conserving water another start is another arrangement of the water; elsewhere all is shifted a little.
TEST(EvaluateProtocolTest, AStartIsAnotherArrangementOfTheWater) {
    json asked = request("bench/small-tank", 0.1);
    asked["overrides"]["settling"]["updates"] = 5;  // the arrangements differ from the beginning
    const auto hash = [&](const char* scheme, std::optional<int> start) {
        asked["scheme"] = scheme;
        asked.erase("start");
        if (start) asked["start"] = *start;
        return result_of(asked).at("hash");
    };
    EXPECT_EQ(hash("conserving", 20), hash("conserving", std::nullopt));
    EXPECT_EQ(hash("conserving", 3), hash("conserving", 3));
    EXPECT_NE(hash("conserving", 3), hash("conserving", 4));
    EXPECT_NE(hash("conserving", 3), hash("conserving", 20));
    EXPECT_NE(hash("flex", 3), hash("flex", 4));
    EXPECT_NE(hash("flex", 20), hash("flex", std::nullopt));

    asked["scheme"] = "conserving";
    asked["start"] = 3;
    json overridden = asked;
    overridden.erase("start");
    overridden["overrides"]["fluid"]["disorder"] = 3;
    EXPECT_EQ(result_of(asked), result_of(overridden));
    asked["overrides"]["fluid"] = nullptr;  // a start makes no water where there is none
    EXPECT_EQ(result_of(asked).at("status"), "ok");
}

TEST(EvaluateProtocolTest, TheRequestsOwnDurationWinsOverOverrides) {
    json asked = request("thesis/creature-1-vacuum", 0.1);
    asked["overrides"] = {{"duration", 3}};
    EXPECT_EQ(result_of(asked)["frames"], 6);
}

TEST(EvaluateProtocolTest, EarlyStopsAreNamed) {
    json falling = request("thesis/creature-1-vacuum", 2);
    falling["overrides"] =
        json::parse(R"({"planes":[[0,1,0,0]],"solver":{"gravity":[0,-10,0]},"stopping":{"planeContact":true}})");
    const json touched = result_of(falling);
    EXPECT_EQ(touched["stopped"], "touched-plane");
    EXPECT_EQ(touched["status"], "ok");
    EXPECT_LT(touched["simulated"].get<double>(), 0.5);

    json resting = request("thesis/creature-1-vacuum", 4);
    resting["gait"]["amplitude"] = {0, 0};
    resting["overrides"] = {{"stopping", {{"noProgressAfter", 2}}}};
    const json idle = result_of(resting);
    EXPECT_EQ(idle["stopped"], "no-progress");
    EXPECT_EQ(idle["frames"], 120);
}

TEST(EvaluateProtocolTest, PlainWritesOnlyTheFitness) {
    const json asked = request("thesis/creature-1-vacuum", 0.5);
    const Outcome outcome = run_simulator({"evaluate", "--plain"}, asked.dump());
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(std::stod(outcome.out), result_of(asked)["fitness"].get<double>());
    EXPECT_EQ(outcome.out.find_first_not_of("-.0123456789e"), outcome.out.size() - 1) << outcome.out;
    EXPECT_EQ(outcome.out.back(), '\n');
}

TEST(EvaluateProtocolTest, AnUnstableRunHasFitnessZeroAndSaysWhere) {
    json asked = request("thesis/creature-1", 0.1);
    asked["overrides"] = {{"solver", {{"relaxationMode", "global"}}}};
    const Outcome outcome = run_simulator({"evaluate"}, asked.dump());
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
    const json result = json::parse(outcome.out);
    EXPECT_EQ(result["id"], 42);
    EXPECT_EQ(result["status"], "unstable");
    EXPECT_EQ(result["stopped"], "unstable");
    EXPECT_EQ(result["fitness"], 0);
    EXPECT_TRUE(result["distance"].is_null());
    EXPECT_TRUE(result["unstable"]["particle"].is_number_unsigned());
    EXPECT_TRUE(result["unstable"]["stage"].is_string());
    EXPECT_GE(result["unstable"]["time"].get<double>(), 0);
    EXPECT_FALSE(result["unstable"]["law"].get<std::string>().empty());
}

/// In scheme flex light water is thrown out of its tank: that is seen at the end of a frame.
TEST(EvaluateProtocolTest, WaterBehindAWallIsUnstable) {
    json asked = request("bench/small-tank", 0.5);
    asked["overrides"] = json::parse(R"({"stopping":{"planeContact":false,"noProgressAfter":0},
                                         "fluid":{"mass":{"gradient":"uniform","bottom":0.02}}})");
    const Outcome outcome = run_simulator({"evaluate"}, asked.dump());
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
    EXPECT_NE(outcome.err.find("is behind a plane"), std::string::npos) << outcome.err;
    const json unstable = json::parse(outcome.out)["unstable"];
    EXPECT_EQ(unstable["law"], "tank");
    EXPECT_EQ(unstable["stage"], "frame");
    const double frames = unstable["time"].get<double>() * 60;
    EXPECT_GE(frames, 0.99);
    EXPECT_NEAR(frames, std::round(frames), 1e-6);
}

TEST(EvaluateProtocolTest, ASceneWithoutActuatorsNeedsNoGait) {
    const json result = result_of({{"id", 0}, {"scene", "thesis/tank"}, {"duration", 0.05}});
    EXPECT_EQ(result["id"], 0);
    EXPECT_EQ(result["distance"], 0);
}

TEST(EvaluateProtocolTest, ALargeRequestIsRefusedAndNotRead) {
    const Outcome outcome = run_simulator({"evaluate"}, std::string(17 << 20, ' '));
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("larger than 16 MiB"), std::string::npos) << outcome.err;
}

TEST(EvaluateProtocolTest, AFullDiskBehindStandardOutputIsAFailure) {
    const Outcome outcome = run_simulator({"evaluate"}, request("thesis/creature-1-vacuum", 0.05).dump(), "/dev/full");
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
}

/// Whoever reads a pipe gets the error as an answer, too; who sees both, once.
TEST(EvaluateProtocolTest, AnErrorIsToldOnceOnATerminal) {
    const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
    ASSERT_GE(terminal, 0);
    ASSERT_EQ(grantpt(terminal) + unlockpt(terminal), 0);
    const Outcome piped = run_simulator({"evaluate"}, "{}");
    const Outcome seen = run_simulator({"evaluate"}, "{}", ptsname(terminal));
    char written[100];
    EXPECT_LE(read(terminal, written, sizeof written), 0) << "nothing but the line on standard error";
    close(terminal);
    EXPECT_EQ(json::parse(piped.out).at("status"), "error");
    EXPECT_EQ(seen.exit_code, piped.exit_code);
    EXPECT_EQ(seen.err, piped.err);
    EXPECT_EQ(lines(seen.err), 1);
}

}  // namespace
}  // namespace natator::test
