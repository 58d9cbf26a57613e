// Bodies from a mesh: its file, what bounds a solid, the particles inside, the skin, the bundled ray, and what is
// refused.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <sstream>

#include "model/mesh/check_mesh.h"
#include "model/mesh/mesh_slices.h"
#include "model/mesh/triangle_mesh.h"
#include "model/skin_weights.h"
#include "model/water_volumes.h"
#include "natator/error.h"
#include "natator/evaluate.h"
#include "natator/limits.h"
#include "natator/model.h"
#include "refusal.h"
#include "scene/scene_json.h"
#include "test_name.h"

namespace natator {
namespace {

using Eigen::Vector3d;
using nlohmann::json;

/// A mesh to be changed and written.
struct Shape {
    std::vector<Vector3d> vertices;
    std::vector<std::array<int, 3>> faces;

    Shape& add(const Shape& other) {
        const int first = static_cast<int>(vertices.size());
        vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
        for (const auto& [a, b, c] : other.faces) faces.push_back({a + first, b + first, c + first});
        return *this;
    }
    Shape& moved(const std::function<Vector3d(const Vector3d&)>& change) {
        for (Vector3d& vertex : vertices) vertex = change(vertex);
        return *this;
    }
    Shape& turned() {
        for (auto& face : faces) std::swap(face[1], face[2]);
        return *this;
    }
    std::string obj() const {
        std::ostringstream text;
        text.precision(17);
        for (const Vector3d& v : vertices) text << "v " << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
        for (const auto& [a, b, c] : faces) text << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
        return text.str();
    }
    std::string text_stl() const {
        std::ostringstream text;
        text << "solid test\n";
        for (const auto& face : faces) {
            text << " facet normal 0 0 0\n  outer loop\n";
            for (const int i : face)
                text << "   vertex " << vertices[i].x() << ' ' << vertices[i].y() << ' ' << vertices[i].z() << '\n';
            text << "  endloop\n endfacet\n";
        }
        return text.str() + "endsolid test\n";
    }
    std::string binary_stl() const {
        std::string bytes(80, ' ');
        bytes.replace(0, 5, "solid");  // as some programs begin it
        const auto append = [&](const auto& value) {
            bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
        };
        append(static_cast<std::uint32_t>(faces.size()));
        for (const auto& face : faces) {
            for (int i = 0; i < 3; ++i) append(0.0f);
            for (const int i : face)
                for (int k = 0; k < 3; ++k) append(static_cast<float>(vertices[i][k]));
            append(std::uint16_t{0});
        }
        return bytes;
    }
};

Shape box(const Vector3d& low, const Vector3d& high) {
    Shape shape;
    for (int i = 0; i < 8; ++i)
        shape.vertices.emplace_back(i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(), i & 4 ? high.z() : low.z());
    shape.faces = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                   {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
    return shape;
}

Shape octahedron(double radius) {
    Shape shape;
    for (int axis = 0; axis < 3; ++axis)
        for (const double way : {radius, -radius}) shape.vertices.push_back(way * Vector3d::Unit(axis));
    shape.faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    return shape;
}

/// Each face becomes four, and all corners lie on the unit sphere, scaled along the axes.
Shape ellipsoid(const Vector3d& radii, int levels) {
    Shape shape = octahedron(1);
    for (int level = 0; level < levels; ++level) {
        Shape finer;
        for (const auto& [a, b, c] : shape.faces) {
            const Vector3d &p = shape.vertices[a], &q = shape.vertices[b], &r = shape.vertices[c];
            const int first = static_cast<int>(finer.vertices.size());
            for (const Vector3d& v : {p, q, r, Vector3d(p + q), Vector3d(q + r), Vector3d(r + p)})
                finer.vertices.push_back(v.normalized());
            for (const auto& face : {std::array{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}})
                finer.faces.push_back({first + face[0], first + face[1], first + face[2]});
        }
        shape = finer;
    }
    return shape.moved([&](const Vector3d& v) { return v.cwiseProduct(radii).eval(); });
}

/// Faces of any number of corners.
struct Polygons {
    std::vector<Vector3d> vertices;
    std::vector<std::vector<int>> faces;

    void turn() {
        for (auto& face : faces) std::reverse(face.begin(), face.end());
    }
    std::string obj() const {
        std::ostringstream text;
        text.precision(17);
        for (const Vector3d& v : vertices) text << "v " << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
        for (const auto& face : faces) {
            text << 'f';
            for (const int i : face) text << ' ' << i + 1;
            text << '\n';
        }
        return text.str();
    }
};

std::string replaced(std::string text, const std::string& old, const std::string& by) {
    for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old, at + by.size()))
        text.replace(at, old.size(), by);
    return text;
}

std::string replaced_second(std::string text, const std::string& old, const std::string& by) {
    return text.replace(text.find(old, text.find(old) + 1), old.size(), by);
}

std::string upper(std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(c));
    return text;
}

std::string utf16(const std::u16string& text, bool big) {
    std::string bytes;
    for (const char16_t c : text) {
        const char low = static_cast<char>(c & 0xff), high = static_cast<char>(c >> 8);
        bytes += {big ? high : low, big ? low : high};
    }
    return bytes;
}

TriangleMesh mesh_of(const Shape& shape) {
    return read_mesh(shape.obj(), "test.obj");
}

/// A folder for files of one test, removed afterwards.
class Mesh : public testing::Test {
protected:
    Mesh() {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        folder_ =
            std::filesystem::temp_directory_path() / ("natator-mesh-" + std::to_string(::getpid()) + test->name());
        std::filesystem::create_directories(folder_);
    }
    ~Mesh() override { std::filesystem::remove_all(folder_); }

    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return (folder_ / name).string();
    }
    static json creature(const std::string& file) {
        return {{"mesh", {{"file", file}, {"joints", {0.3, 0.6}}}}, {"spacing", 0.1}, {"rearCentre", {0.5, 0.5, 0.5}}};
    }
    static Model model_of_mesh(const json& creature) {
        return build_model(scene_from_json({{"creature", creature}}, "test"));
    }

    std::filesystem::path folder_;
};

TEST_F(Mesh, IsTheSameFromEveryKindOfFile) {
    const Shape shape = ellipsoid({1, 0.25, 0.25}, 3);
    std::string quads;  // a box's faces whole, corners counted backwards, with texture coordinates and normals
    for (const Vector3d& v : box({0, 0, 0}, {2, 0.5, 0.25}).vertices) {
        std::ostringstream line;
        line << "v +" << v.x() << ' ' << v.y() << ' ' << v.z() << " 1.0 # corner\r\n";
        quads += line.str();
    }
    quads += "vn 0 0 1\nvt 0 0\no box\nf -8/1/1 -4//1 -2/1 -6\nf 2 4 8 6\nf 1 2 6 5\nf 3 7 8 4\nf 1 3 4 2\nf 5 6 8 7\n";
    const Model whole = model_of_mesh(creature(write("quads.obj", quads)));
    const Model cut = model_of_mesh(creature(write("box.obj", box({0, 0, 0}, {2, 0.5, 0.25}).obj())));
    EXPECT_EQ(whole.position, cut.position);
    EXPECT_EQ(model_of_mesh(creature(write("marked.obj", "\xef\xbb\xbf" + quads))).position, cut.position);
    EXPECT_EQ(whole.particles(), 20 * 5 * 2);

    const Model obj = model_of_mesh(creature(write("a.obj", shape.obj())));
    const Model text = model_of_mesh(creature(write("a.stl", shape.text_stl())));
    const Model binary = model_of_mesh(creature(write("b.stl", shape.binary_stl())));
    EXPECT_GT(obj.particles(), 200);
    EXPECT_EQ(text.position, obj.position);
    EXPECT_EQ(binary.position, obj.position);
}

