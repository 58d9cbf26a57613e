#include <cstring>

#include "cube_cells.h"
#include "kernels.h"
#include "natator/instruction_set.h"
#include "solver/cpu/aligned.h"
#include "solver/cpu/thread_team.h"
#include "water.h"

namespace natator::lattice {
namespace {

constexpr int moments = physics::lattice_moments;

int padded(int cells) {
    return (cells + margin - 1) / margin * margin;
}

class CpuWater : public Water {
public:
    CpuWater(const Box& box, int threads);

    void advance(const std::vector<Cube>& cubes, double step, std::vector<Push>& pushes) override;
    void shift(const Eigen::Vector3i& by) override;
    Cell cell(const Eigen::Vector3i& at) const override;
    void set_cell(const Eigen::Vector3i& at, const Cell& cell) override;

private:
    using Array = cpu::AlignedVector<float>;
    struct Held {
        long cell;
        int cube;
        float xi[3];
        Velocity3 velocity;
        double gained[3];  ///< in the last step, cells' masses cells/step
    };

    long place(int x, int y, int z) const { return (static_cast<long>(z) * ny_ + y) * stride_ + margin + x; }
    View view();
    void release();
    void hold(const std::vector<Cube>& cubes);
    void tell(const std::vector<Cube>& cubes, std::vector<Push>& pushes);
    static void add(const Held& held, const double (&j)[3], std::vector<Push>& pushes);

