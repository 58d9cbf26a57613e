// natator-sim converge: what comes out, what is kept, and what is refused.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "child_process.h"

namespace natator::test {
namespace {

using nlohmann::json;

const json one_swim = {
    {"id", 5}, {"scene", "thesis/creature-1-vacuum"}, {"gait", json::parse(gait)}, {"duration", 0.1}};

class ConvergeTest : public testing::Test {
protected:
    void SetUp() override {
        folder_ =
            std::filesystem::temp_directory_path() / ("natator-converge-" + std::to_string(getpid()) + "-" +
                                                      testing::UnitTest::GetInstance()->current_test_info()->name());
        std::filesystem::create_directories(folder_);
        record = (folder_ / "runs.jsonl").string();
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::string recorded() const {
        std::ifstream file(record);
        std::ostringstream text;
        text << file.rdbuf();
        return text.str();
    }

    std::string record;

private:
    std::filesystem::path folder_;
};

TEST_F(ConvergeTest, EveryLevelHasItsFigures) {
    const Outcome outcome = run_simulator({"converge", "-", "--starts", "2"}, one_swim.dump());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(lines(outcome.out), 1);
    const json result = json::parse(outcome.out);
    EXPECT_EQ(result["id"], 5);
    EXPECT_FALSE(result.contains("perturbation"));
    ASSERT_EQ(result["levels"].size(), 3u);
    const json &base = result["levels"][0], &time = result["levels"][1], &space = result["levels"][2];
    EXPECT_EQ(base["level"], "base");
    EXPECT_EQ(time["level"], "time/2");
    EXPECT_EQ(space["level"], "spacing/2");
    EXPECT_EQ(base["substeps"], 4);
    EXPECT_EQ(time["substeps"], 8);
    EXPECT_EQ(space["substeps"], 4);
    EXPECT_EQ(base["particles"], 255);
    EXPECT_EQ(space["particles"], 8 * 255);
    EXPECT_EQ(space["fluidRestDistance"].get<double>(), base["fluidRestDistance"].get<double>() / 2);
    for (const json& level : result["levels"]) {
        EXPECT_EQ(level["runs"], 2);
        EXPECT_EQ(level["unstable"], 0);
        EXPECT_EQ(level["stopped"], json({{"completed", 2}}));
        EXPECT_GT(level["distance"]["error"].get<double>(), 0);
        EXPECT_NEAR(level["speed"]["mean"].get<double>(), level["distance"]["mean"].get<double>() / 0.1, 1e-9);
        EXPECT_EQ(level.contains("change"), level["level"] != "base");
    }
    const double speed = base["speed"]["mean"], by_time = time["speed"]["mean"], by_space = space["speed"]["mean"];
    EXPECT_NEAR(result["estimate"]["speed"].get<double>(), 2 * by_time + 2 * by_space - 3 * speed, 1e-9);
    EXPECT_NE(outcome.err.find("spacing/2"), std::string::npos);
}

TEST_F(ConvergeTest, RunsThatAreRecordedAreNotDoneAgain) {
    const std::vector<std::string> command = {"converge", "-",      "--starts", "2",
                                              "--levels", "time/2", "--output", record};
    const Outcome first = run_simulator(command, one_swim.dump());
    ASSERT_EQ(first.exit_code, 0) << first.err;
    const std::string all = recorded();
    ASSERT_EQ(lines(all), 4);
    // Interrupted while the third line was written: it and the fourth are done again.
    const std::size_t second_end = all.find('\n', all.find('\n') + 1) + 1;
    std::ofstream(record, std::ios::trunc) << all.substr(0, second_end + 30);
    const Outcome second = run_simulator(command, one_swim.dump());
    EXPECT_EQ(second.exit_code, 0) << second.err;
    EXPECT_EQ(second.out, first.out);
    EXPECT_NE(second.err.find("base: 2 runs are recorded"), std::string::npos) << second.err;
    EXPECT_EQ(second.err.find("base: run"), std::string::npos) << second.err;
    EXPECT_EQ(recorded(), all);
    // More starts use what is there; another gait does not.
    json other = one_swim;
    other["gait"]["frequency"] = 1.2;
    EXPECT_EQ(
        run_simulator({"converge", "-", "--starts", "3", "--levels", "time/2", "--output", record}, one_swim.dump())
            .exit_code,
        0);
    EXPECT_EQ(lines(recorded()), 6);
    EXPECT_EQ(run_simulator(command, other.dump()).exit_code, 0);
    EXPECT_EQ(lines(recorded()), 10);
}

TEST_F(ConvergeTest, ARecordedRequestGivesItsResult) {
    json in_cells = one_swim;  // where another start is another place in the cells
    in_cells["scene"] = "plane/loach";
    in_cells["duration"] = 0.05;
    const std::vector<double> five(5, 0.1);
    in_cells["gait"] = {{"frequency", 1}, {"amplitude", five}, {"phase", five}};
    for (const json& swim : {one_swim, in_cells})
        ASSERT_EQ(
            run_simulator({"converge", "-", "--starts", "2", "--levels", "spacing/2", "--output", record}, swim.dump())
                .exit_code,
            0);
    std::istringstream text(recorded());
    std::string line;
    for (int k = 0; k < 8; ++k) {
        ASSERT_TRUE(std::getline(text, line));
        const json run = json::parse(line);
        EXPECT_EQ(run["request"]["start"], k % 2 + 1);
        EXPECT_EQ(json::parse(run_simulator({"evaluate"}, run["request"].dump()).out), run["result"]);
    }
}

TEST_F(ConvergeTest, PlainWritesTheTable) {
    const Outcome outcome =
        run_simulator({"converge", "-", "--starts", "2", "--levels", "time/2", "--plain"}, one_swim.dump());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out.rfind("level ", 0), 0u) << outcome.out;
    EXPECT_EQ(lines(outcome.out), 4);
    const std::regex columns(R"(\ntime/2 .*\d \+- [0-9.e-]+ {2,}-?[0-9.e-]+ \+- [0-9.e-]+ {2,}\S)");
    EXPECT_TRUE(std::regex_search(outcome.out, columns)) << outcome.out;
}

/// A body at rest: its speed is nothing but scatter, of which no share can be told.
TEST_F(ConvergeTest, AChangeOfASpeedThatMayBeNoneIsNoShareOfIt) {
    json resting = one_swim;
    resting["scene"] = "thesis/creature-1";
    resting["duration"] = 0.02;
    resting["gait"]["amplitude"] = {0, 0};
    resting["overrides"] = {
        {"settling", {{"updates", 0}}}, {"solver", {{"gravity", {0, 0, 0}}}}, {"fluid", {{"count", {1, 1, 1}}}}};
    const Outcome outcome = run_simulator({"converge", "-", "--starts", "8", "--levels", "time/2"}, resting.dump());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json base = json::parse(outcome.out)["levels"][0], finer = json::parse(outcome.out)["levels"][1];
    const double speed = base["speed"]["mean"], error = base["speed"]["error"];
    ASSERT_LT(std::abs(speed), 2 * error) << base;
    EXPECT_FALSE(finer.contains("change")) << finer;
    EXPECT_TRUE(std::regex_search(outcome.err, std::regex(R"(\ntime/2 .* \+- [0-9.e-]+ length/s\n)"))) << outcome.err;
}

TEST_F(ConvergeTest, APerturbationNeedsNoSeed) {
    json perturbed = one_swim;
    perturbed["perturbation"] = {{"amplitude", 2e-4}};
    const Outcome outcome = run_simulator({"converge", "-", "--starts", "2", "--levels", "time/2"}, perturbed.dump());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(json::parse(outcome.out)["perturbation"], 2e-4);
}

TEST_F(ConvergeTest, BadInputIsRefusedInOneLine) {
    const auto refused = [](const std::vector<std::string>& arguments, const std::string& input, const char* what) {
        const Outcome outcome = run_simulator(arguments, input);
        EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
        EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
        EXPECT_EQ(outcome.out, "");
        EXPECT_NE(outcome.err.find(what), std::string::npos) << outcome.err;
    };
    refused({"converge", "-", "--levels", "time/3"}, one_swim.dump(), "time/3");
    refused({"converge", "-", "--levels", "time/2,time/2"}, one_swim.dump(),
            "--levels: time/2 is given twice; must be given once");
    refused({"converge", "-", "--levels", "time/2", "--levels", "spacing/2,time/2"}, one_swim.dump(),
            "--levels: time/2 is given twice");
    const std::vector<double> eight(8, 0.1);
    const json beside_pillars = {
        {"id", 1}, {"scene", "company/pillars"}, {"gait", {{"frequency", 1}, {"amplitude", eight}, {"phase", eight}}}};
    refused({"converge", "-"}, beside_pillars.dump(), "half the spacing is not known of companions and obstacles");
    refused({"converge", "-", "--starts", "1"}, one_swim.dump(), "--starts");
    refused({"converge", "no-such-file.json"}, "", "no-such-file.json");
    refused({"converge", "-"}, "[]", "request");
    refused({"converge", "-"}, R"({"id":1,"scene":"thesis/tank"})", "creature");
    refused({"converge", "-"}, R"({"id":1,"scene":"thesis/creature-1","start":3})", "start: must not be given");
    json still = one_swim;
    still["perturbation"] = {{"amplitude", 0}};
    refused({"converge", "-"}, still.dump(), "perturbation.amplitude = 0: must be above 0");
    json beyond = one_swim;
    beyond["overrides"] = {{"creature", {{"refinement", 5}}}};
    refused({"converge", "-"}, beyond.dump(), "refinement = 10");
    beyond["overrides"] = {{"solver", {{"substeps", 600}}}};
    refused({"converge", "-"}, beyond.dump(), "substeps = 1200");
    std::ofstream(record) << "not a run\n";
    refused({"converge", "-", "--output", record}, one_swim.dump(), "line 1");
    EXPECT_EQ(recorded(), "not a run\n");
}

TEST_F(ConvergeTest, ARecordedLineThatIsNoRunIsRefused) {
    const std::vector<std::string> command = {"converge", "-",      "--starts", "2",
                                              "--levels", "time/2", "--output", record};
    ASSERT_EQ(run_simulator(command, one_swim.dump()).exit_code, 0);
    const std::string all = recorded(), second = all.substr(all.find('\n') + 1);
    json first = json::parse(all.substr(0, all.find('\n')));
    const std::vector<std::pair<json::json_pointer, json>> faults{{"/result"_json_pointer, "x"},
                                                                  {"/result/distance"_json_pointer, "x"},
                                                                  {"/result/distance"_json_pointer, {}},
                                                                  {"/result/simulated"_json_pointer, "x"},
                                                                  {"/result/status"_json_pointer, 1},
                                                                  {"/result/stopped"_json_pointer, {}},
                                                                  {"/of"_json_pointer, 1}};
    for (const auto& [where, value] : faults) {
        json line = first;
        line[where] = value;
        std::ofstream(record, std::ios::trunc) << first.dump() << "\n" << line.dump() << "\n" << second;
        const Outcome outcome = run_simulator(command, one_swim.dump());
        EXPECT_EQ(outcome.exit_code, 2) << where << outcome.err;
        EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
        EXPECT_NE(outcome.err.find("line 2 is no run of natator-sim converge"), std::string::npos)
            << where << outcome.err;
    }
}

/// Two at once would do the same runs, and write each twice.
TEST_F(ConvergeTest, AFileThatAnotherHasIsRefused) {
    const std::vector<std::string> command = {"converge", "-",      "--starts", "2",
                                              "--levels", "time/2", "--output", record};
    const int other = ::open(record.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    ASSERT_EQ(::flock(other, LOCK_EX), 0);
    const Outcome refused = run_simulator(command, one_swim.dump());
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_EQ(lines(refused.err), 1) << refused.err;
    EXPECT_NE(refused.err.find(record + "\": is in use by another natator-sim converge"), std::string::npos)
        << refused.err;
    EXPECT_EQ(recorded(), "");
    ::close(other);
    EXPECT_EQ(run_simulator(command, one_swim.dump()).exit_code, 0);
    EXPECT_EQ(lines(recorded()), 4);
}

TEST_F(ConvergeTest, AFileThatCannotBeMadeIsAFailureBeforeAnyRun) {
    const Outcome outcome = run_simulator({"converge", "-", "--output", "/no-such-folder/runs.jsonl"}, one_swim.dump());
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
}

TEST_F(ConvergeTest, UnstableRunsAreLeftOutAndToldByTheExitCode) {
    json wild = one_swim;
    wild["scene"] = "thesis/creature-1";
    wild["overrides"] = {{"solver", {{"relaxationMode", "global"}}}};
    const Outcome outcome = run_simulator({"converge", "-", "--starts", "2", "--levels", "time/2"}, wild.dump());
    ASSERT_EQ(outcome.exit_code, 3) << outcome.err;
    const json result = json::parse(outcome.out);
    EXPECT_EQ(result["levels"][0]["unstable"], 2);
    EXPECT_EQ(result["levels"][0]["runs"], 0);
    EXPECT_FALSE(result["levels"][0].contains("speed"));
    EXPECT_FALSE(result.contains("estimate"));
}

}  // namespace
}  // namespace natator::test
