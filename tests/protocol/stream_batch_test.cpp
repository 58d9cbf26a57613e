// natator-sim stream --batch: swims side by side (sim-native/protocol/stream.md).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>

#include "../native/small_pair.h"
#include "stream_runs.h"

namespace natator::test {
namespace {

using nlohmann::json;

constexpr std::uint32_t nobody = 0xffffffff;

template <class T>
std::string bytes_of(const T& value) {
    return {reinterpret_cast<const char*>(&value), sizeof value};
}
template <class T>
T at(const std::string& bytes, std::size_t offset) {
    T value;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

/// What one swim is to do: 0 nothing, 1 go on, 2 drive, 3 steer.
std::string action(std::uint32_t what, std::uint32_t frames = 0, const std::vector<std::vector<double>>& rows = {}) {
    std::string bytes = bytes_of(what) + bytes_of(frames) + bytes_of(static_cast<std::uint32_t>(rows.size())) +
                        bytes_of(static_cast<std::uint32_t>(rows.empty() ? 0 : rows[0].size()));
    for (const auto& row : rows)
        for (const double value : row) bytes += bytes_of(value);
    return bytes;
}

std::string actions(std::uint32_t id, const std::vector<std::string>& all) {
    std::string body = bytes_of(id) + bytes_of(static_cast<std::uint32_t>(all.size()));
    for (const std::string& one : all) body += one;
    return message("ACTS", body);
}

struct Sensed {
    std::uint32_t status = 0;
    std::vector<double> senses;
};

/// A batch, whose messages are sorted by swim.
class BatchClient {
public:
    explicit BatchClient(int swims, const std::vector<std::string>& more = {})
        : client_(arguments(swims, more)), speaker_(swims == 1 ? 0 : nobody) {
        for (int i = 0; i < swims; ++i) scene(static_cast<std::uint32_t>(i));
    }

    /// The next message of a swim, with those of others kept.
    StreamMessage next(std::uint32_t swim) {
        while (kept_[swim].empty()) {
            const auto message = client_.next();
            if (!message) throw std::runtime_error("the end");
            if (message->letters == "SWIM")
                speaker_ = at<std::uint32_t>(message->body, 0);
            else
                kept_[message->letters == "OBSV" ? nobody : speaker_].push_back(*message);
        }
        const StreamMessage message = kept_[swim].front();
        kept_[swim].erase(kept_[swim].begin());
        return message;
    }
    json answer(std::uint32_t swim) {
        for (;;)
            if (const StreamMessage message = next(swim); message.letters == "ANSW") return message.value();
    }
    json ask(std::uint32_t swim, json command) {
        command["swim"] = swim;
        client_.send(command);
        return answer(swim);
    }
    json scene(std::uint32_t swim) {
        const StreamMessage message = next(swim);
        EXPECT_EQ(message.letters, "SCEN");
        return message.value();
    }
    /// What came of actions, and what was refused.
    std::vector<Sensed> act(const std::vector<std::string>& all, json* refusals = nullptr) {
        client_.send_bytes(actions(++turn_, all));
        const StreamMessage message = next(nobody);
        EXPECT_EQ(message.letters, "OBSV");
        const std::string& body = message.body;
        EXPECT_EQ(at<std::uint32_t>(body, 0), turn_);
        std::vector<Sensed> outcomes(at<std::uint32_t>(body, 4));
        std::size_t from = 8;
        for (Sensed& outcome : outcomes) {
            outcome.status = at<std::uint32_t>(body, from);
            outcome.senses.resize(at<std::uint32_t>(body, from + 4));
            from += 8;
            for (double& value : outcome.senses) value = at<double>(body, from), from += sizeof value;
        }
        const json told = json::parse(body.substr(from));
        if (refusals)
            *refusals = told;
        else
            EXPECT_EQ(told, json::object());
        return outcomes;
    }
    StreamClient& client() { return client_; }

private:
    static std::vector<std::string> arguments(int swims, const std::vector<std::string>& more) {
        std::vector<std::string> all{small_tank, "--batch", std::to_string(swims), "--fields", "none", "--paused"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }

    StreamClient client_;
    std::uint32_t speaker_, turn_ = 0;
    std::map<std::uint32_t, std::vector<StreamMessage>> kept_;
};

std::string saved(BatchClient& client, std::uint32_t swim) {
    client.client().send({{"do", "save"}, {"swim", swim}});
    const StreamMessage message = client.next(swim);
    EXPECT_EQ(message.letters, "STAT");
    EXPECT_EQ(client.answer(swim)["ok"], true);
    return message.body;
}

/// Swim k of so many, with actions and a start of its own; the others do other things. A hash of its whole end.
std::string swim_of(int k, int swims, int place, const std::vector<std::string>& more) {
    BatchClient client(swims, more);
    for (int i = 0; i < swims; ++i) {
        const int start = i == place ? 3 + k : 50 + i;
        EXPECT_EQ(client.ask(i, {{"do", "reset"}, {"start", start}})["ok"], true);
        if (i == place && k == 1) {
            EXPECT_EQ(
                client.ask(i, {{"do", "overrides"}, {"overrides", {{"solver", {{"dynamicFriction", 0.3}}}}}})["ok"],
                true);
        }
    }
    for (int turn = 0; turn < 3; ++turn) {
        std::vector<std::string> all;
        for (int i = 0; i < swims; ++i) {
            const double own = i == place ? 0.2 * turn - 0.3 * k : 0.9 - 0.1 * i;
            all.push_back(turn == 1 && i != place ? action(1, 1 + i) : action(2, 2, {{own, -own}, {own, 0.1}}));
        }
        for (const Sensed& outcome : client.act(all)) EXPECT_EQ(outcome.status, 1u);
    }
    Fnv1a hash;
    hash.add(saved(client, place));
    return hash_text(hash.value());
}

TEST(StreamBatchTest, EachHasTheBitsOfOneAloneInAnyPlaceAndOnAnyNumberOfThreads) {
    for (const char* scheme : {"flex", "conserving"}) {
        const std::vector<std::string> quick{"--scheme", scheme, "--overrides", R"({"settling":{"updates":2}})"};
        std::vector<std::string> on_threads = quick;
        on_threads.insert(on_threads.end(), {"--threads", "2"});
        std::vector<std::string> alone;
        for (const int k : {0, 1, 2}) alone.push_back(swim_of(k, 1, 0, quick));
        EXPECT_NE(alone[0], alone[1]);
        EXPECT_EQ(swim_of(0, 3, 2, on_threads), alone[0]) << scheme;
        EXPECT_EQ(swim_of(1, 3, 0, on_threads), alone[1]);
        EXPECT_EQ(swim_of(2, 2, 1, quick), alone[2]);
    }
}

TEST(StreamBatchTest, OutcomesAreTheSensesOfAnswers) {
    BatchClient client(2, {"--scheme", "conserving", "--overrides", R"({"settling":{"updates":2}})"});
    const json senses_of =
        client.ask(1, {{"do", "sense"},
                       {"flow", {{{"slice", 1}, {"side", "left"}}, {{"slice", 4}, {"side", "above"}}}},
                       {"target", {1, 0.5, 0.4}}});
    EXPECT_EQ(senses_of["ok"], true);
    const auto outcomes = client.act({action(0), action(3, 3, {{0.5, 1, 0.25, -0.125}})});
    EXPECT_EQ(outcomes[0].status, 0u);
    EXPECT_EQ(outcomes[0].senses[0], 0);
    EXPECT_TRUE(std::isnan(outcomes[0].senses[23]));  // no target
    const json told = client.ask(1, {{"do", "sense"}})["senses"];
    std::vector<double> expected{told["frame"], told["time"], told["distance"], 0, told["work"]};
    const auto add = [&expected](const json& values) {
        for (const json& value : values) expected.push_back(value);
    };
    for (const char* key : {"centre", "forward", "up", "right", "velocity", "turnRate"}) add(told[key]);
    add(told["target"]["direction"]);
    expected.push_back(told["target"]["distance"]);
    add(told["drive"]);
    add(told["bend"]);
    for (const json& place : told["flow"]) add(place["velocity"]);
    for (const json& place : told["flow"]) expected.push_back(place["particles"]);
    EXPECT_EQ(outcomes[1].status, 1u);
    EXPECT_EQ(outcomes[1].senses, expected);
    EXPECT_EQ(told["frame"], 3);
}

/// Values of all swimmers stand one after the other, as their senses do, behind which are the sizes of these.
TEST(StreamBatchTest, CompanionsAreDrivenAndSenseInABatch) {
    for (const std::string scheme : {"flex", "conserving"}) {
        const std::vector<std::string> more{"--scheme", scheme, "--overrides", small_pair.dump()};
        std::vector<std::string> on_threads = more;
        on_threads.insert(on_threads.end(), {"--threads", "2"});
        BatchClient client(3, on_threads), alone(1, more);
        for (BatchClient* each : {&client, &alone})
            each->ask(0, {{"do", "sense"}, {"swimmer", 1}, {"flow", {{{"slice", 1}, {"side", "left"}}}}});
        const std::string own = action(2, 2, {{0.1, 0.2, 0.3, -0.4, 0.5}}),
                          steered = action(3, 1, {{1, 1, 0.5, 0.5, 0.5, 0, 0, 0.1, 0, 0}});
        json refusals;
        const auto outcomes = client.act({own, action(2, 1, {{0, 0, 0, 0, 7}}), action(2, 1, {{0, 0, 0}})}, &refusals);
        EXPECT_EQ(refusals["1"], "swimmer 1: drive[2] = 7: must be a number in [-2, 2]");
        EXPECT_EQ(
            refusals["2"],
            "drive has length 3: must have length 2, one value per actuator of the creature, or 5, of all swimmers");
        const auto expected = alone.act({own});
        const std::vector<double>& senses = outcomes[0].senses;
        EXPECT_EQ(senses.size(), expected[0].senses.size());
        ASSERT_EQ(senses.size(), 27u + 4 + 27 + 6 + 4 + 2);
        EXPECT_EQ(senses[senses.size() - 2], 27 + 4);
        EXPECT_EQ(senses.back(), 27 + 6 + 4);
        const json told = client.ask(0, {{"do", "sense"}})["senses"]["companions"][0];
        EXPECT_EQ(senses[31], 2);
        EXPECT_EQ(senses[31 + 2], told["distance"]);
        EXPECT_EQ(senses[31 + 27], 0.3);
        EXPECT_EQ(senses[31 + 27 + 3], told["bend"][0]);
        EXPECT_EQ(senses[31 + 36], told["flow"][0]["particles"]);
        EXPECT_EQ(client.act({steered, own, action(0)})[0].status, 1u);
        EXPECT_EQ(alone.act({steered})[0].status, 1u);
        EXPECT_EQ(saved(client, 0), saved(alone, 0));
    }
}

TEST(StreamBatchTest, WhatIsWrongWithOneIsToldByItsNumberAndTheOthersGoOn) {
    BatchClient client(4, {"--scheme", "flex", "--overrides", R"({"settling":{"updates":2}})", "--threads", "2"});
    json refusals;
    const double nan = std::nan("");
    auto outcomes = client.act(
        {action(2, 1, {{0.5, 0.5}}), action(2, 1, {{0.5, nan}}), action(2, 3, {{1, 1}, {0, 0}}), action(2, 1, {{0.5}})},
        &refusals);
    EXPECT_EQ(refusals["1"], "drive[1] = NaN: must be a number in [-2, 2]");
    EXPECT_EQ(refusals["2"], "2 rows: must be 1, or one for each of the 3 frames");
    EXPECT_EQ(refusals["3"], "drive has length 1: must have length 2, one value per actuator of the creature");
    for (const int i : {0, 1, 2, 3}) {
        EXPECT_EQ(outcomes[i].status, i == 0 ? 1u : 3u);
        EXPECT_EQ(outcomes[i].senses[0], i == 0 ? 1 : 0);
    }
    for (const auto& [wrong, reason] : std::vector<std::pair<std::string, std::string>>{
             {action(9, 1), "ACTS: what to do = 9: must be 0 to 3"},
             {action(1, 0), "frames = 0: must be a whole number in [1, 1000]"},
             {action(3, 1, {{1, 1, 1}}), "3 values: must be a scale and an offset for each actuator"},
             {action(3, 1, {{1, 5, 0, 0}}), "scale[1] = 5: must be a number in [0, 4]"}}) {
        client.act({action(0), wrong, action(0), action(0)}, &refusals);
        EXPECT_EQ(refusals, json({{"1", reason}}));
    }

    client.ask(2, {{"do", "overrides"}, {"overrides", {{"solver", {{"relaxationMode", "global"}}}}}});
    outcomes = client.act({action(1, 60), action(1, 60), action(2, 60, {{1, -1}}), action(1, 60)});
    EXPECT_EQ(outcomes[2].status, 2u);
    const json stop = client.next(2).value();
    EXPECT_EQ(stop["reason"], "unstable");
    for (const double value : outcomes[2].senses) EXPECT_FALSE(std::isinf(value));
    EXPECT_EQ(outcomes[3].status, 1u);
    EXPECT_EQ(outcomes[3].senses[0], 60);
    outcomes = client.act({action(1, 1), action(1, 1), action(1, 1), action(1, 1)}, &refusals);
    EXPECT_EQ(outcomes[2].status, 3u);
    EXPECT_NE(refusals["2"].get<std::string>().find("the simulation is unstable since"), std::string::npos);
    EXPECT_EQ(outcomes[0].senses[0], 62);
}

TEST(StreamBatchTest, MessagesThatAreNoneAreAnsweredInOneLine) {
    BatchClient client(2, {"--scheme", "flex", "--overrides", R"({"settling":{"updates":2}})"});
    for (const auto& [wrong, reason] : std::vector<std::pair<std::string, std::string>>{
             {actions(1, {action(0)}), "ACTS: of 1 swims: must be of 2"},
             {actions(1, {action(0), action(0), action(0)}), "ACTS: of 3 swims: must be of 2"},
             {message("ACTS", ""), "ACTS: ends too early"},
             {message("ACTS", actions(1, {action(0), action(2, 1, {{0, 0}})}).substr(8, 50)), "ACTS: ends too early"},
             {message("ACTS", actions(1, {action(0), action(0)}).substr(8) + "more"), "ACTS: has more than its swims"},
             {R"({"do":"run","swim":2})"
              "\n",
              "command: swim = 2: must be a whole number in [0, 1]"},
             {R"({"do":"run","swim":-1})"
              "\n",
              "command: swim = -1: must be"},
             {"{\n", "command: not valid JSON"}}) {
        client.client().send_bytes(wrong);
        const std::string said = client.next(nobody).value()["error"];
        EXPECT_EQ(said.find(reason), 0u) << said;
    }
    client.client().send({{"do", "step"}, {"id", 5}});  // for all
    for (const std::uint32_t swim : {0, 1}) EXPECT_EQ(client.answer(swim), json({{"id", 5}, {"ok", true}}));
    EXPECT_EQ(client.act({action(0), action(0)})[1].senses[0], 1);
    client.client().close_input();
    EXPECT_EQ(client.client().wait(), 0);
}

TEST(StreamBatchTest, OneMayHaveAnotherSceneAndAStateGoesFromOneToAll) {
    BatchClient client(3, {"--scheme", "flex", "--overrides", R"({"settling":{"updates":2}})"});
    client.ask(1, {{"do", "scene"}, {"scene", vacuum}});
    const auto outcomes = client.act({action(1, 2), action(2, 1, {{0.5, 0.5}}), action(0)});
    EXPECT_EQ(outcomes[1].status, 1u);
    EXPECT_EQ(outcomes[1].senses.size(), 27u + 2 * 2);
    const std::string state = saved(client, 0);
    client.client().send_bytes(message("STAT", state));
    client.client().send({{"do", "restore"}});
    EXPECT_EQ(client.answer(0)["ok"], true);
    EXPECT_NE(client.answer(1)["error"].get<std::string>().find("state: of scene \"bench/small-tank\""),
              std::string::npos);
    EXPECT_EQ(client.answer(2)["ok"], true);
    client.act({action(1, 2), action(0), action(1, 2)});
    EXPECT_EQ(saved(client, 2), saved(client, 0));
}

}  // namespace
}  // namespace natator::test
