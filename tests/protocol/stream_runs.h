#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "base/fnv1a.h"
#include "child_process.h"
#include "protocol/protocol.h"
#include "stream_client.h"

/// Streams that tests begin with, and what they take from them.
namespace natator::test {

inline const std::string vacuum = "thesis/creature-1-vacuum", water = "thesis/creature-1",
                         small_tank = "bench/small-tank";
inline const nlohmann::json step{{"do", "step"}};

inline std::vector<std::string> paused_in(const std::string& scene, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{scene, "--gait", gait, "--paused"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

inline nlohmann::json credit(int frames) {
    return {{"do", "credit"}, {"frames", frames}};
}

/// A message as it stands among commands.
inline std::string message(const std::string& letters, const std::string& body) {
    const auto length = static_cast<std::uint32_t>(body.size());
    return letters + std::string(reinterpret_cast<const char*>(&length), sizeof length) + body;
}

/// Grants credit for the settled start, which a paused stream sends then.
inline StreamFrame take_start(StreamClient& client) {
    EXPECT_EQ(client.ask(credit(1)).value("ok", false), true);
    return client.frame();
}

/// Simulates so many frames and gives the last one.
inline StreamFrame take_step(StreamClient& client, int frames = 1) {
    EXPECT_EQ(client.ask(credit(1)).value("ok", false), true);
    EXPECT_EQ(client.ask({{"do", "step"}, {"frames", frames}}).value("ok", false), true);
    const auto passed = client.passed();
    EXPECT_EQ(passed.size(), 1u);
    return {passed.at(0).body, client.scene()};
}

/// As `natator-sim evaluate` computes it from the state.
inline std::string hash_of(const StreamFrame& sent) {
    Fnv1a hash;
    for (const auto* values : {&sent.position, &sent.velocity})
        for (const float value : *values) hash.add(value);
    return hash_text(hash.value());
}

inline nlohmann::json evaluated(const std::string& scene, int frames) {
    const nlohmann::json request{{"id", 1},
                                 {"scene", scene},
                                 {"gait", nlohmann::json::parse(gait)},
                                 {"duration", frames / 60.0},
                                 {"overrides", {{"stopping", {{"planeContact", false}, {"noProgressAfter", 0}}}}}};
    return nlohmann::json::parse(run_simulator({"evaluate"}, request.dump()).out);
}

}  // namespace natator::test
