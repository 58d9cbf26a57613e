#include "check_mesh.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <sstream>
#include <utility>

#include "exact_grid.h"
#include "natator/error.h"
#include "natator/limits.h"

namespace natator {
namespace {

using Triangle = std::array<GridPoint, 3>;

std::string edge_between(const TriangleMesh& mesh, int a, int b) {
    return "the edge from " + shown(mesh.vertices[static_cast<std::size_t>(a)]) + " to " +
           shown(mesh.vertices[static_cast<std::size_t>(b)]);
}

void check_areas(const TriangleMesh& mesh, const std::vector<GridPoint>& points) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Eigen::Vector3i& t = mesh.triangles[i];
        const GridPoint &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
        if (area(a, b, c, 0, 1) == 0 && area(a, b, c, 1, 2) == 0 && area(a, b, c, 2, 0) == 0)
            throw InputError(mesh.name(i) + ", at " + shown(mesh.corner(i, 0)) +
                             ", has no area: its corners are in one line; must be a triangle");
    }
}

/// Every edge belongs to two faces, which go along it in opposite directions.
void check_edges(const TriangleMesh& mesh) {
    std::map<std::pair<int, int>, std::array<std::vector<std::size_t>, 2>>
        faces;  // by ends: those that go up, and down
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            const int a = mesh.triangles[i][k], b = mesh.triangles[i][(k + 1) % 3];
            faces[{std::min(a, b), std::max(a, b)}][a < b ? 0 : 1].push_back(i);
        }
    for (const auto& [ends, ways] : faces) {
        const auto& [up, down] = ways;
        if (up.size() == 1 && down.size() == 1) continue;
        const auto of = edge_between(mesh, ends.first, ends.second);
        const std::size_t first = up.empty() ? down[0] : up[0];
        if (up.size() + down.size() == 1)
            throw InputError("a hole at " + of + ", which belongs to " + mesh.name(first) +
                             " alone; the mesh must be closed, each edge between two faces");
        if (up.size() + down.size() == 2)
            throw InputError("inverted faces at " + of + ": " + mesh.name(first) + " and " +
                             mesh.name(up.empty() ? down[1] : up[1]) +
                             " look to different sides; all must go round counter-clockwise seen from outside");
        throw InputError(of + " belongs to " + std::to_string(up.size() + down.size()) + " faces, " + mesh.name(first) +
                         " among them; must be two");
    }
}

/// Whether two segments of one plane meet, seen along the third axis.
bool segments_meet(const GridPoint& p, const GridPoint& q, const GridPoint& a, const GridPoint& b, int x, int y) {
    const auto overlap = [&](int axis) {
        return std::max(std::min(p[axis], q[axis]), std::min(a[axis], b[axis])) <=
               std::min(std::max(p[axis], q[axis]), std::max(a[axis], b[axis]));
    };
    const int pa = sign_of(area(p, q, a, x, y)), pb = sign_of(area(p, q, b, x, y));
    const int ap = sign_of(area(a, b, p, x, y)), aq = sign_of(area(a, b, q, x, y));
    return overlap(x) && overlap(y) && pa * pb <= 0 && ap * aq <= 0;
}

/// Whether a segment in the plane of a triangle meets it.
bool meets_in_plane(const GridPoint& p, const GridPoint& q, const Triangle& t) {
    int x = 0, y = 1;
    while (area(t[0], t[1], t[2], x, y) == 0) x = (x + 1) % 3, y = (y + 1) % 3;
    const int round = sign_of(area(t[0], t[1], t[2], x, y));
    bool inside = true;
    for (int k = 0; k < 3; ++k) {
        if (segments_meet(p, q, t[k], t[(k + 1) % 3], x, y)) return true;
        inside = inside && sign_of(area(t[k], t[(k + 1) % 3], p, x, y)) == round;
    }
    return inside;
}

/// Whether a segment, ends included, meets a triangle, border included.
bool meets(const GridPoint& p, const GridPoint& q, const Triangle& t) {
    const int sp = side(t[0], t[1], t[2], p), sq = side(t[0], t[1], t[2], q);
    if (sp * sq > 0) return false;
    if (sp == 0 && sq == 0) return meets_in_plane(p, q, t);
    const int s0 = side(p, q, t[0], t[1]), s1 = side(p, q, t[1], t[2]), s2 = side(p, q, t[2], t[0]);
    return (s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0);
}

class Intersections {
public:
    Intersections(const TriangleMesh& mesh, const std::vector<GridPoint>& points) : mesh_(mesh), points_(points) {}