TEST_F(Mesh, OfABoxIsThatBoxOfSlices) {
    json slices = {{"slices", {{{"height", 5}, {"width", 4}, {"count", 20}}}},
                   {"joints", {6, 12}},
                   {"spacing", 0.1},
                   {"rearCentre", {0.5, 0.5, 0.5}}};
    json mesh = creature(write("box.obj", box({3, -7, 4}, {5, -6.5, 4.4}).obj()));
    for (const char* bend : {"sideways", "vertical"}) {
        slices["bend"] = mesh["bend"] = bend;
        const Model expected = model_of_mesh(slices), model = model_of_mesh(mesh);
        ASSERT_EQ(model.particles(), expected.particles());
        for (int i = 0; i < model.particles(); ++i) EXPECT_LT((model.position[i] - expected.position[i]).norm(), 1e-12);
        ASSERT_EQ(model.muscles.size(), expected.muscles.size());
        ASSERT_GT(model.muscles.size(), 0u);
        for (std::size_t i = 0; i < model.muscles.size(); ++i) {
            EXPECT_EQ(model.springs[i].a, expected.springs[i].a);
            EXPECT_EQ(model.springs[i].b, expected.springs[i].b);
            EXPECT_EQ(model.muscles[i].lateral, expected.muscles[i].lateral);
        }
        ASSERT_EQ(model.clusters.size(), 3u);
        for (int i = 0; i < 3; ++i) EXPECT_EQ(model.clusters[i].particles, expected.clusters[i].particles);
    }
}

TEST_F(Mesh, IsTurnedAndScaledAsTheCreatureSays) {
    const Shape plain =
        box({0, 0, 0}, {2, 0.5, 0.4}).add(box({1.5, 0.6, 0.1}, {1.9, 0.9, 0.3}));  // a hump on the front
    Shape turned = plain;  // forward is -z, up x, right -y; a unit is 0.01
    turned.moved([](const Vector3d& v) { return Vector3d(100 * v.y(), -100 * v.z(), -100 * v.x()); });
    json described = creature(write("turned.obj", turned.obj()));
    described["mesh"].update({{"forward", "-z"}, {"up", "x"}, {"unit", 0.01}});
    const json straight = creature(write("plain.obj", plain.obj()));
    EXPECT_GT(model_of_mesh(straight).particles(), 20 * 5 * 4);
    EXPECT_EQ(model_of_mesh(described).particles(), model_of_mesh(straight).particles());
    described["mesh"].erase("unit");
    described["mesh"]["length"] = 2;
    const Model model = model_of_mesh(described);
    const Model expected = model_of_mesh(straight);
    for (int i = 0; i < model.particles(); ++i) EXPECT_LT((model.position[i] - expected.position[i]).norm(), 1e-9);
}

/// Outlines whose corners turn both ways, and the volume of a slab of them that is 0.4 thick.
struct Outline {
    const char* name;
    double volume;
    std::vector<std::array<double, 2>> corners;
};

const Outline outlines[] = {
    {"chevron", 0.24, {{0, 0}, {2, 0.4}, {0, 0.8}, {0.5, 0.4}}},
    {"L", 0.448, {{0, 0}, {2, 0}, {2, 0.4}, {0.8, 0.4}, {0.8, 0.8}, {0, 0.8}}},
    {"T", 0.336, {{0, 0.3}, {1.6, 0.3}, {1.6, 0}, {2, 0}, {2, 0.9}, {1.6, 0.9}, {1.6, 0.6}, {0, 0.6}}},
    {"U", 0.56, {{0, 0}, {2, 0}, {2, 1}, {1.5, 1}, {1.5, 0.4}, {0.5, 0.4}, {0.5, 1}, {0, 1}}},
    {"whale",
     0.312,
     {{0, 0.4},
      {0.3, 0.2},
      {0.8, 0.2},
      {0.9, 0.05},
      {1.2, 0.2},
      {1.6, 0.3},
      {2, 0},
      {1.85, 0.4},
      {2, 0.8},
      {1.6, 0.5},
      {1.3, 0.6},
      {0.7, 0.7},
      {0.2, 0.6}}},
    {"teeth",
     0.88,
     {{0, 0},
      {4, 0},
      {4, 0.4},
      {3.5, 0.4},
      {3.5, 1},
      {3, 1},
      {3, 0.4},
      {1, 0.4},
      {1, 1},
      {0.5, 1},
      {0.5, 0.4},
      {0, 0.4}}},
};

void PrintTo(const Outline& outline, std::ostream* out) {
    test::print_name(outline.name, out);
}

/// A slab with whole faces; `on_edges` corners in the middle of each edge of the outline.
Polygons slab(std::vector<std::array<double, 2>> corners, int on_edges) {
    std::vector<std::array<double, 2>> all;
    for (std::size_t i = 0; i < corners.size(); ++i)
        for (int k = 0; k <= on_edges; ++k) {
            const auto &a = corners[i], &b = corners[(i + 1) % corners.size()];
            const double part = k / (on_edges + 1.0);
            all.push_back({a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])});
        }
    Polygons slab;
    const auto count = static_cast<int>(all.size());
    std::vector<int> low, high;
    for (int i = 0; i < 2 * count; ++i)
        slab.vertices.emplace_back(all[i % count][0], all[i % count][1], i < count ? 0 : 0.4);
    for (int i = 0; i < count; ++i) low.push_back(count - 1 - i), high.push_back(count + i);
    slab.faces = {low, high};
    for (int i = 0; i < count; ++i) slab.faces.push_back({i, (i + 1) % count, (i + 1) % count + count, i + count});
    return slab;
}

/// What a closed mesh must be: as check_mesh wants it, of this volume.
TriangleMesh closed_mesh(const std::string& text, double volume, const char* file = "test.obj") {
    TriangleMesh mesh = read_mesh(text, file);
    check_mesh(mesh);
    EXPECT_NEAR(signed_volume(mesh) / volume, 1, 1e-6);
    return mesh;
}

void expect_same(const TriangleMesh& one, const TriangleMesh& other) {
    EXPECT_EQ(one.vertices, other.vertices);
    EXPECT_EQ(one.triangles, other.triangles);
}

class OutlineTest : public testing::TestWithParam<Outline> {};

