// natator-sim stream: its messages, credit and ends (sim-native/protocol/stream.md).
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <set>

#include "stream_runs.h"

namespace natator::test {
namespace {

using nlohmann::json;

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
    const std::vector<std::string> expected{
        "protocol",  "program",  "number",    "restarted",         "scene",
        "overrides", "gait",     "scheme",    "precision",         "definition",
        "timeStep",  "duration", "radius",    "solidRestDistance", "fluidRestDistance",
        "planes",    "periodic", "fields",    "particles",         "mass",
        "fluid",     "body",     "slices",    "bodyLength",        "companions",
        "clusters",  "joints",   "actuators", "muscles",           "skin"};
    std::set<std::string> keys;
    for (const auto& [key, value] : scene.items()) keys.insert(key);
    EXPECT_EQ(keys, std::set<std::string>(expected.begin(), expected.end()));

    const json program = json::parse(run_simulator({"info", "--json"}).out);
    for (const char* key : {"version", "instructionSet"}) EXPECT_EQ(scene["program"][key], program[key]);
    EXPECT_EQ(scene["protocol"], 2);
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

TEST(StreamTest, CompanionsSayWhichParticlesAreTheirs) {
    StreamClient alone(paused_in(water, {}));
    alone.expect("SCEN");
    EXPECT_EQ(alone.scene()["companions"], json::array());

    StreamClient school({"company/school", "--paused"});
    school.expect("SCEN");
    const json& scene = school.scene();
    ASSERT_EQ(scene["companions"].size(), 2u);
    std::set<int> particles;
    for (const int particle : scene["body"]) particles.insert(particle);
    for (const json& companion : scene["companions"]) {
        EXPECT_EQ(companion["name"], "creature-2");
        EXPECT_EQ(companion["body"].size(), scene["body"].size());
        EXPECT_EQ(companion["slices"].size(), scene["slices"].size());
        std::set<int> sliced;
        for (const json& slice : companion["slices"]) sliced.insert(slice.begin(), slice.end());
        EXPECT_EQ(sliced, std::set<int>(companion["body"].begin(), companion["body"].end()));
        for (const int particle : companion["body"]) EXPECT_TRUE(particles.insert(particle).second) << particle;
    }
    EXPECT_EQ(particles.size() + scene["fluid"][1].get<std::size_t>(), scene["particles"]);
}

TEST(StreamTest, ABodyOfAMeshBringsItsSkin) {
    StreamClient with({"pool/ray", "--paused"});
    with.expect("SCEN");
    const json scene = with.scene();
    const json& skin = scene["skin"];
    EXPECT_EQ(skin["file"], "ray.obj");
    EXPECT_EQ(skin["digest"], scene["definition"]["creature"]["mesh"]["digest"]);
    EXPECT_EQ(skin["unit"], 0.04);
    EXPECT_EQ(skin["axes"], json::parse("[[1,0,0],[0,1,0],[0,0,1]]"));
    EXPECT_EQ(skin["rest"].size(), scene["body"].size());
    const std::size_t vertices = skin["vertices"].size();
    ASSERT_GT(vertices, 100u);
    EXPECT_EQ(skin["triangles"].size(), 2 * vertices - 4);  // Euler, of a closed surface without handles
    EXPECT_EQ(skin["cluster"].size(), vertices);
    EXPECT_EQ(skin["share"].size(), vertices);
    for (std::size_t i = 0; i < vertices; ++i) {
        const bool last = skin["cluster"][i] == scene["clusters"].size() - 1;
        EXPECT_TRUE(!last || skin["share"][i] == 1.0) << i;
    }
    for (const json& muscle : scene["muscles"]) EXPECT_EQ(muscle["bend"], "vertical");

    StreamClient without(paused_in(water, {}));
    without.expect("SCEN");
    EXPECT_TRUE(without.scene()["skin"].is_null());
    EXPECT_FALSE(without.scene()["muscles"][0].contains("bend"));
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
            EXPECT_EQ(hash_of(frame), expected["hash"].get<std::string>()) << "frame " << k;
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

/// The end is after the nearest frame, as that of an evaluation; but for no time at all after one at least.
TEST(StreamTest, AnEndBetweenTwoFramesIsTheNearer) {
    for (const auto& [until, frames] :
         {std::pair("0", 0), {"0.001", 1}, {"0.02", 1}, {"0.03", 2}, {"0.0249", 1}, {"0.0251", 2}}) {
        StreamClient client({vacuum, "--rate", "0", "--lossless", "--until", until});
        client.expect("SCEN");
        client.send({{"do", "credit"}, {"frames", 10}});
        int last = -1;
        for (auto message = client.next(); message; message = client.next())
            if (message->letters == "FRAM") last = static_cast<int>(StreamFrame(message->body, client.scene()).number);
        EXPECT_EQ(last, frames) << until;
        if (frames == 0 || until == std::string("0.001")) continue;
        const json request{{"id", 1}, {"scene", vacuum}, {"gait", json::parse(gait)}, {"duration", json::parse(until)}};
        EXPECT_EQ(json::parse(run_simulator({"evaluate"}, request.dump()).out)["frames"], frames) << until;
    }
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
    StreamFrame later = take_step(client);
    EXPECT_EQ(later.number + 1, later.dropped + ++sent);
    // Sooner or later one comes that no credit was left for.
    for (int i = 0; later.dropped == 0 && i < 10'000; ++i) {
        EXPECT_EQ(client.ask({{"do", "run"}})["ok"], true);
        ::usleep(1'000);
        EXPECT_EQ(client.ask({{"do", "pause"}})["ok"], true);
        client.passed();
        later = take_step(client);
        EXPECT_EQ(later.number + 1, later.dropped + ++sent);
    }
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

TEST(StreamTest, OnlyEveryNthFrameIsOffered) {
    StreamClient client({vacuum, "--gait", gait, "--rate", "0", "--lossless", "--every", "3", "--until", "0.15"});
    client.expect("SCEN");
    client.send(credit(10));
    client.expect("ANSW");
    for (const std::uint32_t number : {0u, 3u, 6u, 9u}) EXPECT_EQ(client.frame().number, number);
    client.expect("STOP");
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
    // Commands of 100 kB: at most 128 wait, then the pipe is full; the simulator is blocked by its output meanwhile.
    const std::string command = json({{"do", "pause"}, {"id", 1}}).dump() + std::string(100'000, ' ') + "\n";
    std::size_t taken = 0;
    std::string rest;
    for (int i = 0; i < 400; ++i) {
        while (rest.size() < (1 << 16)) rest += command;
        const std::size_t count = client.try_send(rest);
        rest.erase(0, count);
        taken += count;
        ::usleep(2'000);
    }
    EXPECT_LT(taken, 140 * command.size());
    const double room = sanitized() ? 300 : 30;  // MB: sanitizers keep aside for a while what is freed
    EXPECT_LT(resident(client.pid()), before + room);
    EXPECT_GT(before, 1);
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

/// In the settled start there has been none; scheme flex knows none, and leaves the field out.
TEST(StreamTest, FramesHoldTheForceOfTheWaterWhereTheSchemeKnowsIt) {
    StreamClient client({"plane/loach", "--paused", "--gait",
                         R"({"frequency":2,"amplitude":[1,1,1,1,1],"phase":[0,0,0,0,0]})", "--fields",
                         "position,force"});
    EXPECT_EQ(client.expect("SCEN")["fields"], (json{"position", "force"}));
    const StreamFrame start = take_start(client);
    EXPECT_EQ(start.force, std::vector<float>(start.position.size(), 0));
    const StreamFrame later = take_step(client, 5);
    const auto felt = [](float value) { return value != 0; };
    EXPECT_GT(std::count_if(later.force.begin(), later.force.end(), felt), static_cast<long>(later.force.size() / 2));
    EXPECT_EQ(client.ask({{"do", "scene"}, {"scene", water}})["ok"], true);
    client.passed();
    EXPECT_EQ(client.scene()["scheme"], "flex");
    EXPECT_EQ(client.scene()["fields"], json{"position"});
    EXPECT_TRUE(take_start(client).force.empty());
    EXPECT_EQ(client.ask({{"do", "water"}, {"pressure", true}})["error"],
              "pressure: scheme flex has none; must be conserving or lattice");
}

TEST(StreamTest, BadUsageSaysWhatIsWrong) {
    const std::vector<std::pair<std::vector<std::string>, std::string>> bad{
        {{"thesis/none"}, "thesis/none"},
        {{"thesis/creature-2", "--gait", gait}, "gait.amplitude"},
        {{vacuum, "--overrides", R"({"solver":1})"}, "solver"},
        {{vacuum, "--rate", "-1"}, "--rate"},
        {{vacuum, "--every", "0"}, "--every"},
        {{vacuum, "--fields", "colour"}, "colour"},
        {{vacuum, "--fields", "force", "--batch", "2", "--backend", "cuda"}, "--fields: force"},
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
