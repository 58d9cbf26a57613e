#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/system.h"

namespace natator::cli {

/// Runs that are done, each a line of a file: {"of": what determines it, "request": ..., "result": ...}. A line is
/// written as soon as its run has ended, so that what an interrupted command computed is there for the next. The file
/// is locked meanwhile: of two commands at once each would do the runs of the other again.
class RunRecord {
public:
    /// Without a path nothing is kept. Reads what the file holds if there is one; what is behind its last whole line is
    /// cut off. Throws InputError when a line is none of such a file or another command has it, std::runtime_error
    /// when it can't be made.
    explicit RunRecord(const std::string& path);

    /// The result of a run that is there; null otherwise.
    nlohmann::json find(const nlohmann::json& of) const;
    /// Throws std::runtime_error when the file can't be written.
    void add(const nlohmann::json& of, const nlohmann::json& request, const nlohmann::ordered_json& result);

private:
    void lock();
    void read();

    std::string path_;
    std::optional<system::FileLock> lock_;
    std::vector<nlohmann::json> lines_;
};

}  // namespace natator::cli