TEST_P(OutlineTest, IsTheSameSolidFromAnyCornerInAnyPlane) {
    const Outline& outline = GetParam();
    const Eigen::Matrix3d tilted = Eigen::AngleAxisd(0.7, Vector3d(1, -2, 3).normalized()).toRotationMatrix();
    Eigen::Matrix3d turned;
    turned << 0, 0, -1, 1, 0, 0, 0, -1, 0;
    for (const Eigen::Matrix3d& axes :
         {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), turned, tilted, Eigen::Matrix3d(-turned * tilted)})
        for (const int on_edges : {0, 1, 3}) {
            Polygons polygons = slab(outline.corners, on_edges);
            for (Vector3d& vertex : polygons.vertices) vertex = axes * vertex + Vector3d(3, 0, -5);
            if (axes.determinant() < 0) polygons.turn();
            const TriangleMesh first = closed_mesh(polygons.obj(), outline.volume);
            const std::size_t corners = outline.corners.size() * (on_edges + 1);
            EXPECT_EQ(first.triangles.size(), 4 * corners - 4);
            EXPECT_EQ(first.vertices.size(), 2 * corners);
            for (std::size_t i = 1; i < corners; ++i) {
                for (auto& face : polygons.faces) std::rotate(face.begin(), face.begin() + 1, face.end());
                expect_same(closed_mesh(polygons.obj(), outline.volume), first);
            }
        }
}

/// Corners that one face has on an edge, and its neighbour has not.
TEST_P(OutlineTest, NeedsNotHaveTheCornersOfItsNeighbours) {
    const Outline& outline = GetParam();
    Polygons polygons = slab(outline.corners, 2), plain = slab(outline.corners, 0);
    const auto count = static_cast<int>(outline.corners.size());
    std::vector<std::vector<int>> faces{polygons.faces[0]};  // below with the corners, above and at the sides without
    for (std::size_t i = 1; i < plain.faces.size(); ++i) {
        for (int& corner : plain.faces[i]) corner = 3 * corner;
        faces.push_back(plain.faces[i]);
    }
    polygons.faces = faces;
    EXPECT_EQ(closed_mesh(polygons.obj(), outline.volume).vertices.size(), 4 * static_cast<std::size_t>(count));
}

/// Each face with corners of its own, which differ by the rounding of floats.
TEST_P(OutlineTest, NeedsNotShareCorners) {
    const Outline& outline = GetParam();
    const Polygons polygons = slab(outline.corners, 1);
    for (const double rounding : {0.0, 1e-16, 1e-9, 1e-7, 3e-6, 5e-5}) {
        Polygons apart;
        std::size_t corners = 0;
        for (const auto& face : polygons.faces) {
            apart.faces.emplace_back();
            for (const int corner : face) {
                apart.faces.back().push_back(static_cast<int>(corners));
                const double way = static_cast<double>(++corners % 3) - 1;
                apart.vertices.push_back(polygons.vertices[corner] + way * rounding * Vector3d(0.5, 0.3, -0.4));
            }
        }
        const TriangleMesh mesh = read_mesh(apart.obj(), "apart.obj");
        EXPECT_NO_THROW(check_mesh(mesh)) << rounding;
        EXPECT_EQ(mesh.vertices.size(), polygons.vertices.size()) << rounding;
        EXPECT_NEAR(signed_volume(mesh) / outline.volume, 1, 1e-6 + 10 * rounding);
    }
}

INSTANTIATE_TEST_SUITE_P(All, OutlineTest, testing::ValuesIn(outlines));

/// A plate with a square hole, whose faces are joined to it by an edge that goes both ways.
TEST(MeshFile, MayHaveAFaceWithAHole) {
    Polygons plate;
    for (const double z : {0.0, 0.4})
        for (const auto& [x, y] :
             {std::pair{0., 0.}, {2., 0.}, {2., 2.}, {0., 2.}, {0.5, 0.5}, {0.5, 1.5}, {1.5, 1.5}, {1.5, 0.5}})
            plate.vertices.emplace_back(x, y, z);
    plate.faces = {{0, 4, 7, 6, 5, 4, 0, 3, 2, 1}, {8, 9, 10, 11, 8, 12, 13, 14, 15, 12}};
    for (const int ring : {0, 4})
        for (int i = 0; i < 4; ++i)
            plate.faces.push_back({ring + i, ring + (i + 1) % 4, ring + (i + 1) % 4 + 8, ring + i + 8});
    const TriangleMesh first = closed_mesh(plate.obj(), 1.2);
    for (int i = 1; i < 10; ++i) {
        for (auto& face : plate.faces) std::rotate(face.begin(), face.begin() + 1, face.end());
        expect_same(closed_mesh(plate.obj(), 1.2), first);
    }
}

/// A globe of quadrilaterals as programs write it: twice the meridian where it begins and ends, and each pole once for
/// each meridian.
TEST(MeshFile, MayHaveSeamsAndPoles) {
    constexpr int meridians = 16, rings = 10;
    double volume = 0;  // of frusta
    for (int k = 0; k < rings; ++k) {
        const double from = std::numbers::pi * k / rings, to = std::numbers::pi * (k + 1) / rings, r = std::sin(from),
                     q = std::sin(to);
        volume += (std::cos(from) - std::cos(to)) / 3 * (r * r + r * q + q * q) * 0.25 * meridians / 2 *
                  std::sin(2 * std::numbers::pi / meridians);
    }
    for (const bool joined : {false, true})           // whether the seam is joined already
        for (const bool halves : {false, true})       // of quadrilaterals, one of which is nothing at the poles
            for (const double noise : {0.0, 1e-8}) {  // beside that of sin and cos
                Polygons globe;
                for (int k = 0; k <= rings; ++k)
                    for (int i = 0; i <= meridians; ++i) {
                        const double angle = 2 * std::numbers::pi * (joined ? i % meridians : i) / meridians;
                        const double r = std::sin(std::numbers::pi * k / rings),
                                     x = std::cos(std::numbers::pi * k / rings);
                        globe.vertices.emplace_back(x, 0.5 * r * std::cos(angle) + noise * (i % 3),
                                                    0.5 * r * std::sin(angle) - noise * (i % 2));
                    }
                for (int k = 0; k < rings; ++k)
                    for (int i = 0; i < meridians; ++i) {
                        const int a = k * (meridians + 1) + i, b = a + meridians + 1;
                        if (halves)
                            globe.faces.insert(globe.faces.end(), {{a, b, b + 1}, {a, b + 1, a + 1}});
                        else
                            globe.faces.push_back({a, b, b + 1, a + 1});
                    }
                const TriangleMesh mesh = read_mesh(globe.obj(), "globe.obj");
                EXPECT_NO_THROW(check_mesh(mesh)) << joined << halves << noise;
                EXPECT_EQ(mesh.vertices.size(), static_cast<std::size_t>(meridians * (rings - 1) + 2))
                    << joined << halves << noise;
                EXPECT_EQ(mesh.triangles.size(), static_cast<std::size_t>(2 * meridians * (rings - 1)));
                EXPECT_NEAR(signed_volume(mesh) / volume, 1, 1e-6);
            }
}

