#include "data_files.h"

#include <cstdlib>
#include <filesystem>
#include <set>

#include "natator/error.h"
#include "natator/strict_json.h"

namespace natator {
namespace {

namespace fs = std::filesystem;

constexpr const char* suffix = ".json";

std::vector<fs::path> data_directories() {
    if (const char* chosen = std::getenv("NATATOR_DATA")) return {chosen};
    std::vector<fs::path> directories;
    std::error_code failed;
    const fs::path executable = fs::read_symlink("/proc/self/exe", failed);
    if (!failed) directories.push_back(executable.parent_path().parent_path() / "share" / "natator");
    directories.emplace_back(NATATOR_SOURCE_DATA_DIR);
    return directories;
}

std::string joined(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text.empty() ? "none found; set NATATOR_DATA" : text;
}

/// Whether a name stays inside the data directory: words of letters, digits, '-' and '_' between single slashes.
bool is_plain_name(const std::string& name) {
    bool after_slash = true;
    for (const char c : name) {
        const bool word =
            ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9') || c == '-' || c == '_';
        if (!word && (c != '/' || after_slash)) return false;
        after_slash = c == '/';
    }
    return !after_slash;
}

}  // namespace

nlohmann::json read_data_file(const std::string& kind, const std::string& name) {
    if (name.ends_with(suffix)) {
        std::error_code failed;
        const fs::file_status status = fs::status(name, failed);
        if (fs::exists(status) && !fs::is_regular_file(status))  // a pipe may never end, or never begin
            throw InputError("file " + quoted(name) + ": is no regular file; must be one");
        return read_json_file(name);
    }
    if (is_plain_name(name)) {
        for (const fs::path& directory : data_directories()) {
            const fs::path path = directory / kind / (name + suffix);
            std::error_code failed;
            if (fs::is_regular_file(path, failed)) return read_json_file(path.string());
        }
    }
    const std::string one = kind.substr(0, kind.size() - 1);  // "scenes" -> "scene"
    throw InputError("unknown " + one + " " + quoted(name) + ": must be one of " + joined(data_file_names(kind)) +
                     ", or a path ending in .json");
}

std::vector<std::string> data_file_names(const std::string& kind) {
    std::set<std::string> names;
    for (const fs::path& directory : data_directories()) {
        std::error_code failed;
        const fs::path root = directory / kind;
        for (fs::recursive_directory_iterator file(root, failed), end; !failed && file != end; file.increment(failed)) {
            if (file->path().extension() != suffix) continue;
            names.insert(file->path().lexically_relative(root).replace_extension().generic_string());
        }
    }
    return {names.begin(), names.end()};
}

}  // namespace natator
