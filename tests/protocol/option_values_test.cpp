// Values of options that are refused, in one line and before anything is computed.
#include <gtest/gtest.h>

#include "../native/test_name.h"
#include "child_process.h"

namespace natator::test {
namespace {

const std::string vacuum_scene = "thesis/creature-1-vacuum";

struct BadValue {
    std::vector<std::string> arguments;
    const char* expected;  ///< must be in the message
};

void PrintTo(const BadValue& bad, std::ostream* out) {
    for (const std::string& argument : bad.arguments) print_name(argument + "_", out);
}

const char* const is_empty = ": the value is empty; must be left out or have one";

const BadValue bad_values[] = {
    {{"rnu", vacuum_scene}, "unknown command rnu; did you mean run?"},
    {{"qqqqq"}, "unknown command qqqqq; see "},
    {{"f\u00e9\x1b[31m\xff\n\"\\"}, "unknown command f\u00e9\\u001b[31m\\ufffd \"\\; see "},
    {{""}, "unknown command \"\"; see "},
    {{}, "command: missing; must be "},
    {{"--vesion"}, "unknown option --vesion; did you mean --version?"},
    {{"run"}, "scene: missing; must be given; see "},
    {{"run", "--duraton"}, "unknown option --duraton; did you mean --duration?"},
    {{"run", vacuum_scene, "--duration"}, "--duration: has no value; must have one; see "},
    {{"run", vacuum_scene, "--gait", "--duration", "1"}, "--gait = --duration: must be a value, not an option; see "},
    {{"run", vacuum_scene, "--trajectory", "--particles"},
     "--trajectory = --particles: must be a value, not an option; see "},
    {{"stream", vacuum_scene, "--until", "--paused"}, "--until = --paused: must be "},
    {{"run", vacuum_scene, "--duration", "1", "--duration", "2"},
     "--duration: is given more than once; must be given once; see "},
    {{"run", vacuum_scene, "--duration", "abc"}, "--duration = abc: must be a number; see "},
    {{"run", vacuum_scene, "--duration", "0x2"}, "--duration = 0x2: must be a decimal number; see "},
    {{"run", vacuum_scene, "--duration", "-0X1p3"}, "--duration = -0X1p3: must be a decimal number; see "},
    {{"run", vacuum_scene, "--duration", "1f"}, "--duration = 1f: must be a number; see "},
    {{"run", vacuum_scene, "--threads", "0x2"}, "--threads = 0x2: must be a decimal number; see "},
    {{"run", vacuum_scene, "--threads", "010"},
     "--threads = 010: must be a decimal number without a 0 before it; see "},
    {{"stream", vacuum_scene, "--until", "0x2"}, "--until = 0x2: must be a decimal number; see "},
    {{"stream", vacuum_scene, "--until", "-0x2"}, "--until = -0x2: must be a decimal number; see "},
    {{"converge", "-", "--starts", " 0x10"}, "--starts =  0x10: must be a decimal number; see "},
    {{"run", vacuum_scene, "--threads", "two"}, "--threads = two: must be a whole number in [1, 1024]; see "},
    {{"run", vacuum_scene, "--threads", "1025"}, "--threads = 1025: must be a whole number in [1, 1024]; see "},
    {{"run", vacuum_scene, "--threads", "1.5"}, "--threads = 1.5: must be a whole number in [1, 1024]; see "},
    {{"run", vacuum_scene, "--threads", ""}, is_empty},
    {{"run", vacuum_scene, "--device", "-1", "--backend", "cuda"},
     "--device = -1: must be a whole number in [0, 1023]; see "},
    {{"run", vacuum_scene, "--precision", "half"}, "--precision = half: must be float or double; see "},
    {{"run", vacuum_scene, "--backend", "gpu"}, "--backend = gpu: must be cpu, cuda or auto; see "},
    {{"run", vacuum_scene, "--no-cache=maybe"}, "--no-cache = maybe: must be true or false; see "},
    {{"serve", "--batch", "0"}, "--batch = 0: must be a whole number in [1, 1048576]; see "},
    {{"stream", vacuum_scene, "--start", "99999999999999999999"},
     "--start = 99999999999999999999: must be a whole number in [0, 2147483647]; see "},
    {{"stream", vacuum_scene, "--fields", "position,speed"},
     "--fields = speed: must be position, velocity, density, force or none; see "},
    {{"converge", "-", "--levels", "time/3"}, "--levels = time/3: must be time/2, time/4, spacing/2 or both/2; see "},
    {{"converge", "-", "--starts", "1"}, "--starts = 1: must be a whole number in [2, 1000]; see "},
    {{"particles", "x.json", "--backend", "auto"}, "--backend = auto: must be cpu or cuda; see "},
    {{"run", vacuum_scene, "--duraton", "1"}, "unknown option --duraton; did you mean --duration?"},
    {{"run", vacuum_scene, "1"}, "unexpected argument 1"},
    {{"run", vacuum_scene, "--gait", ""}, is_empty},
    {{"run", vacuum_scene, "--overrides", ""}, is_empty},
    {{"run", vacuum_scene, "--scheme", ""}, is_empty},
    {{"run", vacuum_scene, "--trajectory", ""}, is_empty},
    {{"run", vacuum_scene, "--trajectory="}, "--trajectory: the value is empty"},
    {{"run", vacuum_scene, "--trajectory=", "--no-cache"}, "--trajectory: the value is empty"},
    {{"run", vacuum_scene, "--snapshot", ""}, is_empty},
    {{"run", vacuum_scene, "--snapshot", "/dev/null", "--at", ""}, "--at: the value is empty"},
    {{"run", vacuum_scene, "--perturbation-seed", ""}, is_empty},
    {{"run", ""}, "scene: the value is empty"},
    {{"stream", vacuum_scene, "--gait", ""}, is_empty},
    {{"stream", vacuum_scene, "--overrides", ""}, is_empty},
    {{"stream", vacuum_scene, "--scheme", ""}, is_empty},
    {{"stream", vacuum_scene, "--until", ""}, is_empty},
    {{"stream", vacuum_scene, "--fields", ""}, "--fields: the value is empty"},
    {{"stream", vacuum_scene, "--fields", "velocity,position,velocity"},
     "--fields: velocity is given twice; must be given once"},
    {{"stream", vacuum_scene, "--fields", "density", "--fields", "density"}, "--fields: density is given twice"},
    {{"stream", vacuum_scene, "--fields", "none,position"}, "--fields: none stands beside others; must be none alone"},
    {{"converge", R"({"id":1,"scene":"open-water/creature-1","gait":{"frequency":1,"amplitude":[1,1],"phase":[0,0]}})",
      "--whole-gpu"},
     "--whole-gpu: the backend is cpu"},
    {{"run", vacuum_scene, "--device", "2"}, "--device = 2: the backend is cpu"},
    {{"run", vacuum_scene, "--whole-gpu", "--backend", "cpu"}, "--whole-gpu: the backend is cpu"},
    {{"run", vacuum_scene, "--without-lists"}, "--without-lists: the backend is cpu"},
    {{"particles", std::string(NATATOR_CONFORMANCE_DIR) + "/micro/a_free.json", "--device", "1"},
     "--device = 1: the backend is cpu"},
    {{"run", vacuum_scene, "--gait", R"({"scene":"pool/eel","gait":{"frequency":1}})"},
     "--gait: has its gait under \"gait\", as the winner of an evolution; must be the gait alone; natator evaluate "
     "--gait takes either"},
    {{"stream", vacuum_scene, "--gait", R"({"genes":[1],"gait":{"frequency":1}})"},
     "natator evaluate --gait takes either"},
    {{"info", ""}, is_empty},
    {{"info", vacuum_scene, "--overrides", ""}, is_empty},
    {{"converge", ""}, "request: the value is empty"},
    {{"converge", "-", "--output", ""}, is_empty},
    {{"particles", "x.json", "--output", ""}, is_empty},
    {{"stream", vacuum_scene, "--until", "nan"}, "--until = nan: must be a number of seconds from 0"},
    {{"stream", vacuum_scene, "--until", "inf"}, "--until = inf: must be a number of seconds from 0"},
    {{"stream", vacuum_scene, "--until", " 2"}, "--until =  2: must be a number of seconds from 0; see "},
    {{"stream", vacuum_scene, "--until", "1e6"},
     "until = 1e+06: must be at most 10 million time steps of timeStep = 0.016666666666666666"},
    {{"stream", vacuum_scene, "--until", "1e9", "--paused"}, "until = 1e+09: must be at most 10 million time steps"},
    {{"stream", vacuum_scene, "--until", "-1"}, "--until = -1: must be a number of seconds from 0;"},
    {{"stream", vacuum_scene, "--until", "soon"}, "--until = soon: must be a number of seconds from 0"},
    {{"stream", vacuum_scene, "--rate", "nan"}, "--rate = NaN: must be 0 or a number in [0.001, 1000]"},
    {{"run", vacuum_scene, "--duration", "nan"}, "duration = NaN: must be a number in (0, 1e+06] (s)"},
    {{"run", vacuum_scene, "--duration", "inf"}, "duration = Infinity: must be"},
    {{"run", vacuum_scene, "--snapshot", "/dev/null", "--at", "-1"}, "--at = -1: must be a number of seconds from 0"},
    {{"run", "pool/water", "--trajectory", "/dev/null"},
     "--trajectory = \"/dev/null\": the scene has no creature; must be left out, or --snapshot"},
    {{"run", vacuum_scene, "--snapshot", "/dev/null", "--at", "5"},
     "--at = 5: must be at most 4, the end of the last frame"},
    {{"run", vacuum_scene, "--snapshot", "/dev/null", "--trajectory", "/dev/null"},
     "--snapshot = \"/dev/null\": must be another file than that of --trajectory"},
    {{"run", vacuum_scene, "--snapshot", "/dev/null", "--backend", "cuda"},
     "--backend = cuda: records no --trajectory"},
    {{"run", vacuum_scene, "--perturbation", "1.5"}, "--perturbation = 1.5: must be a number in [0, 1] (length)"},
    {{"run", vacuum_scene, "--perturbation", "-1"}, "must be a number in [0, 1]"},
    {{"run", vacuum_scene, "--perturbation", "nan"}, "--perturbation = NaN: must be a number in [0, 1]"},
    {{"run", vacuum_scene, "--perturbation-seed", "-1"},
     "--perturbation-seed = -1: must be a whole number in [0, 2^64)"},
    {{"run", vacuum_scene, "--perturbation-seed", "18446744073709551616"}, "must be a whole number in [0, 2^64)"},
    {{"run", vacuum_scene, "--perturbation-seed", "99999999999999999999999"}, "must be a whole number in [0, 2^64)"},
    {{"run", vacuum_scene, "--perturbation-seed", "1.5"}, "= 1.5: must be a whole number"},
    {{"run", vacuum_scene, "--perturbation-seed", "one"}, "= \"one\": must be a whole number"},
};

class OptionValueTest : public testing::TestWithParam<BadValue> {};

TEST_P(OptionValueTest, IsRefusedInOneLine) {
    const Outcome outcome = run_simulator(GetParam().arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
    EXPECT_LT(outcome.err.size(), 200u) << outcome.err;
    EXPECT_NE(outcome.err.find(GetParam().expected), std::string::npos) << outcome.err;
}

INSTANTIATE_TEST_SUITE_P(All, OptionValueTest, testing::ValuesIn(bad_values));

/// The limits themselves are allowed.
TEST(OptionValueTest, WhatIsWithinTheLimitsIsAccepted) {
    const Outcome outcome = run_simulator({"run", vacuum_scene, "--duration", "0.02", "--perturbation", "1",
                                           "--perturbation-seed", "18446744073709551615"});
    EXPECT_NE(outcome.exit_code, 2) << outcome.err;
    EXPECT_NE(outcome.exit_code, 1) << outcome.err;
    EXPECT_EQ(run_simulator({"stream", vacuum_scene, "--paused", "--until", "0"}).exit_code, 0);
}

}  // namespace
}  // namespace natator::test