const Vector3d zero{0, 0, 0}, corner{2, 0.5, 0.4};

/// The faces of a file with so many more vertices in front.
std::string counted_from(int more, const std::string& faces) {
    std::istringstream words(faces);
    std::string text, word;
    while (words >> word) text += word == "f" ? "\nf" : " " + std::to_string(std::stoi(word) + more);
    return text;
}

/// Nothing that no face uses, and no face without area, moves or scales the body.
TEST_F(Mesh, IsWhatItsFacesAre) {
    const std::string plain = box(zero, corner).obj();
    const std::string many[] = {
        "v 100 -50 1e8\n" + plain.substr(0, plain.find('f')) + "v -3 7 7\n" +
            counted_from(1, plain.substr(plain.find('f'))),
        plain + "v 9 9 9\n",
        plain + "v 9 9 9\np 9\nl 1 9\nl 9/1 2/1\n",
        plain + "v 9 9 9\nf 9 9 9\nf 9 1 9\nf 1 2 2\n",
        plain + "v 1 0 0\nf 1 9 2\n",
        plain + "v 1 0 0\nv 5 0 0\nf 1 9 10\n",
        plain + "v 9 9 9\nvp 0.5\ncstype bezier\ndeg 3\ncurv 0 1 1 9\nparm u 0 1\nend\n",
    };
    const auto with_length = [&](const std::string& text) {
        json body = creature(write("body.obj", text));
        body["mesh"]["length"] = 1.5;
        body["spacing"] = 0.075;
        return body;
    };
    const Model expected = model_of_mesh(with_length(plain));
    for (const std::string& text : many)
        EXPECT_EQ(model_of_mesh(with_length(text)).position, expected.position) << text;
}

struct Spelling {
    const char* name;
    const char* file;
    std::function<std::string()> content;
};

void PrintTo(const Spelling& spelling, std::ostream* out) {
    test::print_name(spelling.name, out);
}

const std::string whole_box =
    "v 0 0 0\nv 2 0 0\nv 0 .5 0\nv 2. 0.5 0\nv 0 0 4e-1\nv 2 0 +0.4\nv 0 0.5 .4E0\nv 2 0.5 0.4\n"
    "f 1 5 7 3\nf 2 4 8 6\nf 1 2 6 5\nf 3 7 8 4\nf 1 3 4 2\nf 5 6 8 7\n";

std::string text_box() {
    return box(zero, corner).text_stl();
}
std::string binary_box() {
    return box(zero, corner).binary_stl();
}

const Spelling spellings[] = {
    {"plain", "a.obj", [] { return whole_box; }},
    {"largeName", "A.OBJ", [] { return whole_box; }},
    {"cr", "a.obj", [] { return replaced(whole_box, "\n", "\r"); }},
    {"crlf", "a.obj", [] { return replaced(whole_box, "\n", "\r\n"); }},
    {"noLastEnd", "a.obj", [] { return whole_box.substr(0, whole_box.size() - 1); }},
    {"tabs", "a.obj", [] { return replaced(replaced(whole_box, " ", "\t "), "\n", " \t\n"); }},
    {"marked", "a.obj", [] { return "\xef\xbb\xbf" + whole_box; }},
    {"utf16", "a.obj", [] { return utf16(u"\ufeff" + std::u16string(whole_box.begin(), whole_box.end()), false); }},
    {"utf16Big", "a.obj", [] { return utf16(u"\ufeff" + std::u16string(whole_box.begin(), whole_box.end()), true); }},
    {"utf16Bare", "a.obj",
     [] { return utf16(u"# \u6d77\n" + std::u16string(whole_box.begin(), whole_box.end()), false); }},
    {"utf16BareBig", "a.obj", [] { return utf16(std::u16string(whole_box.begin(), whole_box.end()), true); }},
    {"commented", "a.obj", [] { return "# C:\\models\\\n" + replaced(whole_box, "\n", "# v 1 2 \\\n\n#\n"); }},
    {"continued", "a.obj", [] { return replaced(replaced(whole_box, "\nf", "\nf \\\n"), " 8 ", " \\  \r\n8\\\n "); }},
    {"continuedCr", "a.obj",
     [] { return replaced(replaced(replaced(whole_box, "\n", "\r"), " 8 ", " \\\r8\\\r "), "v 2 ", "v\\\r2 "); }},
    {"weights", "a.obj", [] { return replaced(whole_box, "\nv", " 1.0\nv"); }},
    {"colours", "a.obj", [] { return "v 0 0 0 0.1 1 0.5\nv 2 0 0 255 0 0 1\n" + whole_box.substr(16); }},
    {"large", "a.obj", [] { return replaced(replaced(whole_box, "v", "V"), "f", "F"); }},
    {"fo", "a.obj", [] { return replaced(whole_box, "f ", "fo "); }},
    {"textures", "a.obj",
     [] { return "vt 0 0\nvn 0 0 1\n" + replaced(replaced(whole_box, " 8 ", " 8/1/1 "), "f 1 ", "f 1//1 "); }},
    {"emptySlashes", "a.obj", [] { return replaced(replaced(whole_box, " 8 ", " 8// "), "f 1 ", "f 1/ "); }},
    {"backwards", "a.obj", [] { return replaced(whole_box, "f 1 5 7 3", "f -8 -4/-1 -2//-1 -6"); }},
    {"facesFirst", "a.obj",
     [] { return whole_box.substr(whole_box.find('f')) + whole_box.substr(0, whole_box.find('f')); }},
    {"statements", "a.obj",
     [] {
         return "mtllib a b.mtl\no f 1 2 3\ng a\ns off\nusemtl v 9 9 9\nvp 0.1\nlod 2\n#\n" + whole_box +
                "call x\nl 1 2\np 1\n";
     }},
    {"repeatedCorners", "a.obj",
     [] { return replaced(replaced(whole_box, "f 1 5 7 3", "f 1 1 5 7 7 7 3 1"), " 8 6", " 8 6 8 6 6"); }},
    {"endOfFile", "a.obj", [] { return whole_box + '\x1a'; }},
    {"text", "a.stl", text_box},
    {"largeText", "A.STL", [] { return upper(text_box()); }},
    {"largeTextCrlf", "a.stl", [] { return replaced(upper(text_box()), "\n", "\r\n"); }},
    {"crText", "a.stl", [] { return replaced(text_box(), "\n", "\r"); }},
    {"markedText", "a.stl", [] { return "\xef\xbb\xbf" + text_box(); }},
    {"wideText", "a.stl",
     [] {
         const std::string text = text_box();
         return utf16(u"\ufeff" + std::u16string(text.begin(), text.end()), false);
     }},
    {"named", "a.stl", [] { return replaced(text_box(), "solid test", "solid a fish, facet # 7 \\ vertex é"); }},
    {"nameless", "a.stl", [] { return replaced(text_box(), "solid test", "solid"); }},
    {"endsApart", "a.stl",
     [] {
         return replaced(replaced(replaced(text_box(), "endloop", "end loop"), "endfacet", "End Facet"), "endsolid",
                         "end solid");
     }},
    {"endless", "a.stl", [] { return text_box().substr(0, text_box().find("endsolid")); }},
    {"severalSolids", "a.stl",
     [] { return replaced_second(text_box(), " facet", "endsolid test\nsolid another one\n facet"); }},
    {"unendedSolids", "a.stl", [] { return replaced_second(text_box(), " facet", "solid\n facet"); }},
    {"oneLine", "a.stl", [] { return replaced(text_box(), "\n", " "); }},
    {"oneWordALine", "a.stl", [] { return replaced(replaced(text_box(), " test", ""), " ", "\n"); }},
    {"noNormals", "a.stl", [] { return replaced(text_box(), "normal 0 0 0", "normal nan -1.#IND0 inf"); }},
    {"exponents", "a.stl", [] { return replaced(replaced(text_box(), " 0.5", " +5.000000E-001"), " 2 ", " 2.e+00 "); }},
    {"binary", "a.stl", binary_box},
    {"coloured", "a.stl",
     [] {
         std::string bytes = binary_box();
         bytes.replace(0, 10, "COLOR=\x01\x02\xff\xff");
         for (std::size_t i = 132; i < bytes.size(); i += 50) bytes[i] = '\x7f', bytes[i + 1] = '\x80';
         return bytes;
     }},
    {"zeroHead", "a.stl", [] { return std::string(80, '\0') + binary_box().substr(80); }},
    {"trailing", "a.stl", [] { return binary_box() + std::string(7, '\0') + "endsolid\n"; }},
};

