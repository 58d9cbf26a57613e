#pragma once

#include <atomic>
#include <filesystem>
#include <string>

namespace natator {

/// The name of a file that is worth nothing until it is finished, kept for remove_unfinished_files while this lives. Of
/// many at once the last are not kept.
class UnfinishedFile {
public:
    explicit UnfinishedFile(const std::filesystem::path& path);
    ~UnfinishedFile();
    UnfinishedFile(const UnfinishedFile&) = delete;
    UnfinishedFile& operator=(const UnfinishedFile&) = delete;

private:
    std::string* name_;  ///< owned here, or by remove_unfinished_files once it is taken out of its slot
    std::atomic<std::string*>* slot_ = nullptr;
};

/// Removes these files. For a handler of a signal that ends the program.
void remove_unfinished_files();

}  // namespace natator
