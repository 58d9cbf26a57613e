// natator-sim evaluate with unusable requests: one line on standard error, an error result, exit code 2; never a crash.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "../native/test_name.h"
#include "child_process.h"
#include "natator/batch.h"

namespace natator::test {
namespace {

using nlohmann::json;

/// A good request with one key set to something else, or removed if `value` is empty.
std::string request_with(const std::string& key, const std::string& value) {
    json request = {{"id", 7}, {"scene", "thesis/creature-1-vacuum"}, {"gait", json::parse(gait)}, {"duration", 0.05}};
    request.erase(key);
    std::string text = request.dump();
    if (value.empty()) return text;
    text.pop_back();  // the closing brace
    text.append(",").append(json(key).dump()).append(":").append(value).append("}");
    return text;
}

struct BadRequest {
    std::string text;
    const char* expected;  ///< must be in the message
    bool id_known = true;
};

void PrintTo(const BadRequest& bad, std::ostream* out) {
    print_name(bad.text, out);
    *out << "_";
    print_name(bad.expected, out);
}

const BadRequest bad_requests[] = {
    {"", "not valid JSON", false},
    {"{\"id\":7", "not valid JSON", false},
    {"[1]", "must be an object", false},
    {"null", "must be an object", false},
    {std::string("\0\0", 2), "not valid JSON", false},
    {std::string(200'000, '['), "nested deeper than 32", false},
    {R"({"id":7,"id":8})", "\"id\" is given twice", false},
    {request_with("id", ""), "id: missing", false},
    {request_with("id", "-1"), "id = -1", false},
    {request_with("id", "\"x\""), "id = \"x\"", false},
    {request_with("id", "9007199254740992"), "id = 9007199254740992: must be a whole number in [0, 9007199254740991]",
     false},
    {request_with("scene", ""), "scene: missing"},
    {request_with("scene", "5"), "scene = 5: must be a string"},
    {request_with("scene", "\"no/such\""), "must be one of bench/dam-break, "},
    {request_with("scene", "\"thesis/craeture-4\""),
     "unknown scene \"thesis/craeture-4\"; did you mean thesis/creature-4?"},
    {request_with("scene", "\"no\\nsuch.json\""), "cannot be read"},
    {request_with("gaits", "1"), "gaits: unknown key (= 1); did you mean gait?"},
    {request_with("$schema", "3"), "$schema = 3: must be a string"},
    {request_with("gait", ""), "gait: missing"},
    {request_with("gait", "3"), "gait = 3: must be an object"},
    {request_with("gait", R"({"amplitude":[1,1],"phase":[0,0]})"), "gait.frequency: missing"},
    {request_with("gait", R"({"frequency":1,"phase":[0,0]})"), "gait.amplitude: missing"},
    {request_with("gait", R"({"frequency":1,"amplitude":[1,1]})"), "gait.phase: missing"},
    {request_with("gait", R"({"frequency":"1","amplitude":[1,1],"phase":[0,0]})"), "gait.frequency = \"1\""},
    {request_with("gait", R"({"frequency":0,"amplitude":[1,1],"phase":[0,0]})"),
     "gait.frequency = 0: must be a number in (0, 60]"},
    {request_with("gait", R"({"frequency":NaN,"amplitude":[1,1],"phase":[0,0]})"), "invalid literal", false},
    {request_with("gait", R"({"frequency":1e999,"amplitude":[1,1],"phase":[0,0]})"), "not valid JSON", false},
    {request_with("gait", R"({"frequency":1,"amplitude":[1],"phase":[0,0]})"),
     "gait.amplitude has length 1: must have length 2"},
    {request_with("gait", R"({"frequency":1,"amplitude":[1,2.5],"phase":[0,0]})"), "gait.amplitude[1] = 2.5"},
    {request_with("gait", R"({"frequency":1,"amplitude":[1,null],"phase":[0,0]})"), "gait.amplitude[1] = null"},
    {request_with("gait", R"({"frequency":1,"amplitude":1,"phase":[0,0]})"), "gait.amplitude = 1: must be an array"},
    {request_with("gait", R"({"frequency":1,"amplitude":[1,1],"phase":[0,1.5]})"), "gait.phase[1] = 1.5"},
    {request_with("gait", R"({"frequency":1,"amplitude":[1,1],"phase":[0,1.0000001]})"),
     "gait.phase[1] = 1.0000001: must be a number in [0, 1]"},
    {request_with("gait", R"({"frequency":1,"amplitude":[1,0.7],"phase":[0,0],"offset":[0,1.30000004]})"),
     "gait.offset[1] = 1.30000004: must be a number in [-1.3, 1.3]"},
    {request_with("gait", R"({"frequency":1,"amplitude":[1,1],"phase":[0,0],"power":9})"), "gait.power = 9"},
    {request_with("duration", "-1"), "duration = -1: must be a number in (0, "},
    {request_with("duration", "\"4\""), "duration = \"4\""},
    {request_with("duration", "null"), "request: duration = null: must be a number"},
    {request_with("scheme", "null"), "request: scheme = null: must be \"flex\", \"conserving\" or \"lattice\""},
    {request_with("scheme", "\"newton\""), "scheme = \"newton\""},
    {request_with("backend", "\"gpu\""), "backend = \"gpu\": must be \"cpu\" or \"auto\" or \"cuda\""},
    {request_with("precision", "\"half\""), "precision = \"half\": must be \"float\" or \"double\""},
    {request_with("perturbation", "{\"amplitude\":1e-6}"), "perturbation.seed: missing"},
    {request_with("perturbation", "{\"amplitude\":-1,\"seed\":1}"), "perturbation.amplitude = -1"},
    {request_with("perturbation", "{\"amplitude\":0,\"seed\":-1}"), "perturbation.seed = -1"},
    {request_with("start", "-1"), "start = -1: must be"},
    {request_with("start", "1.5"), "start = 1.5: must be"},
    {request_with("start", "4294967296"), "start = 4294967296: must be"},
    {request_with("start", "1,\"perturbation\":{\"amplitude\":0,\"seed\":1}"),
     "start: must not be given together with"},
    {request_with("overrides", "[]"), "overrides = []: must be an object"},
    {request_with("overrides", "{\"solver\":{\"radius\":-1}}"), "solver.radius = -1"},
    {request_with("overrides", "{\"creature\":{\"particleMass\":-1}}"), "creature.particleMass = -1"},
    {request_with("overrides", "{\"planes\":[[0,1,0,-1]]}"), "outside the tank"},
    {request_with("overrides", "{\"creature\":null}"), "gait.amplitude has length 2: must have length 0"},
    {request_with("overrides", "{\"creature\":{\"joints\":[8]}}"), "there is none: an actuator needs two joints"},
    {request_with("overrides", "{\"solver\":{\"radius\":1000}}"), "solver.fluidRestDistance = 0.1: must be at least"},
    {request_with("overrides", "{\"settling\":{\"updates\":1000000,\"substeps\":1000}}"), "in 1e+09 substeps"},
};

class BadRequestTest : public testing::TestWithParam<BadRequest> {};

TEST_P(BadRequestTest, IsAnsweredWithOneLineAndExitCodeTwo) {
    const BadRequest& bad = GetParam();
    const Outcome outcome = run_simulator({"evaluate"}, bad.text);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
    EXPECT_EQ(outcome.err.find("natator-sim: "), 0u) << outcome.err;
    EXPECT_NE(outcome.err.find(bad.expected), std::string::npos) << outcome.err;

    ASSERT_EQ(lines(outcome.out), 1) << outcome.out;
    const json result = json::parse(outcome.out);
    EXPECT_EQ(result.at("status"), "error");
    EXPECT_EQ(result.at("id"), bad.id_known ? json(7) : json());
    EXPECT_EQ("natator-sim: " + result.at("error").get<std::string>() + "\n", outcome.err);
}

INSTANTIATE_TEST_SUITE_P(All, BadRequestTest, testing::ValuesIn(bad_requests));

/// The table above changes one thing of this request at a time.
TEST(BadRequestTest, TheRequestWithoutFaultIsAccepted) {
    const Outcome outcome = run_simulator({"evaluate"}, request_with("duration", "0.05"));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
}

/// A pipe that nobody writes to would be waited for for ever.
TEST(BadRequestTest, ASceneOrCreatureFileThatIsNoFileIsRefused) {
    const std::filesystem::path pipe =
        std::filesystem::path(testing::TempDir()) / ("pipe-" + std::to_string(getpid()) + ".json");
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    const json creature = {{"creature", {{"name", pipe.string()}, {"slices", nullptr}}}};
    for (const auto& [key, value] : {std::pair("scene", json(pipe.string()).dump()), {"overrides", creature.dump()}}) {
        const Outcome outcome = run_simulator({"evaluate"}, request_with(key, value));
        EXPECT_EQ(outcome.exit_code, 2);
        EXPECT_NE(outcome.err.find("is no regular file"), std::string::npos) << outcome.err;
    }
    std::filesystem::remove(pipe);
}

TEST(BadRequestTest, WithPlainThereIsNothingOnStandardOutput) {
    const Outcome outcome = run_simulator({"evaluate", "--plain"}, "{}");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(lines(outcome.err), 1);
}

TEST(BadRequestTest, ADeviceThatIsNotThereHasItsOwnExitCode) {
    if (!cuda_devices().empty()) GTEST_SKIP() << "there is a GPU";
    const Outcome outcome = run_simulator({"evaluate"}, request_with("backend", "\"cuda\""));
    EXPECT_EQ(outcome.exit_code, 4);
    EXPECT_EQ(lines(outcome.err), 1);
    EXPECT_NE(outcome.err.find("backend = \"cuda\""), std::string::npos) << outcome.err;
    EXPECT_EQ(json::parse(outcome.out).at("status"), "error");
}

}  // namespace
}  // namespace natator::test
