#include "output_file.h"

#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "io/strict_json.h"

namespace natator::cli {

void require_writable(const std::string& path) {
    namespace fs = std::filesystem;
    std::error_code not_there;
    const auto refuse = [&](const std::string& why) {
        throw std::runtime_error("file " + natator::quoted(path) + ": cannot be written: " + why);
    };
    const fs::path folder = fs::absolute(path).parent_path();
    const bool exists = fs::exists(path, not_there);
    if (!fs::is_directory(folder, not_there)) refuse("no such folder");
    if (fs::is_directory(path, not_there)) refuse("is a folder");
    if (::access(exists ? path.c_str() : folder.c_str(), W_OK) != 0) refuse(std::generic_category().message(errno));
}

}  // namespace natator::cli
