#include "cut_polygon.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "natator/error.h"

namespace natator {
namespace {

using Three = std::array<int, 3>;

/// A polygon seen along the axis that it faces most, where it goes round counter-clockwise. Corners are told by their
/// places in it.
class Outline {
public:
    Outline(std::span<const int> corners, std::span<const GridPoint> points) : corners_(corners), points_(points) {
        for (const auto& [x, y] : {std::pair{1, 2}, std::pair{2, 0}, std::pair{0, 1}}) {
            Wide sum = 0;
            for (int i = 2; i < size(); ++i) sum += area(at(0), at(i - 1), at(i), x, y);
            const Wide extent = sum < 0 ? -sum : sum;
            if (extent <= area_) continue;
            area_ = extent;
            x_ = sum > 0 ? x : y;
            y_ = sum > 0 ? y : x;
        }
    }

    int size() const { return static_cast<int>(corners_.size()); }
    bool has_area() const { return area_ > 0; }
    int number(int i) const { return corners_[static_cast<std::size_t>(i)]; }
    int turn(int a, int b, int c) const { return sign_of(area(at(a), at(b), at(c), x_, y_)); }

    /// 1/12 for an equilateral triangle, 0 for one of no area.
    double roundness(int a, int b, int c) const {
        const Eigen::Vector3d u = (at(b) - at(a)).cast<double>(), v = (at(c) - at(a)).cast<double>();
        const double lengths = u.squaredNorm() + v.squaredNorm() + (u - v).squaredNorm();
        return u.cross(v).squaredNorm() / (lengths * lengths);
    }

    /// Whether a corner d is inside the circle through a, b and c, which go round counter-clockwise.
    bool in_circle(int a, int b, int c, int d) const {
        Wide sum = 0;
        for (const auto& [p, q, r] : {Three{a, b, c}, Three{b, c, a}, Three{c, a, b}}) {
            const Wide x = at(p)[x_] - at(d)[x_], y = at(p)[y_] - at(d)[y_];
            sum += (x * x + y * y) * area(at(d), at(q), at(r), x_, y_);
        }
        return sum > 0;
    }

private:
    const GridPoint& at(int i) const { return points_[static_cast<std::size_t>(number(i))]; }

    std::span<const int> corners_;
    std::span<const GridPoint> points_;
    Wide area_ = 0;
    int x_ = 0, y_ = 1;
};

class Ears {
public:
    Ears(const Outline& outline, long& work, long max_work) : outline_(outline), work_(work), max_work_(max_work) {
        const int count = outline.size();
        for (int i = 0; i < count; ++i) before_.push_back((i + count - 1) % count), behind_.push_back((i + 1) % count);
        quality_.assign(before_.size(), none);
    }

    std::vector<Three> cut() {
        std::vector<Three> triangles;
        for (int i = 0; i < outline_.size(); ++i)
            if (outline_.turn(before_[i], i, behind_[i]) <= 0) hollow_.push_back(i);
        for (int i = 0; i < outline_.size(); ++i) look_at(i);
        int last = 0;
        for (int left = outline_.size(); left > 3; --left) {
            if (ears_.empty()) return {};
            const int ear = ears_.begin()->second, a = before_[ear], b = behind_[ear];
            triangles.push_back({a, ear, b});
            forget(ear);
            behind_[a] = b, before_[b] = a;
            std::erase_if(hollow_,
                          [&](int i) { return (i == a || i == b) && outline_.turn(before_[i], i, behind_[i]) > 0; });
            look_at(a), look_at(b);
            last = a;
        }
        if (outline_.turn(before_[last], last, behind_[last]) <= 0) return {};
        triangles.push_back({before_[last], last, behind_[last]});
        return triangles;
    }

private:
    static constexpr double none = -1;

