// natator-sim stream: messages, credit, commands, ends (sim-native/protocol/stream.md).
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <set>

#include "child_process.h"
#include "measure/fnv1a.h"
#include "natator/protocol.h"
#include "stream_client.h"

namespace natator::test {
namespace {

using nlohmann::json;

const std::string vacuum = "thesis/creature-1-vacuum", water = "thesis/creature-1";
const std::string gait = R"({"frequency":1.861,"amplitude":[0.973,0.69],"phase":[0,0.648]})";
const json step{{"do", "step"}};

std::vector<std::string> paused_in(const std::string& scene, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{scene, "--gait", gait, "--paused"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

json credit(int frames) {
    return {{"do", "credit"}, {"frames", frames}};
}

/// Grants credit for the settled start, which a paused stream sends then.
StreamFrame take_start(StreamClient& client) {
    EXPECT_EQ(client.ask(credit(1)).value("ok", false), true);
    return client.frame();
}

/// Simulates so many frames and gives the last one.
StreamFrame take_step(StreamClient& client, int frames = 1) {
    EXPECT_EQ(client.ask(credit(1)).value("ok", false), true);
    EXPECT_EQ(client.ask({{"do", "step"}, {"frames", frames}}).value("ok", false), true);
    const auto passed = client.passed();
    EXPECT_EQ(passed.size(), 1u);
    return {passed.at(0).body, client.scene()};
}

/// As `natator-sim evaluate` computes it from the state.
std::string hash_of(const StreamFrame& frame) {
    Fnv1a hash;
    for (const auto* values : {&frame.position, &frame.velocity})
        for (const float value : *values) hash.add(value);
    return hash_text(hash.value());
}

json evaluated(const std::string& scene, int frames) {
    const json request{{"id", 1},
                       {"scene", scene},
                       {"gait", json::parse(gait)},
                       {"duration", frames / 60.0},
                       {"overrides", {{"stopping", {{"planeContact", false}, {"noProgressAfter", 0}}}}}};
    return json::parse(run_simulator({"evaluate"}, request.dump()).out);
}

/// Megabytes in memory.
double resident(pid_t process) {
    std::ifstream file("/proc/" + std::to_string(process) + "/status");
    for (std::string word; file >> word;)
        if (word == "VmRSS:" && file >> word) return std::stod(word) / 1024;
    return 0;
}

TEST(StreamTest, TheSceneIsComplete) {
    StreamClient client(paused_in(water, {"--overrides", R"({"solver":{"substeps":5}})"}));
    const json scene = client.expect("SCEN");
    const std::vector<std::string> expected{"protocol",
                                            "program",
                                            "number",
                                            "restarted",
                                            "scene",
                                            "overrides",
                                            "gait",
                                            "scheme",
                                            "precision",
                                            "definition",
                                            "timeStep",
                                            "duration",
                                            "radius",
                                            "solidRestDistance",
                                            "fluidRestDistance",
                                            "planes",
                                            "fields",
                                            "particles",
                                            "mass",
                                            "fluid",
                                            "body",
                                            "slices",
                                            "bodyLength",
                                            "clusters",
                                            "joints",
                                            "actuators",
                                            "muscles"};
    std::set<std::string> keys;
    for (const auto& [key, value] : scene.items()) keys.insert(key);
    EXPECT_EQ(keys, std::set<std::string>(expected.begin(), expected.end()));

    const json program = json::parse(run_simulator({"info", "--json"}).out);
    for (const char* key : {"version", "instructionSet"}) EXPECT_EQ(scene["program"][key], program[key]);
    EXPECT_EQ(scene["protocol"], 1);
    EXPECT_EQ(scene["number"], 1);
    EXPECT_EQ(scene["restarted"], true);
    EXPECT_EQ(scene["scene"], water);
    EXPECT_EQ(scene["overrides"], json::parse(R"({"solver":{"substeps":5}})"));
    EXPECT_EQ(scene["gait"]["amplitude"], json::parse("[0.973,0.69]"));
    EXPECT_EQ(scene["scheme"], "flex");
    EXPECT_EQ(scene["precision"], "float");
    const Outcome info = run_simulator({"info", water, "--definition", "--overrides", R"({"solver":{"substeps":5}})"});
    EXPECT_EQ(scene["definition"], json::parse(info.out));
    EXPECT_EQ(scene["fields"], json::parse(R"(["position"])"));
    EXPECT_EQ(scene["planes"].size(), 5u);
    EXPECT_EQ(scene["planes"][0].size(), 4u);

    EXPECT_EQ(scene["particles"], 5915);
    EXPECT_EQ(scene["mass"].size(), 5915u);
    EXPECT_EQ(scene["mass"][0], 1.0);
    EXPECT_EQ(scene["fluid"], json::parse("[255,5660]"));
    EXPECT_EQ(scene["body"].size(), 255u);
    EXPECT_EQ(scene["slices"].size(), 17u);
    EXPECT_EQ(scene["bodyLength"], 1.2);
    EXPECT_EQ(scene["clusters"].size(), 4u);
    EXPECT_EQ(scene["joints"].size(), 3u);
    EXPECT_EQ(scene["actuators"], 2);
    EXPECT_EQ(scene["muscles"].size(), 80u);
    for (const json& muscle : scene["muscles"]) {
        EXPECT_LT(muscle["a"], 255);
        EXPECT_LT(muscle["b"], 255);
        EXPECT_LT(muscle["actuator"], 2);
        EXPECT_LE(std::abs(muscle["lateral"].get<double>()), 1);
        EXPECT_GT(muscle["restLength"], 0);
    }
}

TEST(StreamTest, FrameZeroIsTheSettledStart) {
    StreamClient client(paused_in(water, {"--fields", "density,velocity,position"}));
    client.expect("SCEN");
    EXPECT_EQ(client.scene()["fields"], json::parse(R"(["position","velocity","density"])"));
    const StreamFrame start = take_start(client);
    EXPECT_EQ(start.number, 0u);
    EXPECT_EQ(start.dropped, 0u);
    EXPECT_EQ(start.flags, 0u);
    EXPECT_EQ(start.time, 0);
    EXPECT_EQ(start.wall, 0);
    EXPECT_EQ(start.distance, 0);
    for (const float speed : start.velocity) ASSERT_EQ(speed, 0);
    for (std::size_t i = 0; i < start.density.size(); ++i) ASSERT_EQ(start.density[i] > 0, i >= 255) << i;
    EXPECT_FLOAT_EQ(start.drive[0], 0);
    EXPECT_FLOAT_EQ(start.drive[1], static_cast<float>(0.69 * std::sin(2 * M_PI * 0.648)));
}

TEST(StreamTest, FramesAreThoseOfEvaluateBitByBit) {
    StreamClient client(
        {water, "--gait", gait, "--rate", "0", "--lossless", "--until", "0.15", "--fields", "position,velocity"});
    client.expect("SCEN");
    client.send(credit(4));
    client.expect("ANSW");
    for (std::uint32_t k = 0; k <= 9; ++k) {
        const StreamFrame frame = client.frame();
        EXPECT_EQ(frame.number, k);
        EXPECT_EQ(frame.dropped, 0u);
        EXPECT_EQ(frame.time, k * (1.0 / 60));
        if (k == 2 || k == 9) {
            const json expected = evaluated(water, static_cast<int>(k));
            EXPECT_EQ(hash_of(frame), expected["hash"]) << "frame " << k;
            EXPECT_EQ(frame.distance, expected["distance"].get<double>());
            EXPECT_FLOAT_EQ(frame.laws[0], expected["laws"]["linearMomentum"].get<float>());
            EXPECT_FLOAT_EQ(frame.laws[1], expected["laws"]["angularMomentum"].get<float>());
            EXPECT_FLOAT_EQ(frame.laws[2], expected["laws"]["densityErrorMean"].get<float>());
            EXPECT_FLOAT_EQ(frame.laws[3], expected["laws"]["densityErrorMax"].get<float>());
            EXPECT_GT(frame.wall, 0);
        }
        if (k >= 3 && k < 9) client.send(credit(1));  // the next one waits for it
        if (k >= 3 && k < 9) client.expect("ANSW");
    }
    EXPECT_EQ(client.expect("STOP"), json::parse(R"({"reason":"until"})"));
    EXPECT_FALSE(client.next());
    EXPECT_EQ(client.wait(), 0);  // with its input still open
}

TEST(StreamTest, CreditIsSpentFrameByFrameAndDropsAreCounted) {
    StreamClient client({vacuum, "--gait", gait, "--rate", "0"});
    client.expect("SCEN");
    std::uint32_t sent = 0, last = 0;
    for (const int granted : {1, 3, 2}) {
        EXPECT_EQ(client.ask(credit(granted))["ok"], true);
        EXPECT_TRUE(client.passed().empty());
        for (int i = 0; i < granted; ++i) {
            const StreamFrame frame = client.frame();
            EXPECT_TRUE(frame.number > last || sent == 0);
            EXPECT_EQ(frame.number + 1, frame.dropped + ++sent);
            EXPECT_EQ(frame.flags, 1u);
            last = frame.number;
        }
    }
    ::usleep(50'000);
    EXPECT_EQ(client.ask({{"do", "pause"}})["ok"], true);
    EXPECT_TRUE(client.passed().empty());
    const StreamFrame later = take_step(client);
    EXPECT_EQ(later.number + 1, later.dropped + ++sent);
    EXPECT_GT(later.dropped, 0u);
}

TEST(StreamTest, CreditInHandIsAtMostAThousand) {
    StreamClient client({vacuum, "--gait", gait, "--rate", "0", "--lossless", "--paused"});
    client.expect("SCEN");
    for (int i = 0; i < 3; ++i) client.ask(credit(600));
    EXPECT_EQ(client.passed().size(), 1u);  // the start
    client.send({{"do", "run"}});
    int frames = 0;
    for (bool waits = false; !waits;) {
        const auto message = client.next();
        frames += message->letters == "FRAM" ? 1 : 0;
        if (frames < 1000) continue;
        client.ask({{"do", "pause"}});
        waits = client.passed().empty();
    }
    EXPECT_EQ(frames, 1000);
}

TEST(StreamTest, PauseHoldsStillAndStepsGoFrameByFrame) {
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
    EXPECT_EQ(hash_of(next), evaluated(vacuum, static_cast<int>(next.number))["hash"]);
}

TEST(StreamTest, StepsWithoutCreditAreDroppedOrWait) {
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

TEST(StreamTest, OnlyEveryNthFrameIsOffered) {
    StreamClient client({vacuum, "--gait", gait, "--rate", "0", "--lossless", "--every", "3", "--until", "0.15"});
    client.expect("SCEN");
    client.send(credit(10));
    client.expect("ANSW");
    for (const std::uint32_t number : {0u, 3u, 6u, 9u}) EXPECT_EQ(client.frame().number, number);
    client.expect("STOP");
}

TEST(StreamTest, TheRateHoldsFramesBack) {
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
    EXPECT_TRUE(frames <= 1 || Clock::now() - slow > std::chrono::seconds(15)) << frames;
    EXPECT_EQ(client.ask({{"do", "rate"}, {"value", 0}})["ok"], true);
    client.passed();
    for (int i = 0; i < 100; ++i) client.frame();
}

TEST(StreamTest, ResetGivesTheSameBits) {
    StreamClient client(paused_in(water, {"--fields", "position,velocity"}));
    client.expect("SCEN");
    const std::string start = hash_of(take_start(client)), later = hash_of(take_step(client, 3));
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

TEST(StreamTest, AGaitChangesTheNextFrame) {
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

TEST(StreamTest, OverridesGoOnOrRestart) {
    StreamClient client(paused_in(water, {"--fields", "position,velocity"}));
    client.expect("SCEN");
    take_start(client);
    take_step(client, 2);
    const double viscosity = client.scene()["definition"]["solver"].value("viscosity", 10.0);
    EXPECT_EQ(client.ask({{"do", "overrides"}, {"overrides", {{"duration", 9}}}})["ok"], true);
    EXPECT_EQ(client.scene()["restarted"], false);
    EXPECT_EQ(client.scene()["duration"], 9);
    client.passed();
    EXPECT_EQ(hash_of(take_step(client, 2)), evaluated(water, 4)["hash"]);

    const json thicker{{"solver", {{"viscosity", viscosity + 20}}}};
    EXPECT_EQ(client.ask({{"do", "overrides"}, {"overrides", thicker}})["ok"], true);
    EXPECT_EQ(client.scene()["overrides"], json({{"duration", 9}, {"solver", thicker["solver"]}}));
    client.passed();
    const StreamFrame next = take_step(client);
    EXPECT_EQ(next.number, 5u);
    EXPECT_NE(hash_of(next), evaluated(water, 5)["hash"]);

    const json shallower{{"fluid", {{"count", {50, 4, 17}}}}};
    EXPECT_EQ(client.ask({{"do", "overrides"}, {"overrides", shallower}})["ok"], true);
    EXPECT_EQ(client.scene()["restarted"], true);
    EXPECT_LT(client.scene()["particles"], 5000);
    client.passed();
    const StreamFrame start = take_start(client);
    EXPECT_EQ(start.number, 0u);
    EXPECT_EQ(start.scene, 4u);
}

TEST(StreamTest, AnotherSceneRestarts) {
    StreamClient client(paused_in(water));
    client.expect("SCEN");
    EXPECT_EQ(client.ask({{"do", "scene"}, {"scene", "thesis/creature-2-vacuum"}})["ok"], true);
    client.passed();
    EXPECT_EQ(client.scene()["actuators"], 8);
    EXPECT_EQ(client.scene()["fluid"], json::parse("[0,0]"));
    EXPECT_EQ(client.scene()["gait"]["amplitude"], json(std::vector<double>(8, 0)));
    EXPECT_EQ(take_start(client).drive.size(), 8u);
}

TEST(StreamTest, BadCommandsAreAnsweredAndChangeNothing) {
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
        {R"({"do":"gait","gait":{"frequency":1,"amplitude":[1],"phase":[0]}})", "gait.amplitude"},
        {R"({"do":"gait","gait":{"frequency":0,"amplitude":[1,1],"phase":[0,0]}})", "gait.frequency"},
        {R"({"do":"overrides","overrides":{"solver":{"substeps":0}}})", "solver.substeps"},
        {R"({"do":"overrides","overrides":{"creature":{"name":"creature-2"}}})", "gait.amplitude"},
        {R"({"do":"overrides","overrides":3})", "overrides = 3"},
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
    EXPECT_EQ(hash_of(next), evaluated(vacuum, 4)["hash"]);
}

TEST(StreamTest, CommandsAreAnsweredInOrder) {
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
TEST(StreamTest, AnUnstableSceneStopsAndStartsAnewWhenItIsMended) {
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

TEST(StreamTest, TheEndOfTheInputIsTheEnd) {
    const std::vector<std::vector<std::string>> ways{{}, {"--paused"}, {"--lossless"}, {"--rate", "0"}};
    for (const std::vector<std::string>& way : ways) {
        std::vector<std::string> arguments{vacuum};
        arguments.insert(arguments.end(), way.begin(), way.end());
        StreamClient client(arguments);
        client.expect("SCEN");
        client.ask({{"do", "rate"}, {"value", 2}});
        client.close_input();
        EXPECT_EQ(client.wait(), 0);
        EXPECT_FALSE(client.next());
    }
    // Commands before the end are carried out, the last one without an end of its line.
    StreamClient client(paused_in(vacuum));
    client.expect("SCEN");
    client.try_send(credit(1).dump() + "\n" + step.dump());
    client.close_input();
    EXPECT_EQ(client.expect("ANSW")["ok"], true);
    client.frame();
    EXPECT_EQ(client.expect("ANSW")["ok"], true);
    EXPECT_EQ(client.wait(), 0);
}

TEST(StreamTest, AReaderThatStopsReadingCostsNoMemory) {
    StreamClient client({water, "--gait", gait, "--rate", "0", "--fields", "position,velocity,density"});
    client.expect("SCEN");
    client.ask(credit(1000));
    client.frame();
    const double before = resident(client.pid());
    // Commands of 100 kB: a few dozen wait, then the pipe is full; the simulator is blocked by its output meanwhile.
    const std::string command = json({{"do", "pause"}, {"id", 1}}).dump() + std::string(100'000, ' ') + "\n";
    std::size_t taken = 0, offered = 0;
    std::string rest;
    for (int i = 0; i < 200; ++i) {
        while (rest.size() < (1 << 16)) rest += command, offered += command.size();
        const std::size_t count = client.try_send(rest);
        rest.erase(0, count);
        taken += count;
        ::usleep(2'000);
    }
    EXPECT_LT(taken, 70 * command.size());
    EXPECT_LT(resident(client.pid()), before + 30);
    EXPECT_GT(before, 1);
}

TEST(StreamTest, ACommandThatIsTooLongIsRefused) {
    StreamClient client(paused_in(vacuum));
    client.expect("SCEN");
    std::string line(5 << 20, ' ');
    line += R"({"do":"run"})";
    client.send_line(line);
    const json answer = client.expect("ANSW");
    EXPECT_NE(answer["error"].get<std::string>().find("longer than 1 MiB"), std::string::npos);
    EXPECT_EQ(client.ask({{"do", "pause"}})["ok"], true);
}

TEST(StreamTest, AnOutputThatCannotBeWrittenIsAFailure) {
    EXPECT_EQ(run_simulator({"stream", vacuum}, "", "/dev/full").exit_code, 1);
    for (const char* rate : {"0", "1"}) {
        StreamClient client({vacuum, "--rate", rate});
        client.expect("SCEN");
        client.send(credit(1000));
        client.close_output();
        EXPECT_EQ(client.wait(), 1) << rate;  // with its input still open
    }
}

TEST(StreamTest, BadUsageSaysWhatIsWrong) {
    const std::vector<std::pair<std::vector<std::string>, std::string>> bad{
        {{"thesis/none"}, "thesis/none"},
        {{"thesis/creature-2", "--gait", gait}, "gait.amplitude"},
        {{vacuum, "--overrides", R"({"solver":1})"}, "solver"},
        {{vacuum, "--rate", "-1"}, "--rate"},
        {{vacuum, "--every", "0"}, "--every"},
        {{vacuum, "--fields", "colour"}, "colour"},
        {{vacuum, "--precision", "half"}, "half"},
        {{}, "scene"}};
    for (const auto& [arguments, reason] : bad) {
        std::vector<std::string> all{"stream"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        const Outcome outcome = run_simulator(all);
        EXPECT_EQ(outcome.exit_code, 2) << reason;
        EXPECT_EQ(outcome.out, "");
        EXPECT_EQ(lines(outcome.err), 1);
        EXPECT_NE(outcome.err.find(reason), std::string::npos) << outcome.err;
    }
}

}  // namespace
}  // namespace natator::test
