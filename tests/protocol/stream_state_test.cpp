// natator-sim stream: moments that are saved, and gone on from in another process (sim-native/protocol/stream.md).
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "../native/coarse_lake.h"
#include "stream_runs.h"

namespace natator::test {
namespace {

using nlohmann::json;

/// The body of the STAT that `save` sends.
std::string save(StreamClient& client) {
    client.passed();
    EXPECT_EQ(client.ask({{"do", "save"}})["ok"], true);
    const auto passed = client.passed();
    EXPECT_EQ(passed.size(), 1u);
    EXPECT_EQ(passed.at(0).letters, "STAT");
    return passed.at(0).body;
}

std::vector<std::string> all_fields(const std::string& scheme, const std::string& overrides = "{}") {
    return {"--scheme", scheme, "--fields", "position,velocity,density", "--overrides", overrides};
}

TEST(StreamStateTest, AnotherProcessGoesOnWithTheSameBits) {
    const std::string gait_of_8 = R"({"frequency":2,"amplitude":[0.1,0.2,0.3,0.4,0.4,0.5,0.5,0.5],
        "phase":[0,0.9,0.8,0.7,0.6,0.5,0.4,0.3]})";
    for (const auto& [scheme, scene, overrides] :
         {std::tuple<std::string, std::string, std::string>{"flex", small_tank, "{}"},
          {"conserving", small_tank, R"({"settling":{"updates":5}})"},
          {"lattice", "lake/creature-2", coarse_lake.dump()}}) {
        std::vector<std::string> arguments = all_fields(scheme, overrides);
        arguments.insert(arguments.begin(), {scene, "--paused", "--gait", scheme == "lattice" ? gait_of_8 : gait});
        StreamClient first(arguments);
        first.expect("SCEN");
        take_start(first);
        first.passed();
        take_step(first, 4);
        const std::string saved = save(first);
        const StreamFrame expected = take_step(first, 3);

        StreamClient second({scene, "--paused", "--scheme", scheme, "--fields", "position,velocity,density",
                             "--threads", "2", "--overrides", overrides});
        second.expect("SCEN");
        second.send_bytes(message("STAT", saved));
        EXPECT_EQ(second.ask({{"do", "restore"}, {"sense", true}})["senses"]["frame"], 4) << scheme;
        EXPECT_EQ(second.scene()["gait"], first.scene()["gait"]);
        second.passed();
        const StreamFrame seen = take_step(second, 3);
        EXPECT_EQ(hash_of(seen), hash_of(expected)) << scheme;
        EXPECT_EQ(seen.density, expected.density);
        EXPECT_EQ(seen.laws, expected.laws);
        EXPECT_EQ(seen.number, 7u);
        EXPECT_EQ(seen.distance, expected.distance);
        EXPECT_EQ(save(second), save(first));
    }
}

TEST(StreamStateTest, AStreamBranchesFromItsOwnLastState) {
    StreamClient client(paused_in(small_tank, all_fields("flex")));
    client.expect("SCEN");
    EXPECT_EQ(client.ask({{"do", "restore"}})["error"],
              "restore: there is no state; must come behind a STAT, or a save");
    take_step(client, 3);
    save(client);
    std::vector<std::string> seen;
    for (const double drive : {0.5, -0.5, 0.5}) {
        client.ask(credit(1));
        client.ask({{"do", "restore"}});
        const auto passed = client.passed();  // without a SCEN: nothing of it has changed
        ASSERT_EQ(passed.size(), 1u);
        EXPECT_EQ(StreamFrame(passed[0].body, client.scene()).number, 3u);
        client.ask({{"do", "drive"}, {"drive", {drive, drive}}});
        seen.push_back(hash_of(take_step(client, 3)));
    }
    EXPECT_EQ(seen[0], seen[2]);
    EXPECT_NE(seen[0], seen[1]);
}

TEST(StreamStateTest, AStartComesAndGoesWithAState) {
    StreamClient client(paused_in(small_tank, all_fields("flex")));
    client.expect("SCEN");
    const std::string of_its_own = save(client);
    client.ask({{"do", "reset"}, {"start", 3}});
    const std::string of_another = save(client);
    for (const auto& [state, start] : {std::pair<std::string, json>{of_its_own, nullptr}, {of_another, 3}}) {
        client.send_bytes(message("STAT", state));
        EXPECT_EQ(client.ask({{"do", "restore"}})["ok"], true);
        EXPECT_EQ(client.scene()["restarted"], false);
        EXPECT_EQ(client.scene()["start"], start);
        EXPECT_EQ(save(client), state);
    }
}

TEST(StreamStateTest, AFileIsTheStartOfAStream) {
    StreamClient first(paused_in(small_tank, all_fields("flex")));
    first.expect("SCEN");
    take_step(first, 3);
    const auto file = std::filesystem::path(testing::TempDir()) / "natator-stream-state";
    std::ofstream(file, std::ios::binary) << save(first);
    const StreamFrame expected = take_step(first, 2);
    StreamClient second({small_tank, "--state", file.string(), "--paused", "--scheme", "flex", "--fields",
                         "position,velocity,density"});
    second.expect("SCEN");
    EXPECT_EQ(second.scene()["gait"], first.scene()["gait"]);
    EXPECT_EQ(hash_of(take_step(second, 2)), hash_of(expected));

    const Outcome other =
        run_simulator({"stream", "thesis/creature-1", "--scheme", "flex", "--state", file.string()}, "");
    EXPECT_EQ(other.exit_code, 2);
    EXPECT_NE(other.err.find("state: of scene \"bench/small-tank\"; must be of the scene that runs"),
              std::string::npos);
    const Outcome none = run_simulator({"stream", small_tank, "--state", "/no/such"}, "");
    EXPECT_EQ(none.exit_code, 2);
    EXPECT_NE(none.err.find("--state: \"/no/such\" cannot be read"), std::string::npos) << none.err;
    std::filesystem::remove(file);
}

TEST(StreamStateTest, BadStatesAreAnsweredInOneLineAndTheStreamGoesOn) {
    StreamClient client(paused_in(small_tank, all_fields("flex")));
    client.expect("SCEN");
    take_step(client, 3);
    const std::string saved = save(client);
    std::string damaged = saved;
    damaged[damaged.size() / 2] ^= 1;
    for (const auto& [state, reason] : std::vector<std::pair<std::string, std::string>>{
             {"", "restore: there is no state"},
             {"what is this", "state: is no saved state"},
             {saved.substr(0, 1000), "state: is cut off: has 1000 bytes of "},
             {damaged, "state: is damaged: its checksum is another"}}) {
        client.send_bytes(message("STAT", state));
        const std::string said = client.ask({{"do", "restore"}})["error"];
        EXPECT_EQ(said.find(reason), 0u) << said;
    }
    client.send_line("STA");  // no message, and no JSON
    EXPECT_NE(client.expect("ANSW")["error"].get<std::string>().find("not valid JSON"), std::string::npos);
    client.send_bytes(message("STAT", saved) + "\n\n");
    EXPECT_EQ(client.ask({{"do", "restore"}})["ok"], true);
    client.send_bytes(message("STAT", saved).substr(0, 500));
    client.close_input();
    EXPECT_EQ(client.wait(), 0);
}

}  // namespace
}  // namespace natator::test
