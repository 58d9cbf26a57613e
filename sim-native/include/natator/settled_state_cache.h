#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "natator/model.h"
#include "natator/scene.h"

namespace natator {

/// Settled starts of scenes in a folder, one file each, so that a scene settles once and not in every evaluation.
/// A start is found by its whole content: all that settling depends on, with the precision, the instruction set and the
/// build of the program (or the shared library), stands in the file and is compared byte by byte. A build is known by
/// its build id, which most linkers give, or are told to by -Wl,--build-id; without one nothing is kept. Members may be
/// called from several threads, and several processes may share a folder. Never throws: unreadable entries are misses,
/// failed writes are ignored.
class SettledStateCache {
public:
    explicit SettledStateCache(std::filesystem::path folder);  ///< the folder is made when something is kept

    /// In $NATATOR_CACHE, else $XDG_CACHE_HOME/natator, else $HOME/.cache/natator; none if that is empty or unset.
    static std::optional<SettledStateCache> of_user();

    /// The start of a model, none if it is not kept. `by`: what settles it, if that is not the CPU.
    template <class Real>
    std::optional<State<Real>> find(const Model& model, const Settling& settling, const std::string& by = {}) const;
    /// Keeps a start; the oldest file gives way to it.
    template <class Real>
    void keep(const Model& model, const Settling& settling, const State<Real>& settled,
              const std::string& by = {}) const;

    const std::filesystem::path& folder() const { return folder_; }  ///< where starts are kept

    static constexpr int max_files = 64;  ///< kept; the oldest give way

private:
    std::filesystem::path folder_;
};

}  // namespace natator