    bool is_ear(int i) {
        const int a = before_[i], b = behind_[i];
        if (outline_.turn(a, i, b) <= 0) return false;
        if ((work_ += static_cast<long>(hollow_.size())) > max_work_)
            throw InputError("has an outline of " + std::to_string(outline_.size()) +
                             " corners, too many hollow ones among them; must be cut into smaller faces");
        const auto same = [this](int p, int q) { return outline_.number(p) == outline_.number(q); };
        // What reaches into a triangle has a hollow corner there. Edges that go both ways have two corners in one
        // place.
        return std::none_of(hollow_.begin(), hollow_.end(), [&](int w) {
            if (w == a || w == b) return false;
            if (same(w, a)) return same(before_[w], b) || same(behind_[w], b);
            if (same(w, b) || same(w, i)) return false;
            return outline_.turn(a, i, w) >= 0 && outline_.turn(i, b, w) >= 0 && outline_.turn(b, a, w) >= 0;
        });
    }

    void forget(int i) {
        if (quality_[i] != none) ears_.erase({-quality_[i], i});
        quality_[i] = none;
    }
    void look_at(int i) {
        forget(i);
        if (!is_ear(i)) return;
        quality_[i] = outline_.roundness(before_[i], i, behind_[i]);
        ears_.insert({-quality_[i], i});
    }

    const Outline& outline_;
    long& work_;
    long max_work_;
    std::vector<int> before_, behind_;  // of those that are left
    std::vector<int> hollow_;           // at which the outline does not turn inwards
    std::vector<double> quality_;       // of ears
    std::set<std::pair<double, int>> ears_;
};

/// Turns edges between two triangles until no circle through three corners holds the fourth, or it takes too long.
void turn_edges(const Outline& outline, std::vector<Three>& triangles) {
    std::map<std::pair<int, int>, std::size_t> at_left;
    std::vector<std::pair<int, int>> edges;
    const auto enter = [&](std::size_t number) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::pair edge{triangles[number][k], triangles[number][(k + 1) % 3]};
            at_left[edge] = number;
            edges.push_back(edge);
        }
    };
    const auto tip = [&](std::size_t number, int a, int b) {
        return *std::find_if(triangles[number].begin(), triangles[number].end(),
                             [&](int i) { return i != a && i != b; });
    };
    for (std::size_t i = 0; i < triangles.size(); ++i) enter(i);
    for (long left = 100L * outline.size(); !edges.empty() && left > 0;) {
        const auto [a, b] = edges.back();
        edges.pop_back();
        const auto one = at_left.find({a, b}), other = at_left.find({b, a});
        if (one == at_left.end() || other == at_left.end()) continue;
        const std::size_t first = one->second, second = other->second;
        const int c = tip(first, a, b), d = tip(second, a, b);
        if (!outline.in_circle(a, b, c, d) || outline.turn(d, b, c) <= 0 || outline.turn(c, a, d) <= 0) continue;
        at_left.erase(one), at_left.erase(other);
        triangles[first] = {d, b, c};
        triangles[second] = {c, a, d};
        enter(first), enter(second);
        --left;
    }
}

}  // namespace

void rotate_to_canonical(std::vector<int>& corners) {
    // Two beginnings are compared; the loser goes behind the first difference (Shiloach: Fast canonization of circular
    // strings, 1981).
    const std::size_t count = corners.size();
    std::size_t a = 0, b = 1, same = 0;
    while (a < count && b < count && same < count) {
        const int one = corners[(a + same) % count], other = corners[(b + same) % count];
        if (one == other) {
            ++same;
            continue;
        }
        (one > other ? a : b) += same + 1;
        if (a == b) ++b;
        same = 0;
    }
    std::rotate(corners.begin(), corners.begin() + static_cast<long>(std::min(a, b)), corners.end());
}

std::vector<std::array<int, 3>> cut_polygon(std::span<const int> corners, std::span<const GridPoint> points, long& work,
                                            long max_work) {
    const Outline outline(corners, points);
    if (!outline.has_area()) return {};
    std::vector<Three> triangles = Ears(outline, work, max_work).cut();
    turn_edges(outline, triangles);
    for (Three& triangle : triangles)
        for (int& corner : triangle) corner = outline.number(corner);
    return triangles;
}

}  // namespace natator