class SpellingTest : public Mesh, public testing::WithParamInterface<Spelling> {};

TEST_P(SpellingTest, IsTheSameBody) {
    const Model expected = model_of_mesh(creature(write("plain.obj", box(zero, corner).obj())));
    const Spelling& spelling = GetParam();
    EXPECT_EQ(model_of_mesh(creature(write(spelling.file, spelling.content()))).position, expected.position);
    EXPECT_EQ(expected.particles(), 20 * 5 * 4);
}

INSTANTIATE_TEST_SUITE_P(All, SpellingTest, testing::ValuesIn(spellings));

/// An outline of very many corners is cut up soon if it is round.
TEST(MeshFile, MayHaveAFaceOfManyCorners) {
    constexpr int count = 20'000;
    std::vector<std::array<double, 2>> corners;
    for (int i = 0; i < count; ++i)
        corners.push_back({std::cos(2 * std::numbers::pi * i / count), std::sin(2 * std::numbers::pi * i / count)});
    const TriangleMesh mesh = read_mesh(slab(corners, 0).obj(), "round.obj");
    EXPECT_EQ(mesh.triangles.size(), 4u * count - 4);
    EXPECT_NEAR(signed_volume(mesh) / (0.4 * std::numbers::pi), 1, 1e-6);
}

/// The lines of the lattice go through edges and corners of these, where a face must count once.
TEST_F(Mesh, CountsEdgesOnce) {
    for (const double radius : {7.25, 8.0, 9.25}) {  // no particle is on the surface
        const MeshSlices body = slice_mesh(mesh_of(octahedron(radius)), 1);
        int expected = 0, found = 0;
        const auto half = static_cast<int>(std::lround(2 * radius));  // slices, rows; columns are even
        for (int x = 0; x < half; ++x)
            for (int y = 0; y < half; ++y)
                for (int z = -10; z < 10; ++z) {
                    const double sum =
                        std::abs(x - (half - 1) / 2.0) + std::abs(y - (half - 1) / 2.0) + std::abs(z + 0.5);
                    // Slices of the tips, which are one particle high, are left out.
                    const bool tip = std::abs(x - (half - 1) / 2.0) + (half % 2 == 0 ? 1 : 1.5) >= radius;
                    if (sum < radius - 1e-9 && !tip) ++expected;
                }
        for (const Slice& slice : body.slices) found += slice.particles();
        EXPECT_EQ(found, expected) << radius;
        EXPECT_GT(expected, 50);
    }
}

TEST_F(Mesh, HasTheVolumeOfItsSolid) {
    const TriangleMesh mesh = mesh_of(ellipsoid({1, 0.5, 0.25}, 5));
    EXPECT_NEAR(signed_volume(mesh) / (4 * std::numbers::pi / 3 * 0.125), 1, 0.005);
    for (const auto& [spacing, tolerance] : {std::pair{0.1, 0.06}, std::pair{0.05, 0.02}, std::pair{0.02, 0.006}}) {
        double particles = 0;
        for (const Slice& slice : slice_mesh(mesh, spacing).slices) particles += slice.particles();
        EXPECT_NEAR(particles * std::pow(spacing, 3) / signed_volume(mesh), 1, tolerance) << spacing;
    }
}

/// A cavity is empty, and no muscle runs through it.
TEST_F(Mesh, LeavesACavityEmpty) {
    Shape hollow = box({0, 0, 0}, {2, 0.6, 0.6});
    hollow.add(box({0.5, 0.2, 0.2}, {1.3, 0.4, 0.4}).turned());
    const json solid = creature(write("solid.obj", box({0, 0, 0}, {2, 0.6, 0.6}).obj()));
    const json with_cavity = creature(write("hollow.obj", hollow.obj()));
    const Model full = model_of_mesh(solid), empty = model_of_mesh(with_cavity);
    EXPECT_EQ(full.particles() - empty.particles(), 8 * 2 * 2);
    EXPECT_LT(empty.springs.size(), full.springs.size());
    for (const Spring& spring : empty.springs) {  // joints at 14 and 8 from the rear, where y, z in (0.4, 0.6) is empty
        const Vector3d middle = (empty.position[spring.a] + empty.position[spring.b]) / 2 - Vector3d(0.5, 0.5, 0.5);
        EXPECT_GT(std::max(std::abs(middle.y()), std::abs(middle.z())), 0.1);
    }
}

TEST_F(Mesh, IsTheSameFileWhereverItIsNamedFrom) {
    write("box.obj", box({0, 0, 0}, {2, 0.5, 0.4}).obj());
    const std::string name = write("box.json", R"({"mesh":{"file":"box.obj","joints":[0.3,0.6]},"spacing":0.1})");
    const json definition = scene_definition("pool/eel", {{"creature", {{"name", name}, {"profile", nullptr}}}});
    EXPECT_EQ(definition["creature"]["mesh"]["file"], (folder_ / "box.obj").string());
    EXPECT_EQ(definition["creature"]["mesh"]["digest"].get<std::string>().size(), 16u);
    EXPECT_EQ(build_model(load_scene("pool/eel", {{"creature", {{"name", name}, {"rearCentre", {0.5, 0.5, 0.5}}}}}))
                  .body.particles.size(),
              400u);
}

