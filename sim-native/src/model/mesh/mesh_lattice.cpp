#include "mesh_lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "natator/error.h"

namespace natator {
namespace {

constexpr double max_across = 1000;  // spacings
constexpr double max_volume_error = 0.25;

/// On which side of the line from a to b a point of the plane (y, z) is, moved by an infinitesimal amount along y and
/// by one that is infinitesimal even to that along z: never on it, unless a = b.
int side_of_edge(const GridPoint& a, const GridPoint& b, const GridPoint& point) {
    if (const int side = sign_of(area(a, b, point, 1, 2))) return side;
    if (const int side = sign_of(Wide{a.z() - b.z()})) return side;
    return sign_of(Wide{b.y() - a.y()});
}

}  // namespace

MeshLattice::MeshLattice(const TriangleMesh& mesh, double spacing) : grid_(mesh.vertices), spacing_(spacing) {
    const Eigen::Vector3d extent = grid_.high() - grid_.low();
    for (int axis = 0; axis < 3; ++axis) {
        const double across = extent[axis] / spacing;
        if (across >= (axis == 0 ? 2 : 1.5) && across <= max_across) continue;
        std::ostringstream text;
        text << (axis == 0   ? "is "
                 : axis == 1 ? "is high "
                             : "is wide ")
             << across << " spacings" << (axis == 0 ? " long" : "") << ", " << extent[axis] << " units of the file of "
             << spacing << " to a spacing; must be " << (axis == 0 ? "2" : "1.5, which is two particles across,")
             << " to " << max_across << ": see unit and length";
        throw InputError(text.str());
    }
    count_ = (extent / spacing).array().round().max(1).cast<int>();
    count_.z() =
        2 * static_cast<int>(std::lround(extent.z() / spacing / 2 + 0.5));  // on both sides, with room to spare
    middle_ = (grid_.low() + grid_.high()) / 2;
}

std::string MeshLattice::part(double slice) const {
    std::ostringstream text;
    text << (slice + 0.5) / count_.x() << " of the length";
    return text.str();
}

std::vector<std::vector<Crossing>> crossings_of(const TriangleMesh& mesh, const MeshLattice& lattice) {
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
                    x += place[k].x() *
                         (static_cast<double>(area(corner[(k + 1) % 3], corner[(k + 2) % 3], line, 1, 2)) /
                          static_cast<double>(whole));
                // A face that goes round from y to z looks to larger x: the line leaves the body there.
                lines[static_cast<std::size_t>(row) * columns + column].push_back({x, whole > 0 ? -1 : 1});
            }
    }
    return lines;
}

void add_inside(std::vector<Crossing>& line, const MeshLattice& lattice, int row, int column,
                std::vector<int>& inside) {
    std::sort(line.begin(), line.end(),
              [](const Crossing& a, const Crossing& b) { return a.x != b.x ? a.x < b.x : a.step > b.step; });
    int winding = 0;
    const double least = 1e-6 * std::abs(lattice.x(0) - lattice.x(1));
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        winding += line[i].step;
        const double from = line[i].x, to = line[i + 1].x;
        if ((winding < 0 || winding > 1) && to - from > least)
            throw InputError(
                std::string(winding < 0 ? "has a part whose faces look inwards" : "has a part inside another") +
                ", at " + shown(Eigen::Vector3d((from + to) / 2, lattice.y(row), lattice.z(column))) +
                " (forward, up, right); faces must bound one solid");
        if (winding < 1) continue;
        // Slices count against x: those with from <= x < to.
        const int first = static_cast<int>(std::floor(lattice.slice(to))) + 1;
        const int last = static_cast<int>(std::floor(lattice.slice(from)));
        for (int slice = std::max(0, first); slice <= std::min(last, lattice.count().x() - 1); ++slice)
            inside.push_back(slice);
    }
}

void check_volume(double particles, double spacing, double volume) {
    const double sampled = particles * spacing * spacing * spacing;
    if (std::abs(sampled / volume - 1) <= max_volume_error) return;
    std::ostringstream text;
    text << "is too coarsely sampled: its " << particles << " particles have " << sampled / volume
         << " of its volume; must be within a quarter of it, by a finer spacing";
    throw InputError(text.str());
}

}  // namespace natator
