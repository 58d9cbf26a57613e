// natator-sim serve: a stream of requests, each answered once by its id.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "child_process.h"

namespace natator::test {
namespace {

using nlohmann::json;

std::string request(int id, const std::string& more = "") {
    return R"({"id":)" + std::to_string(id) +
           R"(,"scene":"thesis/creature-1-vacuum","duration":0.1,"gait":{"frequency":1,"amplitude":[0.5,0.)" +
           std::to_string(id % 10) + R"(],"phase":[0,0.25]})" + more + "}\n";
}

/// The answers by id; -1 stands for null.
std::map<int, json> answers(const Outcome& outcome) {
    std::map<int, json> by_id;
    std::istringstream text(outcome.out);
    for (std::string line; std::getline(text, line);) {
        const json answer = json::parse(line);
        by_id[answer["id"].is_null() ? -1 : answer["id"].get<int>()] = answer;
    }
    return by_id;
}

TEST(ServeProtocolTest, EveryRequestIsAnsweredAsEvaluateAnswersIt) {
    const Outcome served = run_simulator({"serve"}, request(1) + "\n" + request(2) + request(3));
    EXPECT_EQ(served.exit_code, 0) << served.err;
    EXPECT_EQ(served.err, "");
    EXPECT_EQ(lines(served.out), 3);
    const auto by_id = answers(served);
    for (const int id : {1, 2, 3}) {
        ASSERT_TRUE(by_id.contains(id));
        EXPECT_EQ(by_id.at(id), json::parse(run_simulator({"evaluate"}, request(id)).out));
    }
    EXPECT_NE(by_id.at(1)["hash"], by_id.at(2)["hash"]);
}

TEST(ServeProtocolTest, ABadRequestSpoilsNoOther) {
    const Outcome served =
        run_simulator({"serve"}, request(1) + "{half a li\n" + request(2, R"(,"speed":9)") + request(3) + "[]\n");
    EXPECT_EQ(served.exit_code, 0) << served.err;
    const auto by_id = answers(served);
    EXPECT_EQ(by_id.at(1)["status"], "ok");
    EXPECT_EQ(by_id.at(3)["status"], "ok");
    EXPECT_EQ(by_id.at(2)["status"], "error");
    EXPECT_NE(by_id.at(2)["error"].get<std::string>().find("speed"), std::string::npos);
    EXPECT_EQ(by_id.at(-1)["status"], "error");
    EXPECT_EQ(lines(served.out), 5);
}

TEST(ServeProtocolTest, RequestsThatDifferInTheirIdsOnlyAreEvaluatedOnce) {
    const std::string same = R"(,"scene":"thesis/creature-1-vacuum","duration":0.1,"gait":{"frequency":1,)"
                             R"("amplitude":[0.5,0.5],"phase":[0,0.25]}})";
    const std::string other_order = R"({"duration":0.1,"gait":{"phase":[0,0.25],"amplitude":[0.5,0.5],"frequency":1},)"
                                    R"("scene":"thesis/creature-1-vacuum","id":3,"$schema":"request.schema.json"})";
    const Outcome served = run_simulator(
        {"serve", "--summary"}, "{\"id\":1" + same + "\n{\"id\":2" + same + "\n" + other_order + "\n" + request(4));
    EXPECT_EQ(served.err, "natator-sim: 4 requests, 2 evaluations\n");
    EXPECT_EQ(run_simulator({"serve", "--summary"}, request(1)).err, "natator-sim: 1 request, 1 evaluation\n");
    const auto by_id = answers(served);
    ASSERT_EQ(by_id.size(), 4u);
    json third = by_id.at(3), fourth = by_id.at(4);
    for (json* answer : {&third, &fourth}) (*answer)["id"] = 1;
    EXPECT_EQ(third, by_id.at(1));
    EXPECT_NE(fourth, by_id.at(1));
}

/// A line beyond the limit is answered without being kept, and so is one that needs more memory or time than there is.
TEST(ServeProtocolTest, ALineThatIsTooLongSpoilsNoOther) {
    std::string text = R"({"id":1,"scene":"thesis/creature-1-vacuum","gait":[)";
    text.append(40u << 20, '0').append("]}\n");
    const Outcome served = run_simulator({"serve"}, text + request(2));
    EXPECT_EQ(served.exit_code, 0) << served.err;
    const auto by_id = answers(served);
    EXPECT_EQ(by_id.at(-1)["error"], "request: larger than 16 MiB");
    EXPECT_EQ(by_id.at(2)["status"], "ok");
}

TEST(ServeProtocolTest, ARequestThatCostsTooMuchSpoilsNoOther) {
    const Outcome served = run_simulator(
        {"serve"}, request(1, R"(,"overrides":{"solver":{"radius":1000}})") +
                       request(2, R"(,"overrides":{"settling":{"updates":1000000,"substeps":1000}})") + request(3));
    EXPECT_EQ(served.exit_code, 0) << served.err;
    const auto by_id = answers(served);
    EXPECT_NE(by_id.at(1)["error"].get<std::string>().find("solver.fluidRestDistance = 0.1"), std::string::npos);
    EXPECT_NE(by_id.at(2)["error"].get<std::string>().find("must be at most 5e+12"), std::string::npos);
    EXPECT_EQ(by_id.at(3)["status"], "ok");
}

TEST(ServeProtocolTest, ARequestWithoutMemorySpoilsNoOther) {
    if (sanitized()) GTEST_SKIP() << "sanitizers reserve more memory than this";
    const std::string large = R"({"id":1,"scene":"thesis/tank","duration":0.1,"overrides":)"
                              R"({"planes":[],"fluid":{"count":[160,160,160]}}})";
    const Outcome served = run_with_memory(400u << 20, {"serve", "--no-cache"}, large + "\n" + request(2));
    EXPECT_EQ(served.exit_code, 0) << served.err;
    const auto by_id = answers(served);
    ASSERT_TRUE(by_id.contains(1) && by_id.contains(2)) << served.out << served.err;
    EXPECT_NE(by_id.at(1)["error"].get<std::string>().find("memory"), std::string::npos) << by_id.at(1);
    EXPECT_EQ(by_id.at(2)["status"], "ok");
}

TEST(ServeProtocolTest, TheLastLineNeedsNoEnd) {
    std::string text = request(1);
    text.pop_back();
    EXPECT_EQ(lines(run_simulator({"serve"}, text).out), 1);
    const Outcome nothing = run_simulator({"serve"}, "");
    EXPECT_EQ(nothing.exit_code, 0);
    EXPECT_EQ(nothing.out, "");
}

/// Nothing that the program opens is taken for it: that was awaited for ever.
TEST(ServeProtocolTest, AClosedInputHasNoRequests) {
    const Outcome outcome = run_limited("exec <&-", {"serve"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.out + outcome.err, "");
}

TEST(ServeProtocolTest, AFolderIsNoInput) {
    using Words = std::vector<std::string>;
    for (const Words& command : {Words{"serve"}, Words{"stream", "bench/small-tank", "--paused"}}) {
        const Outcome outcome = run_limited("exec </tmp", command);
        EXPECT_EQ(outcome.exit_code, 2);
        EXPECT_EQ(outcome.err,
                  "natator-sim: standard input: cannot be read (Is a directory); must be a file, a pipe or a "
                  "terminal\n");
    }
}

TEST(ServeProtocolTest, AnsweringIntoAFullDiskIsAFailure) {
    EXPECT_EQ(run_simulator({"serve"}, request(1), "/dev/full").exit_code, 1);
}

/// Device 1023 is nowhere, so these hold on machines with a GPU too.
TEST(BackendTest, AMissingGpuIsSaidOnceAndHasAnExitCode) {
    const Outcome cuda = run_simulator({"serve", "--backend", "cuda", "--device", "1023"}, request(1));
    EXPECT_EQ(cuda.exit_code, 4);
    EXPECT_EQ(cuda.out, "");
    EXPECT_EQ(lines(cuda.err), 1);
    EXPECT_NE(cuda.err.find("device 1023"), std::string::npos) << cuda.err;

    const Outcome automatic =
        run_simulator({"serve", "--backend", "auto", "--device", "1023"}, request(1) + request(2));
    EXPECT_EQ(automatic.exit_code, 0);
    EXPECT_EQ(lines(automatic.out), 2);
    EXPECT_EQ(lines(automatic.err), 1);
    EXPECT_NE(automatic.err.find("using the CPU"), std::string::npos) << automatic.err;
}

}  // namespace
}  // namespace natator::test
