#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

#include "base/system.h"
#include "commands.h"

namespace natator::cli {

void start_bench(char** arguments) {
    const auto folder = system::program_file().parent_path();
    const std::string program = (folder / "natator-bench").string();
    system::become(program, arguments);
    if (errno != ENOENT) throw std::system_error(errno, std::generic_category(), program);
    const std::filesystem::path build = folder.parent_path();
    const bool built_here = std::filesystem::exists(build / "CMakeCache.txt");
    throw std::runtime_error(
        "the benchmarks are a program of their own, which is not " +
        (built_here ? "built; build it by: cmake --build " + build.string() + " --target natator-bench"
                    : "installed; build it in a checkout by: cmake --build --preset release --target natator-bench"));
}

}  // namespace natator::cli
