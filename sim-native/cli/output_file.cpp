#include "output_file.h"

#include <unistd.h>

#include <filesystem>
#include <system_error>

#include "base/whole_file.h"

namespace natator::cli {

void require_writable(const std::string& path) {
    namespace fs = std::filesystem;
    std::error_code not_there;
    const fs::path folder = fs::absolute(path).parent_path();
    const bool exists = fs::exists(path, not_there);
    if (!fs::is_directory(folder, not_there)) throw cannot_be_written(path, "no such folder");
    if (fs::is_directory(path, not_there)) throw cannot_be_written(path, "is a folder");
    if (::access(exists ? path.c_str() : folder.c_str(), W_OK) != 0) throw cannot_be_written(path);
}

}  // namespace natator::cli
