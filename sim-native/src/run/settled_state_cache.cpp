#include "natator/settled_state_cache.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <system_error>
#include <vector>

#include "base/byte_writer.h"
#include "base/fnv1a.h"
#include "base/whole_file.h"
#include "natator/limits.h"
#include "settled_state_key.h"

namespace natator {
namespace {

namespace fs = std::filesystem;

/// A file holds the key, the state and a hash of both, so that half a file is not taken for a whole one.
std::uint64_t hash_of(const std::string& bytes) {
    Fnv1a hash;
    hash.add(bytes);
    return hash.value();
}

fs::path file_for(const fs::path& folder, const std::string& key) {
    char name[32];
    std::snprintf(name, sizeof name, "%016llx.start", static_cast<unsigned long long>(hash_of(key)));
    return folder / name;
}

template <class Real>
std::string bytes_of(const State<Real>& state) {
    ByteWriter bytes;
    bytes.add(state.position);
    bytes.add(state.velocity);
    bytes.add(state.cluster_rotation);
    bytes.add(state.cluster_centre);
    bytes.add(state.spring_rest_length);
    return bytes.bytes();
}

/// Reads values of Real, `components` to each, behind their count. Moves `at` on; false if the count is another one.
template <class Real, class Set>
bool read_into(const char*& at, std::size_t count, int components, const Set& set) {
    std::size_t stored = 0;
    std::memcpy(&stored, at, sizeof stored);
    at += sizeof stored;
    if (stored != count) return false;
    for (std::size_t i = 0; i < count; ++i) {
        Real values[4];
        std::memcpy(values, at, sizeof(Real) * components);
        at += sizeof(Real) * components;
        set(i, values);
    }
    return true;
}

/// Fills a state of the right sizes from bytes_of; false if they do not fit it.
template <class Real>
bool read_state(const std::string& bytes, State<Real>& state) {
    if (bytes.size() != bytes_of(state).size()) return false;
    const char* at = bytes.data();
    const auto read_vectors = [&at](std::vector<Vector3<Real>>& vectors) {
        return read_into<Real>(at, vectors.size(), 3,
                               [&](std::size_t i, const Real* v) { vectors[i] = {v[0], v[1], v[2]}; });
    };
    return read_vectors(state.position) && read_vectors(state.velocity) &&
           read_into<Real>(
               at, state.cluster_rotation.size(), 4,
               [&](std::size_t i, const Real* v) { state.cluster_rotation[i].coeffs() << v[0], v[1], v[2], v[3]; }) &&
           read_vectors(state.cluster_centre) &&
           read_into<Real>(at, state.spring_rest_length.size(), 1,
                           [&](std::size_t i, const Real* v) { state.spring_rest_length[i] = v[0]; });
}

/// Nothing to settle, or too large.
bool is_not_worth_it(const Model& model, const Settling& settling) {
    return settling.updates == 0 || model.particles() > limits::cached_particles;
}

/// Leaves at most `max_files` starts, the last written ones.
void prune(const fs::path& folder, std::size_t max_files) {
    std::error_code error;
    std::vector<std::pair<fs::file_time_type, fs::path>> files;
    for (const auto& entry : fs::directory_iterator(folder, error))
        if (entry.path().extension() == ".start") files.emplace_back(entry.last_write_time(error), entry.path());
    if (files.size() <= max_files) return;
    std::sort(files.begin(), files.end());
    for (std::size_t i = 0; i < files.size() - max_files; ++i) fs::remove(files[i].second, error);
}

}  // namespace

SettledStateCache::SettledStateCache(fs::path folder) : folder_(std::move(folder)) {}

std::optional<SettledStateCache> SettledStateCache::of_user() {
    const auto variable = [](const char* name) -> std::optional<std::string> {
        const char* const value = std::getenv(name);
        return value ? std::optional<std::string>(value) : std::nullopt;
    };
    if (const auto own = variable("NATATOR_CACHE"))
        return own->empty() ? std::nullopt : std::optional<SettledStateCache>(SettledStateCache(*own));
    if (const auto shared = variable("XDG_CACHE_HOME"); shared && !shared->empty())
        return SettledStateCache(fs::path(*shared) / "natator");
    if (const auto home = variable("HOME"); home && !home->empty())
        return SettledStateCache(fs::path(*home) / ".cache" / "natator");
    return std::nullopt;
}

template <class Real>
std::optional<State<Real>> SettledStateCache::find(const Model& model, const Settling& settling,
                                                   const std::string& by) const {
    if (is_not_worth_it(model, settling)) return std::nullopt;
    std::string key = settled_state_key(model, settling, sizeof(Real));
    if (key.empty()) return std::nullopt;
    key.insert(0, by);
    std::ifstream file(file_for(folder_, key), std::ios::binary);
    if (!file) return std::nullopt;
    std::ostringstream content;
    content << file.rdbuf();
    const std::string bytes = std::move(content).str();
    std::uint64_t hash = 0;
    if (bytes.size() < key.size() + sizeof hash || bytes.compare(0, key.size(), key) != 0) return std::nullopt;
    const std::string body = bytes.substr(0, bytes.size() - sizeof hash);
    std::memcpy(&hash, bytes.data() + body.size(), sizeof hash);
    if (hash != hash_of(body)) return std::nullopt;
    State<Real> state = initial_state<Real>(model);
    if (!read_state(body.substr(key.size()), state)) return std::nullopt;
    return state;
}

template <class Real>
void SettledStateCache::keep(const Model& model, const Settling& settling, const State<Real>& settled,
                             const std::string& by) const {
    if (is_not_worth_it(model, settling)) return;
    std::string key = settled_state_key(model, settling, sizeof(Real));
    if (key.empty()) return;
    key.insert(0, by);
    std::string bytes = key + bytes_of(settled);
    const std::uint64_t hash = hash_of(bytes);
    bytes.append(reinterpret_cast<const char*>(&hash), sizeof hash);

    std::error_code error;
    fs::create_directories(folder_, error);
    WholeFile file(file_for(folder_, key), std::ios::binary);
    file.stream().write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    static_cast<void>(file.finish());  // what is not kept is settled anew
    prune(folder_, max_files);
}

template std::optional<State<float>> SettledStateCache::find<float>(const Model&, const Settling&,
                                                                    const std::string&) const;
template std::optional<State<double>> SettledStateCache::find<double>(const Model&, const Settling&,
                                                                      const std::string&) const;
template void SettledStateCache::keep<float>(const Model&, const Settling&, const State<float>&,
                                             const std::string&) const;
template void SettledStateCache::keep<double>(const Model&, const Settling&, const State<double>&,
                                              const std::string&) const;

}  // namespace natator