/// A scene's file that holds its creature, with a companion: their meshes are beside it; a bundled one needs not be.
TEST_F(Mesh, IsBesideTheSceneThatHoldsItsCreature) {
    write("box.obj", box({0, 0, 0}, {2, 0.5, 0.4}).obj());
    const auto written = [&](const std::string& file) {
        const json one{{"mesh", {{"file", file}, {"joints", {0.3, 0.6}}, {"length", 1.2}}},
                       {"rearCentre", {0.6, 0.6, 0.6}}};
        json other = one;
        other["rearCentre"] = {3, 0.6, 0.6};
        return write(
            "scene.json",
            json{{"base", "pool/water"}, {"creature", one}, {"companions", json::array({{{"creature", other}}})}}
                .dump());
    };
    const json definition = scene_definition(written("box.obj"), json::object());
    for (const json& creature : {definition["creature"], definition["companions"][0]["creature"]}) {
        EXPECT_EQ(creature["mesh"]["file"], (folder_ / "box.obj").string());
        EXPECT_EQ(creature["mesh"]["digest"].get<std::string>().size(), 16u);
    }
    EXPECT_EQ(scene_definition(written("ray.obj"), json::object())["creature"]["mesh"]["file"], "ray.obj");
    write("ray.obj", box({0, 0, 0}, {2, 0.5, 0.4}).obj());
    EXPECT_EQ(scene_definition(written("ray.obj"), json::object())["creature"]["mesh"]["file"],
              (folder_ / "ray.obj").string());
}

/// What an override cannot take away.
TEST_F(Mesh, NamesWhatIsMissing) {
    const std::string file = write("box.obj", box({0, 0, 0}, {2, 0.5, 0.4}).obj());
    for (const std::string key : {"file", "joints"}) {
        json body = creature(file);
        body["mesh"].erase(key);
        try {
            model_of_mesh(body);
            FAIL() << key;
        } catch (const InputError& error) {
            EXPECT_EQ(error.what(), "scene \"test\": creature.mesh." + key + ": missing; must be given");
        }
    }
    json body = creature(file);
    body["profile"] = {{"length", 1}};
    EXPECT_THROW(model_of_mesh(body), InputError);
}

TEST_F(Mesh, OfASceneIsScaledByWhatTheSceneSays) {
    const Scene scene = load_scene("pool/ray", json::parse(R"({"creature":{"mesh":{"unit":0.05}}})"));
    EXPECT_EQ(scene.creature->skin->unit, 0.05);
    EXPECT_EQ(scene.creature->slices.size(), 20u);
}

/// A definition says which file it was made of, so that nothing that was computed is taken for what another would give.
TEST_F(Mesh, IsToldFromAnotherOfTheSameName) {
    const std::string file = write("box.obj", box({0, 0, 0}, {2, 0.5, 0.4}).obj());
    const json overrides = {{"creature", creature(file)}};
    const json before = scene_definition("pool/water", overrides);
    EXPECT_EQ(scene_definition("pool/water", overrides), before);
    EXPECT_NO_THROW(scene_from_json(before, "before"));
    write("box.obj", box({0, 0, 0}, {2, 0.5, 0.6}).obj());
    EXPECT_NE(scene_definition("pool/water", overrides), before);
    try {
        scene_from_json(before, "before");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("creature.mesh.digest"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("which has changed"), std::string::npos);
    }
}

struct BadMesh {
    const char* name;
    std::function<std::string()> content;
    const char* file = "bad.obj";
    std::vector<std::string> expected;
};

void PrintTo(const BadMesh& bad, std::ostream* out) {
    test::print_name(bad.name, out);
}

Shape without_a_face() {
    Shape shape = box(zero, corner);
    shape.faces.erase(shape.faces.begin() + 4);
    return shape;
}
Shape with_a_turned_face() {
    Shape shape = box(zero, corner);
    std::swap(shape.faces[5][0], shape.faces[5][1]);
    return shape;
}
/// A face with a row of teeth, each corner of which is in the way of what could be cut off.
Polygons comb(int teeth) {
    Polygons shape;
    std::vector<int> face;
    for (int i = 0; i < 2 * teeth; ++i) shape.vertices.emplace_back(i, i % 2 * teeth, 0);
    shape.vertices.emplace_back(2 * teeth, 0, 0);
    shape.vertices.emplace_back(2 * teeth, -teeth, 0);
    shape.vertices.emplace_back(0, -teeth, 0);
    for (int i = static_cast<int>(shape.vertices.size()); i-- > 0;) face.push_back(i);
    shape.faces.push_back(face);
    return shape;
}
Shape with_a_fin() {
    Shape shape = box(zero, corner);
    shape.vertices.emplace_back(1, 1, 0.2);
    shape.faces.push_back({0, 1, 8});
    shape.faces.push_back({1, 0, 8});
    return shape;
}
/// A bar whose sections are wide at the ends, and in the middle as thin as `waist`.
Shape dumbbell(double waist) {
    Shape shape = ellipsoid({1, 0.3, 0.3}, 4);
    return shape.moved([&](const Vector3d& v) {
        const double thin = waist + (1 - waist) * std::min(1.0, std::max(0.0, std::abs(v.x()) - 0.2) * 4);
        return Vector3d(v.x(), v.y() * thin, v.z() * thin);
    });
}

