// What a scene's bad input must be answered with.
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "natator/error.h"
#include "natator/model.h"
#include "scene/scene_json.h"
#include "test_name.h"

namespace natator {

/// An override that a scene is refused with, and what must be in the message: the field, and what is allowed.
struct BadInput {
    const char* overrides;
    const char* field;
    const char* allowed;
};

inline void PrintTo(const BadInput& bad, std::ostream* out) {
    test::print_name(bad.overrides, out);
}

/// The scene with these overrides is refused in one line that says which, where, and all of what was expected.
inline void expect_refused(const std::string& scene, const nlohmann::json& overrides, const std::string& where,
                           const std::vector<std::string>& expected) {
    try {
        build_model(load_scene(scene, overrides));
        FAIL() << "accepted " << overrides;
    } catch (const InputError& error) {
        const std::string message = error.what();
        EXPECT_EQ(message.find("scene \"" + scene + "\": "), 0u) << message;
        EXPECT_NE(message.find(where), std::string::npos) << message;
        for (const std::string& one : expected) EXPECT_NE(message.find(one), std::string::npos) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
}

}  // namespace natator
