#include "regions.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>
#include <tuple>
#include <utility>

#include "natator/error.h"

namespace natator {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;
using Particles = std::vector<int>;

constexpr int spacing = 3;  // in chamfer lengths
constexpr int apart = 2 * spacing;
constexpr std::size_t min_lines = 4;  // regions that only touch at a corner have no muscles
constexpr double max_away = 2;        // spacings from a given place to its particle
constexpr int unreached = std::numeric_limits<int>::max();

/// The particles of a body on their lattice. Places are in half spacings from the centre of the last slice.
class BodyLattice {
public:
    explicit BodyLattice(const std::vector<Slice>& slices) : slices_(slices) {
        const auto last = static_cast<int>(slices.size()) - 1;
        for (int slice = 0; slice <= last; ++slice) {
            first_row_.push_back(static_cast<int>(first_.size()));
            for (int iy = 0; iy < slices[slice].height; ++iy) {
                first_.push_back(particles());
                for (int iz = 0; iz < slices[slice].row(iy); ++iz)
                    places_.emplace_back(2 * (last - slice), slices[slice].y(iy), slices[slice].z(iy, iz));
            }
        }
    }

    int particles() const { return static_cast<int>(places_.size()); }
    const Vector3i& place(int particle) const { return places_[particle]; }
    int slices() const { return static_cast<int>(slices_.size()); }

    /// The particle at a place; -1 if none is.
    int at(const Vector3i& place) const {
        const int slice = slices() - 1 - place.x() / 2;
        if (place.x() < 0 || slice < 0) return -1;
        const Slice& shape = slices_[slice];
        const int iy = (place.y() - shape.y(0)) / 2;
        if (place.y() < shape.y(0) || iy >= shape.height) return -1;
        const auto begin = places_.begin() + first_[first_row_[slice] + iy];
        const auto end = begin + shape.row(iy);
        const auto found = std::lower_bound(begin, end, place.z(), [](const Vector3i& a, int z) { return a.z() < z; });
        return found != end && found->z() == place.z() ? static_cast<int>(found - places_.begin()) : -1;
    }
    int mirrored(int particle) const { return at(place(particle).cwiseProduct(Vector3i(1, 1, -1))); }

    /// The place of the lattice nearest to one in half spacings.
    Vector3i nearest(const Vector3d& place) const {
        const auto rounded = [](double value, int odd) {
            return 2 * static_cast<int>(std::floor((value - odd + 1) / 2)) + odd;
        };
        return {rounded(place.x(), 0), rounded(place.y(), slices_[0].y(0) & 1), rounded(place.z(), 1)};
    }

