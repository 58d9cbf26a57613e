#include "mesh_slices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <utility>

#include "exact_grid.h"
#include "natator/error.h"
#include "natator/limits.h"

namespace natator {
namespace {

constexpr double most_across = 1000;      // spacings
constexpr std::size_t most_left_out = 2;  // slices at each tip
constexpr double most_asymmetric = 0.1;   // of the particles
constexpr double most_volume_error = 0.25;
constexpr int reach = 3;                  // spacings from the surface to the next particle

struct Crossing {
    double x;
    int step;  ///< of the winding number, towards larger x
};

/// The lattice in the box of a mesh: slice 0 is nearest the head.
class Lattice {
public:
    Lattice(const TriangleMesh& mesh, double spacing) : grid_(mesh.vertices), spacing_(spacing) {
        const Eigen::Vector3d extent = grid_.high() - grid_.low();
        for (int axis = 0; axis < 3; ++axis) {
            const double across = extent[axis] / spacing;
            if (across >= (axis == 0 ? 2 : 1.5) && across <= most_across) continue;
            std::ostringstream text;
            text << (axis == 0 ? "is " : axis == 1 ? "is high " : "is wide ") << across << " spacings"
                 << (axis == 0 ? " long" : "") << ", " << extent[axis] << " units of the file of " << spacing
                 << " to a spacing; must be " << (axis == 0 ? "2" : "1.5, which is two particles across,") << " to "
                 << most_across << ": see unit and length";
            throw InputError(text.str());
        }
        count_ = (extent / spacing).array().round().max(1).cast<int>();
        count_.z() = 2 * static_cast<int>(std::lround(extent.z() / spacing / 2 + 0.5));  // on both sides, with room to spare
        middle_ = (grid_.low() + grid_.high()) / 2;
    }

    const ExactGrid& grid() const { return grid_; }
    const Eigen::Vector3i& count() const { return count_; }
    double x(double slice) const { return middle_.x() + ((count_.x() - 1) / 2.0 - slice) * spacing_; }
    double y(int row) const { return middle_.y() + (row - (count_.y() - 1) / 2.0) * spacing_; }
    double z(int column) const { return middle_.z() + (column - (count_.z() - 1) / 2.0) * spacing_; }
    const Eigen::Vector3d& middle() const { return middle_; }

