#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>
#include <tuple>

#include "io/decimal_number.h"
#include "io/strict_json.h"
#include "natator/error.h"
#include "natator/limits.h"
#include "triangle_mesh.h"

namespace natator {
namespace {

constexpr double largest_coordinate = 1e9;  // of a file's units; a float's 7 digits mean little beyond

/// Words of a text, line by line.
class Words {
public:
    explicit Words(std::string_view text) : rest_(text) {}

    /// Goes to the next line. False at the end.
    bool next_line() {
        if (rest_.empty()) return false;
        const std::size_t end = rest_.find('\n');
        line_ = rest_.substr(0, end);
        rest_ = end == std::string_view::npos ? std::string_view() : rest_.substr(end + 1);
        line_ = line_.substr(0, line_.find('#'));
        ++number_;
        return true;
    }
    /// The next word of the line; empty at its end.
    std::string_view next() {
        constexpr std::string_view space = " \t\r\v\f";
        const std::size_t begin = line_.find_first_not_of(space);
        if (begin == std::string_view::npos) return line_ = {};
        const std::size_t end = std::min(line_.find_first_of(space, begin), line_.size());
        const std::string_view word = line_.substr(begin, end - begin);
        line_ = line_.substr(end);
        return word;
    }
    long number() const { return number_; }

    [[noreturn]] void refuse(const std::string& what) const {
        throw InputError("line " + std::to_string(number_) + ": " + what);
    }
    Eigen::Vector3d next_place() {
        Eigen::Vector3d place;
        for (double& value : place) value = next_number();
        return place;
    }

private:
    double next_number() {
        const std::string_view word = next();
        const std::optional<double> value = decimal_number(word);
        if (!value || std::abs(*value) > largest_coordinate)
            refuse((word.empty() ? "a coordinate is missing" : quoted(std::string(word)) + " is no coordinate") +
                   "; must be three numbers within 1e9");
        return *value + 0.0;  // -0 is 0
    }

