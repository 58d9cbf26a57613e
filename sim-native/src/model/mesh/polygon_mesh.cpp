#include "polygon_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "cut_polygon.h"
#include "exact_grid.h"
#include "natator/error.h"

namespace natator {
namespace {

// Of the largest extent: what is one place anywhere, and at borders. A body's finest spacing is 1e-3.
constexpr double one_place = 1e-6, max_nearby = 1e-4;
constexpr long max_steps = 10'000'000;     // along borders
constexpr long max_corners = 200'000'000;  // that are looked at to cut up polygons, some seconds' worth

/// Leaves out vertices that no face uses; the others keep their order.
void leave_out_unused(PolygonMesh& mesh) {
    std::vector<int> number(mesh.vertices.size(), -1);
    for (const std::vector<int>& face : mesh.faces)
        for (const int corner : face) number[corner] = 0;
    int count = 0;
    for (std::size_t i = 0; i < number.size(); ++i) {
        if (number[i] < 0) continue;
        mesh.vertices[count] = mesh.vertices[i];
        number[i] = count++;
    }
    mesh.vertices.resize(static_cast<std::size_t>(count));
    for (std::vector<int>& face : mesh.faces)
        for (int& corner : face) corner = number[corner];
}

/// Takes corners out that are the one before once more, and those at which the outline goes back the way it came.
void tidy(std::vector<int>& face) {
    std::vector<int> kept;
    for (const int corner : face) {
        if (!kept.empty() && kept.back() == corner) continue;
        if (kept.size() >= 2 && kept[kept.size() - 2] == corner)
            kept.pop_back();
        else
            kept.push_back(corner);
    }
    std::size_t begin = 0;
    while (kept.size() - begin >= 2) {
        const std::size_t last = kept.size() - 1;
        if (kept[begin] == kept[last] || kept[begin] == kept[last - 1])
            kept.pop_back();
        else if (kept[begin + 1] == kept[last])
            ++begin;
        else
            break;
    }
    face.assign(kept.begin() + static_cast<long>(begin), kept.end());
}

/// Leaves out faces for which `is_bad`; the first of them is told if none is left.
template <class F>
void leave_out_faces(PolygonMesh& mesh, const F& is_bad) {
    std::size_t kept = 0;
    long first = 0;
    for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
        if (is_bad(mesh.faces[i])) {
            if (first == 0) first = mesh.source[i];
            continue;
        }
        if (kept != i) mesh.faces[kept] = std::move(mesh.faces[i]);
        mesh.source[kept++] = mesh.source[i];
    }
    if (kept == 0)
        throw InputError("has no face with an area: " + face_name(first, mesh.has_lines) +
                         " has no area, its corners are in one line");
    mesh.faces.resize(kept);
    mesh.source.resize(kept);
}

/// Each vertex becomes the one whose number stands at its own in `same`.
void merge(PolygonMesh& mesh, const std::vector<int>& same) {
    for (std::vector<int>& face : mesh.faces) {
        for (int& corner : face) corner = same[corner];
        tidy(face);
    }
    leave_out_faces(mesh, [](const std::vector<int>& face) { return face.size() < 3; });
    leave_out_unused(mesh);
}

void merge_equal(PolygonMesh& mesh) {
    std::map<std::tuple<double, double, double>, int> known;
    std::vector<int> same;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        const Eigen::Vector3d& place = mesh.vertices[i];
        same.push_back(
            known.try_emplace(std::tuple(place.x(), place.y(), place.z()), static_cast<int>(i)).first->second);
    }
    merge(mesh, same);
}

std::vector<GridPoint> grid_points(const PolygonMesh& mesh) {
    const ExactGrid grid(mesh.vertices);
    std::vector<GridPoint> points;
    for (const Eigen::Vector3d& vertex : mesh.vertices) points.push_back(grid.at(vertex));
    return points;
}

bool in_one_line(const std::vector<int>& face, const std::vector<GridPoint>& points) {
    const auto at = [&](int corner) -> const GridPoint& { return points[static_cast<std::size_t>(corner)]; };
    const auto other = std::find_if(face.begin(), face.end(), [&](int corner) { return at(corner) != at(face[0]); });
    return other == face.end() || std::all_of(other, face.end(), [&](int corner) {
               const GridPoint &a = at(face[0]), &b = at(*other), &c = at(corner);
               return area(a, b, c, 0, 1) == 0 && area(a, b, c, 1, 2) == 0 && area(a, b, c, 2, 0) == 0;
           });
}