    /// Of all particles from the nearest of `seeds`.
    std::vector<int> distances(const Particles& seeds) const {
        std::vector<int> distance(places_.size(), unreached);
        std::vector<Particles> buckets{seeds};
        for (const int seed : seeds) distance[seed] = 0;
        for (std::size_t d = 0; d < buckets.size(); ++d) {
            for (const int particle : std::exchange(buckets[d], {})) {
                if (distance[particle] != static_cast<int>(d)) continue;
                for (int step = 0; step < 27; ++step) {
                    const Vector3i way(step / 9 - 1, step / 3 % 3 - 1, step % 3 - 1);
                    const int next = step == 13 ? -1 : at(place(particle) + 2 * way);
                    const int length = static_cast<int>(d) + spacing - 1 + way.cwiseAbs().sum();
                    if (next < 0 || length >= distance[next]) continue;
                    distance[next] = length;
                    if (buckets.size() <= static_cast<std::size_t>(length)) buckets.resize(length + 1);
                    buckets[length].push_back(next);
                }
            }
        }
        return distance;
    }

private:
    const std::vector<Slice>& slices_;
    std::vector<Vector3i> places_;
    std::vector<int> first_;      ///< particle of each row
    std::vector<int> first_row_;  ///< of each slice
};

/// All particles that are nearest to a place, half spacings, among those that `belongs` says.
template <class Belongs>
Particles nearest_particles(const BodyLattice& body, const Vector3d& place, const Belongs& belongs) {
    constexpr double same = 1e-6;
    double least = std::numeric_limits<double>::infinity();
    Particles nearest;
    for (int particle = 0; particle < body.particles(); ++particle) {
        if (!belongs(particle)) continue;
        const double away = (body.place(particle).cast<double>() - place).norm();
        if (away > least + same) continue;
        if (away < least - same) nearest.clear();
        least = std::min(least, away);
        nearest.push_back(particle);
    }
    return nearest;
}

Particles mirrored(const BodyLattice& body, Particles particles) {
    for (int& particle : particles) particle = body.mirrored(particle);
    std::sort(particles.begin(), particles.end());
    return particles;
}

std::vector<Particles> sampled_points(const BodyLattice& body, int count) {
    const int head = body.place(0).x();
    int next = nearest_particles(body, Vector3d(head, 0, 0), [&](int particle) {
                   return body.place(particle).x() == head;
               }).front();
    std::vector<Particles> points;
    std::vector<int> nearest;  // distance to the nearest point, by particle
    int away = apart;          // of the next one
    while (static_cast<int>(points.size()) < count) {
        if (away < apart) throw InputError("at most " + std::to_string(points.size()) + " fit 2 spacings apart");
        const int image = body.mirrored(next);
        if (body.distances({next})[image] < away) {
            points.push_back({next, image});
        } else {
            if (static_cast<int>(points.size()) + 2 > count) break;
            points.push_back({next});
            points.push_back({image});
        }
        const std::vector<int> distance = body.distances({next, image});
        if (nearest.empty()) nearest = distance;
        for (std::size_t i = 0; i < nearest.size(); ++i) nearest[i] = std::min(nearest[i], distance[i]);
        next = static_cast<int>(std::max_element(nearest.begin(), nearest.end()) - nearest.begin());
        away = nearest[next];
    }
    if (static_cast<int>(points.size()) < min_control_points)
        throw InputError("one point in the middle, and the next ones are a pair; must be 3 or more");
    return points;
}

std::vector<Particles> given_points(const BodyLattice& body, const std::vector<Vector3d>& places) {
    std::vector<Particles> points;
    std::vector<std::size_t> given;  // by point
    for (std::size_t k = 0; k < places.size(); ++k) {
        const bool middle = std::abs(places[k].z()) <= 0.5;
        const Vector3d place = 2 * Vector3d(places[k].x(), places[k].y(), middle ? 0 : places[k].z());
        const Particles one = nearest_particles(body, place, [](int) { return true; });
        const double away = (body.place(one.front()).cast<double>() - place).norm() / 2;
        if (away > max_away) {
            std::ostringstream text;
            text << "point " << k << " is " << away << " spacings from the nearest particle; must be within "
                 << max_away;
            throw InputError(text.str());
        }
        const std::vector<int> from_one = body.distances({one.front()});
        for (const int seed : one)
            if (from_one[seed] > apart)
                throw InputError("point " + std::to_string(k) + " is as near to two parts of the body; must be in one");
        for (const Particles& seeds : {one, mirrored(body, one)}) {
            const std::size_t same = std::find(points.begin(), points.end(), seeds) - points.begin();
            if (same < points.size() && (given[same] == k || places[given[same]].z() * places[k].z() < 0)) continue;
            const std::vector<int> distance = body.distances(seeds);
            for (std::size_t i = 0; i < points.size(); ++i) {
                if (distance[points[i].front()] < apart)
                    throw InputError("points " + std::to_string(given[i]) + " and " + std::to_string(k) +
                                     " or their mirror images are nearer than 2 spacings; must be farther apart");
            }
            points.push_back(seeds);
            given.push_back(k);
        }
    }
    if (static_cast<int>(points.size()) < min_control_points) throw InputError("one point; must be two or more");
    return points;
}

/// Of particles, spacings.
Vector3d middle_of(const BodyLattice& body, const Particles& particles) {
    Vector3i sum = Vector3i::Zero();
    for (const int particle : particles) sum += body.place(particle);
    return sum.cast<double>() / (2 * static_cast<double>(particles.size()));
}

/// Two neighbouring regions, and their mirror image if that is another pair.
struct Pair {
    Vector3d middle;                         ///< of the border, spacings
    Vector3d along;                          ///< from the front region's middle to the other one's, of length 1
    std::vector<std::pair<int, int>> lines;  ///< front and rear particle of each fibre
    bool twice = false;                      ///< whether the mirror image is another one
};

/// Regions on the way to becoming clusters and muscles.
class RegionBuilder {
public:
    RegionBuilder(const BodyLattice& body, std::vector<Particles> points) : body_(body), points_(std::move(points)) {
        for (Particles& point : points_) std::sort(point.begin(), point.end());
        const auto order = [&](const Particles& point) {
            const Vector3d middle = middle_of(body_, point);
            return std::tuple(-middle.x(), std::abs(middle.z()), middle.z(), middle.y());
        };
        std::sort(points_.begin(), points_.end(),
                  [&](const Particles& a, const Particles& b) { return order(a) < order(b); });
        nearest_.assign(static_cast<std::size_t>(body.particles()), unreached);
        for (const Particles& point : points_) {
            distances_.push_back(body.distances(point));
            for (std::size_t i = 0; i < nearest_.size(); ++i) nearest_[i] = std::min(nearest_[i], distances_.back()[i]);
        }
        clusters_.resize(points_.size());
        for (std::size_t region = 0; region < clusters_.size(); ++region) {
            for (int particle = 0; particle < body_.particles(); ++particle)
                if (belongs(particle, region)) clusters_[region].push_back(particle);
            const Particles image = mirrored(body, points_[region]);
            mirror_.push_back(std::find(points_.begin(), points_.end(), image) - points_.begin());
        }
    }

