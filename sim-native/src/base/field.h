#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

/// Reading of JSON objects by tables: one line per field with its key, member, range and unit.
namespace natator::fields {

using nlohmann::json;

/// Where a value stands, for messages: which document, and the path in it (`solver.gravity[1]`); an option is in none.
struct Place {
    std::string document;
    std::string path;

    Place key(std::string_view name) const;
    Place item(std::size_t index) const;
};

/// Throws InputError: "document: path = value: must be ...".
[[noreturn]] void refuse(const Place& place, const json& value, const std::string& must_be);
/// Throws InputError: "document: path: what".
[[noreturn]] void refuse(const Place& place, const std::string& what);

/// What values a number may have. All ranges lie within what a float can hold.
struct Range {
    double low;
    double high;
    bool low_open = false;  ///< `low` itself is not allowed
    const char* unit = "";

    bool contains(double value) const { return (low_open ? value > low : value >= low) && value <= high; }
    std::string text() const;  ///< "in [0, 1] (length)"
};

template <class T>
using Member =
    std::variant<double T::*, int T::*, bool T::*, std::string T::*, Eigen::Vector3d T::*, Eigen::Vector3i T::*>;

template <class T>
struct Field {
    const char* key;
    Member<T> member;
    Range range{0, 0};  ///< of numbers, and of each component of vectors
};

void read(const json& value, const Place& place, const Range& range, double& out);
void read(const json& value, const Place& place, const Range& range, int& out);
void read(const json& value, const Place& place, const Range& range, bool& out);
void read(const json& value, const Place& place, const Range& range, std::string& out);
void read(const json& value, const Place& place, const Range& range, Eigen::Vector3d& out);
void read(const json& value, const Place& place, const Range& range, Eigen::Vector3i& out);

/// A value as a document would have it.
template <class Value>
json as_json(const Value& value) {
    return value;
}
inline json as_json(const Eigen::Vector3d& value) {
    return {value.x(), value.y(), value.z()};
}
inline json as_json(const Eigen::Vector3i& value) {
    return {value.x(), value.y(), value.z()};
}

/// Refuses a value other than 0 (false, a vector of zeros).
void require_zero(const json& value, const Place& place, const std::string& reason);

/// "; did you mean X?" with the word of `allowed` that an unknown one most resembles; empty if it resembles none.
std::string did_you_mean(std::string_view unknown, const std::vector<std::string_view>& allowed);

/// The words with commas between them.
template <class Word>
std::string listed(const std::vector<Word>& words) {
    std::string list;
    for (const Word& word : words) list += (list.empty() ? "" : ", ") + std::string(word);
    return list;
}

/// Refuses what is not an object, and keys that are not among `allowed`.
void check_keys(const json& object, const Place& place, const std::vector<std::string_view>& allowed);

/// By this key at its top an editor finds the schema of a file. Readers ignore its value, which must be a string.
inline constexpr const char* schema_key = "$schema";

void check_schema_key(const json& object, const Place& place);

/// Takes the key away, if `object` is one that has it.
void drop_schema_key(json& object, const Place& place);

/// The value of a key that must be there.
const json& required(const json& object, const Place& place, const char* key);

/// Whether a part is there: its key is, and is not null.
bool has(const json& object, const char* key);

/// The value of one of several words.
template <class Enum>
Enum read_choice(const json& value, const Place& place, const std::vector<std::pair<std::string_view, Enum>>& choices) {
    std::string list;
    for (const auto& [word, choice] : choices) {
        if (value.is_string() && value.get_ref<const std::string&>() == word) return choice;
        list += (list.empty() ? "\"" : "\" or \"") + std::string(word);
    }
    refuse(place, value, list + "\"");
}

/// Reads the fields of `table` that `object` has into `out`; the others keep their value.
template <class T>
void read_fields(const json& object, const Place& place, const std::vector<Field<T>>& table, T& out) {
    for (const Field<T>& field : table) {
        const auto found = object.find(field.key);
        if (found == object.end()) continue;
        const Place at = place.key(field.key);
        std::visit([&](auto member) { read(*found, at, field.range, out.*member); }, field.member);
    }
}

/// As read_fields, and refuses any key but those of `table` and those of `also`, which the caller reads itself.
template <class T>
void read_object(const json& object, const Place& place, const std::vector<Field<T>>& table,
                 const std::vector<std::string_view>& also, T& out) {
    std::vector<std::string_view> allowed = also;
    for (const Field<T>& field : table) allowed.emplace_back(field.key);
    check_keys(object, place, allowed);
    read_fields(object, place, table, out);
}

/// Refuses a field of `table` whose value in `object`, which a program has made, no document could give it.
template <class T>
void check_object(const T& object, const Place& place, const std::vector<Field<T>>& table) {
    for (const Field<T>& field : table) {
        const auto check = [&](auto member) {
            auto value = object.*member;
            read(as_json(value), place.key(field.key), field.range, value);
        };
        std::visit(check, field.member);
    }
}

}  // namespace natator::fields