    /// Whether two faces have more in common than the corners that they share.
    bool cut(std::size_t i, std::size_t j) const {
        const Triangle a = corners(i), b = corners(j);
        std::array<int, 3> own{}, other{};  // of the corners: whether shared
        int shared = 0;
        for (int k = 0; k < 3; ++k)
            for (int m = 0; m < 3; ++m)
                if (mesh_.triangles[i][k] == mesh_.triangles[j][m]) own[k] = other[m] = 1, ++shared;
        if (shared >= 2) return folded(a, b, own, other, shared);
        return any_edge_meets(a, own, b) || any_edge_meets(b, other, a);
    }

private:
    Triangle corners(std::size_t i) const {
        const Eigen::Vector3i& t = mesh_.triangles[i];
        return {points_[t[0]], points_[t[1]], points_[t[2]]};
    }

    /// Edges without a shared corner.
    static bool any_edge_meets(const Triangle& a, const std::array<int, 3>& shared, const Triangle& b) {
        for (int k = 0; k < 3; ++k)
            if (!shared[k] && !shared[(k + 1) % 3] && meets(a[k], a[(k + 1) % 3], b)) return true;
        return false;
    }

    /// Neighbours at an edge that lie on each other.
    static bool folded(const Triangle& a, const Triangle& b, const std::array<int, 3>& own,
                       const std::array<int, 3>& other, int shared) {
        if (shared == 3) return true;
        const auto apart = [](const std::array<int, 3>& of) { return std::find(of.begin(), of.end(), 0) - of.begin(); };
        const auto tip = apart(own), other_tip = apart(other);
        if (side(a[0], a[1], a[2], b[other_tip]) != 0) return false;
        const GridPoint &from = a[(tip + 1) % 3], &to = a[(tip + 2) % 3];
        for (const auto& [x, y] : {std::pair{0, 1}, std::pair{1, 2}, std::pair{2, 0}}) {
            const int one = sign_of(area(from, to, a[tip], x, y));
            if (one != 0) return one == sign_of(area(from, to, b[other_tip], x, y));
        }
        return false;
    }

    const TriangleMesh& mesh_;
    const std::vector<GridPoint>& points_;
};

struct Box {
    GridPoint low, high;
};

/// Pairs whose boxes overlap along the longest axis are looked at, in the order in which they begin there.
void check_intersections(const TriangleMesh& mesh, const std::vector<GridPoint>& points, int axis) {
    std::vector<Box> boxes;
    for (const Eigen::Vector3i& t : mesh.triangles) {
        const GridPoint &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
        boxes.push_back({a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)});
    }
    std::vector<std::size_t> order(boxes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return boxes[a].low[axis] < boxes[b].low[axis]; });
    const Intersections intersections(mesh, points);
    long pairs = 0;
    for (std::size_t k = 0; k < order.size(); ++k) {
        const Box& box = boxes[order[k]];
        for (std::size_t m = k + 1; m < order.size() && boxes[order[m]].low[axis] <= box.high[axis]; ++m) {
            if (++pairs > limits::mesh_pairs)
                throw InputError("more than " + std::to_string(limits::mesh_pairs) +
                                 " pairs of faces lie beside each other; must have fewer or smaller faces");
            const Box& other = boxes[order[m]];
            if ((box.low.array() > other.high.array()).any() || (other.low.array() > box.high.array()).any()) continue;
            if (!intersections.cut(order[k], order[m])) continue;
            const auto [first, second] = std::minmax(order[k], order[m]);
            throw InputError("intersects itself: " + mesh.name(first) + ", at " + shown(mesh.corner(first, 0)) +
                             ", and " + mesh.name(second) + ", at " + shown(mesh.corner(second, 0)) +
                             ", cut or touch; only neighbours may, in what they share");
        }
    }
}

}  // namespace

void check_mesh(const TriangleMesh& mesh) {
    const ExactGrid grid(mesh.vertices);
    std::vector<GridPoint> points;
    for (const Eigen::Vector3d& vertex : mesh.vertices) points.push_back(grid.at(vertex));
    check_areas(mesh, points);
    check_edges(mesh);
    Eigen::Index longest = 0;
    (grid.high() - grid.low()).maxCoeff(&longest);
    check_intersections(mesh, points, static_cast<int>(longest));
    if (const double volume = signed_volume(mesh); !(volume > 0)) {
        std::ostringstream text;
        text << "is inside out: all faces look inwards (volume " << volume
             << "); they must go round counter-clockwise seen from outside";
        throw InputError(text.str());
    }
}

}  // namespace natator