    /// Number of a place along an axis, not rounded; slices from the head.
    double slice(double at) const { return (count_.x() - 1) / 2.0 - (at - middle_.x()) / spacing_; }
    double row(double at) const { return (count_.y() - 1) / 2.0 + (at - middle_.y()) / spacing_; }
    double column(double at) const { return (count_.z() - 1) / 2.0 + (at - middle_.z()) / spacing_; }
    /// Half spacings of a column from the middle.
    int from_middle(int column) const { return 2 * column - (count_.z() - 1); }
    std::string part(double slice) const {
        std::ostringstream text;
        text << (slice + 0.5) / count_.x() << " of the length";
        return text.str();
    }

private:
    ExactGrid grid_;
    double spacing_;
    Eigen::Vector3i count_;
    Eigen::Vector3d middle_;
};

/// On which side of the line from a to b a point of the plane (y, z) is, moved by an infinitesimal amount along y and by one
/// that is infinitesimal even to that along z: never on it, unless a = b.
int side_of_edge(const GridPoint& a, const GridPoint& b, const GridPoint& point) {
    if (const int side = sign_of(area(a, b, point, 1, 2))) return side;
    if (const int side = sign_of(Wide{a.z() - b.z()})) return side;
    return sign_of(Wide{b.y() - a.y()});
}

/// What the lines of the lattice along x go through, by row and column.
std::vector<std::vector<Crossing>> crossings_of(const TriangleMesh& mesh, const Lattice& lattice) {
    const ExactGrid& grid = lattice.grid();
    const int rows = lattice.count().y(), columns = lattice.count().z();
    std::vector<std::vector<Crossing>> lines(static_cast<std::size_t>(rows) * columns);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const std::array<Eigen::Vector3d, 3> place{mesh.corner(i, 0), mesh.corner(i, 1), mesh.corner(i, 2)};
        const std::array<GridPoint, 3> corner{grid.at(place[0]), grid.at(place[1]), grid.at(place[2])};
        const Wide whole = area(corner[0], corner[1], corner[2], 1, 2);
        if (whole == 0) continue;  // seen edge-on
        const auto [low_y, high_y] = std::minmax({place[0].y(), place[1].y(), place[2].y()});
        const auto [low_z, high_z] = std::minmax({place[0].z(), place[1].z(), place[2].z()});
        const int last_row = std::min(rows - 1, static_cast<int>(std::ceil(lattice.row(high_y))));
        const int last_column = std::min(columns - 1, static_cast<int>(std::ceil(lattice.column(high_z))));
        for (int row = std::max(0, static_cast<int>(std::floor(lattice.row(low_y)))); row <= last_row; ++row)
            for (int column = std::max(0, static_cast<int>(std::floor(lattice.column(low_z)))); column <= last_column;
                 ++column) {
                const GridPoint line{0, grid.at(lattice.y(row), 1), grid.at(lattice.z(column), 2)};
                const bool inside = side_of_edge(corner[0], corner[1], line) == sign_of(whole) &&
                                    side_of_edge(corner[1], corner[2], line) == sign_of(whole) &&
                                    side_of_edge(corner[2], corner[0], line) == sign_of(whole);
                if (!inside) continue;
                double x = 0;
                for (int k = 0; k < 3; ++k)
                    x += place[k].x() * (static_cast<double>(area(corner[(k + 1) % 3], corner[(k + 2) % 3], line, 1, 2)) /
                                         static_cast<double>(whole));
                // A face that goes round from y to z looks to larger x: the line leaves the body there.
                lines[static_cast<std::size_t>(row) * columns + column].push_back({x, whole > 0 ? -1 : 1});
            }
    }
    return lines;
}

/// Numbers of the slices that are inside on one line, ascending; appended to `slices` by row and column.
void add_inside(std::vector<Crossing>& line, const Lattice& lattice, int row, int column, std::vector<int>& inside) {
    std::sort(line.begin(), line.end(),
              [](const Crossing& a, const Crossing& b) { return a.x != b.x ? a.x < b.x : a.step > b.step; });
    int winding = 0;
    const double least = 1e-6 * std::abs(lattice.x(0) - lattice.x(1));
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        winding += line[i].step;
        const double from = line[i].x, to = line[i + 1].x;
        if ((winding < 0 || winding > 1) && to - from > least)
            throw InputError(std::string(winding < 0 ? "has a part whose faces look inwards" : "has a part inside another") +
                             ", at " + shown({(from + to) / 2, lattice.y(row), lattice.z(column)}) +
                             " (forward, up, right); faces must bound one solid");
        if (winding < 1) continue;
        // Slices count against x: those with from <= x < to.
        const int first = static_cast<int>(std::floor(lattice.slice(to))) + 1;
        const int last = static_cast<int>(std::floor(lattice.slice(from)));
        for (int slice = std::max(0, first); slice <= std::min(last, lattice.count().x() - 1); ++slice)
            inside.push_back(slice);
    }
}

/// Columns of each row of each slice, half spacings from the middle: those of the left half, mirrored.
using Sites = std::vector<std::vector<std::vector<int>>>;

Sites symmetric_sites(const TriangleMesh& mesh, const Lattice& lattice) {
    const int rows = lattice.count().y(), columns = lattice.count().z();
    std::vector<std::vector<Crossing>> lines = crossings_of(mesh, lattice);
    Sites sites(static_cast<std::size_t>(lattice.count().x()), std::vector<std::vector<int>>(static_cast<std::size_t>(rows)));
    long particles = 0, different = 0;
    std::vector<int> left, right, both;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns / 2; ++column) {
            left.clear(), right.clear(), both.clear();
            const int mirrored = columns - 1 - column;
            add_inside(lines[static_cast<std::size_t>(row) * columns + column], lattice, row, column, left);
            add_inside(lines[static_cast<std::size_t>(row) * columns + mirrored], lattice, row, mirrored, right);
            std::sort(left.begin(), left.end());
            std::sort(right.begin(), right.end());
            std::set_symmetric_difference(left.begin(), left.end(), right.begin(), right.end(), std::back_inserter(both));
            different += static_cast<long>(both.size());
            particles += 2 * static_cast<long>(left.size());
            if (particles > limits::particles)
                throw InputError("holds more than " + std::to_string(limits::particles) +
                                 " particles at this spacing; see unit and length");
            for (const int slice : left) sites[slice][row].push_back(lattice.from_middle(column));
        }
    if (static_cast<double>(different) > most_asymmetric * static_cast<double>(particles)) {
        std::ostringstream text;
        text << "has different halves to the left and right of " << lattice.middle().z() << ": " << different << " of "
             << particles << " particles have none on the other side; must be at most a tenth, since the left half is mirrored";
        throw InputError(text.str());
    }
    for (auto& slice : sites)
        for (std::vector<int>& row : slice)
            for (std::size_t i = row.size(); i-- > 0;) row.push_back(-row[i]);
    return sites;
}

