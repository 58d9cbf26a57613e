// The files that natator-sim run writes: there whole, or as they were.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <thread>

#include "child_process.h"

namespace natator::test {
namespace {

namespace fs = std::filesystem;

const std::string header_of_trajectory = "frame,time,slice,x,y,z";

class OutputFilesTest : public testing::Test {
protected:
    void SetUp() override {
        folder = fs::path(testing::TempDir()) / ("natator-output-" + std::to_string(::getpid()) + "-" +
                                                 testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::create_directories(folder);
        file = (folder / "out.csv").string();
    }
    void TearDown() override { fs::remove_all(folder); }

    static std::vector<std::string> run_writing(const char* option, const std::string& path) {
        return {"run", "thesis/creature-1-vacuum", "--duration", "0.5", "--no-cache", option, path};
    }
    static std::string first_line(const std::string& path) {
        std::ifstream in(path);
        std::string line;
        std::getline(in, line);
        return line;
    }
    std::size_t files() const {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
    }

    fs::path folder;
    std::string file;
};

/// The signal comes as soon as something stands beside the file; the run would take much longer.
TEST_F(OutputFilesTest, ARunThatIsToldToEndLeavesTheFileAsItWasAndNothingBesideIt) {
    std::vector<std::string> arguments = run_writing("--trajectory", file);
    arguments[3] = "1000";
    arguments.insert(arguments.end(), {"--overrides", R"({"stopping":{"planeContact":false,"noProgressAfter":0}})"});
    for (const char* signal : {"TERM", "INT", "HUP", "QUIT", "XCPU", "KILL"}) {
        std::ofstream(file) << "computed before\n";
        const std::string beside = "'" + file + "'.$$";
        const Outcome outcome = run_limited("(while kill -0 $$ && ! [ -s " + beside +
                                                " ]; do sleep 0.01; done; kill -" + signal + " $$) 2> /dev/null & true",
                                            arguments);
        EXPECT_EQ(outcome.exit_code, -1) << signal;
        EXPECT_EQ(first_line(file), "computed before") << signal;
        EXPECT_EQ(files(), signal == std::string("KILL") ? 2u : 1u) << signal;  // no program hears that one
    }
}

/// Files of more than a few kilobytes cannot be written, as on a full disk. There is a signal for that, which ends a
/// program that does not ignore it.
TEST_F(OutputFilesTest, AFileThatGetsTooLargeIsAFailureAndLeavesTheOneBefore) {
    for (const char* signal : {"", "trap '' XFSZ; "}) {
        for (const char* option : {"--trajectory", "--snapshot"}) {
            std::ofstream(file) << "computed before\n";
            const Outcome outcome = run_limited(std::string(signal) + "ulimit -f 8", run_writing(option, file));
            EXPECT_EQ(outcome.exit_code, 1) << signal << option;
            EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
            EXPECT_NE(outcome.err.find("\"" + file + "\": cannot be written: File too large"), std::string::npos)
                << outcome.err;
            EXPECT_EQ(first_line(file), "computed before") << signal << option;
            EXPECT_NE(outcome.out.find("distance"), std::string::npos) << outcome.out;  // what was computed is told
            EXPECT_EQ(files(), 1u) << signal << option;
        }
    }
}

/// Whatever is written: experiments, recorded runs, standard output. A start that cannot be kept is settled anew.
TEST_F(OutputFilesTest, NoFileThatGetsTooLargeEndsAProgramWithoutAWord) {
    const auto limited = [](const std::vector<std::string>& arguments, const std::string& input = "") {
        return run_limited("ulimit -f 1", arguments, input);
    };
    const std::string request =
        R"({"id":1,"scene":"thesis/creature-1-vacuum","duration":0.1,"gait":)" + std::string(gait) + "}";
    const Outcome record = limited({"converge", "-", "--starts", "2", "--levels", "time/2", "--output", file}, request);
    EXPECT_EQ(record.exit_code, 1);
    EXPECT_NE(record.err.find("cannot be written: File too large"), std::string::npos) << record.err;
    const Outcome particles =
        limited({"particles", std::string(NATATOR_CONFORMANCE_DIR) + "/micro/a_free.json", "--output", file});
    EXPECT_EQ(particles.exit_code, 1);
    EXPECT_EQ(particles.err, "natator-sim: file \"" + file + "\": cannot be written: File too large\n");
    const std::string cache = (folder / "cache").string();
    const Outcome out = run_limited("ulimit -f 1; exec > '" + file + "'", {"info"});
    EXPECT_EQ(out.exit_code, 1);
    EXPECT_EQ(out.err, "natator-sim: standard output cannot be written: File too large\n");
    const Outcome cached =
        run_limited("ulimit -f 8; export NATATOR_CACHE='" + cache + "'", {"evaluate"},
                    R"({"id":1,"scene":"thesis/creature-1","duration":0.1,"gait":)" + std::string(gait) + "}");
    EXPECT_EQ(cached.exit_code, 0) << cached.err;
    EXPECT_TRUE(fs::is_empty(cache));
}

TEST_F(OutputFilesTest, AWholeFileTakesThePlaceAndTheRightsOfTheOneBefore) {
    std::ofstream(file) << "computed before\n";
    fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
    const std::string link = (folder / "link.csv").string();
    fs::create_symlink("out.csv", link);
    ASSERT_EQ(run_simulator(run_writing("--trajectory", link)).exit_code, 0);
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_EQ(first_line(file), header_of_trajectory);
    EXPECT_EQ(fs::status(file).permissions(), fs::perms::owner_read | fs::perms::owner_write);
    EXPECT_EQ(files(), 2u);
}

TEST_F(OutputFilesTest, WhatIsNoRegularFileIsWrittenDirectly) {
    ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
    std::string read;
    std::thread reader([&] { read = first_line(file); });
    const Outcome outcome =
        run_simulator({"run", "thesis/creature-1-vacuum", "--duration", "0.02", "--trajectory", file});
    reader.join();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(read, header_of_trajectory);
    EXPECT_TRUE(fs::is_fifo(file));
    EXPECT_EQ(run_simulator(run_writing("--snapshot", "/dev/null")).exit_code, 0);
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

/// Its summary goes there too: the file must stay the same one.
TEST_F(OutputFilesTest, TheFileOfStandardOutputIsWrittenDirectly) {
    std::ofstream(file).close();
    ASSERT_EQ(run_simulator(run_writing("--trajectory", "/dev/stdout"), "", file).exit_code, 0);
    std::ifstream in(file);
    const std::string all{std::istreambuf_iterator<char>(in), {}};
    EXPECT_NE(all.find("\n30,0.5,16,"), std::string::npos);
    EXPECT_NE(all.find("hash  "), std::string::npos);
    EXPECT_EQ(files(), 1u);
}

}  // namespace
}  // namespace natator::test