void leave_out_flat_faces(PolygonMesh& mesh) {
    for (int again = 0; again < 2; ++again) {  // without some of them the mesh may be smaller, and the grid finer
        const std::vector<GridPoint> points = grid_points(mesh);
        const std::size_t before = mesh.faces.size();
        leave_out_faces(mesh, [&](const std::vector<int>& face) { return in_one_line(face, points); });
        if (mesh.faces.size() == before) return;
        leave_out_unused(mesh);
    }
}

/// An edge that no other face goes along the other way.
struct OpenEdge {
    int from, to;
    std::size_t face, corner;  ///< of `from`
};

std::vector<OpenEdge> open_edges(const PolygonMesh& mesh) {
    std::vector<OpenEdge> edges;
    for (std::size_t i = 0; i < mesh.faces.size(); ++i)
        for (std::size_t k = 0; k < mesh.faces[i].size(); ++k)
            edges.push_back({mesh.faces[i][k], mesh.faces[i][(k + 1) % mesh.faces[i].size()], i, k});
    const auto ends = [](const OpenEdge& edge) { return std::minmax(edge.from, edge.to); };
    std::stable_sort(edges.begin(), edges.end(),
                     [&](const OpenEdge& a, const OpenEdge& b) { return ends(a) < ends(b); });
    std::vector<OpenEdge> open;
    for (auto first = edges.begin(); first != edges.end();) {
        const auto last =
            std::find_if(first, edges.end(), [&](const OpenEdge& edge) { return ends(edge) != ends(*first); });
        if (std::all_of(first, last, [&](const OpenEdge& edge) { return edge.from == first->from; }))
            open.insert(open.end(), first, last);
        first = last;
    }
    return open;
}

double max_extent(const PolygonMesh& mesh) {
    const ExactGrid grid(mesh.vertices);
    return (grid.high() - grid.low()).maxCoeff();
}

std::vector<bool> at_open_edges(const PolygonMesh& mesh) {
    std::vector<bool> is_open(mesh.vertices.size());
    for (const OpenEdge& edge : open_edges(mesh)) is_open[edge.from] = is_open[edge.to] = true;
    return is_open;
}

/// Those of some vertices that are near each other become one: at seams and poles they differ by rounding.
void merge_near(PolygonMesh& mesh, const std::vector<bool>& some, double distance) {
    std::vector<int> same(mesh.vertices.size());
    std::iota(same.begin(), same.end(), 0);
    std::map<std::array<long, 3>, std::vector<int>> cells;
    const Eigen::Vector3d low = ExactGrid(mesh.vertices).low();
    for (std::size_t i = 0; i < same.size(); ++i) {
        if (!some[i]) continue;
        const Eigen::Vector3d& place = mesh.vertices[i];
        std::array<long, 3> cell;
        for (int axis = 0; axis < 3; ++axis) cell[axis] = static_cast<long>((place[axis] - low[axis]) / distance);
        double nearest = distance;
        for (int near = 0; near < 27; ++near) {
            const auto found = cells.find({cell[0] + near % 3 - 1, cell[1] + near / 3 % 3 - 1, cell[2] + near / 9 - 1});
            if (found == cells.end()) continue;
            for (const int other : found->second) {
                const double away = (mesh.vertices[other] - place).norm();
                if (away > nearest || (away == nearest && same[i] != static_cast<int>(i) && same[i] < other)) continue;
                nearest = away;
                same[i] = other;
            }
        }
        if (same[i] == static_cast<int>(i)) cells[cell].push_back(same[i]);
    }
    merge(mesh, same);
    leave_out_flat_faces(mesh);
}

/// Vertices in the middle of an open edge, of other open edges that go the other way along it, become corners of its
/// face.
class EdgeCorners {
public:
    EdgeCorners(PolygonMesh& mesh, double off_line)
        : mesh_(mesh), edges_(open_edges(mesh)), used_(edges_.size()), off_line_(off_line) {
        for (std::size_t i = 0; i < edges_.size(); ++i) from_[edges_[i].from].push_back(i);
    }