/// One slice of the rows that have particles; of height 0 without any.
Slice slice_of(const std::vector<std::vector<int>>& rows) {
    Slice slice{0, 0};
    const auto filled = [](const std::vector<int>& row) { return !row.empty(); };
    const auto first = std::find_if(rows.begin(), rows.end(), filled);
    const auto last = std::find_if(rows.rbegin(), rows.rend(), filled).base();
    if (first == rows.end()) return slice;
    slice.columns.assign(first, last);
    slice.height = static_cast<int>(slice.columns.size());
    slice.lift = static_cast<int>((first - rows.begin()) + (last - rows.begin())) - static_cast<int>(rows.size());
    for (const std::vector<int>& row : slice.columns)
        if (!row.empty()) slice.width = std::max(slice.width, row.back() + 1);
    return slice;
}

bool thin(const Slice& slice) {
    return slice.height < 2 || slice.width < 2;
}

void refuse_thin(const Lattice& lattice, std::size_t number, const Slice& slice) {
    std::ostringstream text;
    text << "is thinner than two particles at " << lattice.part(static_cast<double>(number)) << ", "
         << (slice.height == 0 ? "where no particle is inside"
             : slice.height < 2 ? "where one row is inside"
                                : "where one column is inside")
         << "; must be thicker, or the spacing finer";
    throw InputError(text.str());
}

/// The surface is nowhere far from the particles.
void check_reach(const TriangleMesh& mesh, const Lattice& lattice, const Sites& sites) {
    const auto near = [&](const Eigen::Vector3d& at) {
        const double slice = lattice.slice(at.x()), row = lattice.row(at.y()), column = lattice.column(at.z());
        for (int i = static_cast<int>(std::ceil(slice - reach)); i <= slice + reach; ++i)
            for (int k = static_cast<int>(std::ceil(row - reach)); k <= row + reach; ++k) {
                if (i < 0 || k < 0 || i >= lattice.count().x() || k >= lattice.count().y()) continue;
                const double square = reach * reach - (i - slice) * (i - slice) - (k - row) * (k - row);
                if (square < 0) continue;
                const double half = std::sqrt(square);
                const std::vector<int>& columns = sites[i][k];
                const auto found = std::lower_bound(columns.begin(), columns.end(), column - half,
                                                    [&](int z, double from) { return (z + lattice.count().z() - 1) / 2.0 < from; });
                if (found != columns.end() && (*found + lattice.count().z() - 1) / 2.0 <= column + half) return true;
            }
        return false;
    };
    for (const Eigen::Vector3d& vertex : mesh.vertices) {
        if (near(vertex)) continue;
        std::ostringstream text;
        text << "is too thin for particles around " << shown(vertex) << " (forward, up, right), at "
             << lattice.part(lattice.slice(vertex.x())) << ": none is within " << reach
             << " spacings; must be thicker, or the spacing finer";
        throw InputError(text.str());
    }
}

}  // namespace

MeshSlices slice_mesh(const TriangleMesh& mesh, double spacing) {
    const Lattice lattice(mesh, spacing);
    const Sites sites = symmetric_sites(mesh, lattice);
    std::vector<Slice> slices;
    for (const auto& rows : sites) slices.push_back(slice_of(rows));
    std::size_t first = 0, last = slices.size();
    while (first < most_left_out && first < last && thin(slices[first])) ++first;
    while (slices.size() - last < most_left_out && last > first && thin(slices[last - 1])) --last;
    for (std::size_t i = first; i < last; ++i)
        if (thin(slices[i])) refuse_thin(lattice, i, slices[i]);
    if (last - first < 2) throw InputError("holds fewer than two slices of particles; the spacing must be finer");
    check_reach(mesh, lattice, sites);

    MeshSlices result;
    result.slices.assign(slices.begin() + static_cast<long>(first), slices.begin() + static_cast<long>(last));
    result.rear_centre = {lattice.x(static_cast<double>(last) - 1), lattice.middle().y(), lattice.middle().z()};
    result.volume = signed_volume(mesh);
    double particles = 0;
    for (const Slice& slice : result.slices) particles += slice.particles();
    const double volume = particles * spacing * spacing * spacing;
    if (std::abs(volume / result.volume - 1) > most_volume_error) {
        std::ostringstream text;
        text << "is too coarsely sampled: its " << particles << " particles have " << volume / result.volume
             << " of its volume; must be within a quarter of it, by a finer spacing";
        throw InputError(text.str());
    }
    return result;
}

}  // namespace natator
