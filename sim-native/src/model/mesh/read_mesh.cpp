#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <sstream>
#include <string_view>

#include "base/text.h"
#include "natator/error.h"
#include "natator/limits.h"
#include "polygon_mesh.h"
#include "text_words.h"

namespace natator {
namespace {

/// Counts the triangles that faces will make.
class FaceReader {
public:
    explicit FaceReader(bool has_lines) { mesh.has_lines = has_lines; }

    void add(std::vector<int> corners, long source) {
        triangles_ += static_cast<long>(corners.size()) - 2;
        check_count(triangles_);
        mesh.faces.push_back(std::move(corners));
        mesh.source.push_back(source);
    }
    static void check_count(long triangles) {
        if (triangles > limits::mesh_faces)
            throw InputError("more than " + std::to_string(limits::mesh_faces) + " triangles");
    }

    PolygonMesh mesh;

private:
    long triangles_ = 0;
};

/// What stands behind the first slash of an .obj corner, the numbers of a texture and of a normal: either may be left
/// out.
void check_other_numbers(std::string_view word, const TextWords& words) {
    std::size_t slashes = 0;
    for (std::size_t begin = word.find('/'); begin != std::string_view::npos;
         begin = word.find('/', begin), ++slashes) {
        std::string_view digits = word.substr(++begin);
        digits = digits.substr(0, digits.find('/'));
        if (digits.starts_with('-')) digits.remove_prefix(1);
        if (slashes == 2 || digits.find_first_not_of("0123456789") != std::string_view::npos)
            words.refuse("corner " + quoted(std::string(word)) + ": must be whole numbers, as 7, 7/1, 7//2 or 7/1/2");
    }
}

std::string must_be_one_of(long vertices) {
    return "must be one of the " + std::to_string(vertices) + " vertices";
}

/// A corner of an .obj face, the number before the first slash: from 1, or from -1 backwards.
int obj_corner(std::string_view word, long vertices, const TextWords& words) {
    check_other_numbers(word, words);
    const std::string_view digits = word.substr(0, word.find('/'));
    long number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    const long index = number < 0 ? vertices + number : number - 1;
    if (digits.empty() || error != std::errc() || end != digits.data() + digits.size() || index < 0 ||
        index > std::numeric_limits<int>::max())
        words.refuse("corner " + quoted(std::string(word)) + ": " + must_be_one_of(vertices) + " before this line");
    return static_cast<int>(index);
}

std::vector<int> obj_corners(TextWords& words, long vertices) {
    std::vector<int> corners;
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        corners.push_back(obj_corner(word, vertices, words));
        FaceReader::check_count(static_cast<long>(corners.size()) - 2);
    }
    if (corners.size() < 3) words.refuse("a face of " + std::to_string(corners.size()) + " corners; must be 3 or more");
    return corners;
}

Eigen::Vector3d obj_vertex(TextWords& words) {
    Eigen::Vector3d place;
    for (double& value : place) value = words.coordinate(words.next());
    for (std::string_view word = words.next(); !word.empty(); word = words.next())  // a weight or a colour
        if (!decimal_number(word)) words.refuse(quoted(std::string(word)) + " behind a vertex; must be a number");
    return place;
}

TriangleMesh read_obj(std::string_view text) {
    TextWords words(text, true);
    FaceReader reader(true);
    std::vector<Eigen::Vector3d>& vertices = reader.mesh.vertices;
    while (words.next_line()) {
        const std::string what = lower_case(words.next());
        if (what == "v") vertices.push_back(obj_vertex(words));
        // "fo" is how version 2 of the format calls a face.
        if (what == "f" || what == "fo")
            reader.add(obj_corners(words, static_cast<long>(vertices.size())), words.number());
    }
    for (std::size_t i = 0; i < reader.mesh.faces.size(); ++i)
        for (const int corner : reader.mesh.faces[i])
            if (static_cast<std::size_t>(corner) >= vertices.size())
                throw InputError("line " + std::to_string(reader.mesh.source[i]) + ": corner \"" +
                                 std::to_string(corner + 1L) +
                                 "\": " + must_be_one_of(static_cast<long>(vertices.size())));
    return triangles_of(std::move(reader.mesh));
}

/// Goes behind a solid's name, which ends with its line, or where a facet begins in that.
void skip_name(TextWords& words) {
    std::string_view& rest = words.rest_of_line();
    rest.remove_prefix(std::min(lower_case(rest).find("facet normal"), rest.size()));
}

/// A facet's three vertices, from behind its first word to that which ends it.
std::vector<int> stl_facet(TextWords& words, std::vector<Eigen::Vector3d>& vertices) {
    std::vector<int> corners;
    bool in_normal = true;  // which does not count: it may be missing, or no numbers
    for (std::string_view word = words.next_of_text(); !word.empty(); word = words.next_of_text()) {
        std::string what = lower_case(word);
        if (what == "end") what += lower_case(words.next());
        if (what == "facet") words.refuse("a facet within a facet");
        if (what == "vertex") {
            in_normal = false;
            Eigen::Vector3d& place = vertices.emplace_back();
            for (double& value : place) value = words.coordinate(words.next_of_text());
            corners.push_back(static_cast<int>(vertices.size()) - 1);
        } else if (what == "endfacet") {
            if (corners.size() != 3)
                words.refuse("a facet of " + std::to_string(corners.size()) + " vertices; must be 3");
            return corners;
        } else if (what == "outer") {
            in_normal = false;
        } else if (!in_normal && what != "loop" && what != "endloop") {
            words.refuse(quoted(std::string(word)) + ": must be a word of a text .stl: vertex, endloop, endfacet …");
        }
    }
    throw InputError("ends at line " + std::to_string(words.number()) + " within a facet");
}

TriangleMesh read_text_stl(std::string_view text) {
    TextWords words(text, false);
    FaceReader reader(true);
    for (std::string_view word = words.next_of_text(); !word.empty(); word = words.next_of_text()) {
        std::string what = lower_case(word);
        if (what == "end") what += lower_case(words.next());
        if (what == "facet") {
            const long line = words.number();
            reader.add(stl_facet(words, reader.mesh.vertices), line);
        } else if (what == "solid" || what == "endsolid") {
            skip_name(words);
        } else if (what == "vertex") {
            words.refuse("a vertex outside of a facet");
        } else {
            words.refuse(quoted(std::string(word)) + ": must be a word of a text .stl: facet, endsolid …");
        }
    }
    return triangles_of(std::move(reader.mesh));
}

constexpr std::size_t stl_head = 84, stl_facet_size = 50;

std::size_t binary_stl_facets(std::string_view bytes) {
    std::uint32_t facets = 0;
    if (bytes.size() >= stl_head) std::memcpy(&facets, bytes.data() + 80, sizeof facets);
    return facets;
}

TriangleMesh read_binary_stl(std::string_view bytes) {
    static_assert(std::endian::native == std::endian::little, "numbers are in memory as in the file");
    const std::size_t facets = binary_stl_facets(bytes);
    FaceReader::check_count(static_cast<long>(facets));
    FaceReader reader(false);
    for (std::size_t i = 0; i < facets; ++i) {
        std::vector<int> corners;
        for (std::size_t k = 0; k < 3; ++k) {
            float place[3];
            std::memcpy(place, bytes.data() + stl_head + stl_facet_size * i + 12 * (k + 1), sizeof place);
            for (const float value : place)
                if (!(std::abs(value) <= max_coordinate))
                    throw InputError("facet " + std::to_string(i + 1) + ": a coordinate is no number within 1e9");
            reader.mesh.vertices.emplace_back(place[0] + 0.0, place[1] + 0.0, place[2] + 0.0);
            corners.push_back(static_cast<int>(reader.mesh.vertices.size()) - 1);
        }
        reader.add(std::move(corners), static_cast<long>(i) + 1);
    }
    return triangles_of(std::move(reader.mesh));
}

/// Binary if it holds all facets that its head counts, whatever the head begins with and whatever stands behind them:
/// of a text the four bytes of that number are more than a file may hold.
TriangleMesh read_stl(std::string_view bytes) {
    const std::size_t facets = binary_stl_facets(bytes);
    if (bytes.size() >= stl_head && bytes.size() >= stl_head + stl_facet_size * facets) return read_binary_stl(bytes);
    std::string room;
    const std::string_view text = plain_text(bytes, room);
    const bool has_zeros = text.find('\0') < text.find_last_not_of(std::string_view("\0\x1a\r\n ", 5)) + 1;
    if (!has_zeros && lower_case(TextWords(text, false).next_of_text()) == "solid") return read_text_stl(text);
    std::ostringstream what;
    what << "has " << bytes.size() << " bytes";
    if (bytes.size() >= stl_head)
        what << ", a binary .stl of " << facets << " facets, as its head says, " << stl_head + stl_facet_size * facets;
    what << "; must be a whole .stl, binary or text that begins with solid";
    throw InputError(what.str());
}

}  // namespace

std::string TriangleMesh::name(std::size_t triangle) const {
    return face_name(source[triangle], has_lines);
}

std::string face_name(long source, bool has_lines) {
    return (has_lines ? "the face of line " : "facet ") + std::to_string(source);
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

bool is_obj(const std::string& name) {
    return lower_case(name).ends_with(".obj");
}

bool is_stl(const std::string& name) {
    return lower_case(name).ends_with(".stl");
}

TriangleMesh read_mesh(const std::string& bytes, const std::string& name) {
    if (!is_obj(name)) return read_stl(bytes);
    std::string room;
    return read_obj(plain_text(bytes, room));
}

}  // namespace natator
