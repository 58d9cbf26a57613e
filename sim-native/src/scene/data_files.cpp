#include "data_files.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/field.h"
#include "base/strict_json.h"
#include "base/system.h"
#include "base/text.h"
#include "natator/error.h"

namespace natator {
namespace {

namespace fs = std::filesystem;

constexpr const char* suffix = ".json";

fs::path folder_of(const std::string& kind, const fs::path& data) {
    return (data.empty() ? data_directory() : data) / kind;
}

/// What a name may be, for messages: the one that it resembles, or else all.
std::string advice(const std::string& kind, const std::string& unknown, const fs::path& data) {
    const std::vector<std::string> names = data_file_names(kind, data);
    if (names.empty()) return ": none found in " + quoted(folder_of(kind, data).string()) + "; set NATATOR_DATA";
    const std::string hint = fields::did_you_mean(unknown, {names.begin(), names.end()});
    return hint.empty() ? ": must be one of " + fields::listed(names) + ", or a path ending in .json" : hint;
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

fs::path data_directory() {
    if (const char* const chosen = std::getenv("NATATOR_DATA"); chosen && *chosen != '\0') return chosen;
    return system::program_file().parent_path().parent_path() / "share" / "natator";
}

nlohmann::json read_data_file(const std::string& kind, const std::string& name, const fs::path& data) {
    if (name.ends_with(suffix)) {
        std::error_code failed;
        const fs::file_status status = fs::status(name, failed);
        if (fs::exists(status) && !fs::is_regular_file(status))  // a pipe may never end, or never begin
            throw InputError("file " + quoted(name) + ": is no regular file; must be one");
        return read_json_file(name);
    }
    if (is_plain_name(name)) {
        const fs::path path = folder_of(kind, data) / (name + suffix);
        std::error_code failed;
        if (fs::is_regular_file(path, failed)) return read_json_file(path.string());
    }
    const std::string one = kind.substr(0, kind.size() - 1);  // "scenes" -> "scene"
    throw InputError("unknown " + one + " " + quoted(name) + advice(kind, name, data));
}

fs::path mesh_path(const std::string& file, const fs::path& data) {
    std::error_code failed;
    const fs::path bundled = folder_of("creatures", data) / file;
    return file.find('/') == std::string::npos && fs::exists(bundled, failed) ? bundled : fs::path(file);
}

std::vector<std::string> data_file_names(const std::string& kind, const fs::path& data) {
    std::vector<std::string> names;
    std::error_code failed;
    const fs::path root = folder_of(kind, data);
    for (fs::recursive_directory_iterator file(root, failed), end; !failed && file != end; file.increment(failed)) {
        if (file->path().extension() != suffix) continue;
        names.push_back(file->path().lexically_relative(root).replace_extension().generic_string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

}  // namespace natator