    std::string_view rest_, line_;
    long number_ = 0;
};

/// Collects triangles; equal vertices become one.
class MeshBuilder {
public:
    int vertex(const Eigen::Vector3d& place) {
        const auto [found, is_new] =
            known_.try_emplace(std::tuple(place.x(), place.y(), place.z()), static_cast<int>(mesh_.vertices.size()));
        if (is_new) mesh_.vertices.push_back(place);
        return found->second;
    }
    void triangle(int a, int b, int c, long source) {
        if (mesh_.triangles.size() == static_cast<std::size_t>(limits::mesh_faces))
            throw InputError("more than " + std::to_string(limits::mesh_faces) + " triangles");
        mesh_.triangles.emplace_back(a, b, c);
        mesh_.source.push_back(source);
    }
    TriangleMesh finish(bool has_lines) {
        mesh_.has_lines = has_lines;
        if (mesh_.triangles.empty()) throw InputError("has no faces");
        return std::move(mesh_);
    }

private:
    TriangleMesh mesh_;
    std::map<std::tuple<double, double, double>, int> known_;
};

/// What stands behind the first slash of an .obj corner, the numbers of a texture and of a normal: either may be left out.
void check_other_numbers(std::string_view word, const Words& words) {
    std::size_t slashes = 0;
    for (std::size_t begin = word.find('/'); begin != std::string_view::npos; begin = word.find('/', begin), ++slashes) {
        std::string_view digits = word.substr(++begin);
        digits = digits.substr(0, digits.find('/'));
        if (digits.starts_with('-')) digits.remove_prefix(1);
        if (slashes == 2 || digits.find_first_not_of("0123456789") != std::string_view::npos)
            words.refuse("corner " + quoted(std::string(word)) + ": must be whole numbers, as 7, 7/1, 7//2 or 7/1/2");
    }
}

/// A corner of an .obj face: the number before the first slash, from 1, or from -1 backwards.
int obj_corner(std::string_view word, const std::vector<int>& vertices, const Words& words) {
    check_other_numbers(word, words);
    const std::string_view digits = word.substr(0, word.find('/'));
    long number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    const auto count = static_cast<long>(vertices.size());
    const long index = number < 0 ? count + number : number - 1;
    if (digits.empty() || error != std::errc() || end != digits.data() + digits.size() || index < 0 || index >= count)
        words.refuse("corner " + quoted(std::string(word)) + ": must be one of the " + std::to_string(count) +
                     " vertices before this line");
    return vertices[static_cast<std::size_t>(index)];
}

TriangleMesh read_obj(std::string_view text) {
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
    Words words(text);
    MeshBuilder builder;
    std::vector<int> vertices;
    while (words.next_line()) {
        const std::string_view what = words.next();
        if (what == "v") vertices.push_back(builder.vertex(words.next_place()));
        if (what != "f") continue;
        std::vector<int> corners;
        for (std::string_view word = words.next(); !word.empty(); word = words.next())
            corners.push_back(obj_corner(word, vertices, words));
        if (corners.size() < 3) words.refuse("a face of " + std::to_string(corners.size()) + " corners; must be 3 or more");
        for (std::size_t i = 2; i < corners.size(); ++i)
            builder.triangle(corners[0], corners[i - 1], corners[i], words.number());
    }
    return builder.finish(true);
}

TriangleMesh read_text_stl(std::string_view text) {
    Words words(text);
    MeshBuilder builder;
    std::vector<int> corners;
    bool open = false, ended = false;
    while (words.next_line()) {
        const std::string_view what = words.next();
        if (what == "facet") {
            if (open) words.refuse("a facet within a facet");
            open = true;
        } else if (what == "vertex") {
            if (!open) words.refuse("a vertex outside of a facet");
            corners.push_back(builder.vertex(words.next_place()));
        } else if (what == "endfacet") {
            if (corners.size() != 3) words.refuse("a facet of " + std::to_string(corners.size()) + " vertices; must be 3");
            builder.triangle(corners[0], corners[1], corners[2], words.number());
            corners.clear();
            open = false;
        } else if (what == "endsolid") {
            ended = true;
        } else if (!what.empty() && what != "solid" && what != "outer" && what != "endloop") {
            words.refuse(quoted(std::string(what)) + ": must be a word of a text .stl: facet, vertex, endfacet …");
        }
    }
    if (open || !ended) throw InputError("ends at line " + std::to_string(words.number()) + " before its endsolid");
    return builder.finish(true);
}

constexpr std::size_t stl_head = 84, stl_facet = 50;

std::size_t binary_stl_facets(std::string_view bytes) {
    std::uint32_t facets = 0;
    if (bytes.size() >= stl_head) std::memcpy(&facets, bytes.data() + 80, sizeof facets);
    return facets;
}

TriangleMesh read_binary_stl(std::string_view bytes) {
    static_assert(std::endian::native == std::endian::little, "numbers are in memory as in the file");
    MeshBuilder builder;
    for (std::size_t i = 0; i < binary_stl_facets(bytes); ++i) {
        Eigen::Vector3i corners;
        for (std::size_t k = 0; k < 3; ++k) {
            float place[3];
            std::memcpy(place, bytes.data() + stl_head + stl_facet * i + 12 * (k + 1), sizeof place);
            for (const float value : place)
                if (!(std::abs(value) <= largest_coordinate))
                    throw InputError("facet " + std::to_string(i + 1) + ": a coordinate is no number within 1e9");
            corners[static_cast<Eigen::Index>(k)] = builder.vertex({place[0] + 0.0, place[1] + 0.0, place[2] + 0.0});
        }
        builder.triangle(corners[0], corners[1], corners[2], static_cast<long>(i) + 1);
    }
    return builder.finish(false);
}

TriangleMesh read_stl(std::string_view bytes) {
    const std::size_t facets = binary_stl_facets(bytes);
    if (bytes.size() >= stl_head && bytes.size() == stl_head + stl_facet * facets) return read_binary_stl(bytes);
    const std::size_t begin = bytes.find_first_not_of(" \t\r\n");
    if (begin != std::string_view::npos && bytes.substr(begin).starts_with("solid") &&
        bytes.find('\0') == std::string_view::npos)
        return read_text_stl(bytes);
    std::ostringstream text;
    text << "has " << bytes.size() << " bytes";
    if (bytes.size() >= stl_head)
        text << ", a binary .stl of " << facets << " facets, as its head says, " << stl_head + stl_facet * facets;
    text << "; must be a whole .stl, binary or text that begins with solid";
    throw InputError(text.str());
}

}  // namespace

std::string TriangleMesh::name(std::size_t triangle) const {
    return (has_lines ? "the face of line " : "facet ") + std::to_string(source[triangle]);
}

std::string shown(const Eigen::Vector3d& place) {
    std::ostringstream text;
    text << '(' << place.x() << ", " << place.y() << ", " << place.z() << ')';
    return text.str();
}

double signed_volume(const TriangleMesh& mesh) {
    const Eigen::Vector3d middle = mesh.vertices.front();
    double sum = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        sum += (mesh.corner(i, 0) - middle).dot((mesh.corner(i, 1) - middle).cross(mesh.corner(i, 2) - middle));
    return sum / 6;
}

TriangleMesh read_mesh(const std::string& bytes, const std::string& name) {
    return name.ends_with(".obj") ? read_obj(bytes) : read_stl(bytes);
}

}  // namespace natator
