#include "output_file.h"

#include <filesystem>
#include <system_error>

#include "base/system.h"
#include "base/whole_file.h"

namespace natator::cli {

void require_writable(const std::string& path) {
    namespace fs = std::filesystem;
    std::error_code not_there;
    const fs::path folder = fs::absolute(path).parent_path();
    const bool exists = fs::exists(path, not_there);
    if (!fs::is_directory(folder, not_there)) throw cannot_be_written(path, "no such folder");
    if (fs::is_directory(path, not_there)) throw cannot_be_written(path, "is a folder");
    if (!system::is_writable(exists ? fs::path(path) : folder)) throw cannot_be_written(path);
}

}  // namespace natator::cli
