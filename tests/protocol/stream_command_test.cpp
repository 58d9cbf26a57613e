// natator-sim stream: what its commands do (sim-native/protocol/stream.md).
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <set>

#include "stream_runs.h"

namespace natator::test {
namespace {

using nlohmann::json;

TEST(StreamCommandTest, PauseHoldsStillAndStepsGoFrameByFrame) {
    StreamClient client(paused_in(vacuum, {"--fields", "position,velocity"}));
    client.expect("SCEN");
    take_start(client);
    EXPECT_EQ(client.ask({{"do", "run"}})["ok"], true);
    EXPECT_EQ(client.ask({{"do", "pause"}})["ok"], true);
    client.passed();
    client.ask(credit(3));
    ::usleep(50'000);
    client.ask(credit(3));
    EXPECT_TRUE(client.passed().empty());

    const StreamFrame here = take_step(client);
    EXPECT_EQ(here.flags, 0u);
    const StreamFrame next = take_step(client, 5);
    EXPECT_EQ(next.number, here.number + 5);
    EXPECT_EQ(hash_of(next), evaluated(vacuum, static_cast<int>(next.number))["hash"].get<std::string>());
}

TEST(StreamCommandTest, StepsWithoutCreditAreDroppedOrWait) {
    StreamClient lossy(paused_in(vacuum));
    lossy.expect("SCEN");
    lossy.ask({{"do", "step"}, {"frames", 4}});
    EXPECT_TRUE(lossy.passed().empty());
    const StreamFrame frame = take_step(lossy, 2);
    EXPECT_EQ(frame.number, 6u);
    EXPECT_EQ(frame.dropped, 2u);  // the start and frame 4, the only ones that were offered

    StreamClient lossless(paused_in(vacuum, {"--lossless"}));
    lossless.expect("SCEN");
    EXPECT_NE(lossless.ask(step)["error"].get<std::string>().find("waits for credit"), std::string::npos);
    EXPECT_EQ(take_start(lossless).number, 0u);
    EXPECT_EQ(lossless.ask(step)["ok"], true);
    lossless.ask({{"do", "pause"}});
    EXPECT_TRUE(lossless.passed().empty());
    lossless.ask(credit(1));
    EXPECT_EQ(lossless.frame().number, 1u);
}

TEST(StreamCommandTest, TheRateHoldsFramesBack) {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    StreamClient client({vacuum, "--gait", gait, "--lossless", "--rate", "1"});
    client.expect("SCEN");
    client.ask(credit(1000));
    while (client.frame().number < 12) continue;
    EXPECT_GT(std::chrono::duration<double>(Clock::now() - begin).count(), 10.0 / 60);

    EXPECT_EQ(client.ask({{"do", "rate"}, {"value", 0.001}})["ok"], true);  // 17 s for a frame
    const auto slow = Clock::now();
    client.passed();
    for (int i = 0; i < 100; ++i) client.ask(credit(1));
    const std::size_t frames = client.passed().size();
    // one that was ready when the rate came, and the next, which comes at once
    EXPECT_TRUE(frames <= 2 || Clock::now() - slow > std::chrono::seconds(15)) << frames;
    EXPECT_EQ(client.ask({{"do", "rate"}, {"value", 0}})["ok"], true);
    client.passed();
    for (int i = 0; i < 100; ++i) client.frame();
}

TEST(StreamCommandTest, ResetGivesTheSameBits) {
    StreamClient client(paused_in(water, {"--fields", "position,velocity"}));
    client.expect("SCEN");
    const std::string start = hash_of(take_start(client)), later = hash_of(take_step(client, 3));
    EXPECT_EQ(client.ask(step)["ok"], true);  // without credit: dropped
    EXPECT_TRUE(client.passed().empty());
    EXPECT_EQ(client.ask({{"do", "reset"}})["ok"], true);
    ASSERT_EQ(client.passed().size(), 1u);
    EXPECT_EQ(client.scene()["number"], 2);
    EXPECT_EQ(client.scene()["restarted"], true);
    const StreamFrame again = take_start(client);
    EXPECT_EQ(again.number, 0u);
    EXPECT_EQ(again.dropped, 0u);
    EXPECT_EQ(hash_of(again), start);
    EXPECT_EQ(hash_of(take_step(client, 3)), later);
}

TEST(StreamCommandTest, AGaitChangesTheNextFrame) {
    StreamClient client(paused_in(vacuum)), unchanged(paused_in(vacuum));
    for (StreamClient* each : {&client, &unchanged}) each->expect("SCEN");
    take_start(client);
    EXPECT_EQ(take_step(client, 3).position, (take_start(unchanged), take_step(unchanged, 3)).position);
    json other = json::parse(gait);
    other["amplitude"] = {0.2, 0.3};
    EXPECT_EQ(client.ask({{"do", "gait"}, {"gait", other}})["ok"], true);
    EXPECT_EQ(client.passed().size(), 1u);
    EXPECT_EQ(client.scene()["number"], 2);
    EXPECT_EQ(client.scene()["restarted"], false);
    EXPECT_EQ(client.scene()["gait"]["amplitude"], other["amplitude"]);
    const StreamFrame changed = take_step(client), as_before = take_step(unchanged);
    EXPECT_EQ(changed.number, 4u);
    EXPECT_NE(changed.position, as_before.position);
    EXPECT_LE(std::abs(changed.drive[0]), 0.2);
}

TEST(StreamCommandTest, OverridesGoOnOrRestart) {
    StreamClient client(paused_in(water, {"--fields", "position,velocity"}));
    client.expect("SCEN");
    take_start(client);
    take_step(client, 2);
    const double viscosity = client.scene()["definition"]["solver"].value("viscosity", 10.0);
    EXPECT_EQ(client.ask({{"do", "overrides"}, {"overrides", {{"duration", 9}}}})["ok"], true);
    EXPECT_EQ(client.scene()["restarted"], false);
    EXPECT_EQ(client.scene()["duration"], 9);
    client.passed();
    EXPECT_EQ(hash_of(take_step(client, 2)), evaluated(water, 4)["hash"].get<std::string>());

    const json thicker{{"solver", {{"viscosity", viscosity + 20}}}};
    EXPECT_EQ(client.ask({{"do", "overrides"}, {"overrides", thicker}})["ok"], true);
    EXPECT_EQ(client.scene()["overrides"], json({{"duration", 9}, {"solver", thicker["solver"]}}));
    client.passed();
    const StreamFrame next = take_step(client);
    EXPECT_EQ(next.number, 5u);
    EXPECT_NE(hash_of(next), evaluated(water, 5)["hash"].get<std::string>());

    const json shallower{{"fluid", {{"count", {50, 4, 17}}}}};
    EXPECT_EQ(client.ask({{"do", "overrides"}, {"overrides", shallower}})["ok"], true);
    EXPECT_EQ(client.scene()["restarted"], true);
    EXPECT_LT(client.scene()["particles"], 5000);
    client.passed();
    const StreamFrame start = take_start(client);
    EXPECT_EQ(start.number, 0u);
    EXPECT_EQ(start.scene, 4u);
}

/// What a slider sends is answered by what it changes, not by the masses and muscles of the whole scene.
TEST(StreamCommandTest, AChangeThatGoesOnIsToldInShort) {
    StreamClient client(paused_in(water));
    EXPECT_GT(client.expect("SCEN").dump().size(), 50'000u);
    take_start(client);
    const json whole = client.scene();
    client.ask({{"do", "overrides"}, {"overrides", {{"solver", {{"viscosity", 3}}}}}});
    const std::vector<StreamMessage> told = client.passed();
    ASSERT_EQ(told.size(), 1u);
    const json change = told[0].value();
    EXPECT_LT(change.dump().size(), 4'000u);
    std::set<std::string> keys;
    for (const auto& [key, value] : change.items()) keys.insert(key);
    EXPECT_EQ(keys, (std::set<std::string>{"definition", "number", "overrides", "restarted"}));
    EXPECT_EQ(client.scene()["definition"]["solver"]["viscosity"], 3);
    EXPECT_EQ(client.scene()["mass"], whole["mass"]);

    json other = json::parse(gait);
    other["frequency"] = 0.75;
    client.ask({{"do", "gait"}, {"gait", other}});
    EXPECT_LT(client.passed().at(0).body.size(), 300u);
    client.ask({{"do", "reset"}});
    json again = client.passed().at(0).value();
    EXPECT_EQ(again["mass"], whole["mass"]);
    EXPECT_EQ(again["gait"]["frequency"], 0.75);
    EXPECT_EQ(take_start(client).number, 0u);
}

TEST(StreamCommandTest, AnotherSceneRestarts) {
    StreamClient client(paused_in(water));
    client.expect("SCEN");
    EXPECT_EQ(client.ask({{"do", "scene"}, {"scene", "thesis/creature-2-vacuum"}})["ok"], true);
    client.passed();
    EXPECT_EQ(client.scene()["actuators"], 8);
    EXPECT_EQ(client.scene()["fluid"], json::parse("[0,0]"));
    EXPECT_EQ(client.scene()["gait"]["amplitude"], json(std::vector<double>(8, 0)));
    EXPECT_EQ(take_start(client).drive.size(), 8u);
}

TEST(StreamCommandTest, BadCommandsAreAnsweredAndChangeNothing) {
    StreamClient client(paused_in(vacuum, {"--fields", "position,velocity"}));
    client.expect("SCEN");
    take_start(client);
    take_step(client, 2);
    const std::vector<std::pair<std::string, std::string>> bad{
        {"{half", "not valid JSON"},
        {"[]", "must be an object"},
        {"{}", "do"},
        {R"({"do":"jump"})", "jump"},
        {R"({"do":"run","frames":1})", "frames"},
        {R"({"do":"credit","frames":0})", "frames = 0"},
        {R"({"do":"credit","frames":1001})", "1000"},
        {R"({"do":"step","frames":1e9})", "frames"},
        {R"({"do":"rate","value":-1})", "value = -1"},
        {R"({"do":"rate","value":1e-9})", "0.001"},
        {R"({"do":"run","id":"x"})", "id"},
        {R"({"do":"run","id":9007199254740992})",
         "id = 9007199254740992: must be a whole number in [0, 9007199254740991]"},
        {R"({"do":"gait","gait":{"frequency":1,"amplitude":[1],"phase":[0]}})", "gait.amplitude"},
        {R"({"do":"gait","gait":{"frequency":0,"amplitude":[1,1],"phase":[0,0]}})", "gait.frequency"},
        {R"({"do":"overrides","overrides":{"solver":{"substeps":0}}})", "solver.substeps"},
        {R"({"do":"overrides","overrides":{"creature":{"name":"creature-2"}}})", "gait.amplitude"},
        {R"({"do":"overrides","overrides":3})", "overrides = 3"},
        {R"({"do":"overrides","overrides":{},"bodies":[]})", "the scene would have 1 swimmers: must have 0"},
        {R"({"do":"overrides","overrides":{},"bodies":[{"actuators":9,"slices":0}]})",
         "swimmer 0 would have 2 actuators: must have 9"},
        {R"({"do":"overrides","overrides":{},"bodies":[{"actuators":2,"slices":99}]})", "must have at least 99"},
        {R"({"do":"overrides","overrides":{},"bodies":[{"actuators":2}]})", "bodies[0].slices"},
        {R"({"do":"overrides","overrides":{},"bodies":{}})", "bodies = {}"},
        {R"({"do":"scene","scene":"thesis/none"})", "thesis/none"},
        {R"({"do":"scene","scene":7})", "scene"},
        {"{\"do\":\"run\",\"do\":\"run\"}", "twice"}};
    for (const auto& [line, reason] : bad) {
        client.send_line(line);
        const json answer = client.expect("ANSW");
        EXPECT_FALSE(answer.contains("ok")) << line;
        EXPECT_NE(answer["error"].get<std::string>().find(reason), std::string::npos) << line << ": " << answer;
        EXPECT_TRUE(answer["id"].is_null());
    }
    EXPECT_TRUE(client.ask({{"do", "nonsense"}}).contains("error"));  // and with its id
    const StreamFrame next = take_step(client, 2);
    EXPECT_EQ(next.number, 4u);
    EXPECT_EQ(next.scene, 1u);
    EXPECT_EQ(hash_of(next), evaluated(vacuum, 4)["hash"].get<std::string>());
}

TEST(StreamCommandTest, CommandsAreAnsweredInOrder) {
    StreamClient client(paused_in(vacuum));
    client.expect("SCEN");
    std::string text = "\n  \r\n";
    for (int id = 0; id < 300; ++id) text += json({{"do", id % 2 ? "pause" : "credit"}, {"id", id}}).dump() + "\n";
    text.pop_back();
    client.send_line(text);
    for (int id = 0; id < 300;) {
        const auto message = client.next();
        if (message->letters != "ANSW") continue;
        EXPECT_EQ(message->value(), json({{"id", id++}, {"ok", true}}));
    }
}

/// Undivided global relaxation explodes in the thesis scene, while it settles if not before.
TEST(StreamCommandTest, AnUnstableSceneStopsAndStartsAnewWhenItIsMended) {
    const auto relaxation = [](const char* mode) {
        return json{{"do", "overrides"}, {"overrides", {{"solver", {{"relaxationMode", mode}}}}}};
    };
    StreamClient client({water, "--gait", gait, "--rate", "0"});
    client.expect("SCEN");
    client.ask(relaxation("global"));
    EXPECT_EQ(client.scene()["restarted"], false);
    const json stop = client.expect("STOP");
    EXPECT_EQ(stop["reason"], "unstable");
    EXPECT_GE(stop["particle"], 0);
    EXPECT_FALSE(stop["stage"].get<std::string>().empty());
    EXPECT_GE(stop["time"], 0.0);
    EXPECT_FALSE(stop["law"].get<std::string>().empty());
    client.passed();
    for (const char* refused : {"run", "step"})
        EXPECT_NE(client.ask({{"do", refused}})["error"].get<std::string>().find("unstable"), std::string::npos);
    EXPECT_TRUE(client.passed().empty());

    client.ask({{"do", "reset"}});
    const auto passed = client.passed();
    ASSERT_EQ(passed.size(), 2u);
    EXPECT_EQ(passed[0].letters, "SCEN");
    EXPECT_EQ(passed[1].letters, "STOP");
    EXPECT_EQ(passed[1].value()["time"], 0.0);

    client.ask(relaxation("local"));
    EXPECT_EQ(client.scene()["restarted"], true);
    client.ask(credit(2));
    client.passed();
    const StreamFrame frame = client.frame();
    EXPECT_EQ(frame.flags & 1u, 1u);  // it runs on as it did
    EXPECT_LT(frame.number, client.frame().number);
}

/// What a step causes comes before its answer, the end too; nothing is simulated behind it.
TEST(StreamCommandTest, TheEndComesBeforeTheAnswerOfTheStepThatReachesIt) {
    StreamClient client(paused_in(vacuum, {"--until", "0.05"}));
    client.expect("SCEN");
    client.send_line(R"({"id":1,"do":"step","frames":10,"sense":true})"
                     "\n"
                     R"({"id":2,"do":"step","sense":true})");
    EXPECT_EQ(client.expect("STOP"), json::parse(R"({"reason":"until"})"));
    const json answer = client.expect("ANSW");
    EXPECT_EQ(answer["ok"], true);
    EXPECT_EQ(answer["senses"]["frame"], 3);
    if (const auto later = client.next()) {  // else the program was faster
        EXPECT_EQ(later->letters, "ANSW");
        EXPECT_EQ(later->value(), json({{"id", 2}, {"error", "the stream has reached its end, --until 0.05 s"}}));
        EXPECT_FALSE(client.next());
    }
    EXPECT_EQ(client.wait(), 0);
}

TEST(StreamCommandTest, AFrameThatWaitsForCreditComesBeforeTheEnd) {
    StreamClient client(paused_in(vacuum, {"--until", "0.05", "--lossless"}));
    client.expect("SCEN");
    take_start(client);
    EXPECT_EQ(client.ask({{"do", "step"}, {"frames", 10}})["ok"], true);
    EXPECT_NE(client.ask(step)["error"].get<std::string>().find("has reached its end"), std::string::npos);
    EXPECT_TRUE(client.passed().empty());
    client.ask(credit(1));
    EXPECT_EQ(client.frame().number, 3u);
    client.expect("STOP");
    EXPECT_FALSE(client.next());
}

TEST(StreamCommandTest, ACommandThatIsTooLongIsRefused) {
    StreamClient client(paused_in(vacuum));
    client.expect("SCEN");
    std::string line(5 << 20, ' ');
    line += R"({"do":"run"})";
    client.send_line(line);
    const json answer = client.expect("ANSW");
    EXPECT_NE(answer["error"].get<std::string>().find("longer than 1 MiB"), std::string::npos);
    EXPECT_EQ(client.ask({{"do", "pause"}})["ok"], true);
}

/// What would hang the stream is refused, and all stays as it was.
TEST(StreamCommandTest, ChangesThatCostTooMuchAreRefused) {
    StreamClient client(paused_in(vacuum, {"--fields", "position,velocity"}));
    client.expect("SCEN");
    take_start(client);
    const auto refusal = [&client](const json& overrides) {
        return client.ask({{"do", "overrides"}, {"overrides", overrides}}).at("error").get<std::string>();
    };
    EXPECT_NE(refusal({{"solver", {{"radius", 1000}}}}).find("solver.fluidRestDistance"), std::string::npos);
    EXPECT_NE(refusal({{"settling", {{"updates", 1000000}, {"substeps", 1000}}}}).find("NATATOR_MOST_WORK"),
              std::string::npos);
    EXPECT_EQ(hash_of(take_step(client, 2)), evaluated(vacuum, 2)["hash"].get<std::string>());
}

/// Nulls stay in the overrides that are in force, whatever they are of: not without end.
TEST(StreamCommandTest, OverridesDoNotGrowWithoutEnd) {
    StreamClient client(paused_in(vacuum));
    client.expect("SCEN");
    int accepted = 0;
    std::string error;
    while (accepted < 10 && error.empty()) {
        json overrides;
        for (int k = 0; k < 1000; ++k) {
            std::string key(600, 'x');
            key.append(std::to_string(1000 * accepted + k));
            overrides[key] = nullptr;
        }
        const json answer = client.ask({{"do", "overrides"}, {"overrides", overrides}});
        answer.contains("error") ? static_cast<void>(error = answer["error"]) : static_cast<void>(++accepted);
    }
    EXPECT_EQ(accepted, 1);  // each alone is within the limit
    EXPECT_NE(error.find("larger than 1 MiB"), std::string::npos) << error;
    EXPECT_EQ(client.ask({{"do", "scene"}, {"scene", vacuum}})["ok"], true);
}

}  // namespace
}  // namespace natator::test