    int nx_, ny_, nz_, stride_;
    Array now_[moments], next_[moments], change_[3];
    std::vector<unsigned char> row_changes_;
    std::vector<int> owner_;   ///< by cell: a cube of the last step, -1: none
    std::vector<int> chosen_;  ///< by cell, of this one: place in held_, -1: none
    std::vector<float> out_;   ///< by place in held_
    std::vector<Held> held_;   ///< cells in bodies, by cube
    std::vector<Array> rooms_;
    cpu::ThreadTeam team_;
    bool begun_ = false;  ///< else the water in bodies begins with their velocity
};

CpuWater::CpuWater(const Box& box, int threads)
    : Water(box), nx_(box.cells.x()), ny_(box.cells.y()), nz_(box.cells.z()), stride_(padded(nx_) + 2 * margin), team_(threads) {
    const auto size = static_cast<std::size_t>(stride_) * ny_ * nz_ + margin;
    for (Array& array : now_) array.assign(size, 0);
    for (Array& array : next_) array.assign(size, 0);
    for (Array& array : change_) array.assign(size, 0);
    row_changes_.assign(static_cast<std::size_t>(ny_) * nz_, 0);
    owner_.assign(size, -1);
    chosen_.assign(size, -1);
}

View CpuWater::view() {
    View view{nx_, ny_, nz_, stride_, {}, {}, {}, {}, {}, row_changes_.data()};
    for (int a = 0; a < 3; ++a)
        for (int end = 0; end < 2; ++end) {
            view.bounces[a][end] = box_.faces[a][end] == Face::no_slip;
            view.mirrors[a][end] = box_.faces[a][end] == Face::free_slip;
        }
    for (int e = 0; e < moments; ++e) view.now[e] = now_[e].data(), view.next[e] = next_[e].data();
    for (int a = 0; a < 3; ++a) view.change[a] = change_[a].data();
    return view;
}

/// Nothing is told any more.
void CpuWater::release() {
    for (const Held& held : held_) {
        for (Array& change : change_) change[held.cell] = 0;
        row_changes_[static_cast<std::size_t>(held.cell / stride_)] = 0;
        chosen_[held.cell] = -1;
    }
}

/// Finds the cells in bodies. Of several cubes that hold a cell the one whose middle is nearest has it, of equally near ones the first.
void CpuWater::hold(const std::vector<Cube>& cubes) {
    release();
    held_.clear();
    out_.clear();
    const int cells[3] = {nx_, ny_, nz_};
    for (std::size_t p = 0; p < cubes.size(); ++p) {
        const Cube& cube = cubes[p];
        const CellRange range = cells_around(cube, cells);
        for (int z = range.low[2]; z < range.low[2] + range.count[2]; ++z)
            for (int y = range.low[1]; y < range.low[1] + range.count[1]; ++y)
                for (int x = range.low[0]; x < range.low[0] + range.count[0]; ++x) {
                    const PlaceInCube in = place_in(cube, x, y, z);
                    if (!(in.out <= cube_edge)) continue;
                    const long at = place(x, y, z);
                    if (chosen_[at] < 0) {
                        chosen_[at] = static_cast<int>(held_.size());
                        held_.emplace_back();
                        out_.push_back(in.out);
                    } else if (out_[chosen_[at]] <= in.out) {
                        continue;
                    }
                    held_[chosen_[at]] = {at, static_cast<int>(p), {in.xi[0], in.xi[1], in.xi[2]}, velocity_in(cube, in.xi), {}};
                    out_[chosen_[at]] = in.out;
                }
    }
}

void CpuWater::add(const Held& held, const double (&j)[3], std::vector<Push>& pushes) {
    Push& push = pushes[held.cube];
    for (int a = 0; a < 3; ++a) {
        push.j[a] += j[a];
        for (int b = 0; b < 3; ++b) push.moment[3 * a + b] += j[a] * held.xi[b];
    }
}

/// The cells in bodies are to have these velocities.
void CpuWater::tell(const std::vector<Cube>& cubes, std::vector<Push>& pushes) {
    for (const Held& held : held_) {
        const long at = held.cell;
        now_[0][at] += divergence_of(cubes[held.cube]);
        const float density = 1 + now_[0][at];
        const float by[3] = {held.velocity.x - now_[1][at] / density, held.velocity.y - now_[2][at] / density, held.velocity.z - now_[3][at] / density};
        for (int a = 0; a < 3; ++a) change_[a][at] = by[a];
        row_changes_[static_cast<std::size_t>(at / stride_)] = 1;
        if (begun_ && owner_[at] < 0) add(held, {-density * by[0], -density * by[1], -density * by[2]}, pushes);
    }
}

void CpuWater::advance(const std::vector<Cube>& cubes, double step, std::vector<Push>& pushes) {
    pushes.assign(cubes.size(), {});
    const std::vector<Held> before = held_;
    hold(cubes);
    tell(cubes, pushes);
    for (const Held& held : before) {
        owner_[held.cell] = -1;
        if (chosen_[held.cell] < 0) add(held, {-held.gained[0], -held.gained[1], -held.gained[2]}, pushes);  // it keeps that
    }
    for (const Held& held : held_) owner_[held.cell] = held.cube;
    begun_ = true;

    const physics::LatticeRates rates = physics::lattice_rates(box_.viscosity * step / (box_.cell * box_.cell));
    const View lattice = view();
    const auto& kernel = kernels<float>(instruction_set());
    rooms_.resize(static_cast<std::size_t>(team_.most_parts()));
    const std::size_t room = std::size_t{3} * physics::lattice_populations * ny_ * stride_ + 2 * margin;
    team_.for_parts(nz_, 4, [&](int part, int begin, int end) {
        Array& own = rooms_[static_cast<std::size_t>(part)];
        if (own.empty()) own.assign(room, 0);
        kernel.advance(lattice, rates, begin, end, own.data());
    });
    for (int e = 0; e < moments; ++e) std::swap(now_[e], next_[e]);

    for (Held& held : held_) {
        const long at = held.cell;
        const float density = 1 + now_[0][at];
        const Velocity3& u = held.velocity;
        const Velocity3 on = advected_in(cubes[held.cube], u);
        held.gained[0] = now_[1][at] - density * (u.x - on.x);
        held.gained[1] = now_[2][at] - density * (u.y - on.y);
        held.gained[2] = now_[3][at] - density * (u.z - on.z);
        add(held, held.gained, pushes);
    }
}

void CpuWater::shift(const Eigen::Vector3i& by) {
    const Eigen::Vector3i size = box_.cells;
    const auto inside = [&](const Eigen::Vector3i& c) { return (c.array() >= 0).all() && (c.array() < size.array()).all(); };
    const auto moved = [&](auto& array, auto empty) {
        auto old = array;
        for (int z = 0; z < nz_; ++z)
            for (int y = 0; y < ny_; ++y)
                for (int x = 0; x < nx_; ++x) {
                    const Eigen::Vector3i from = Eigen::Vector3i(x, y, z) + by;
                    array[place(x, y, z)] = inside(from) ? old[place(from.x(), from.y(), from.z())] : empty;
                }
    };
    for (Array& array : now_) moved(array, 0.0f);
    moved(owner_, -1);
    release();
    std::vector<Held> here;
    for (Held& held : held_) {
        const int row = static_cast<int>(held.cell / stride_);
        const Eigen::Vector3i to = Eigen::Vector3i(static_cast<int>(held.cell % stride_) - margin, row % ny_, row / ny_) - by;
        if (!inside(to)) continue;
        held.cell = place(to.x(), to.y(), to.z());
        here.push_back(held);
    }
    held_ = here;
}

Cell CpuWater::cell(const Eigen::Vector3i& at) const {
    const long i = place(at.x(), at.y(), at.z());
    return {now_[0][i], Eigen::Vector3d(now_[1][i], now_[2][i], now_[3][i]) / (1 + now_[0][i])};
}

void CpuWater::set_cell(const Eigen::Vector3i& at, const Cell& cell) {
    const long i = place(at.x(), at.y(), at.z());
    float values[moments];
    equilibrium(cell, values);
    for (int e = 0; e < moments; ++e) now_[e][i] = values[e];
}

}  // namespace

std::unique_ptr<Water> Water::on_cpu(const Box& box, int threads) {
    return std::make_unique<CpuWater>(box, threads);
}

}  // namespace natator::lattice
