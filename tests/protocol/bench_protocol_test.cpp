// natator-sim bench from outside: files that it writes, and what it refuses.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <vector>

#include "child_process.h"

namespace natator::test {
namespace {

/// A folder in the temporary folder, freed at the end.
struct TemporaryFolder {
    TemporaryFolder() : path(std::filesystem::temp_directory_path() / ("natator-bench-" + std::to_string(::getpid()))) {
        std::filesystem::create_directory(path);
    }
    ~TemporaryFolder() { std::filesystem::remove_all(path); }
    std::filesystem::path path;
};

std::string content(const std::filesystem::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

TEST(BenchProtocolTest, ValidationWritesItsTableAndTheFrontsBesideIt) {
    const TemporaryFolder folder;
    const std::string file = (folder.path / "validation.csv").string();
    const Outcome outcome =
        run_simulator({"bench", "validation", "--quick", "--scheme", "conserving", "--output", file});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    const std::string table = content(file);
    EXPECT_NE(table.find("dam-break,tall,8,conserving,float,4,4,ok"), std::string::npos) << table;
    EXPECT_NE(table.find("tank,thesis/tank,,conserving,float,4,4,ok"), std::string::npos) << table;
    const std::string fronts = content(folder.path / "validation-fronts.csv");
    EXPECT_NE(fronts.find("tall,,experiment,,,,0.41,1.11"), std::string::npos) << fronts;
    EXPECT_NE(fronts.find("square,8,conserving,float,4,4,0,1"), std::string::npos) << fronts;
}

TEST(BenchProtocolTest, WaterWritesEveryFigureOfItsCasesAndTheCurvesBesideIt) {
    const TemporaryFolder folder;
    const std::string file = (folder.path / "water.csv").string();
    const Outcome outcome = run_simulator({"bench", "water", "--quick", "--scheme", "conserving", "--case", "vortex",
                                           "standing-wave", "tilted-gravity", "--output", file});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::string table = content(file);
    for (const char* row : {"vortex,10,conserving,float,cpu,4,4,no,2.5,1,amplitude after one turnover,ok,",
                            "vortex,10,conserving,float,cpu,4,4,no,2.5,1,numerical Reynolds number,ok,",
                            "vortex,10,conserving,float,cpu,4,4,no,2.5,1,gain of kinetic energy,ok,",
                            "standing-wave,10,conserving,float,cpu,4,4,no,2.5,1,period (s),ok,",
                            "tilted-gravity,10,conserving,float,cpu,4,4,no,2.5,1,slope under 1 degree (degrees),ok,"})
        EXPECT_NE(table.find(row), std::string::npos) << row << " in " << table;
    EXPECT_NE(content(folder.path / "water-curves.csv").find("vortex,10,conserving,float,cpu,4,4,no,2.5,0,1\n"),
              std::string::npos);
}

/// The support of the kernel is part of a row's key, but where a scheme has none; what it can't be is refused.
TEST(BenchProtocolTest, WaterTakesTheKernelsSupport) {
    const TemporaryFolder folder;
    const std::string file = (folder.path / "water.csv").string();
    const Outcome outcome = run_simulator({"bench", "water", "--resolution", "8", "--setting", "1x1", "--case",
                                           "tilted-gravity", "--support", "2", "--support", "2.5", "--output", file});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::string table = content(file), quantity = "slope afterwards (degrees)";
    EXPECT_NE(table.find(",support,start,quantity,"), std::string::npos) << table;
    std::vector<std::string> values;
    for (const char* key :
         {"conserving,float,cpu,1,1,no,2,1,", "conserving,float,cpu,1,1,no,2.5,1,", "flex,float,cpu,1,1,,,,"}) {
        const std::size_t at = table.find(key + quantity);
        ASSERT_NE(at, std::string::npos) << key << " in " << table;
        values.push_back(table.substr(at + std::string(key + quantity).size(), 12));
    }
    EXPECT_NE(values[0], values[1]);
    EXPECT_EQ(lines(table), 1 + 2 * 3) << table;
    const Outcome refused = run_simulator({"bench", "water", "--support", "1.9"});
    EXPECT_NE(refused.exit_code, 0);
    EXPECT_NE(refused.err.find("--support"), std::string::npos) << refused.err;
}

/// What a solver looks for is part of a row's key, too.
TEST(BenchProtocolTest, WaterTakesTheModifiedPressure) {
    const TemporaryFolder folder;
    const std::string file = (folder.path / "water.csv").string();
    const Outcome outcome = run_simulator({"bench", "water", "--scheme", "conserving", "--resolution", "20",
                                           "--setting", "1x1", "1x1m", "--case", "still-water", "--output", file});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::string table = content(file);
    const auto bobbing = [&](const std::string& modified) {
        const std::string key = "still-water,20,conserving,float,cpu,1,1," + modified + ",2.5,1,bobbing (length/s),ok,";
        const std::size_t at = table.find(key);
        return at == std::string::npos ? -1 : std::stod(table.substr(at + key.size()));
    };
    EXPECT_LT(bobbing("yes"), 0.5 * bobbing("no")) << table;
    EXPECT_GT(bobbing("yes"), 0) << table;
}

/// Each start is another run, but of a scheme whose water begins as a lattice; curves are kept of the first alone.
TEST(BenchProtocolTest, WaterTakesSeveralStarts) {
    const TemporaryFolder folder;
    const std::string file = (folder.path / "water.csv").string();
    const Outcome outcome = run_simulator({"bench", "water", "--resolution", "8", "--setting", "1x1", "--case",
                                           "tilted-gravity", "--start", "1", "3", "--output", file});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::string table = content(file), quantity = "slope afterwards (degrees),ok,";
    std::vector<std::string> values;
    for (const char* key : {"conserving,float,cpu,1,1,no,2.5,1,", "conserving,float,cpu,1,1,no,2.5,3,"}) {
        const std::size_t at = table.find(key + quantity);
        ASSERT_NE(at, std::string::npos) << key << " in " << table;
        values.push_back(table.substr(at + std::string(key + quantity).size(), 8));
    }
    EXPECT_NE(values[0], values[1]);
    EXPECT_EQ(lines(table), 1 + 2 * 3) << table;
    const std::string curves = content(folder.path / "water-curves.csv");
    EXPECT_NE(curves.find("tilted-gravity,8,conserving,float,cpu,1,1,no,2.5,0,"), std::string::npos);
    EXPECT_EQ(curves.find("tilted-gravity,8,conserving,float,cpu,1,1,no,2.5,0,", curves.find("1,1,no,2.5,0,") + 1),
              std::string::npos);
}

/// A figure whose viscosity an explicit substep would cut off is not that of the case: its row says so, and has no
/// value.
TEST(BenchProtocolTest, WaterMeasuresNoCaseThatIsTooViscousForItsSubsteps) {
    const Outcome outcome = run_simulator({"bench", "water", "--resolution", "16", "--setting", "1x1", "--case",
                                           "spinning-sphere", "--scheme", "conserving"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find(
                  "spinning-sphere,16,conserving,float,cpu,1,1,no,2.5,1,torque (of Kirchhoff's),too viscous,,,,,no,"),
              std::string::npos)
        << outcome.out;
}

/// Of a file of one's own, and taken up again where rows are there; beats and targets stand beside it.
TEST(BenchProtocolTest, SwimmersWriteRowsBeatsAndTargets) {
    const TemporaryFolder folder;
    const std::string file = (folder.path / "swimmers.csv").string(), own = (folder.path / "own.json").string();
    std::ofstream(own) << R"({"source": "a test", "slab": true, "outline": [[0, 0.05], [1, 0.05]], "viscosity": 0.02,
        "midline": {"by": "displacement", "amplitude": [0.08], "waves": 1},
        "variants": {"a": {}, "b": {"midline": {"scale": 0.5}}},
        "targets": [{"quantity": "power", "over": "amplitude", "reference": 2, "within": 0.3, "confirmed": true, "source": "of small waves"},
                    {"quantity": "speed", "variant": "b", "reference": 9, "within": 0.1, "confirmed": false, "source": "none"}]})";
    const std::vector<std::string> arguments{"bench",     "swimmers", "--case",   own,        "--resolution",
                                             "8",         "--beats",  "1",        "--scheme", "conserving",
                                             "--setting", "2x2",      "--output", file};
    const Outcome outcome = run_simulator(arguments);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::string table = content(file), targets = content(folder.path / "swimmers-targets.csv");
    EXPECT_NE(table.find("own,a,8,1,2.5,1,conserving,float,cpu,2,2,no,2.5,1,,ok,0.8,240,0.02,"), std::string::npos)
        << table;
    EXPECT_NE(table.find(",9,"), std::string::npos) << "the target of b alone: " << table;
    EXPECT_NE(content(folder.path / "swimmers-beats.csv").find("own,b,8,1,2.5,1,conserving,float,cpu,2,2,no,2.5,1,,1,"),
              std::string::npos);
    EXPECT_NE(targets.find("own,all,8,1,2.5,1,conserving,float,cpu,2,2,no,2.5,1,,power,amplitude,,"), std::string::npos)
        << targets;
    EXPECT_NE(targets.find("own,b,8,1,2.5,1,conserving,float,cpu,2,2,no,2.5,1,,speed,,,"), std::string::npos)
        << targets;
    EXPECT_NE(targets.find(",no,no\n"), std::string::npos) << targets;
    EXPECT_EQ(run_simulator(arguments).exit_code, 0);
    EXPECT_EQ(content(file), table);
    const Outcome lattice = run_simulator({"bench", "swimmers", "--case", own, "--resolution", "8", "--beats", "1",
                                           "--scheme", "lattice", "--output", file});
    ASSERT_EQ(lattice.exit_code, 0) << lattice.err;
    EXPECT_NE(content(file).find("own,a,8,1,,1,lattice,float,cpu,,,,,,0.15,ok,0.8,111,0.02,"), std::string::npos)
        << content(file);
}

TEST(BenchProtocolTest, WhatCannotBeMeantIsRefusedInOneLine) {
    const std::vector<std::pair<std::vector<std::string>, std::string>> bad = {
        {{"water", "--scheme", "flex", "flex"}, "--scheme: flex is given twice; must be given once"},
        {{"water", "--case", "vortex", "--case", "vortex"}, "--case: vortex is given twice"},
        {{"water", "--case", "towed-sphere", "--scheme", "flex"},
         "--case = towed-sphere: runs in scheme conserving only, and not by --quick; must be left out"},
        {{"water", "--quick", "--case", "vortex", "towed-sphere"},
         "--case = towed-sphere: runs in scheme conserving only"},
        {{"water", "--support", "nan"}, "--support = nan: must be a number in [2, 4]; see "},
        {{"water", "--support", "two"}, "--support = two: must be a number in [2, 4]; see "},
        {{"water", "--resolution", "20", "7"}, "--resolution = 7: must be a whole number in [8, 200]; see "},
        {{"water", "--start", "0"}, "--start = 0: must be a whole number in [1, 1000000]; see "},
        {{"speed", "--batch", "two"}, "--batch = two: must be a whole number in [1, 1048576]; see "},
        {{"stability", "--scheme", "fles"}, "--scheme = fles: must be flex or conserving; see "},
        {{"water", "--device", "1"},
         "--device = 1: the backend is cpu; must be left out, or beside --backend cuda or auto"},
        {{"stages", "--precision", "double"}, "--precision = double: must be float"},
        {{"stability", "--scene", "bathtub"}, "--scene = bathtub: must be small-tank, moving-tank, periodic-tank, "},
        {{"stability", "--duration", "0"}, "--duration = 0: must be a number in [0.01, 1000]"},
        {{"stability", "--device", "1"}, "--device = 1: the backend is cpu; must be left out"},
        {{"stability", "--axis", "dr"}, "--axis = \"dr\": must be one of "},
        {{"speed", "--whole-gpu"}, "--whole-gpu: the backend is cpu; must be left out"},
        {{"swimmers", "--scheme", "flex"}, "--scheme = flex: has no forces on a body; must be conserving or lattice"},
        {{"swimmers", "--scheme", "latice"}, "--scheme = latice: is unknown; must be conserving or lattice"},
        {{"swimmers", "--scheme", "lattice", "--pressure", "1"},
         "--pressure: is of scheme conserving; must be left out"},
        {{"swimmers", "--scheme", "lattice", "--setting", "8x4"},
         "--setting: is of scheme conserving; must be left out"},
        {{"swimmers", "--scheme", "lattice", "--support", "2.5"},
         "--support: is of scheme conserving; must be left out"},
        {{"swimmers", "--scheme", "lattice", "--start", "2"}, "--start: is of scheme conserving; must be left out"},
        {{"swimmers", "--scheme", "conserving", "--mach", "0.1"}, "--mach: is of scheme lattice; must be left out"},
        {{"swimmers", "--mach", "0.6"}, "--mach = 0.6: must be a number in [0.01, 0.5]; see "},
        {{"swimmers", "--precision", "double"},
         "--precision = double: scheme lattice computes in float; must be float"},
        {{"swimmers", "--case", "lavra"}, "--case = lavra: must be creature-2, creature-2-deformed, eel-2d, "},
        {{"swimmers", "--case", "no/such.json"}, "no/such.json"},
        {{"swimmers", "--case", "plate", "x/plate.json"}, "x/plate.json"},
        {{"swimmers", "--resolution", "7"}, "--resolution = 7: must be a whole number in [8, 1000]; see "},
        {{"swimmers", "--box", "0.5"}, "--box = 0.5: must be a number in [0.8, 10]; see "},
        {{"swimmers", "--pressure", "0"}, "--pressure = 0: must be a number in [0.01, 100]; see "},
        {{"swimmers", "--beats", "0"}, "--beats = 0: must be a whole number in [1, 1000]; see "},
        {{"wtaer"}, "unknown command wtaer; did you mean water?; see "},
        {{"validation", "--part", "tank", "--setting", "4x4", "4x4"}, "--setting: 4x4 is given twice"},
        {{"validation", "--part", "tank", "--setting", "4x4m"}, "--setting = \"4x4m\": must be without m"},
    };
    for (const auto& [options, message] : bad) {
        std::vector<std::string> arguments{"bench"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const Outcome outcome = run_simulator(arguments);
        EXPECT_EQ(outcome.exit_code, 2) << message;
        EXPECT_EQ(outcome.out, "");
        EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
        EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
    }
}

TEST(BenchProtocolTest, AFileThatIsNoTableOfTheStudyIsLeftAsItIs) {
    const TemporaryFolder folder;
    const std::string file = (folder.path / "notes.csv").string();
    std::ofstream(file) << "notes\n";
    const Outcome outcome = run_simulator({"bench", "water", "--quick", "--output", file});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.err,
              "natator-bench: file \"" + file +
                  "\": holds other columns than this study writes; must be a table of this study, or a new name\n");
    EXPECT_EQ(content(file), "notes\n");
    const Outcome nowhere = run_simulator({"bench", "water", "--quick", "--output", "/no/such/folder/x.csv"});
    EXPECT_EQ(nowhere.exit_code, 1);
    EXPECT_EQ(nowhere.err,
              "natator-bench: file \"/no/such/folder/x.csv\": cannot be written: No such file or directory\n");
}

/// --quick chooses a resolution only where none is given.
TEST(BenchProtocolTest, QuickWaterKeepsTheResolutionThatIsGiven) {
    const Outcome outcome = run_simulator(
        {"bench", "water", "--quick", "--case", "tilted-gravity", "--scheme", "conserving", "--resolution", "8"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("\ntilted-gravity,8,"), std::string::npos) << outcome.out;
}

TEST(BenchProtocolTest, ValidationRefusesWhatIsNoSetting) {
    for (const char* setting : {"8", "8x", "x4", "0x4", "8x4x2", "8,4", "-1x4", "8x1001", "fine"}) {
        const Outcome outcome = run_simulator({"bench", "validation", "--part", "tank", "--setting", setting});
        EXPECT_EQ(outcome.exit_code, 2) << setting;
        EXPECT_NE(outcome.err.find("--setting = \"" + std::string(setting) + "\": must be SUBSTEPSxITERATIONS"),
                  std::string::npos)
            << outcome.err;
        EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
    }
}

/// A stage that a scene does not need is not called, and running all stages all the same changes no bit.
TEST(BenchProtocolTest, StagesThatAreOffDoNotRunAndTheOthersDo) {
    const Outcome outcome = run_simulator({"bench", "stages", "--quick", "--repeats", "1"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    std::istringstream table(outcome.out);
    std::string line;
    std::getline(table, line);
    EXPECT_EQ(line,
              "feature,scheme,state,machine,stage,calls,stage_ms_per_frame,ms_per_frame,hash,unskipped_ms_per_frame,"
              "unskipped_hash");
    const std::set<std::string> branches_within_stages{"solidPressure", "friction", "viscosity",
                                                       "damping",       "maxSpeed", "shockPropagation"};
    int rows = 0;
    while (std::getline(table, line)) {
        ++rows;
        std::vector<std::string> field;
        std::istringstream text(line);
        for (std::string one; std::getline(text, one, ',');) field.push_back(one);
        ASSERT_EQ(field.size(), 11u) << line;
        EXPECT_EQ(field[8], field[10]) << line;
        const bool is_branch = branches_within_stages.contains(field[0]) && field[4] != "viscosity";
        const bool runs = field[2] == "on" || is_branch;
        EXPECT_EQ(field[5] != "0", runs) << line;
    }
    EXPECT_EQ(rows, 72);
}

TEST(BenchProtocolTest, NoStageIsAboveTheRoofs) {
    const Outcome outcome = run_simulator({"bench", "roofline", "--quick"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    std::istringstream table(outcome.out);
    std::string line;
    std::getline(table, line);
    int stages = 0;
    double peak = 0;
    while (std::getline(table, line)) {
        std::vector<std::string> field;
        std::istringstream text(line);
        for (std::string one; std::getline(text, one, ',');) field.push_back(one);
        ASSERT_GE(field.size(), 10u) << line;
        if (field[0] == "compute") peak = std::stod(field[9]);
        if (field[0] != "stage") continue;
        ++stages;
        EXPECT_GT(std::stod(field[7]), 1e5) << line;  // pairs per frame
        EXPECT_GT(std::stod(field[9]), 0) << line;
        EXPECT_LT(std::stod(field[9]), peak) << line;
    }
    EXPECT_EQ(stages, 5);
}

TEST(BenchProtocolTest, WithoutTheGpuThatWasAskedForThereIsOneLine) {
    const std::string experiments = std::string(NATATOR_CONFORMANCE_DIR) + "/micro/a_free.json";
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"bench", "speed", "--quick", "--backend", "cuda"},
          std::vector<std::string>{"bench", "throughput", "--quick"},
          std::vector<std::string>{"bench", "roofline", "--quick", "--backend", "cuda"},
          std::vector<std::string>{"particles", experiments, "--backend", "cuda"}}) {
        std::vector<std::string> arguments = command;
        arguments.insert(arguments.end(), {"--device", "1023"});
        const Outcome outcome = run_simulator(arguments);
        EXPECT_EQ(outcome.exit_code, 4) << command.front();
        EXPECT_EQ(outcome.out, "");
        EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
    }
}

TEST(BenchProtocolTest, ThroughputSaysWhatItTakes) {
    const Outcome help = run_simulator({"bench", "throughput", "--help"});
    EXPECT_EQ(help.exit_code, 0) << help.err;
    for (const char* option :
         {"--particles", "--batch", "--whole-gpu", "--without-lists", "--device", "--repeats", "1000 - 15000000"})
        EXPECT_NE(help.out.find(option), std::string::npos) << option << " in " << help.out;
    for (const std::vector<std::string>& bad : std::vector<std::vector<std::string>>{{"--particles", "999"},
                                                                                     {"--particles", "15000001"},
                                                                                     {"--particles", "many"},
                                                                                     {"--batch", "0"},
                                                                                     {"--batch", "0x10"},
                                                                                     {"--repeats", "0"},
                                                                                     {"--scheme", "both"}}) {
        const Outcome outcome = run_simulator({"bench", "throughput", bad[0], bad[1]});
        EXPECT_EQ(outcome.exit_code, 2) << bad[1];
        EXPECT_EQ(outcome.out, "");
        EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
        EXPECT_NE(outcome.err.find(bad[0]), std::string::npos) << outcome.err;
    }
}

}  // namespace
}  // namespace natator::test
