#include "field.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "natator/error.h"
#include "text.h"

namespace natator::fields {
namespace {

/// Least number of single-character edits that turn `a` into `b`, an exchange of two neighbours being one
/// (Levenshtein's distance with transpositions: optimal string alignment).
std::size_t edits(std::string_view a, std::string_view b) {
    std::vector<std::size_t> last(b.size() + 1), row(b.size() + 1), before_last;
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        before_last = std::exchange(last, row);
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
            const bool exchanged = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (exchanged) row[j] = std::min(row[j], before_last[j - 2] + 1);
        }
    }
    return row[b.size()];
}

std::string lower(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (c != '_' && c != '-') result += ('A' <= c && c <= 'Z') ? static_cast<char>(c - 'A' + 'a') : c;
    }
    return result;
}

/// Edits that leave a resemblance: of three letters or four, one may be wrong.
std::size_t max_edits(std::string_view a, std::string_view b) {
    const std::size_t letters = std::min(a.size(), b.size());
    return letters >= 5 ? 2 : letters >= 3 ? 1 : 0;
}

std::string document_of(const Place& place) {
    return place.document.empty() ? "" : place.document + ": ";
}

template <class Vector>
void read_vector(const json& value, const Place& place, const Range& range, Vector& out) {
    if (!value.is_array() || value.size() != 3) refuse(place, value, "an array of 3 numbers, each " + range.text());
    for (int i = 0; i < 3; ++i)
        read(value[static_cast<std::size_t>(i)], place.item(static_cast<std::size_t>(i)), range, out[i]);
}

}  // namespace

std::string did_you_mean(std::string_view unknown, const std::vector<std::string_view>& allowed) {
    constexpr std::size_t max_compared = 64;
    if (unknown.size() > max_compared) return {};
    std::string_view best;
    std::size_t least = unknown.size();
    for (const std::string_view word : allowed) {
        const std::size_t distance = edits(lower(unknown), lower(word));
        if (distance < least && distance <= max_edits(unknown, word)) {
            least = distance;
            best = word;
        }
    }
    return best.empty() ? std::string() : "; did you mean " + std::string(best) + "?";
}

Place Place::key(std::string_view name) const {
    return {document, path + (path.empty() ? "" : ".") + std::string(name)};
}

Place Place::item(std::size_t index) const {
    return {document, path + "[" + std::to_string(index) + "]"};
}

void refuse(const Place& place, const json& value, const std::string& must_be) {
    const std::string path = place.path.empty() ? "value" : place.path;
    throw InputError(document_of(place) + path + " = " + shown(value) + ": must be " + must_be);
}

void refuse(const Place& place, const std::string& what) {
    throw InputError(document_of(place) + (place.path.empty() ? "" : place.path + ": ") + what);
}

std::string Range::text() const {
    const std::string limits = number_text(low) + ", " + number_text(high) + "]";
    return std::string("in ") + (low_open ? '(' : '[') + limits + (*unit != '\0' ? std::string(" (") + unit + ")" : "");
}

void read(const json& value, const Place& place, const Range& range, double& out) {
    if (!value.is_number() || !range.contains(value.get<double>())) refuse(place, value, "a number " + range.text());
    out = value.get<double>();
}

void read(const json& value, const Place& place, const Range& range, int& out) {
    const bool whole = value.is_number() && std::trunc(value.get<double>()) == value.get<double>();
    if (!whole || !range.contains(value.get<double>())) refuse(place, value, "a whole number " + range.text());
    out = static_cast<int>(value.get<double>());
}

void read(const json& value, const Place& place, const Range&, bool& out) {
    if (!value.is_boolean()) refuse(place, value, "true or false");
    out = value.get<bool>();
}

void read(const json& value, const Place& place, const Range&, std::string& out) {
    if (!value.is_string()) refuse(place, value, "a string");
    out = value.get<std::string>();
}

void read(const json& value, const Place& place, const Range& range, Eigen::Vector3d& out) {
    read_vector(value, place, range, out);
}

void read(const json& value, const Place& place, const Range& range, Eigen::Vector3i& out) {
    read_vector(value, place, range, out);
}

void require_zero(const json& value, const Place& place, const std::string& reason) {
    const auto zero = [](const json& v) { return v.is_number() && v.get<double>() == 0; };
    const bool zeros = value.is_array() && value.size() == 3 && std::all_of(value.begin(), value.end(), zero);
    if (!zero(value) && !zeros) refuse(place, value, reason);
}

void check_keys(const json& object, const Place& place, const std::vector<std::string_view>& allowed) {
    if (!object.is_object()) refuse(place, object, "an object");
    for (const auto& [key, value] : object.items()) {
        if (std::find(allowed.begin(), allowed.end(), key) != allowed.end()) continue;
        const std::string name = quoted(key), hint = did_you_mean(key, allowed);
        refuse(place.key(name.substr(1, name.size() - 2)),
               "unknown key (= " + shown(value) + ")" + (hint.empty() ? "; allowed: " + listed(allowed) : hint));
    }
}

void check_schema_key(const json& object, const Place& place) {
    if (!object.is_object() || !object.contains(schema_key)) return;
    std::string ignored;
    read(object.at(schema_key), place.key(schema_key), {}, ignored);
}

void drop_schema_key(json& object, const Place& place) {
    check_schema_key(object, place);
    if (object.is_object()) object.erase(schema_key);
}

const json& required(const json& object, const Place& place, const char* key) {
    const auto found = object.find(key);
    if (found == object.end()) refuse(place.key(key), "missing; must be given");
    return *found;
}

bool has(const json& object, const char* key) {
    return object.contains(key) && !object.at(key).is_null();
}

}  // namespace natator::fields