    const std::vector<Particles>& clusters() const { return clusters_; }

    /// Of all regions that have a border and lines through it, by the border's middle from the head.
    std::vector<Pair> pairs() const {
        std::vector<Pair> all;
        for (std::size_t i = 0; i < points_.size(); ++i)
            for (std::size_t j = i + 1; j < points_.size(); ++j) {
                const auto [a, b] = std::minmax(mirror_[i], mirror_[j]);
                if (std::pair(a, b) < std::pair(i, j)) continue;  // that is the one
                Pair pair = pair_of(i, j, std::pair(a, b) == std::pair(i, j));
                if (pair.lines.size() >= min_lines) all.push_back(std::move(pair));
            }
        const auto order = [](const Pair& pair) {
            return std::tuple(-pair.middle.x(), std::abs(pair.middle.z()), pair.middle.y());
        };
        std::stable_sort(all.begin(), all.end(), [&](const Pair& a, const Pair& b) { return order(a) < order(b); });
        return all;
    }

    /// Of a vertex, spacings.
    SkinWeight skin_weight(const Vector3d& vertex) const {
        const int particle = nearest_to(vertex);
        std::vector<int> order(points_.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
        const auto distance = [&](int region) { return distances_[static_cast<std::size_t>(region)][particle]; };
        std::partial_sort(order.begin(), order.begin() + 2, order.end(),
                          [&](int a, int b) { return std::pair(distance(a), a) < std::pair(distance(b), b); });
        const double own = distance(order[0]), other = distance(order[1]);
        return {order[0], order[1], other / (own + other)};
    }

private:
    bool belongs(int particle, std::size_t region) const {
        return distances_[region][particle] <= nearest_[particle] + spacing;
    }

    /// `alone`: the pair is its own mirror image.
    Pair pair_of(std::size_t i, std::size_t j, bool alone) const {
        Pair pair;
        pair.twice = !alone;
        Particles border;
        for (const int particle : clusters_[i])
            if (belongs(particle, j)) border.push_back(particle);
        if (border.empty()) return pair;
        pair.middle = middle_of(body_, border);
        const Vector3d between = middle_of(body_, clusters_[j]) - middle_of(body_, clusters_[i]);
        if (between.isZero(0)) return pair;
        pair.along = between.normalized();
        const int half = std::max(1, static_cast<int>(std::lround(between.norm() / 2)));
        std::set<std::pair<int, int>> lines;
        for (const int particle : border) {
            if (alone && body_.place(particle).z() > 0) continue;  // as its mirror image
            const int front = end_of_line(particle, -pair.along, half, i);
            const int rear = end_of_line(particle, pair.along, half, j);
            if (front == particle || rear == particle) continue;
            lines.insert({front, rear});
            if (alone) lines.insert({body_.mirrored(front), body_.mirrored(rear)});
        }
        pair.lines.assign(lines.begin(), lines.end());
        return pair;
    }

    /// How far a line goes from a particle, within the body and a region.
    int end_of_line(int particle, const Vector3d& along, int most, std::size_t region) const {
        int end = particle;
        for (int k = 1; k <= most; ++k) {
            const int next = body_.at(body_.nearest(body_.place(particle).cast<double>() + 2 * k * along));
            if (next < 0 || !belongs(next, region)) break;
            end = next;
        }
        return end;
    }

    int nearest_to(const Vector3d& vertex) const {
        constexpr int around = 3;  // as far as slice_mesh lets the surface be
        const Vector3i middle = body_.nearest(2 * vertex);
        double least = std::numeric_limits<double>::infinity();
        int nearest = -1;
        for (int x = -around; x <= around; ++x)
            for (int y = -around; y <= around; ++y)
                for (int z = -around; z <= around; ++z) {
                    const int particle = body_.at(middle + 2 * Vector3i(x, y, z));
                    if (particle < 0) continue;
                    const double away = (body_.place(particle).cast<double>() - 2 * vertex).squaredNorm();
                    if (away < least) least = away, nearest = particle;
                }
        return nearest >= 0 ? nearest : nearest_particles(body_, 2 * vertex, [](int) { return true; }).front();
    }

    const BodyLattice& body_;
    std::vector<Particles> points_;
    std::vector<std::vector<int>> distances_;  ///< by point, then particle
    std::vector<int> nearest_;                 ///< distance to the nearest point, by particle
    std::vector<Particles> clusters_;          ///< by point
    std::vector<std::size_t> mirror_;          ///< mirror image of each point
};

/// The direction across a pair's line in which the muscles' part changes.
Vector3d across(const Pair& pair, Bend bend) {
    const Vector3d up = std::abs(pair.along.y()) < 0.9 ? Vector3d::UnitY() : Vector3d::UnitX();
    const Vector3d vertical = (up - up.dot(pair.along) * pair.along).normalized();
    return bend == Bend::vertical ? vertical : vertical.cross(pair.along);
}

/// Adds the fibres of a pair for one actuator. None where its border is too thin to bend that way.
void add_fibres(const BodyLattice& body, const Pair& pair, Bend bend, int actuator, std::vector<Fibre>& fibres) {
    constexpr double thinnest = 0.25;  // spacings from the middle
    std::vector<double> lateral(pair.lines.size(), 1);
    if (bend != Bend::contract) {
        const Vector3d way = across(pair, bend);
        double most = 0;
        for (std::size_t i = 0; i < lateral.size(); ++i) {
            const Vector3i ends = body.place(pair.lines[i].first) + body.place(pair.lines[i].second);
            lateral[i] = way.dot(ends.cast<double>() / 4 - pair.middle);
            most = std::max(most, std::abs(lateral[i]));
        }
        if (most < thinnest) return;
        for (double& one : lateral) one /= most;
    }
    const auto add = [&](int a, int b, double by) { fibres.push_back({std::min(a, b), std::max(a, b), actuator, by}); };
    for (std::size_t i = 0; i < lateral.size(); ++i) {
        if (std::abs(lateral[i]) < 1e-9) continue;
        const auto [front, rear] = pair.lines[i];
        add(front, rear, lateral[i]);
        if (pair.twice) add(body.mirrored(front), body.mirrored(rear), lateral[i]);
    }
}

}  // namespace

std::shared_ptr<const Regions> make_regions(const std::vector<Slice>& slices, const ControlPoints& points,
                                            const std::vector<Vector3d>& vertices) {
    const BodyLattice body(slices);
    const std::vector<int> from_first = body.distances({0});
    if (std::find(from_first.begin(), from_first.end(), unreached) != from_first.end())
        throw InputError("the body is in several pieces at this spacing; must be in one");
    const RegionBuilder builder(
        body, points.count > 0 ? sampled_points(body, points.count) : given_points(body, points.places));
    auto regions = std::make_shared<Regions>();
    regions->clusters = builder.clusters();
    for (const Vector3d& vertex : vertices) regions->skin.push_back(builder.skin_weight(vertex));

    const std::vector<Pair> pairs = builder.pairs();
    for (const Bend bend : points.bends)
        for (std::size_t first = 0, last = 0; first < pairs.size(); first = last) {
            last = first + 1;
            while (bend == Bend::contract && last < pairs.size() &&
                   pairs[last - 1].middle.x() - pairs[last].middle.x() <= 1)
                ++last;
            const auto actuator = static_cast<int>(regions->actuators.size());
            const std::size_t before = regions->fibres.size();
            double slice = 0;
            for (std::size_t k = first; k < last; ++k) {
                add_fibres(body, pairs[k], bend, actuator, regions->fibres);
                slice += (body.slices() - 1 - pairs[k].middle.x()) / static_cast<double>(last - first);
            }
            if (regions->fibres.size() == before) continue;
            regions->actuators.push_back({static_cast<int>(first), bend});
            regions->places.push_back((slice + 0.5) / body.slices());
        }
    if (regions->fibres.empty()) throw InputError("no muscle fits between the regions");
    std::stable_sort(regions->fibres.begin(), regions->fibres.end(), [](const Fibre& a, const Fibre& b) {
        return std::tuple(a.actuator, a.front, a.rear) < std::tuple(b.actuator, b.front, b.rear);
    });
    return regions;
}

}  // namespace natator
