// natator-sim run and info, usage errors, and the form of their output.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "child_process.h"

namespace natator::test {
namespace {

using nlohmann::json;

/// A path in the temporary folder, freed at the end.
struct TemporaryPath {
    explicit TemporaryPath(const std::string& name)
        : path((std::filesystem::temp_directory_path() / ("natator-" + std::to_string(::getpid()) + name)).string()) {}
    ~TemporaryPath() { std::filesystem::remove(path); }
    std::string path;
};

std::vector<std::string> file_lines(const std::string& path) {
    std::ifstream file(path);
    std::vector<std::string> result;
    for (std::string line; std::getline(file, line);) result.push_back(line);
    return result;
}

TEST(InfoTest, DescribesASceneAsJson) {
    const Outcome outcome = run_simulator({"info", "thesis/creature-1", "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json info = json::parse(outcome.out);
    const json expected = {{"scene", "thesis/creature-1"},
                           {"creature", "creature-1"},
                           {"actuators", 2},
                           {"particles", 5915},
                           {"fluidParticles", 5660},
                           {"bodyParticles", 255},
                           {"bodyLength", 1.2},
                           {"springs", 80},
                           {"clusters", 4},
                           {"planes", 5},
                           {"duration", 4.0}};
    for (const auto& [key, value] : expected.items()) EXPECT_EQ(info.at(key), value) << key;
    ASSERT_TRUE(info.at("plan").is_array());
    EXPECT_GT(info["plan"].size(), 5u);
}

// 18 x 0.075 is 1.3499999999999999 to programs, who get what is computed with.
TEST(InfoTest, PeopleReadNumbersWithoutTheirRounding) {
    EXPECT_NE(run_simulator({"info", "pool/creature-2"}).out.find("\nbodyLength      1.35\n"), std::string::npos);
    EXPECT_NE(run_simulator({"info", "thesis/creature-2"}).out.find("\nleastSpacing    0.01\n"), std::string::npos);
    EXPECT_EQ(run_simulator({"info", "pool/creature-2"}).out.find("leastSpacing"), std::string::npos);
    EXPECT_EQ(json::parse(run_simulator({"info", "pool/creature-2", "--json"}).out).at("bodyLength"), 18 * 0.075);
}

// The water of scheme conserving bears only so long a substep, and only so light a body.
TEST(InfoTest, SaysWhatIsFittedToTheWater) {
    const auto info = [](const std::string& overrides) {
        const Outcome outcome = run_simulator({"info", "bench/small-tank", "--json", "--overrides", overrides});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return json::parse(outcome.out);
    };
    const json as_asked = info(R"({"scheme":"conserving"})");
    EXPECT_EQ(as_asked.at("scheme"), "conserving");
    EXPECT_EQ(as_asked.at("substeps"), 4);
    EXPECT_FALSE(as_asked.contains("substepsAsked"));
    EXPECT_FALSE(as_asked.contains("madeHeavier"));
    const json fitted = info(R"({"scheme":"conserving","timeStep":0.5,"creature":{"particleMass":1e-4}})");
    EXPECT_GT(fitted.at("substeps"), 4);
    EXPECT_EQ(fitted.at("substepsAsked"), 4);
    EXPECT_EQ(fitted.at("madeHeavier"), fitted.at("bodyParticles"));
}

TEST(InfoTest, OverridesCanComeFromAFile) {
    const TemporaryPath file("overrides.json");
    std::ofstream(file.path) << R"({"duration":3})";
    EXPECT_EQ(json::parse(run_simulator({"info", "pool/eel", "--json", "--overrides", file.path}).out).at("duration"),
              3);
}

TEST(InfoTest, ReadsTheInstructionSetFromTheEnvironment) {
    EXPECT_EQ(run_limited("export NATATOR_ISA=", {"info"}).exit_code, 0);
    const Outcome refused = run_limited("export NATATOR_ISA=sse", {"info"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_EQ(refused.err, "natator-sim: environment: NATATOR_ISA = \"sse\": must be portable, avx2, avx512 or neon\n");
}

TEST(InfoTest, RefusesALimitInTheEnvironmentThatIsNoDecimalNumber) {
    const Outcome refused = run_limited("export NATATOR_MOST_WORK=0x1p60", {"run", "pool/eel", "--duration", "0.1"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_EQ(refused.err,
              "natator-sim: environment: NATATOR_MOST_WORK = \"0x1p60\": must be a decimal number above 0\n");
}

TEST(InfoTest, TellsOfAxesThatHaveNoEnds) {
    const Outcome outcome = run_simulator({"info", "open-water/periodic", "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json info = json::parse(outcome.out);
    EXPECT_EQ(info.at("periodic"), "x from 0 to 2.4");
    EXPECT_EQ(info.at("planes"), 3);
    const Outcome refused = run_simulator({"run", "open-water/periodic", "--scheme", "flex"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_NE(refused.err.find("periodic: scheme = \"flex\": must be \"conserving\""), std::string::npos)
        << refused.err;
}

TEST(InfoTest, TellsOfTheMeshAndTheWaysABodyBends) {
    const Outcome outcome =
        run_simulator({"info", "pool/ray", "--json", "--overrides", R"({"creature":{"bend":"both","joint":"line"}})"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json info = json::parse(outcome.out);
    EXPECT_EQ(info.at("bends"), "0 to 4 sideways, 5 to 9 up and down");
    EXPECT_EQ(info.at("joint"), "line");
    EXPECT_EQ(info.at("mesh").get<std::string>().find("ray.obj, 1152 triangles, a unit is 0.04, volume 0.106"), 0u)
        << outcome.out;
    const json plain = json::parse(run_simulator({"info", "pool/eel", "--json"}).out);
    for (const char* key : {"bends", "joint", "mesh"}) EXPECT_FALSE(plain.contains(key)) << key;
}

TEST(InfoTest, RefusesAMeshWithAHoleInOneLine) {
    const TemporaryPath file("hole.obj");
    std::ofstream(file.path) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n";
    const Outcome outcome =
        run_simulator({"info", "pool/water", "--overrides",
                       json({{"creature", {{"mesh", {{"file", file.path}, {"joints", {0.5}}}}}}}).dump()});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find("a hole at the edge from (1, 0, 0) to (0, 1, 0)"), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1);
}

// At rest in vacuum nothing moves, by whichever sign.
TEST(RunTest, SaysUnitsAndNoMinusBeforeNothing) {
    const Outcome outcome = run_simulator({"run", "thesis/creature-1-vacuum", "--duration", "0.05"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find(" units\nspeed      "), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find(" units/s, "), std::string::npos) << outcome.out;
    EXPECT_EQ(outcome.out.find("-0 "), std::string::npos) << outcome.out;
}

// Others would change with the start of a swim.
TEST(RunTest, FiguresHaveThreeDigits) {
    const Outcome outcome = run_simulator({"run", "pool/creature-1", "--gait", gait, "--duration", "0.6"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::regex number(R"((?:distance|speed|number|tail|work|wall time) +-?([\d.]+))");
    int figures = 0;
    for (std::sregex_iterator found(outcome.out.begin(), outcome.out.end(), number), end; found != end;
         ++found, ++figures) {
        const std::string digits = std::regex_replace((*found)[1].str(), std::regex(R"(^0?\.0*|0+$|\.)"), "");
        EXPECT_LE(digits.size(), 3u) << found->str();
    }
    EXPECT_EQ(figures, 8) << outcome.out;
}

// What a vacuum scene is by its file, any scene becomes by a merge patch; both then have the same definition.
TEST(InfoTest, DefinesASceneWithAllThatItBuildsOn) {
    const std::string patch =
        R"({"fluid":null,"planes":[],"solver":{"gravity":[0,0,0]},"stopping":{"planeContact":false,"noProgressAfter":0}})";
    const Outcome patched =
        run_simulator({"info", "thesis/creature-1", "--definition", "--json", "--overrides", patch});
    ASSERT_EQ(patched.exit_code, 0) << patched.err;
    json scene = json::parse(patched.out);
    json vacuum = json::parse(run_simulator({"info", "thesis/creature-1-vacuum", "--definition", "--json"}).out);
    EXPECT_EQ(scene.at("timeStep"), 0.016666666666666666);
    EXPECT_GT(scene.at("creature").at("slices").size(), 0u);
    EXPECT_FALSE(scene.contains("base"));
    scene.erase("description");
    vacuum.erase("description");
    EXPECT_EQ(scene, vacuum);
    const Outcome refused =
        run_simulator({"info", "thesis/creature-1", "--definition", "--overrides", R"({"planes":1})"});
    EXPECT_EQ(refused.exit_code, 2);
    // Also where an option is merged into them.
    for (const std::vector<std::string>& command : {std::vector<std::string>{"info"},
                                                    {"run", "--duration", "1"},
                                                    {"run", "--scheme", "flex"},
                                                    {"stream", "--scheme", "flex"}}) {
        std::vector<std::string> arguments = command;
        arguments.insert(arguments.end(), {"thesis/creature-1", "--overrides", "[1]"});
        const Outcome list = run_simulator(arguments);
        EXPECT_EQ(list.exit_code, 2);
        EXPECT_NE(list.err.find("overrides = [1]: must be an object"), std::string::npos) << list.err;
    }
}

TEST(InfoTest, WritesAGaitToBeginWith) {
    const Outcome gait = run_simulator({"info", "pool/creature-1", "--gait-template"});
    ASSERT_EQ(gait.exit_code, 0) << gait.err;
    EXPECT_EQ(gait.out, "{\n  \"frequency\": 2.0,\n  \"amplitude\": [0.76, 1.0],\n  \"phase\": [0.0, 0.88]\n}\n");
    EXPECT_EQ(json::parse(run_simulator({"info", "pool/creature-1", "--gait-template", "--json"}).out),
              json::parse(gait.out));
    const auto refusal = [](const std::vector<std::string>& arguments) {
        const Outcome outcome = run_simulator(arguments);
        EXPECT_EQ(outcome.exit_code, 2);
        return outcome.err;
    };
    EXPECT_NE(refusal({"info", "pool/water", "--gait-template"}).find("it has no creature"), std::string::npos);
    EXPECT_NE(
        refusal({"info", "pool/eel", "--gait-template", "--overrides", R"({"creature":{"profile":{"joints":[0.5]}}})"})
            .find("an actuator needs two joints"),
        std::string::npos);
    EXPECT_NE(refusal({"info", "--gait-template"}).find("needs a scene"), std::string::npos);
}

TEST(InfoTest, DescribesTheProgramWithoutAScene) {
    const json info = json::parse(run_simulator({"info", "--json"}).out);
    EXPECT_TRUE(info.at("version").is_string());
    EXPECT_TRUE(info.at("instructionSet").is_string());
    const std::string commit = info.at("commit");
    EXPECT_TRUE(std::regex_match(commit, std::regex("unknown|[0-9a-f]{12,40}(-modified)?"))) << commit;
    const std::string version = run_simulator({"--version"}).out;
    for (const char* key : {"version", "commit", "instructionSet"})
        EXPECT_NE(version.find(info[key].get<std::string>()), std::string::npos) << version;
    EXPECT_GE(info.at("scenes").size(), 9u);
    EXPECT_NE(run_simulator({"info"}).out.find("thesis/creature-4-vacuum"), std::string::npos);
}

/// Scene lake/water has no particles; the rest has a body in the same cells.
TEST(InfoTest, DescribesWaterOnALattice) {
    for (const char* scene : {"lake/water", "lake/creature-2"}) {
        const Outcome text = run_simulator({"info", scene});
        EXPECT_EQ(text.exit_code, 0) << text.err;
        EXPECT_NE(text.out.find("cells           120\n                48\n                48\n"), std::string::npos)
            << text.out;
        EXPECT_EQ(json::parse(run_simulator({"info", scene, "--json"}).out).at("cells"), json({120, 48, 48}));
    }
    const Outcome run = run_simulator({"run", "lake/water", "--duration", "0.1"});
    EXPECT_EQ(run.exit_code, 0) << run.err << run.out;
    EXPECT_NE(run.out.find("completed"), std::string::npos) << run.out;
}

TEST(RunTest, ASnapshotHoldsAllParticlesAndChangesNothing) {
    const TemporaryPath file("-snapshot.csv");
    const std::vector<std::string> run = {"run", "thesis/creature-1", "--gait", gait, "--duration", "0.1"};
    std::vector<std::string> with = run;
    for (const char* word : {"--snapshot", file.path.c_str(), "--at", "0.05"}) with.emplace_back(word);
    const Outcome plain = run_simulator(run);
    const Outcome outcome = run_simulator(with);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto hash = [](const std::string& text) { return text.substr(text.find("hash"), 27); };
    EXPECT_EQ(hash(outcome.out), hash(plain.out));

    const std::vector<std::string> lines = file_lines(file.path);
    ASSERT_EQ(lines.size(), 1u + 5915u);
    EXPECT_EQ(lines[0], "time,kind,mass,x,y,z,vx,vy,vz,density");
    double lowest_mass = 1e9, highest_mass = 0;
    std::vector<double> density;
    for (std::size_t i = 1; i < lines.size(); ++i) {
        std::istringstream fields(lines[i]);
        std::string time, kind, mass, skipped, rho;
        std::getline(fields, time, ',');
        std::getline(fields, kind, ',');
        std::getline(fields, mass, ',');
        for (int k = 0; k < 6; ++k) std::getline(fields, skipped, ',');
        std::getline(fields, rho, ',');
        EXPECT_NEAR(std::stod(time), 0.05, 1e-9);
        if (kind != "fluid") {
            EXPECT_EQ(kind + mass + rho, "body10");
            continue;
        }
        density.push_back(std::stod(rho));
        lowest_mass = std::min(lowest_mass, std::stod(mass));
        highest_mass = std::max(highest_mass, std::stod(mass));
    }
    EXPECT_EQ(density.size(), 5660u);
    EXPECT_NEAR(lowest_mass, 1.0 / 14, 1e-6);
    EXPECT_NEAR(highest_mass, 2, 1e-6);
    const auto middle = density.begin() + 2830;
    std::nth_element(density.begin(), middle, density.end());
    EXPECT_NEAR(*middle, 1, 0.02);  // less at walls and surface, so not the mean
}

TEST(RunTest, ASnapshotThatNeverComesIsSaid) {
    const TemporaryPath file("-snapshot.csv");
    const Outcome late = run_simulator({"run", "thesis/creature-1-vacuum", "--snapshot", file.path, "--at", "5"});
    EXPECT_EQ(late.exit_code, 2);
    EXPECT_NE(late.err.find("--at = 5"), std::string::npos) << late.err;
    const Outcome early = run_simulator({"run", "thesis/creature-1", "--snapshot", file.path, "--at", "3",
                                         "--overrides", R"({"stopping":{"noProgressAfter":0.05}})"});
    EXPECT_EQ(early.exit_code, 1);
    EXPECT_NE(early.err.find("before --at 3"), std::string::npos) << early.err;
}

/// KiB that a run had at most.
long peak_of_run(std::vector<std::string> arguments) {
    const pid_t child = fork();
    if (child == 0) {
        arguments.insert(arguments.begin(), simulator());
        std::vector<char*> words;
        for (std::string& word : arguments) words.push_back(word.data());
        words.push_back(nullptr);
        dup2(::open("/dev/null", O_WRONLY), STDOUT_FILENO);
        execv(simulator(), words.data());
        _exit(127);
    }
    int status = 0;
    rusage used{};
    EXPECT_EQ(wait4(child, &status, 0, &used), child);
    EXPECT_EQ(status, 0);
    return used.ru_maxrss;
}

/// What a run is said to need is what it takes, and not much more: of all schemes and precisions, of one thread and
/// two.
TEST(RunTest, MemoryIsWhatWasSaid) {
    if (sanitized()) GTEST_SKIP() << "sanitizers take memory of their own";
    const char* const settings = R"("settling":{"updates":0},"planes":[[0,1,0,0]],"stopping":{"planeContact":false})";
    const std::vector<std::vector<std::string>> ways{
        {"flex", "float", "1", "[90,20,100]"},       {"flex", "double", "2", "[70,20,100]"},
        {"conserving", "float", "1", "[40,20,50]"},  {"conserving", "float", "2", "[40,20,50]"},
        {"conserving", "double", "1", "[40,20,50]"}, {"conserving", "double", "2", "[40,10,80]"}};
    std::vector<std::vector<std::string>> runs{{"run", "lake/creature-2", "--threads", "1", "--duration", "0.01"},
                                               {"run", "lake/creature-2", "--threads", "2", "--duration", "0.01"}};
    for (const auto& way : ways)
        runs.push_back(
            {"run", "thesis/tank", "--scheme", way[0], "--precision", way[1], "--threads", way[2], "--duration", "0.02",
             "--no-cache", "--overrides",
             std::string("{") + settings + R"(,"fluid":{"clearance":0,"spacing":0.1,"count":)" + way[3] + "}}"});
    for (const auto& run : runs) {
        const Outcome refused = run_limited("export NATATOR_MOST_MEMORY=1e-9", run);
        const std::size_t at = refused.err.find("need about ");
        ASSERT_NE(at, std::string::npos) << refused.err;
        const double said = std::stod(refused.err.substr(at + 11)) * 1024 * 1024;
        const double taken = static_cast<double>(peak_of_run(run));
        EXPECT_GE(said, taken) << ::testing::PrintToString(run);
        EXPECT_LE(said, 1.35 * taken) << ::testing::PrintToString(run);
    }
}

/// Without --at it is that of the run's last frame: of a duration that frames do not fill, up or down, and of a run
/// that ends early.
TEST(RunTest, ASnapshotOfTheEndIsThatOfTheLastFrame) {
    struct Run {
        const char *scene, *duration, *overrides, *end;
    };
    for (const Run& run : {Run{"thesis/creature-1-vacuum", "0.105", "{}", "0.1"},
                           Run{"thesis/creature-1-vacuum", "0.11", "{}", "0.116666667"},
                           Run{"thesis/creature-1-vacuum", "0.1", R"({"timeStep":0.03})", "0.09"},
                           Run{"thesis/creature-1", "3", R"({"stopping":{"noProgressAfter":0.05}})", ""}}) {
        const TemporaryPath file("-snapshot.csv");
        const Outcome outcome = run_simulator(
            {"run", run.scene, "--duration", run.duration, "--overrides", run.overrides, "--snapshot", file.path});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        std::ifstream in(file.path);
        std::string line;
        std::getline(in, line);
        std::getline(in, line);
        const std::size_t at = outcome.out.find("simulated  ") + 11;
        EXPECT_NEAR(std::stod(line), std::stod(outcome.out.substr(at)), 1e-6) << line;
        EXPECT_TRUE(*run.end == 0 || line.substr(0, line.find(',')) == run.end) << line;
    }
    const Outcome beyond = run_simulator(
        {"run", "thesis/creature-1-vacuum", "--duration", "0.105", "--snapshot", "/dev/null", "--at", "0.104"});
    EXPECT_EQ(beyond.exit_code, 2);
    EXPECT_EQ(beyond.err, "natator-sim: --at = 0.104: must be at most 0.1, the end of the last frame\n");
}

TEST(RunTest, AShiftedStartTakesAnotherCourse) {
    const auto run = [](const char* seed) {
        return run_simulator({"run", "bench/small-tank", "--gait", gait, "--duration", "0.1", "--perturbation", "1e-4",
                              "--perturbation-seed", seed})
            .out;
    };
    const auto hash = [](const std::string& text) { return text.substr(text.find("hash"), 27); };
    EXPECT_EQ(hash(run("1")), hash(run("1")));
    EXPECT_NE(hash(run("1")), hash(run("2")));
}

// With room for the stacks of one or two. The same bits, as for any number.
TEST(RunTest, TakesFewerThreadsWhereThereAreNotSoMany) {
    if (sanitized()) GTEST_SKIP() << "a sanitizer takes more address space";
    const std::vector<std::string> run = {"run", "bench/small-tank", "--duration", "0.02", "--threads", "8"};
    const Outcome outcome = run_limited("ulimit -s 1000000; ulimit -v 3000000", run);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto hash = [](const std::string& text) { return text.substr(text.find("hash"), 27); };
    EXPECT_EQ(hash(outcome.out), hash(run_simulator(run).out));
}

TEST(RunTest, PrintsASummary) {
    const Outcome outcome = run_simulator({"run", "thesis/creature-1-vacuum", "--gait", gait, "--duration", "0.1"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("creature-1, 2 actuators"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("0.1 s in 6 frames, completed"), std::string::npos) << outcome.out;
    const Outcome one = run_simulator({"run", "thesis/creature-1-vacuum", "--duration", "0.01"});
    EXPECT_NE(one.out.find(" s in 1 frame, completed"), std::string::npos) << one.out;
    EXPECT_NE(outcome.out.find("body lengths/s"), std::string::npos) << outcome.out;
}

/// The same state as `evaluate` reaches, whatever is recorded on the way.
TEST(RunTest, ATrajectoryChangesNothingAndEndsAtTheDistance) {
    const TemporaryPath csv("slices.csv");
    const std::vector<std::string> command = {"run", "thesis/creature-1-vacuum", "--gait", gait, "--duration", "0.5"};
    std::vector<std::string> recording = command;
    recording.insert(recording.end(), {"--trajectory", csv.path});
    const Outcome recorded = run_simulator(recording);
    ASSERT_EQ(recorded.exit_code, 0) << recorded.err;
    const auto hash = [](const std::string& text) { return text.substr(text.find("hash"), 27); };
    EXPECT_EQ(hash(recorded.out), hash(run_simulator(command).out));

    const std::vector<std::string> rows = file_lines(csv.path);
    ASSERT_EQ(rows.size(), 1u + 31 * 17);  // start and 30 frames, 17 slices
    EXPECT_EQ(rows[0], "frame,time,slice,x,y,z");
    EXPECT_EQ(rows[1].find("0,0,0,1.6"), 0u) << rows[1];
    EXPECT_EQ(rows.back().find("30,0.5,16,"), 0u) << rows.back();
    const auto mean_x = [&](std::size_t first) {
        double sum = 0;
        for (std::size_t i = first; i < first + 17; ++i) {
            std::istringstream row(rows[i]);
            std::string cell;
            for (int column = 0; column < 4; ++column) std::getline(row, cell, ',');
            sum += std::stod(cell);
        }
        return sum / 17;
    };
    const json request = {{"id", 1}, {"scene", command[1]}, {"gait", json::parse(gait)}, {"duration", 0.5}};
    const double distance = json::parse(run_simulator({"evaluate", request.dump()}).out).at("distance");
    EXPECT_NEAR(mean_x(rows.size() - 17) - mean_x(1), distance, 1e-5);
}

TEST(RunTest, ATrajectoryCanHoldEveryParticle) {
    const TemporaryPath csv("particles.csv");
    const Outcome outcome = run_simulator(
        {"run", "thesis/creature-2-vacuum", "--duration", "0.05", "--trajectory", csv.path, "--particles"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::vector<std::string> rows = file_lines(csv.path);
    EXPECT_EQ(rows.size(), 1u + 4 * 228);
    EXPECT_EQ(rows[0], "frame,time,particle,x,y,z");
}

TEST(RunTest, AGaitCanComeFromAFile) {
    const TemporaryPath file("gait.json");
    std::ofstream(file.path) << gait;
    const auto run = [](const std::string& text_or_file) {
        const auto out =
            run_simulator({"run", "thesis/creature-1-vacuum", "--gait", text_or_file, "--duration", "0.05"}).out;
        return out.substr(0, out.find("wall time"));
    };
    EXPECT_EQ(run(file.path), run(gait));
    EXPECT_NE(run(file.path).find("hash"), std::string::npos);
}

TEST(RunTest, AnUnstableRunEndsWithItsExitCode) {
    const Outcome outcome =
        run_simulator({"run", "thesis/creature-1", "--overrides", R"({"solver":{"relaxationMode":"global"}})"});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_NE(outcome.out.find("unstable"), std::string::npos);
}

TEST(RunTest, ATrajectoryThatCannotBeWrittenIsAFailure) {
    for (const char* path : {"/no/such/folder/x.csv", "/dev/full"}) {
        const Outcome outcome =
            run_simulator({"run", "thesis/creature-1-vacuum", "--duration", "0.1", "--trajectory", path});
        EXPECT_EQ(outcome.exit_code, 1) << path;
        EXPECT_NE(outcome.err.find(path), std::string::npos) << outcome.err;
    }
}

// Of what is found out when the last of it is written, too.
TEST(RunTest, AFullDiskIsTheReasonThatIsTold) {
    for (const char* option : {"--trajectory", "--snapshot"}) {
        const Outcome outcome =
            run_simulator({"run", "thesis/creature-1-vacuum", "--duration", "0.05", option, "/dev/full"});
        EXPECT_EQ(outcome.err, "natator-sim: file \"/dev/full\": cannot be written: No space left on device\n")
            << option;
    }
}

// What was computed before is not lost to a run that does not begin.
TEST(RunTest, WhatIsRefusedLeavesTheFileAsItWas) {
    const TemporaryPath file("kept.csv");
    std::ofstream(file.path) << "computed before\n";
    const std::vector<std::vector<std::string>> refused = {
        {"--trajectory", file.path, "--gait", R"({"frequency":1,"amplitude":[1,1,1],"phase":[0,0,0]})"},
        {"--trajectory", file.path, "--snapshot", file.path + "2", "--at", "5"},
        {"--trajectory", file.path, "--snapshot", file.path + "2", "--at", "nan"},
        {"--trajectory", file.path, "--snapshot", file.path},
        {"--trajectory", file.path, "--perturbation", "nan"},
        {"--trajectory", file.path, "--perturbation", "inf"},
    };
    for (const auto& arguments : refused) {
        std::vector<std::string> command = {"run", "thesis/creature-1-vacuum", "--duration", "0.05"};
        command.insert(command.end(), arguments.begin(), arguments.end());
        const Outcome outcome = run_simulator(command);
        EXPECT_EQ(outcome.exit_code, 2) << json(command) << outcome.out;
        EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
        EXPECT_EQ(file_lines(file.path), std::vector<std::string>{"computed before"}) << json(command);
    }
}

// One that can't be written is told before the run; one that turns out so, after its summary.
TEST(RunTest, ASnapshotThatCannotBeWrittenIsAFailure) {
    const auto run = [](const std::string& path) {
        return run_simulator({"run", "thesis/creature-1-vacuum", "--duration", "0.05", "--snapshot", path});
    };
    const Outcome early = run("/no/such/folder/x.csv");
    EXPECT_EQ(early.exit_code, 1);
    EXPECT_EQ(early.out, "");
    EXPECT_NE(early.err.find("/no/such/folder/x.csv"), std::string::npos) << early.err;
    const Outcome late = run("/dev/full");
    EXPECT_EQ(late.exit_code, 1);
    EXPECT_NE(late.out.find("hash"), std::string::npos) << late.out;
    EXPECT_NE(late.err.find("/dev/full"), std::string::npos) << late.err;
}

TEST(RunTest, ATrajectoryHasNoNumbersThatAreNone) {
    const TemporaryPath csv("unstable.csv");
    const Outcome outcome = run_simulator({"run", "thesis/creature-1", "--trajectory", csv.path, "--overrides",
                                           R"({"solver":{"relaxationMode":"global"}})"});
    ASSERT_EQ(outcome.exit_code, 3) << outcome.out << outcome.err;
    const std::vector<std::string> rows = file_lines(csv.path);
    EXPECT_EQ(rows, std::vector<std::string>{}) << "there was no start to write";
}

TEST(UsageTest, BadUsageIsOneLineAndExitCodeTwo) {
    const std::vector<std::vector<std::string>> commands = {
        {},
        {"swim"},
        {"evaluate", "--bogus"},
        {"run"},
        {"run", "thesis/nothing"},
        {"run", "thesis/tank", "--duration", "x"},
        {"run", "thesis/tank", "--duration", "-1"},
        {"run", "thesis/tank", "--duration", "nan"},
        {"run", "thesis/tank", "--precision", "half"},
        {"run", "thesis/tank", "--scheme", "best"},
        {"run", "thesis/tank", "--particles"},
        {"run", "thesis/tank", "--overrides", "{"},
        {"run", "thesis/creature-1", "--gait", "{}"},
        {"run", "thesis/creature-1", "--gait", "/no/such/gait"},
        {"run", "thesis/creature-2", "--gait", gait},
        {"info", "thesis/nothing"},
        {"info", "--overrides", "{}"},
    };
    for (const auto& command : commands) {
        const Outcome outcome = run_simulator(command);
        const std::string shown = json(command).dump();
        EXPECT_EQ(outcome.exit_code, 2) << shown;
        EXPECT_EQ(lines(outcome.err), 1) << shown << outcome.err;
        EXPECT_EQ(outcome.err.find("natator-sim: "), 0u) << shown << outcome.err;
        EXPECT_EQ(outcome.out, "") << shown;
    }
}

TEST(UsageTest, HelpAndVersionAreNoErrors) {
    for (const char* argument : {"--help", "--version"}) {
        const Outcome outcome = run_simulator({argument});
        EXPECT_EQ(outcome.exit_code, 0);
        EXPECT_NE(outcome.out.find("natator-sim"), std::string::npos);
        EXPECT_EQ(outcome.err, "");
    }
    const Outcome help = run_simulator({"run", "--help"});
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_NE(help.out.find("--trajectory"), std::string::npos);
}

TEST(UsageTest, AFullDiskBehindStandardOutputIsAFailure) {
    const Outcome outcome = run_simulator({"info"}, "", "/dev/full");
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
}

TEST(RunTest, BackendAutoRunsEverywhereAndCudaRecordsNothing) {
    const std::vector<std::string> run{"run", "thesis/creature-1-vacuum", "--duration", "0.05", "--backend"};
    const auto with = [&run](std::vector<std::string> more) {
        more.insert(more.begin(), run.begin(), run.end());
        return run_simulator(more);
    };
    EXPECT_EQ(with({"auto"}).exit_code, 0);
    const TemporaryPath file("trajectory.csv");
    EXPECT_EQ(with({"auto", "--trajectory", file.path}).exit_code, 0);
    EXPECT_EQ(file_lines(file.path).front(), "frame,time,slice,x,y,z");
    for (const char* recording : {"--trajectory", "--snapshot"}) {
        const Outcome refused = with({"cuda", recording, file.path});
        EXPECT_EQ(refused.exit_code, 2);
        EXPECT_EQ(lines(refused.err), 1) << refused.err;
        EXPECT_NE(refused.err.find("must be cpu or auto"), std::string::npos) << refused.err;
    }
}

/// Raw particles are held to the same limits as scenes: time, the results' size, the rest density's sum.
TEST(ParticlesTest, WhatCostsTooMuchIsRefused) {
    const TemporaryPath file("dear.json");
    const auto refusal = [&file](const json& change) {
        json experiment =
            json::parse(R"({"name":"dear","dt":0.01,"substeps":1,"pos":[[0,1,0]],"vel":[[0,0,0]],"invm":[1],)"
                        R"("phase":[1],"params":{"radius":0.15}})");
        experiment.merge_patch(change);
        std::ofstream(file.path) << json::array({experiment});
        const Outcome outcome = run_simulator({"particles", file.path});
        EXPECT_EQ(outcome.exit_code, change.empty() ? 0 : 2) << outcome.err;
        EXPECT_EQ(lines(outcome.err), change.empty() ? 0 : 1) << outcome.err;
        return outcome.err;
    };
    EXPECT_EQ(refusal(json::object()), "");
    EXPECT_NE(refusal({{"frames", {{{"frame", 1000000000000000000}}}}}).find("NATATOR_MOST_WORK"), std::string::npos);
    EXPECT_NE(refusal({{"substeps", 1000000}, {"frames", {{{"frame", 10000}}}}}).find("in 1e+10 substeps"),
              std::string::npos);
    EXPECT_NE(refusal({{"substeps", 1000000},
                       {"params", {{"numIterations", 10000}}},
                       {"frames", {{{"frame", 1}, {"substeps_trace", true}}}}})
                  .find("NATATOR_MOST_MEMORY"),
              std::string::npos);
    EXPECT_NE(refusal({{"params", {{"fluidRestDistance", 1e-9}}}}).find("params.fluidRestDistance = 1e-09: must be"),
              std::string::npos);
}

/// It is told before anything is computed: what these experiments lack is found later.
TEST(ParticlesTest, AFileThatCannotBeWrittenIsAFailure) {
    const TemporaryPath file("dear.json");
    std::ofstream(file.path) << R"([{"dt":0.01,"substeps":1,"pos":[],"vel":[],"invm":[],"phase":[],"params":{}}])";
    const Outcome outcome = run_simulator({"particles", file.path, "--output", "/no/such/folder/x.json"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(outcome.err, "natator-sim: file \"/no/such/folder/x.json\": cannot be written: no such folder\n");
}

TEST(ParticlesTest, WhatCannotBeUsedIsRefusedInTheWordsOfScenes) {
    const TemporaryPath file("bad.json");
    const std::pair<const char*, const char*> bad[] = {
        {R"({})", "value = {}: must be an array of experiments"},
        {R"([5])", "[0]: value = 5: must be an object"},
        {R"([{"dt":0.01,"sping":{}}])", "[0]: sping: unknown key (= {}); did you mean springs?"},
        {R"([{"dt":0.01}])", "[0]: substeps: missing; must be given, a number of substeps"},
        {R"([{"dt":0}])", "[0]: dt = 0: must be a time above 0"},
        {R"([{"dt":1,"substeps":1,"pos":[[0,1,"a"]]}])", "[0]: pos[0][2] = \"a\": must be a finite number"},
        {R"([{"dt":1,"substeps":1,"pos":[],"vel":[[0,0,0]]}])", "[0]: vel has length 1: must have length 0"},
        {R"([{"dt":1,"substeps":1,"pos":[],"vel":[],"invm":[],"phase":[],"params":{"radius":1,"raduis":1}}])",
         "[0]: params.raduis: unknown key (= 1)"},
        {R"([{"dt":1,"substeps":1,"pos":[],"vel":[],"invm":[],"phase":[],"params":{"radius":1},"springs":5}])",
         "[0]: springs = 5: must be an object"},
        {R"([{"dt":1,"substeps":1,"pos":[],"vel":[],"invm":[],"phase":[],"params":{"radius":1},"springs":{"length":[]}}])",
         "[0]: springs.length: unknown key (= []); allowed: idx, l0, k"},
        {R"([{"dt":1,"substeps":1,"pos":[],"vel":[],"invm":[],"phase":[],"params":{"radius":1},"rigids":{}}])",
         "[0]: rigids.clusters: missing; must be given, lists of particles"},
    };
    for (const auto& [experiments, message] : bad) {
        std::ofstream(file.path) << experiments;
        const Outcome outcome = run_simulator({"particles", file.path});
        EXPECT_EQ(outcome.exit_code, 2) << experiments;
        EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
        EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
    }
}

/// A body without two joints has no muscle: who runs it is told so.
TEST(RunTest, ACreatureThatCannotMoveIsSaid) {
    const Outcome outcome = run_simulator(
        {"run", "thesis/creature-1-vacuum", "--duration", "0.02", "--overrides", R"({"creature":{"joints":[8]}})"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("it cannot move by itself (an actuator needs two joints)"), std::string::npos)
        << outcome.out;
}

}  // namespace
}  // namespace natator::test
