#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>

#include "unfinished_file.h"

namespace natator {

/// To be thrown of a file that cannot be written, for this reason.
std::runtime_error cannot_be_written(const std::string& path, const std::string& why);
/// The same where the last call of the system, whose reason errno holds, was the write that failed.
std::runtime_error cannot_be_written(const std::string& path);

/// A file that is there whole or not at all: it is written beside its place, as `file.PID`, and takes it when it is
/// finished. What stood there before stays until then. What is there and is no regular file, as a pipe, is written
/// directly; so is a file in a folder that takes no new ones, and one that standard output or error goes to.
class WholeFile {
public:
    explicit WholeFile(const std::filesystem::path& path, std::ios::openmode mode = {});
    ~WholeFile();  ///< removes what was not finished
    WholeFile(const WholeFile&) = delete;
    WholeFile& operator=(const WholeFile&) = delete;

    std::ofstream& stream() { return stream_; }
    /// Puts the file in its place. False if that or any write before failed.
    [[nodiscard]] bool finish();

private:
    std::filesystem::path target_, written_;
    std::optional<UnfinishedFile> unfinished_;  ///< where it is written beside its place; known before it is opened
    std::ofstream stream_;
    bool finished_ = false;
};

}  // namespace natator
