// natator-sim stream driven from outside: actuator values, steering, senses, in lock-step
// (sim-native/protocol/stream.md).
#include <gtest/gtest.h>

#include <set>

#include "../native/small_pair.h"
#include "stream_runs.h"

namespace natator::test {
namespace {

using nlohmann::json;

const json skin_places = {
    {{"slice", 1}, {"side", "left"}}, {{"slice", 1}, {"side", "right"}}, {{"slice", 4}, {"side", "above"}}};
const json all_senses{{"do", "sense"}, {"flow", skin_places}, {"target", {3, 0.5, 0.4}}};

std::vector<std::string> driven_in(const std::string& scene, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{scene, "--paused", "--fields", "position,velocity"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

/// A step of so many frames with these values; its senses.
json driven_step(StreamClient& client, const json& drive, int frames = 1) {
    const json answer = client.ask({{"do", "step"}, {"frames", frames}, {"drive", drive}, {"sense", true}});
    EXPECT_TRUE(answer.contains("senses")) << answer;
    return answer.value("senses", json::object());
}

/// The last frame of a client that has dropped all before it.
std::string state_of(StreamClient& client) {
    return hash_of(take_step(client));
}

/// A controller that turns towards where the water comes from, by what it senses: it is in the loop.
std::pair<json, std::string> swim_in_the_loop(const std::vector<std::string>& more) {
    StreamClient client(driven_in(small_tank, more));
    client.expect("SCEN");
    json senses = client.ask(all_senses).at("senses");
    for (int turn = 0; turn < 6; ++turn) {
        const double left = senses["flow"][0]["velocity"][2], bend = senses["bend"][0];
        senses = driven_step(client, {std::clamp(0.5 + left, -1.0, 1.0), std::clamp(-0.5 * bend, -1.0, 1.0)}, 2);
    }
    return {senses, state_of(client)};
}

TEST(StreamDriveTest, TheSameCommandsGiveTheSameBits) {
    for (const char* scheme : {"flex", "conserving"}) {
        const auto once = swim_in_the_loop({"--scheme", scheme}),
                   again = swim_in_the_loop({"--scheme", scheme, "--threads", "2"});
        EXPECT_EQ(once.first, again.first);
        EXPECT_EQ(once.second, again.second);
        EXPECT_EQ(once.first["frame"], 12);
        EXPECT_EQ(once.first.contains("work"), std::string(scheme) == "conserving");
        EXPECT_NE(swim_in_the_loop({"--scheme", scheme, "--start", "3"}).second, once.second);
    }
}

TEST(StreamDriveTest, ValuesForEachFrameAreStepsOneByOne) {
    const json rows = {{0.1, 0.2}, {0.4, -0.3}, {-1, 1}};
    StreamClient together(driven_in(small_tank)), apart(driven_in(small_tank)), other(driven_in(small_tank));
    for (StreamClient* client : {&together, &apart, &other}) client->expect("SCEN");
    const json senses = driven_step(together, rows, 3);
    json last;
    for (const json& row : rows) last = driven_step(apart, row);
    driven_step(other, rows[0], 3);
    EXPECT_EQ(senses, last);
    EXPECT_EQ(senses["drive"], rows[2]);
    const std::string expected = state_of(apart);
    EXPECT_EQ(state_of(together), expected);
    EXPECT_NE(state_of(other), expected);
    EXPECT_EQ(together.ask({{"do", "step"}, {"drive", rows}})["ok"], true);  // frames may be left out
    EXPECT_EQ(take_step(together).number, 3 + 1 + 3 + 1u);
}

TEST(StreamDriveTest, ARunningStreamTakesValuesFromTheNextFrameOn) {
    StreamClient client({small_tank, "--rate", "0", "--lossless", "--fields", "none"});
    client.expect("SCEN");
    client.ask({{"do", "drive"}, {"drive", {0.25, -0.5}}});
    client.passed();
    client.ask(credit(3));
    std::vector<float> drive;
    for (int k = 0; k < 3; ++k) drive = client.frame().drive;
    EXPECT_EQ(drive, (std::vector<float>{0.25, -0.5}));
    client.ask({{"do", "steer"}});  // back to the gait: at rest
    client.passed();
    client.ask(credit(5));
    for (int k = 0; k < 3; ++k) drive = client.frame().drive;
    EXPECT_EQ(drive, (std::vector<float>{0, 0}));
}

TEST(StreamDriveTest, SteeringScalesTheGaitAndAddsToIt) {
    StreamClient steered(paused_in(small_tank)), plain(paused_in(small_tank));
    for (StreamClient* client : {&steered, &plain}) {
        client->expect("SCEN");
        take_start(*client);
    }
    steered.ask({{"do", "steer"}, {"scale", {0.5, 1}}, {"offset", {0.25, -0.125}}});
    const std::vector<float> changed = take_step(steered, 5).drive, as_it_is = take_step(plain, 5).drive;
    EXPECT_FLOAT_EQ(changed[0], 0.5f * as_it_is[0] + 0.25f);
    EXPECT_FLOAT_EQ(changed[1], as_it_is[1] - 0.125f);
    EXPECT_EQ(steered.ask({{"do", "step"}, {"offset", {0, 0}}, {"sense", true}})["senses"]["drive"][1],
              plain.ask({{"do", "step"}, {"sense", true}})["senses"]["drive"][1]);
}

TEST(StreamDriveTest, SensesComeInAnswersAndBeforeFrames) {
    StreamClient client(driven_in(small_tank));
    client.expect("SCEN");
    take_start(client);
    const json start = client.ask(all_senses).at("senses");
    EXPECT_EQ(start["frame"], 0);
    EXPECT_EQ(start["forward"], json({1, 0, 0}));
    EXPECT_EQ(start["velocity"], json({0, 0, 0}));
    EXPECT_EQ(start["flow"].size(), 3u);
    EXPECT_GT(start["flow"][0]["particles"], 0);
    const double way = 3 - start["centre"][0].get<double>();
    EXPECT_NEAR(start["target"]["distance"], way, 0.02);
    EXPECT_GT(start["target"]["direction"][0], 0.99);

    client.ask({{"do", "sense"}, {"each", true}, {"target", nullptr}});
    client.ask(credit(2));
    client.passed();
    client.ask({{"do", "step"}, {"frames", 3}});
    const auto sent = client.passed();
    ASSERT_EQ(sent.size(), 2u);
    EXPECT_EQ(sent[0].letters, "SENS");
    EXPECT_EQ(sent[0].value()["frame"], 3);
    EXPECT_EQ(sent[0].value()["flow"].size(), 3u);
    EXPECT_FALSE(sent[0].value().contains("target"));
    EXPECT_EQ(sent[1].letters, "FRAM");

    client.ask({{"do", "reset"}});  // what is asked for stays
    EXPECT_EQ(client.ask({{"do", "step"}, {"sense", true}})["senses"]["flow"].size(), 3u);
    client.ask({{"do", "scene"}, {"scene", vacuum}});  // of another body it is unknown
    EXPECT_FALSE(client.ask({{"do", "step"}, {"sense", true}})["senses"].contains("flow"));
}

/// Without a word of them companions beat by their own gaits.
TEST(StreamDriveTest, CommandsAreForTheFirstSwimmerUnlessTheySayMore) {
    const json overrides = {
        {"fluid", nullptr},
        {"companions",
         {{{"creature", {{"name", "ray"}, {"rearCentre", {0.5, 0.6, 3}}}},
           {"gait", {{"frequency", 2}, {"amplitude", {0.5, 0.5, 0.5, 0.5, 0.5}}, {"phase", {0, 0, 0, 0, 0}}}}}}}};
    StreamClient client(driven_in(vacuum, {"--overrides", overrides.dump()}));
    const json scene = client.expect("SCEN");
    ASSERT_EQ(scene["actuators"], 2);
    std::set<std::string> ways;
    for (const json& muscle : scene["muscles"])
        ways.insert(muscle.value("bend", "sideways") + (muscle["actuator"] < 2 ? " own" : " companion"));
    EXPECT_EQ(ways, (std::set<std::string>{"sideways own"}));
    const json senses = driven_step(client, {0.5, -0.5}, 3);
    EXPECT_EQ(senses["drive"], json({0.5, -0.5}));
    EXPECT_EQ(senses["bend"].size(), 2u);
    ASSERT_EQ(senses.at("companions").size(), 1u);
    EXPECT_NE(senses.at("companions")[0]["drive"][0], 0);
    EXPECT_EQ(client.ask({{"do", "drive"}, {"drive", {1, 1, 1}}})["error"],
              "drive has length 3: must have length 2, one value per actuator of the creature, or 7, of all swimmers");
}

std::vector<std::string> pair_in(const std::string& scheme, std::vector<std::string> more = {}) {
    more.insert(more.end(), {"--scheme", scheme, "--overrides", small_pair.dump()});
    return driven_in(small_tank, more);
}

/// Each by itself, or all by one command.
TEST(StreamDriveTest, CompanionsAreSteeredAndSense) {
    for (const std::string scheme : {"flex", "conserving"}) {
        StreamClient apart(pair_in(scheme)), together(pair_in(scheme, {"--threads", "2"}));
        for (StreamClient* client : {&apart, &together}) {
            const json scene = client->expect("SCEN");
            const json companion = scene["companions"][0];
            EXPECT_EQ(companion.at("actuators"), 3);
            EXPECT_EQ(companion.at("gait")["amplitude"], json({0.5, 0.4, 0.3}));
            EXPECT_EQ(companion.at("joints"), json({1, 3, 5, 7}));
            std::set<int> actuators;
            for (const json& muscle : companion.at("muscles")) actuators.insert(muscle["actuator"].get<int>());
            EXPECT_EQ(actuators, (std::set<int>{0, 1, 2}));
            const json senses = client->ask(
                {{"do", "sense"}, {"swimmer", 1}, {"flow", skin_places}, {"target", {1, 0.5, 0.4}}})["senses"];
            EXPECT_FALSE(senses.contains("flow"));
            EXPECT_EQ(senses["companions"][0]["flow"].size(), 3u);
            EXPECT_GT(senses["companions"][0]["target"]["distance"], 0);
        }
        apart.ask({{"do", "drive"}, {"swimmer", 1}, {"drive", {0.1, -0.2, 0.3}}});
        apart.ask({{"do", "step"}, {"swimmer", 0}, {"drive", {0.4, 0.5}}});
        apart.ask({{"do", "step"}, {"swimmer", 1}, {"frames", 2}, {"drive", {{0.6, 0, 0}, {0.7, 0, 0}}}});
        const json last = apart.ask({{"do", "steer"}, {"swimmer", 1}, {"scale", {0.5, 0.5, 0.5}}});
        EXPECT_EQ(last["ok"], true) << last;
        const json senses = apart.ask({{"do", "step"}, {"sense", true}})["senses"];
        together.ask({{"do", "step"}, {"drive", {0.4, 0.5, 0.1, -0.2, 0.3}}});
        together.ask({{"do", "step"}, {"drive", {{0.4, 0.5, 0.6, 0, 0}, {0.4, 0.5, 0.7, 0, 0}}}});
        together.ask({{"do", "steer"}, {"scale", {0, 0, 0.5, 0.5, 0.5}}, {"offset", {0.4, 0.5, 0, 0, 0}}});
        EXPECT_EQ(together.ask({{"do", "step"}, {"sense", true}})["senses"], senses);
        EXPECT_EQ(senses["drive"], json({0.4, 0.5}));
        EXPECT_EQ(senses["companions"][0].contains("work"), scheme == "conserving");
        EXPECT_EQ(state_of(together), state_of(apart));

        json gait = json::parse(R"({"frequency":3,"amplitude":[0.2,0.2,0.2],"phase":[0,0,0]})");
        apart.passed();
        EXPECT_EQ(apart.ask({{"do", "gait"}, {"swimmer", 1}, {"gait", gait}})["ok"], true);
        EXPECT_EQ(apart.passed().at(0).value()["companions"][0]["gait"]["frequency"], 3);
        apart.ask({{"do", "save"}});
        const std::string saved = apart.passed().at(0).body;
        together.send_bytes(message("STAT", saved));
        EXPECT_EQ(together.ask({{"do", "restore"}})["ok"], true);
        EXPECT_EQ(together.scene()["companions"][0]["gait"]["frequency"], 3);
        together.passed();
        EXPECT_EQ(driven_step(together, {0.1, 0.1}, 3), driven_step(apart, {0.1, 0.1}, 3));
        EXPECT_EQ(state_of(together), state_of(apart));
    }
}

TEST(StreamDriveTest, WhatIsWrongWithACompanionNamesItAndChangesNothing) {
    StreamClient client(pair_in("flex")), untouched(pair_in("flex"));
    for (StreamClient* each : {&client, &untouched}) each->expect("SCEN");
    const auto error_of = [&](const json& command) { return client.ask(command)["error"].get<std::string>(); };
    const std::string not_there = "swimmer = 2: must be in [0, 1], the creature and its companions";
    for (const json& command :
         {json{{"do", "drive"}, {"drive", {0, 0, 0}}}, json{{"do", "sense"}}, json{{"do", "steer"}},
          json{{"do", "step"}, {"offset", {0, 0, 0}}},
          json{{"do", "gait"}, {"gait", {{"frequency", 1}, {"amplitude", {0, 0, 0}}, {"phase", {0, 0, 0}}}}}}) {
        json of_another = command;
        of_another["swimmer"] = 2;
        EXPECT_EQ(error_of(of_another), not_there) << command;
    }
    EXPECT_EQ(error_of({{"do", "drive"}, {"swimmer", 1}, {"drive", {0, 0}}}),
              "swimmer 1: drive has length 2: must have length 3, one value per actuator of the creature");
    EXPECT_EQ(error_of({{"do", "step"}, {"swimmer", 1}, {"drive", {{0, 0, 0}, {0, 5, 0}}}}),
              "swimmer 1: drive[1][1] = 5: must be a number in [-2, 2]");
    EXPECT_EQ(error_of({{"do", "step"}, {"drive", {1, 1, 0, 0, -3}}}),
              "swimmer 1: drive[2] = -3: must be a number in [-2, 2]");
    EXPECT_EQ(error_of({{"do", "steer"}, {"scale", {1, 1, 9, 1, 1}}}),
              "swimmer 1: scale[0] = 9: must be a number in [0, 4]");
    EXPECT_EQ(error_of({{"do", "sense"}, {"swimmer", 1}, {"flow", {{{"slice", 9}, {"side", "left"}}}}}),
              "swimmer 1: flow[0].slice = 9: must be a slice of the body, in [0, 8]");
    EXPECT_EQ(error_of({{"do", "step"}, {"swimmer", 1}}),
              "command: swimmer: must come with drive, scale or offset, for it");
    EXPECT_EQ(error_of({{"do", "run"}, {"swimmer", 1}}).find("command: swimmer"), 0u);
    client.send_line(R"({"do":"drive","swimmer":1,"drive":[0,null,0],"id":3})");
    EXPECT_NE(client.expect("ANSW")["error"].get<std::string>().find("drive[1] = null"), std::string::npos);
    for (StreamClient* each : {&client, &untouched}) take_start(*each);
    EXPECT_EQ(hash_of(take_step(client, 3)), hash_of(take_step(untouched, 3)));
}

TEST(StreamDriveTest, ResetChoosesTheStart) {
    StreamClient client(paused_in(small_tank, {"--fields", "position,velocity"}));
    client.expect("SCEN");
    std::vector<std::string> seen;
    for (const int start : {4, 5, 4}) {
        client.ask({{"do", "reset"}, {"start", start}});
        EXPECT_EQ(client.scene()["start"], start);
        client.passed();
        take_start(client);
        seen.push_back(hash_of(take_step(client, 6)));
    }
    const json request{{"id", 1},
                       {"scene", small_tank},
                       {"gait", json::parse(gait)},
                       {"duration", 0.1},
                       {"start", 4},
                       {"overrides", {{"stopping", {{"planeContact", false}, {"noProgressAfter", 0}}}}}};
    EXPECT_EQ(seen[0], json::parse(run_simulator({"evaluate"}, request.dump()).out)["hash"]);
    EXPECT_NE(seen[1], seen[0]);
    EXPECT_EQ(seen[2], seen[0]);
}

TEST(StreamDriveTest, BadCommandsAreAnsweredInOneLineAndChangeNothing) {
    StreamClient client(driven_in(small_tank)), untouched(driven_in(small_tank));
    for (StreamClient* each : {&client, &untouched}) {
        each->expect("SCEN");
        EXPECT_EQ(each->ask({{"do", "drive"}, {"drive", {0.5, 0.5}}})["ok"], true);
    }
    const std::vector<std::pair<std::string, std::string>> bad{
        {R"({"do":"drive"})", "command: drive: missing; must be given"},
        {R"({"do":"drive","drive":0.5})", "command: drive = 0.5: must be an array of numbers, one per actuator"},
        {R"({"do":"drive","drive":[1]})",
         "drive has length 1: must have length 2, one value per actuator of the creature"},
        {R"({"do":"drive","drive":[1,2.01]})", "drive[1] = 2.01: must be a number in [-2, 2]"},
        {R"({"do":"drive","drive":[1,null]})", "command: drive[1] = null: must be a number"},
        {R"({"do":"step","drive":[1,"a"]})", "command: drive[1] = \"a\": must be a number"},
        {R"({"do":"step","drive":[[1,1],[1,1]],"frames":3})",
         "command: drive: has 2 lists: must have one for each of the 3 frames"},
        {R"({"do":"step","drive":[[1,1],[1,9]]})", "drive[1][1] = 9: must be a number in [-2, 2]"},
        {R"({"do":"step","drive":[1,1],"offset":[0,0]})",
         "command: drive: must not be given together with scale or offset"},
        {R"({"do":"steer","scale":[1,5]})", "scale[1] = 5: must be a number in [0, 4]"},
        {R"({"do":"steer","drive":[1,1]})", "command: drive: unknown"},
        {R"({"do":"sense","flow":[{"slice":9,"side":"left"}]})",
         "flow[0].slice = 9: must be a slice of the body, in [0, 8]"},
        {R"({"do":"sense","flow":[{"slice":0,"side":"port"}]})", "command: flow[0].side = \"port\": must be \"left\""},
        {R"({"do":"sense","target":[1,2]})", "command: target = [1,2]: must be an array of 3 numbers"},
        {R"({"do":"reset","start":-1})", "command: start = -1: must be"},
        {R"({"do":"drive","drive":[NaN,1]})", "not valid JSON"},
        {R"({"do":"drive","drive":[1e999,1]})", "command: "}};
    for (const auto& [command, reason] : bad) {
        client.send_line(command);
        const json answer = client.expect("ANSW");
        ASSERT_TRUE(answer.contains("error")) << command;
        EXPECT_NE(answer["error"].get<std::string>().find(reason), std::string::npos) << answer;
        EXPECT_EQ(answer["error"].get<std::string>().find('\n'), std::string::npos);
    }
    EXPECT_EQ(state_of(client), state_of(untouched));
    client.ask({{"do", "scene"}, {"scene", "thesis/tank"}});
    EXPECT_NE(client.ask({{"do", "sense"}})["error"].get<std::string>().find("no creature"), std::string::npos);
    EXPECT_NE(client.ask({{"do", "step"}, {"sense", true}})["error"].get<std::string>().find("no creature"),
              std::string::npos);
}

}  // namespace
}  // namespace natator::test
