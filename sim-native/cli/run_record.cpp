#include "run_record.h"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include "io/strict_json.h"
#include "natator/error.h"

namespace natator::cli {

RunRecord::RunRecord(const std::string& path) : path_(path) {
    std::error_code failed;
    if (path.empty()) return;
    if (!std::filesystem::exists(path, failed)) {  // known to be writable before anything is computed
        if (!std::ofstream(path, std::ios::app))
            throw std::runtime_error("--output " + natator::quoted(path) + ": cannot be written");
        return;
    }
    if (!std::filesystem::is_regular_file(path, failed))
        throw InputError("--output " + natator::quoted(path) + ": is no regular file; must be one, or a new name");
    std::ifstream file(path, std::ios::binary);
    std::ostringstream content;
    content << file.rdbuf();
    if (!file) throw InputError("--output " + natator::quoted(path) + ": cannot be read");
    const std::string text = std::move(content).str();
    std::size_t begin = 0;
    for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
        const nlohmann::json line = nlohmann::json::parse(text.substr(begin, end - begin), nullptr, false);
        if (!line.is_object() || !line.contains("of") || !line.contains("result"))
            throw InputError("--output " + natator::quoted(path) + ": line " + std::to_string(lines_.size() + 1) +
                             " is no run of natator-sim converge; must be such a file, or a new name");
        lines_.push_back(line);
    }
    if (begin < text.size() && lines_.empty())
        throw InputError("--output " + natator::quoted(path) +
                         ": holds no run of natator-sim converge; must be such a file, or a new name");
    if (begin < text.size()) std::filesystem::resize_file(path, begin);
}

nlohmann::json RunRecord::find(const nlohmann::json& of) const {
    for (const nlohmann::json& line : lines_)
        if (line.at("of") == of) return line.at("result");
    return nullptr;
}

void RunRecord::add(const nlohmann::json& of, const nlohmann::json& request, const nlohmann::ordered_json& result) {
    if (path_.empty()) return;
    nlohmann::ordered_json line;
    line["of"] = of;
    line["request"] = request;
    line["result"] = result;
    std::ofstream file(path_, std::ios::binary | std::ios::app);
    file << line.dump() + "\n" << std::flush;
    if (!file) throw std::runtime_error("--output " + natator::quoted(path_) + ": cannot be written");
}

}  // namespace natator::cli