    void add() {
        std::map<std::pair<std::size_t, std::size_t>, std::vector<int>> between;  // by face, and corner in front
        for (std::size_t i = 0; i < edges_.size(); ++i) {
            std::vector<int> corners = corners_on(i);
            if (!corners.empty()) between[{edges_[i].face, edges_[i].corner}] = std::move(corners);
        }
        for (auto last = between.rbegin(); last != between.rend(); ++last) {  // so that numbers in front of it stay
            std::vector<int>& face = mesh_.faces[last->first.first];
            face.insert(face.begin() + static_cast<long>(last->first.second) + 1, last->second.rbegin(),
                        last->second.rend());
        }
    }

private:
    /// From the edge's end to its beginning.
    std::vector<int> corners_on(std::size_t number) {
        const OpenEdge& edge = edges_[number];
        const Eigen::Vector3d &begin = mesh_.vertices[edge.to], along = mesh_.vertices[edge.from] - begin;
        const double length = along.norm();
        std::vector<std::size_t> way;
        std::vector<int> corners;
        double passed = 0;
        for (int end = edge.to; end != edge.from;) {
            std::optional<std::size_t> next;
            double least = length;
            for (const std::size_t i : from_[end]) {
                if (++steps_ > max_steps) return {};
                if (used_[i] || used_[number]) continue;
                const Eigen::Vector3d place = mesh_.vertices[edges_[i].to] - begin;
                const double distance = edges_[i].to == edge.from ? length : place.dot(along) / length;
                if (distance <= passed || distance > least || (place - along * (distance / length)).norm() > off_line_)
                    continue;
                least = distance;
                next = i;
            }
            if (!next) return {};
            passed = least;
            way.push_back(*next);
            end = edges_[*next].to;
            if (end != edge.from) corners.push_back(end);
        }
        for (const std::size_t i : way) used_[i] = true;
        used_[number] = true;
        return corners;
    }

    PolygonMesh& mesh_;
    std::vector<OpenEdge> edges_;
    std::vector<bool> used_;
    std::map<int, std::vector<std::size_t>> from_;
    double off_line_;
    long steps_ = 0;
};

/// What cannot be closed stays as it is, so that what is refused is what the file has.
void close_borders(PolygonMesh& mesh) try {
    PolygonMesh closed = mesh;
    for (double nearby = one_place; nearby < 1.1 * max_nearby; nearby *= 10) {
        const double distance = nearby * max_extent(closed);
        merge_near(closed, at_open_edges(closed), distance);
        EdgeCorners(closed, distance).add();
        if (!open_edges(closed).empty()) continue;
        mesh = std::move(closed);
        return;
    }
} catch (const InputError&) {  // no face is left
}

}  // namespace

TriangleMesh triangles_of(PolygonMesh mesh) {
    if (mesh.faces.empty()) throw InputError("has no faces");
    leave_out_unused(mesh);
    merge_equal(mesh);
    leave_out_flat_faces(mesh);
    merge_near(mesh, std::vector<bool>(mesh.vertices.size(), true), one_place * max_extent(mesh));
    if (!open_edges(mesh).empty()) close_borders(mesh);

    TriangleMesh triangles;
    triangles.has_lines = mesh.has_lines;
    const std::vector<GridPoint> points = grid_points(mesh);
    long work = 0;
    for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
        rotate_to_canonical(mesh.faces[i]);
        const auto name = [&] { return face_name(mesh.source[i], mesh.has_lines); };
        std::vector<std::array<int, 3>> cut;
        if (const std::vector<int>& face = mesh.faces[i]; face.size() == 3)
            cut.push_back({face[0], face[1], face[2]});
        else
            try {
                cut = cut_polygon(face, points, work, max_corners);
            } catch (const InputError& error) {
                throw InputError(name() + " " + error.what());
            }
        if (cut.empty())
            throw InputError("intersects itself: " + name() + ", at " + shown(mesh.vertices[mesh.faces[i][0]]) +
                             ", has an outline that cuts or touches itself");
        for (std::array<int, 3>& corners : cut) {
            std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
            triangles.triangles.emplace_back(corners[0], corners[1], corners[2]);
            triangles.source.push_back(mesh.source[i]);
        }
    }
    triangles.vertices = std::move(mesh.vertices);
    return triangles;
}

}  // namespace natator