const BadMesh bad_meshes[] = {
    {"empty", [] { return std::string(); }, "bad.obj", {"has no faces"}},
    {"number", [] { return std::string("v 0 0 0\nv 1 x 0\n"); }, "bad.obj", {"line 2", "\"x\" is no coordinate"}},
    {"two_signs",
     [] { return std::string("v 0 0 0\nv 1 +-2 0\n"); },
     "bad.obj",
     {"line 2", "\"+-2\" is no coordinate"}},
    {"missing", [] { return std::string("v 0 0\n"); }, "bad.obj", {"line 1", "a coordinate is missing"}},
    {"nan", [] { return std::string("v 0 0 nan\n"); }, "bad.obj", {"line 1", "\"nan\""}},
    {"huge", [] { return std::string("v 0 0 1e12\n"); }, "bad.obj", {"line 1", "within 1e9"}},
    {"corner",
     [] { return std::string("v 0 0 0\nv 1 0 0\nf 1 2 3\n"); },
     "bad.obj",
     {"line 3", "corner \"3\"", "2 vertices"}},
    {"corner0", [] { return std::string("v 0 0 0\nf 0 1 1\n"); }, "bad.obj", {"line 2", "corner \"0\""}},
    {"texture",
     [] { return std::string("v 0 0 0\nv 1 0 0\nf 1/a/b 2 1\n"); },
     "bad.obj",
     {"line 3", "corner \"1/a/b\"", "7/1/2"}},
    {"slashes", [] { return std::string("v 0 0 0\nf 1/1/1/1 1 1\n"); }, "bad.obj", {"line 2", "corner \"1/1/1/1\""}},
    {"marked",
     [] { return "\xef\xbb\xbf" + std::string("v 0 0 0\nv 1 0 0\nf 1 2 3\n"); },
     "bad.obj",
     {"line 3", "2 vertices"}},
    {"face", [] { return std::string("v 0 0 0\nf 1 1\n"); }, "bad.obj", {"line 2", "2 corners"}},
    {"repeated", [] { return std::string("v 0 0 0\nv 1 0 0\nf 1 1 2\n"); }, "bad.obj", {"line 3", "no area"}},
    {"hole", [] { return without_a_face().obj(); }, "bad.obj", {"a hole at the edge from", "(0, 0, 0)", "alone"}},
    {"turned",
     [] { return with_a_turned_face().obj(); },
     "bad.obj",
     {"inverted faces at the edge", "the face of line 14"}},
    {"insideOut", [] { return box(zero, corner).turned().obj(); }, "bad.obj", {"inside out", "-0.4"}},
    {"bowTie",
     [] { return std::string("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3 4\n"); },
     "bad.obj",
     {"the face of line 5", "(0, 0, 0)", "an outline that cuts or touches itself"}},
    {"comb",
     [] { return comb(60'000).obj(); },
     "bad.obj",
     {"the face of line 120004", "outline of 120003 corners", "smaller faces"}},
    {"behindVertex", [] { return std::string("v 0 0 0 v 1 0 0\n"); }, "bad.obj", {"line 1", "\"v\" behind a vertex"}},
    {"continued", [] { return std::string("v 0 0 0\nf 1 \\\n 1 \\\n x\n"); }, "bad.obj", {"line 2", "corner \"x\""}},
    {"wide", [] { return utf16(u"v 0 0 0\nv 0 \u00e9 0\n", false); }, "bad.obj", {"line 2", "\"?\" is no coordinate"}},
    {"noFacets", [] { return std::string("solid a\nendsolid a\n"); }, "bad.stl", {"has no faces"}},
    {"manyFacets",
     [] { return std::string(80, ' ') + std::string("\xff\xff\x0f\0", 4) + std::string(50 << 20, '\0'); },
     "bad.stl",
     {"more than 200000 triangles"}},
    {"fin", [] { return with_a_fin().obj(); }, "bad.obj", {"belongs to 4 faces"}},
    {"crossed",
     [] { return box(zero, corner).add(box({0.5, -0.1, 0.1}, {0.8, 0.6, 0.3})).obj(); },
     "bad.obj",
     {"intersects itself", "the face of line"}},
    {"touching",
     [] { return box(zero, corner).add(box({0.5, 0.5, 0.1}, {0.8, 0.7, 0.3})).obj(); },
     "bad.obj",
     {"intersects itself"}},
    {"inner",
     [] { return box(zero, corner).add(box({0.5, 0.1, 0.1}, {0.8, 0.4, 0.3})).obj(); },
     "bad.obj",
     {"a part inside another"}},
    {"apartTurned",
     [] { return box(zero, corner).add(box({0.5, 0.6, 0.1}, {0.8, 0.9, 0.3}).turned()).obj(); },
     "bad.obj",
     {"a part whose faces look inwards"}},
    {"thin", [] { return dumbbell(0.1).obj(); }, "bad.obj", {"thinner than two particles at 0.", "of the length"}},
    {"wing",
     [] {
         return box(zero, corner)
             .add(box({1, 0.21, 0.5}, {1.3, 0.24, 1.5}))
             .add(box({1, 0.21, -1.1}, {1.3, 0.24, -0.1}))
             .obj();
     },
     "bad.obj",
     {"too thin for particles around", "1.5"}},
    {"flatBody", [] { return box(zero, {2, 0.5, 0.1}).obj(); }, "bad.obj", {"is wide 1 spacings", "two particles"}},
    {"short", [] { return box(zero, {0.1, 0.5, 0.4}).obj(); }, "bad.obj", {"is 1 spacings long", "unit and length"}},
    {"tenThousand",
     [] { return box(zero, 10000 * Vector3d(0.1, 0.1, 0.1)).obj(); },
     "bad.obj",
     {"is 10000 spacings long", "1000"}},
    {"millions",
     [] { return box(zero, 900 * Vector3d(0.1, 0.1, 0.1)).obj(); },
     "bad.obj",
     {"more than 16000000 particles"}},
    {"oneSided",
     [] { return box(zero, corner).add(box({0.5, 0.6, 0.6}, {1.5, 0.9, 1.2})).obj(); },
     "bad.obj",
     {"different halves", "mirrored"}},
    {"facet",
     [] { return std::string("solid a\nfacet normal 0 0 1\nvertex 0 0 0\nendfacet\n"); },
     "bad.stl",
     {"line 4", "1 vertices"}},
    {"outside", [] { return std::string("solid a\nvertex 0 0 0\n"); }, "bad.stl", {"line 2", "outside of a facet"}},
    {"within", [] { return std::string("solid a\nfacet\nfacet\n"); }, "bad.stl", {"line 3", "within a facet"}},
    {"word", [] { return std::string("solid a\nfacette\n"); }, "bad.stl", {"line 2", "\"facette\""}},
    {"cutText", [] { return box(zero, corner).text_stl().substr(0, 400); }, "bad.stl", {"ends at line"}},
    {"cutBinary",
     [] { return box(zero, corner).binary_stl().substr(0, 300); },
     "bad.stl",
     {"has 300 bytes", "12 facets", "684"}},
    {"noStl", [] { return std::string("stl"); }, "bad.stl", {"has 3 bytes"}},
    {"nanBinary",
     [] {
         Shape shape = box(zero, corner);
         shape.vertices[1].x() = std::nan("");
         return shape.binary_stl();
     },
     "bad.stl",
     {"facet 3", "no number"}},
};

class BadMeshTest : public Mesh, public testing::WithParamInterface<BadMesh> {};

TEST_P(BadMeshTest, IsRefusedWithOneLineThatSaysWhere) {
    const BadMesh& bad = GetParam();
    const std::string file = write(bad.file, bad.content());
    expect_refused("pool/water", {{"creature", creature(file)}}, "creature.mesh.file: \"", bad.expected);
}

INSTANTIATE_TEST_SUITE_P(All, BadMeshTest, testing::ValuesIn(bad_meshes));

const BadInput bad_bodies[] = {
    {R"({"mesh":{"file":"none.obj"}})", "creature.mesh.file: \"none.obj\"", "no such file"},
    {R"({"mesh":{"file":"m\u00e9 \ud83d\udc1f\u0007.obj"}})", "creature.mesh.file: \"m\u00e9 \U0001f41f\\u0007.obj\"",
     "no such file"},
    {R"({"mesh":{"file":"ray.json"}})", "creature.mesh.file: \"ray.json\"", ".obj or .stl"},
    {R"({"mesh":{"file":"/dev/zero.obj"}})", "creature.mesh.file", "no such file"},
    {R"({"mesh":{"file":7}})", "creature.mesh.file", "string"},
    {R"({"mesh":{"unit":1,"length":2}})", "creature.mesh.length = 2", "left out beside unit"},
    {R"({"mesh":{"unit":0}})", "creature.mesh.unit = 0", "(0,"},
    {R"({"mesh":{"length":-2}})", "creature.mesh.length = -2", "(0,"},
    {R"({"mesh":{"length":1000}})", "creature.mesh.file: \"ray.obj\"", "spacings long"},
    {R"({"mesh":{"length":0.01}})", "creature.mesh.file: \"ray.obj\"", "spacings long"},
    {R"({"mesh":{"forward":"up"}})", "creature.mesh.forward", "\"x\" or \"-x\""},
    {R"({"mesh":{"up":"-x"}})", "creature.mesh.up", "right angle"},
    {R"({"mesh":{"digest":"0"}})", "creature.mesh.digest", "which has changed"},
    {R"({"mesh":{"joint":[0.5]}})", "creature.mesh.joint", "did you mean joints?"},
    {R"({"mesh":{"joints":[0.5,0.4]}})", "creature.mesh.joints[1] = 0.4", "behind slice"},
    {R"({"mesh":7})", "creature.mesh", "an object"},
    {R"({"joints":[3,5]})", "creature.joints", "left out beside mesh"},
    {R"({"bend":"sidewise"})", "creature.bend", "\"sideways\" or \"vertical\" or \"both\""},
    {R"({"bend":["both","vertical"]})", "creature.bend", "each of the 5 gaps"},
    {R"({"bend":["both","vertical","both","both",1]})", "creature.bend[4] = 1", "\"sideways\""},
    {R"({"joint":"hinge"})", "creature.joint", "\"slice\" or \"line\""},
};

class BadBodyTest : public testing::TestWithParam<BadInput> {};

TEST_P(BadBodyTest, IsRefusedWithOneLineThatSaysWhere) {
    const BadInput& bad = GetParam();
    expect_refused("pool/ray", {{"creature", json::parse(bad.overrides)}}, bad.field, {bad.allowed});
}

INSTANTIATE_TEST_SUITE_P(All, BadBodyTest, testing::ValuesIn(bad_bodies));

TEST_F(Mesh, OfTooManyFacesIsRefused) {
    std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf";
    for (long i = 0; i < limits::mesh_faces + 3; ++i) text += " 1";
    EXPECT_THROW(read_mesh(text, "many.obj"), InputError);
}

class RayTest : public testing::Test {
protected:
    Scene scene = load_scene("pool/ray");
    Model model = build_model(scene);
};

TEST_F(RayTest, IsSymmetricLeftAndRight) {
    using Place = std::array<long, 3>;  // in half spacings from the rear centre
    std::set<Place> places;
    for (const int i : model.body.particles) {
        const Vector3d at = (model.position[i] - scene.creature->rear_centre) / scene.creature->spacing * 2;
        EXPECT_LT((at - at.array().round().matrix()).norm(), 1e-9);  // on the lattice
        places.insert({std::lround(at.x()), std::lround(at.y()), std::lround(at.z())});
    }
    EXPECT_EQ(places.size(), model.body.particles.size());
    for (const Place& place : places) EXPECT_TRUE(places.count({place[0], place[1], -place[2]}));
}

TEST_F(RayTest, BendsUpAndDown) {
    ASSERT_EQ(model.actuators, 5);
    for (const Muscle& muscle : model.muscles) {
        const Spring& spring = model.springs[muscle.spring];
        const double y =
            (model.position[spring.a] + model.position[spring.b]).y() / 2 - scene.creature->rear_centre.y();
        EXPECT_GT(y * muscle.lateral, 0);
        EXPECT_LE(std::abs(muscle.lateral), 1);
    }
}

/// Its volume is that of the mesh, and its weight that of the water it displaces.
TEST_F(RayTest, IsAsLargeAsItsMeshAndAsHeavyAsItsWater) {
    const std::vector<double> volumes = particle_volumes(model);
    double mass = 0, volume = 0;
    for (const int i : model.body.particles) {
        mass += 1 / model.inverse_mass[i];
        volume += volumes[i];
    }
    EXPECT_NEAR(volume / scene.creature->skin->volume, 1, 0.08);
    EXPECT_NEAR(mass / (volume * fluid_density(model, volumes)), 1, 0.005);
}

/// At rest the skin fits around the particles, and each vertex follows the one or two clusters that it is nearest to.
TEST_F(RayTest, HasASkin) {
    const Skin& skin = *scene.creature->skin;
    const std::vector<SkinWeight> weights = skin_weights(*scene.creature, model);
    ASSERT_EQ(weights.size(), skin.vertices.size());
    EXPECT_EQ(skin.file, "ray.obj");
    std::set<int> used;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        EXPECT_GT(weights[i].share, 0);
        EXPECT_LE(weights[i].share, 1);
        used.insert(weights[i].cluster);
        double nearest = 1e9;
        for (const int particle : model.body.particles)
            nearest =
                std::min(nearest, (model.position[particle] - scene.creature->rear_centre - skin.vertices[i]).norm());
        EXPECT_LT(nearest, 3 * scene.creature->spacing);
        // What the file has, by the transformation that is told.
        const Vector3d in_file = skin.origin + skin.axes.transpose() * skin.vertices[i] / skin.unit;
        EXPECT_LT(in_file.x(), 1e-9);
        EXPECT_GT(in_file.x(), -30 - 1e-9);
    }
    EXPECT_EQ(used.size(), model.clusters.size());
}

TEST_F(RayTest, IsRefinedLikeAnyOther) {
    const Model fine = build_model(load_scene("pool/ray", json::parse(R"({"creature":{"refinement":2}})")));
    EXPECT_EQ(fine.body.particles.size(), 8 * model.body.particles.size());
    ASSERT_EQ(fine.springs.size(), 8 * model.springs.size());
    std::vector<double> sum(5), size(5);
    for (const Muscle& muscle : fine.muscles) {
        const Spring& spring = fine.springs[muscle.spring];
        const double y = (fine.position[spring.a] + fine.position[spring.b]).y() / 2 - scene.creature->rear_centre.y();
        EXPECT_GT(y * muscle.lateral, 0);
        sum[muscle.actuator] += muscle.lateral;
        size[muscle.actuator] += std::abs(muscle.lateral);
    }
    for (int i = 0; i < 5; ++i) {
        EXPECT_NEAR(sum[i], 0, 1e-9);
        EXPECT_GT(size[i], 1);
    }
}

/// A wave that travels to the tail drives it forward, and without water nowhere.
TEST_F(RayTest, SwimsByATravellingWave) {
    Gait gait = resting_gait(model.actuators);
    gait.frequency = 1.5;
    for (int i = 0; i < model.actuators; ++i) {
        gait.amplitude[i] = 1;
        gait.phase[i] = i == 0 ? 0 : 1 - 0.08 * i;
    }
    scene.duration = 1;
    scene.stopping = {.plane_contact = false, .no_progress_after = 0};
    const Evaluation water = evaluate(scene, gait);
    EXPECT_EQ(water.stopped, StopReason::completed);
    EXPECT_GT(water.distance, 0.02);
    scene.fluid.reset();
    scene.planes.clear();
    scene.solver.gravity = {0, 0, 0};
    EXPECT_NEAR(evaluate(scene, gait).distance, 0, 0.001);
}

}  // namespace
}  // namespace natator
