#include "mesh_slices.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "mesh_lattice.h"
#include "natator/error.h"
#include "natator/limits.h"

namespace natator {
namespace {

constexpr std::size_t max_left_out = 2;  // slices at each tip
constexpr double max_asymmetric = 0.1;   // of the particles
constexpr int reach = 3;                 // spacings from the surface to the next particle

/// Columns of each row of each slice, half spacings from the middle: those of the left half, mirrored.
using Sites = std::vector<std::vector<std::vector<int>>>;

Sites symmetric_sites(const TriangleMesh& mesh, const MeshLattice& lattice) {
    const int rows = lattice.count().y(), columns = lattice.count().z();
    std::vector<std::vector<Crossing>> lines = crossings_of(mesh, lattice);
    Sites sites(static_cast<std::size_t>(lattice.count().x()),
                std::vector<std::vector<int>>(static_cast<std::size_t>(rows)));
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
            std::set_symmetric_difference(left.begin(), left.end(), right.begin(), right.end(),
                                          std::back_inserter(both));
            different += static_cast<long>(both.size());
            particles += 2 * static_cast<long>(left.size());
            if (particles > limits::particles)
                throw InputError("holds more than " + std::to_string(limits::particles) +
                                 " particles at this spacing; see unit and length");
            for (const int slice : left) sites[slice][row].push_back(lattice.from_middle(column));
        }
    if (static_cast<double>(different) > max_asymmetric * static_cast<double>(particles)) {
        std::ostringstream text;
        text << "has different halves to the left and right of " << lattice.middle().z() << ": " << different << " of "
             << particles
             << " particles have none on the other side; must be at most a tenth, since the left half is mirrored";
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

void refuse_thin(const MeshLattice& lattice, std::size_t number, const Slice& slice) {
    std::ostringstream text;
    text << "is thinner than two particles at " << lattice.part(static_cast<double>(number)) << ", "
         << (slice.height == 0  ? "where no particle is inside"
             : slice.height < 2 ? "where one row is inside"
                                : "where one column is inside")
         << "; must be thicker, or the spacing finer";
    throw InputError(text.str());
}

/// The surface is nowhere far from the particles.
void check_reach(const TriangleMesh& mesh, const MeshLattice& lattice, const Sites& sites) {
    const auto near = [&](const Eigen::Vector3d& at) {
        const double slice = lattice.slice(at.x()), row = lattice.row(at.y()), column = lattice.column(at.z());
        for (int i = static_cast<int>(std::ceil(slice - reach)); i <= slice + reach; ++i)
            for (int k = static_cast<int>(std::ceil(row - reach)); k <= row + reach; ++k) {
                if (i < 0 || k < 0 || i >= lattice.count().x() || k >= lattice.count().y()) continue;
                const double square = reach * reach - (i - slice) * (i - slice) - (k - row) * (k - row);
                if (square < 0) continue;
                const double half = std::sqrt(square);
                const std::vector<int>& columns = sites[i][k];
                const auto found =
                    std::lower_bound(columns.begin(), columns.end(), column - half,
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
    const MeshLattice lattice(mesh, spacing);
    const Sites sites = symmetric_sites(mesh, lattice);
    std::vector<Slice> slices;
    for (const auto& rows : sites) slices.push_back(slice_of(rows));
    std::size_t first = 0, last = slices.size();
    while (first < max_left_out && first < last && thin(slices[first])) ++first;
    while (slices.size() - last < max_left_out && last > first && thin(slices[last - 1])) --last;
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
    check_volume(particles, spacing, result.volume);
    return result;
}

}  // namespace natator
