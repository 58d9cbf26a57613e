#include "whole_file.h"

#include <cerrno>
#include <system_error>

#include "system.h"
#include "text.h"

namespace natator {
namespace {

namespace fs = std::filesystem;

/// Where a file is, if there is one: its place and not that of a link to it.
fs::path place_of(const fs::path& path) {
    std::error_code failed;
    const fs::path found = fs::canonical(path, failed);
    return failed ? path : found;
}

/// Whether another file may take the place of what is there.
bool can_be_replaced(const fs::path& file) {
    std::error_code failed;
    const fs::file_status there = fs::symlink_status(file, failed);
    if (!fs::exists(there)) return true;
    return fs::is_regular_file(there) && !system::is_standard_output(file) &&
           system::is_writable(fs::absolute(file).parent_path());
}

fs::path sibling(fs::path file) {
    return (file += ".") += std::to_string(system::process_id());
}

}  // namespace

std::runtime_error cannot_be_written(const std::string& path, const std::string& why) {
    return std::runtime_error("file " + quoted(path) + ": cannot be written: " + why);
}

std::runtime_error cannot_be_written(const std::string& path) {
    return cannot_be_written(path, std::generic_category().message(errno));
}

WholeFile::WholeFile(const fs::path& path, std::ios::openmode mode)
    : target_(place_of(path)), written_(can_be_replaced(target_) ? sibling(target_) : target_) {
    if (written_ != target_) unfinished_.emplace(written_);
    stream_.open(written_, mode | std::ios::out | std::ios::binary);
    std::error_code failed;
    if (!stream_ || written_ == target_) return;
    if (const fs::file_status there = fs::status(target_, failed); fs::exists(there))
        fs::permissions(written_, there.permissions(), failed);
}

WholeFile::~WholeFile() {
    std::error_code failed;
    if (finished_ || written_ == target_) return;
    stream_.close();
    fs::remove(written_, failed);
}

bool WholeFile::finish() {
    std::error_code failed;
    stream_.close();
    if (!stream_) return false;
    if (written_ != target_) fs::rename(written_, target_, failed);
    return finished_ = !failed;
}

}  // namespace natator
