#include "unfinished_file.h"

#include <array>

#include "system.h"

namespace natator {
namespace {

std::array<std::atomic<std::string*>, 64> slots;
static_assert(std::atomic<std::string*>::is_always_lock_free, "a signal's handler must not wait");

}  // namespace

UnfinishedFile::UnfinishedFile(const std::filesystem::path& path) : name_(new std::string(path.string())) {
    for (auto& slot : slots) {
        std::string* none = nullptr;
        if (!slot.compare_exchange_strong(none, name_)) continue;
        slot_ = &slot;
        return;
    }
}

/// A name that a handler has taken is left to it.
UnfinishedFile::~UnfinishedFile() {
    std::string* own = name_;
    if (!slot_ || slot_->compare_exchange_strong(own, nullptr)) delete name_;
}

void remove_unfinished_files() {
    for (auto& slot : slots)
        if (const std::string* name = slot.exchange(nullptr)) system::remove_file(name->c_str());
}

}  // namespace natator
