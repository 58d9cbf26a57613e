#include "run_record.h"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include "base/text.h"
#include "natator/error.h"

namespace natator::cli {
namespace {

using nlohmann::json;

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
    throw InputError("--output " + natator::quoted(path) + ": " + what);
}

/// Whether an object has a value for which `is` holds.
bool has(const json& object, const char* key, bool (json::*is)() const noexcept) {
    return object.is_object() && object.contains(key) && (object.at(key).*is)();
}

/// Whether a line holds what `converge` reads of a run.
bool is_run(const json& line) {
    if (!has(line, "of", &json::is_object) || !has(line, "result", &json::is_object)) return false;
    const json& result = line.at("result");
    return has(result, "status", &json::is_string) && has(result, "stopped", &json::is_string) &&
           has(result, "simulated", &json::is_number) &&
           (result.at("status") != "ok" || has(result, "distance", &json::is_number));
}

}  // namespace

RunRecord::RunRecord(const std::string& path) : path_(path) {
    if (path.empty()) return;
    lock();
    read();
}

/// Opens the file, which is made if it is not there: so it is known to be writable before anything is computed.
void RunRecord::lock() {
    std::error_code failed;
    const bool exists = std::filesystem::exists(path_, failed);
    if (exists && !std::filesystem::is_regular_file(path_, failed))
        refuse(path_, "is no regular file; must be one, or a new name");
    using State = system::FileLock::State;
    const State state = lock_.emplace(path_).state();
    const std::string why = std::generic_category().message(errno);
    if (state == State::failed && exists) refuse(path_, "cannot be read: " + why);
    if (state == State::failed)
        throw std::runtime_error("--output " + natator::quoted(path_) + ": cannot be written: " + why);
    if (state == State::taken) refuse(path_, "is in use by another natator-sim converge");
}

void RunRecord::read() {
    std::ifstream file(path_, std::ios::binary);
    std::ostringstream content;
    content << file.rdbuf();
    if (!file) refuse(path_, "cannot be read");
    const std::string text = std::move(content).str();
    std::size_t begin = 0;
    for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
        const json line = json::parse(text.substr(begin, end - begin), nullptr, false);
        if (!is_run(line))
            refuse(path_, "line " + std::to_string(lines_.size() + 1) +
                              " is no run of natator-sim converge; must be such a file, or a new name");
        lines_.push_back(line);
    }
    if (begin < text.size() && lines_.empty())
        refuse(path_, "holds no run of natator-sim converge; must be such a file, or a new name");
    if (begin < text.size()) std::filesystem::resize_file(path_, begin);
}

json RunRecord::find(const json& of) const {
    for (const json& line : lines_)
        if (line.at("of") == of) return line.at("result");
    return nullptr;
}

void RunRecord::add(const json& of, const json& request, const nlohmann::ordered_json& result) {
    if (path_.empty()) return;
    nlohmann::ordered_json line;
    line["of"] = of;
    line["request"] = request;
    line["result"] = result;
    std::ofstream file(path_, std::ios::binary | std::ios::app);
    file << line.dump() + "\n" << std::flush;
    if (!file)
        throw std::runtime_error("--output " + natator::quoted(path_) +
                                 ": cannot be written: " + std::generic_category().message(errno));
}

}  // namespace natator::cli
