#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "cube_cells.h"
#include "kernels.h"
#include "natator/instruction_set.h"
#include "solver/cpu/aligned.h"
#include "solver/cpu/thread_team.h"
#include "water.h"

namespace natator::lattice {
namespace {

constexpr int moments = physics::lattice_moments;

/// By population, where it goes in a step; a zero more.
constexpr auto directions = [] {
    std::array<std::array<float, 4>, physics::lattice_populations> all{};
    for (int i = 0; i < physics::lattice_populations; ++i) {
        const int x = i % 3 - 1, y = i / 3 % 3 - 1, z = i / 9 - 1;
        all[i] = {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), 0};
    }
    return all;
}();

int padded(int cells) {
    return (cells + margin - 1) / margin * margin;
}

/// Rows along y that are advanced at once: as many as leave what is between collision and streaming in a core's second
/// cache, shared out evenly. The two beside them collide again.
int rows_at_once(int ny, int stride) {
    constexpr long most = 800'000;  // bytes
    const long row = 3L * physics::lattice_populations * stride * static_cast<long>(sizeof(float));
    const int fit = static_cast<int>(std::clamp<long>(most / row - 2, std::min(ny, 4), ny));
    const int strips = (ny + fit - 1) / fit;
    return (ny + strips - 1) / strips;
}

/// The least planes of a part.
constexpr int least_planes = 4;

/// Rows in the room of a part of so many planes (Kernels::advance).
double rows_of_room(int rows, int ny, double planes) {
    return 3.0 * physics::lattice_populations * (rows + 2) + 2.0 * moments * (ny + (rows < ny ? planes : 0));
}

/// A number of each cell. Arrays begin at other places of a page, by `skew` lines of a cache: the same cell of all of
/// them would else be in the same few lines of a cache, which has not so many.
class PerCell {
public:
    void assign(std::size_t cells, int skew) {
        begin_ = static_cast<long>(skew) * margin;  // 16 numbers, 64 bytes
        all_.assign(cells + static_cast<std::size_t>(begin_), 0);
    }
    float* data() { return all_.data() + begin_; }
    float& operator[](long cell) { return all_[begin_ + cell]; }
    const float& operator[](long cell) const { return all_[begin_ + cell]; }

private:
    cpu::AlignedVector<float> all_;
    long begin_ = 0;
};

class CpuWater : public Water {
public:
    CpuWater(const Box& box, int threads);

    void advance(const std::vector<Cube>& cubes, double step, std::vector<Push>& pushes) override;
    void shift(const Eigen::Vector3i& by) override;
    Cell cell(const Eigen::Vector3i& at) const override;
    std::vector<Eigen::Vector4f> cells() const override;
    void set_cell(const Eigen::Vector3i& at, const Cell& cell) override;
    void set_cells(const Cell& all) override;
    void save(ByteWriter& to) const override;
    void restore(ByteReader from) override;

private:
    using Array = cpu::AlignedVector<float>;
    struct BodyCell {
        long cell;
        int cube;
        float xi[3];
        Velocity3 velocity;
        int x, y, z;
    };

    template <class Row>
    void for_each_row(const Row& row) const {
        for (int e = 0; e < moments; ++e)
            for (int z = 0; z < cells_[2]; ++z)
                for (int y = 0; y < cells_[1]; ++y) row(e, place(0, y, z));
    }
    long place(int x, int y, int z) const { return (static_cast<long>(z) * cells_[1] + y) * stride_ + margin + x; }
    /// Whether some of a cell's neighbours are beyond an end; along y there are none in plane flow.
    bool is_at_end(const int (&cell)[3]) const {
        bool is = false;
        for (int a = 0; a < 3; ++a)
            is = is || (cells_[a] > 1 || a == 0 ? cell[a] == 0 || cell[a] == cells_[a] - 1 : !periodic_[a]);
        return is;
    }
    View view();
    void let_in(double step);
    void hold(const std::vector<Cube>& cubes);
    void update_bodies(const std::vector<Cube>& cubes, std::vector<Push>& pushes);
    void transfer_surplus(const BodyCell& held, const std::array<float, 3>& surplus, std::vector<Push>& pushes);
    void release(const std::vector<Cube>& cubes, std::vector<Push>& pushes);
    void remember();
    void cells_beside(const BodyCell& held, long (&to)[physics::lattice_populations]) const;
    int place_to_collide(long cell);
    void find_surface();
    void exchange(const View& lattice, const Kernels<float>& kernel, const physics::LatticeRates& rates,
                  std::vector<Push>& pushes);
    static void add(const BodyCell& held, double x, double y, double z, std::vector<Push>& pushes);

    int cells_[3], stride_;
    PerCell now_[moments];
    Array change_[3];
    std::vector<unsigned char> row_changes_;
    std::vector<int> owner_;  ///< by cell: the cube that held it in the last step, -1: none
    struct Owned {
        long cell;
        int x, y, z;
    };
    std::vector<Owned> owned_;    ///< those cells
    std::vector<int> chosen_;     ///< by cell, of this one: place in held_, -1: none
    std::vector<float> out_;      ///< by place in held_
    std::vector<BodyCell> held_;  ///< cells in bodies, by cube
    bool periodic_[3];
    Array inflow_[physics::lattice_populations];  ///< rows of what comes in at open ends, if there are any
    double step_let_in_ = 0;                      ///< for which these were made, s
    /// A body's cell with water beside it.
    struct Surface {
        const BodyCell* held;
        int own;        ///< its place in to_collide_
        unsigned from;  ///< a bit of each population that comes from water; the places of those are next in sources_
    };
    std::vector<Surface> surface_;
    std::vector<int> sources_;
    std::vector<long> to_collide_;  ///< the cells whose populations after collision push bodies
    std::vector<int> collided_of_;  ///< by cell: place in to_collide_, -1: none
    std::vector<float> collided_;   ///< those populations, as the kernel lays them out
    std::vector<Array> rooms_;
    cpu::ThreadTeam team_;
    long beside_[physics::lattice_populations];  ///< from a cell to where each population streams to, but at ends
    bool begun_ = false;                         ///< else the water in bodies begins with their velocity
};

CpuWater::CpuWater(const Box& box, int threads)
    : Water(box),
      cells_{box.cells.x(), box.cells.y(), box.cells.z()},
      stride_(padded(cells_[0]) + 2 * margin),
      team_(threads) {
    const auto size = static_cast<std::size_t>(stride_) * cells_[1] * cells_[2] + margin;
    for (int i = 0; i < physics::lattice_populations; ++i)
        beside_[i] = i % 3 - 1 +
                     stride_ * ((cells_[1] > 1 ? i / 3 % 3 - 1 : 0) +
                                static_cast<long>(cells_[1]) * (cells_[2] > 1 ? i / 9 - 1 : 0));
    for (int e = 0; e < moments; ++e) now_[e].assign(size, e);
    for (Array& array : change_) array.assign(size, 0);
    row_changes_.assign(static_cast<std::size_t>(cells_[1]) * cells_[2], 0);
    owner_.assign(size, -1);
    chosen_.assign(size, -1);
    collided_of_.assign(size, -1);
    for (int a = 0; a < 3; ++a) periodic_[a] = box.faces[a][0] == Face::periodic;
}

View CpuWater::view() {
    View view{};
    view.nx = cells_[0], view.ny = cells_[1], view.nz = cells_[2], view.stride = stride_;
    view.rows = rows_at_once(cells_[1], stride_);
    view.row_changes = row_changes_.data();
    for (int a = 0; a < 3; ++a)
        for (int end = 0; end < 2; ++end) {
            view.bounces[a][end] = box_.faces[a][end] == Face::no_slip;
            view.mirrors[a][end] = box_.faces[a][end] == Face::free_slip;
            view.opens[a][end] = box_.faces[a][end] == Face::open;
        }
    for (int i = 0; i < physics::lattice_populations; ++i) view.inflow[i] = inflow_[i].data();
    for (int e = 0; e < moments; ++e) view.now[e] = now_[e].data();
    for (int a = 0; a < 3; ++a) view.change[a] = change_[a].data();
    return view;
}

/// The rows change with the step alone.
void CpuWater::let_in(double step) {
    if (std::exchange(step_let_in_, step) == step) return;
    const Populations populations = inflow(box_, step);
    for (int i = 0; i < physics::lattice_populations; ++i)
        inflow_[i].assign(static_cast<std::size_t>(stride_), populations.of[i]);
}

/// Finds the cells in bodies. Of several cubes that hold a cell the one whose middle is nearest has it, of equally near
/// ones the first.
void CpuWater::hold(const std::vector<Cube>& cubes) {
    for (const BodyCell& held : held_) {
        for (Array& change : change_) change[held.cell] = 0;
        row_changes_[static_cast<std::size_t>(held.cell / stride_)] = 0;
        chosen_[held.cell] = -1;
    }
    held_.clear();
    out_.clear();
    for (std::size_t p = 0; p < cubes.size(); ++p) {
        const Cube& cube = cubes[p];
        const CellRange range = cells_around(cube, cells_, periodic_);
        for (int z = range.low[2]; z < range.low[2] + range.count[2]; ++z)
            for (int y = range.low[1]; y < range.low[1] + range.count[1]; ++y)
                for (int x = range.low[0]; x < range.low[0] + range.count[0]; ++x) {
                    const PlaceInCube in = place_in(cube, x, y, z);
                    if (!(in.out <= cube.edge)) continue;
                    const int inside[3] = {wrapped(x, cells_[0]), wrapped(y, cells_[1]), wrapped(z, cells_[2])};
                    const long at = place(inside[0], inside[1], inside[2]);
                    if (chosen_[at] < 0) {
                        chosen_[at] = static_cast<int>(held_.size());
                        held_.emplace_back();
                        out_.push_back(in.out);
                    } else if (out_[chosen_[at]] <= in.out) {
                        continue;
                    }
                    held_[chosen_[at]] = {at,
                                          static_cast<int>(p),
                                          {in.xi[0], in.xi[1], in.xi[2]},
                                          velocity_in(cube, in.xi),
                                          inside[0],
                                          inside[1],
                                          inside[2]};
                    out_[chosen_[at]] = in.out;
                }
    }
}

void CpuWater::add(const BodyCell& held, double x, double y, double z, std::vector<Push>& pushes) {
    Push& push = pushes[held.cube];
    const double j[3] = {x, y, z};
    for (int a = 0; a < 3; ++a) {
        push.j[a] += j[a];
        for (int b = 0; b < 3; ++b) push.moment[3 * a + b] += j[a] * held.xi[b];
    }
}

/// The cells that populations stream to from a body's; that itself where there is none but beyond a periodic end.
void CpuWater::cells_beside(const BodyCell& held, long (&to)[physics::lattice_populations]) const {
    const int here[3] = {held.x, held.y, held.z};
    const bool at_end = is_at_end(here);
    for (int i = 0; i < physics::lattice_populations; ++i) {
        int cell[3];
        to[i] = !at_end                                       ? held.cell + beside_[i]
                : neighbour(i, here, cells_, periodic_, cell) ? place(cell[0], cell[1], cell[2])
                                                              : held.cell;
    }
}

/// The cells in bodies are to have these velocities. What those that a body comes to cover have more than it goes to
/// the body and the water beside them.
void CpuWater::update_bodies(const std::vector<Cube>& cubes, std::vector<Push>& pushes) {
    for (const BodyCell& held : held_) {
        const long at = held.cell;
        now_[0][at] += divergence_of(cubes[held.cube]);
        const float density = 1 + now_[0][at];
        const float by[3] = {held.velocity.x - now_[1][at] / density, held.velocity.y - now_[2][at] / density,
                             held.velocity.z - now_[3][at] / density};
        for (int a = 0; a < 3; ++a) change_[a][at] = by[a];
        row_changes_[static_cast<std::size_t>(at / stride_)] = 1;
        if (begun_ && owner_[at] < 0)
            transfer_surplus(held, {-density * by[0], -density * by[1], -density * by[2]}, pushes);
    }
}

/// Shares a covered cell's surplus between the body and the water beside it; the body gets all where there is none.
void CpuWater::transfer_surplus(const BodyCell& held, const std::array<float, 3>& surplus, std::vector<Push>& pushes) {
    long beside[physics::lattice_populations];
    cells_beside(held, beside);
    float sum = 0;
    for (int i = 0; i < physics::lattice_populations; ++i)
        if (chosen_[beside[i]] < 0) sum += neighbour_weight(i);
    const float to_body = sum == 0 ? 1 : covered_share, to_water = sum == 0 ? 0 : (1 - covered_share) / sum;
    add(held, to_body * surplus[0], to_body * surplus[1], to_body * surplus[2], pushes);
    for (int i = 0; i < physics::lattice_populations; ++i)
        for (int a = 0; a < 3 && chosen_[beside[i]] < 0; ++a)
            now_[1 + a][beside[i]] += neighbour_weight(i) * (surplus[a] * to_water);
}

/// Cells that a body has left keep what they have more than it, which it was given.
void CpuWater::release(const std::vector<Cube>& cubes, std::vector<Push>& pushes) {
    for (const Owned& one : owned_) {
        if (chosen_[one.cell] >= 0) continue;
        const int p = std::exchange(owner_[one.cell], -1);
        if (p >= static_cast<int>(cubes.size())) continue;
        const int at[3] = {one.x, one.y, one.z};
        int here[3];
        bool near = true;  // a body that has been put elsewhere is not pushed by what it left
        for (int a = 0; a < 3; ++a) {
            here[a] = nearest_copy(cubes[p].x[a], at[a], cells_[a], periodic_[a]);
            near = near && std::abs(static_cast<float>(here[a]) - cubes[p].x[a]) <= cubes[p].reach[a] + 1;
        }
        if (!near) continue;
        const PlaceInCube in = place_in(cubes[p], here[0], here[1], here[2]);
        const BodyCell left{one.cell, p,    {in.xi[0], in.xi[1], in.xi[2]}, velocity_in(cubes[p], in.xi), one.x,
                            one.y,    one.z};
        const float density = 1 + now_[0][one.cell];
        add(left, density * left.velocity.x - now_[1][one.cell], density * left.velocity.y - now_[2][one.cell],
            density * left.velocity.z - now_[3][one.cell], pushes);
    }
}

void CpuWater::remember() {
    owned_.clear();
    for (const BodyCell& held : held_) {
        owner_[held.cell] = held.cube;
        owned_.push_back({held.cell, held.x, held.y, held.z});
    }
}

void CpuWater::advance(const std::vector<Cube>& cubes, double step, std::vector<Push>& pushes) {
    pushes.assign(cubes.size(), {});
    hold(cubes);
    release(cubes, pushes);
    update_bodies(cubes, pushes);
    remember();
    begun_ = true;

    const physics::LatticeRates rates = rates_in(box_, step);
    if (!box_.current.isZero(0)) let_in(step);
    const View lattice = view();
    const auto& kernel = kernels<float>(instruction_set());
    exchange(lattice, kernel, rates, pushes);
    rooms_.resize(static_cast<std::size_t>(team_.max_parts()));
    const auto for_parts = [&](const auto& work) {
        team_.for_parts(cells_[2], least_planes, [&](int part, int begin, int end) {
            Array& room = rooms_[static_cast<std::size_t>(part)];
            if (room.empty())
                room.assign(
                    static_cast<std::size_t>(rows_of_room(lattice.rows, cells_[1], end - begin)) * stride_ + 2 * margin,
                    0);
            work(begin, end, room.data());
        });
    };
    for_parts([&](int begin, int end, float* room) { kernel.keep(lattice, begin, end, room); });
    for_parts([&](int begin, int end, float* room) { kernel.advance(lattice, rates, begin, end, room); });
}

/// A cell's place among those whose populations after collision push bodies.
int CpuWater::place_to_collide(long cell) {
    int& place = collided_of_[cell];
    if (place < 0) {
        to_collide_.push_back(cell);
        place = static_cast<int>(to_collide_.size()) - 1;
    }
    return place;
}

/// Finds what streams between bodies and water in a step.
void CpuWater::find_surface() {
    for (const long cell : to_collide_) collided_of_[cell] = -1;
    to_collide_.clear();
    surface_.clear();
    sources_.clear();
    for (const BodyCell& held : held_) {
        long beside[physics::lattice_populations];
        cells_beside(held, beside);
        unsigned from = 0;
        for (int i = 0; i < physics::lattice_populations; ++i)
            from |= static_cast<unsigned>(chosen_[beside[physics::lattice_populations - 1 - i]] < 0) << i;
        if (from == 0) continue;
        surface_.push_back({&held, place_to_collide(held.cell), from});
        for (; from != 0; from &= from - 1)
            sources_.push_back(place_to_collide(beside[physics::lattice_populations - 1 - std::countr_zero(from)]));
    }
}

/// Pushes bodies by what streams between their cells and cells of water in this step.
void CpuWater::exchange(const View& lattice, const Kernels<float>& kernel, const physics::LatticeRates& rates,
                        std::vector<Push>& pushes) {
    constexpr int populations = physics::lattice_populations;
    find_surface();
    const std::size_t blocks = (to_collide_.size() + margin - 1) / margin;
    if (collided_.size() < blocks * margin * populations) collided_.resize(blocks * margin * populations);
    kernel.collide(lattice, rates, to_collide_.data(), static_cast<long>(to_collide_.size()), collided_.data());
    const auto collided = [&](int place, int i) {
        return collided_[(static_cast<long>(place) / margin * populations + i) * margin + place % margin];
    };
    const int* source = sources_.data();
    for (const Surface& one : surface_) {
        const float u[3] = {one.held->velocity.x, one.held->velocity.y, one.held->velocity.z};
        float moving[populations];
        physics::moving_populations(u, moving);
        const Eigen::Array4f velocity(u[0], u[1], u[2], 0);
        Eigen::Array4d j = Eigen::Array4d::Zero();
        for (unsigned from = one.from; from != 0; from &= from - 1) {
            const int i = std::countr_zero(from), opposite = populations - 1 - i;
            const float in = collided(*source++, i) - moving[i];
            const float out = collided(one.own, opposite) - moving[opposite];
            const Eigen::Array4f c = Eigen::Array4f::Map(directions[i].data());
            j += physics::link_push(in, out, c, velocity).cast<double>();
        }
        add(*one.held, j[0], j[1], j[2], pushes);
    }
}

void CpuWater::shift(const Eigen::Vector3i& by) {
    const Eigen::Vector3i size = box_.cells;
    const auto inside = [&](const Eigen::Vector3i& c) {
        return (c.array() >= 0).all() && (c.array() < size.array()).all();
    };
    // In place: in the order in which no cell is taken from that was given to.
    const auto each = [](int cells, int step, const auto& work) {
        for (int k = 0; k < cells; ++k) work(step < 0 ? cells - 1 - k : k);
    };
    for (PerCell& array : now_)
        each(cells_[2], by.z(), [&](int z) {
            each(cells_[1], by.y(), [&](int y) {
                each(cells_[0], by.x(), [&](int x) {
                    const Eigen::Vector3i from = Eigen::Vector3i(x, y, z) + by;
                    array[place(x, y, z)] = inside(from) ? array[place(from.x(), from.y(), from.z())] : 0;
                });
            });
        });
    std::vector<Owned> moved;
    std::vector<int> owners;
    for (const Owned& one : owned_) {
        const int owner = std::exchange(owner_[one.cell], -1);
        const Eigen::Vector3i to = Eigen::Vector3i(one.x, one.y, one.z) - by;
        if (!inside(to)) continue;
        moved.push_back({place(to.x(), to.y(), to.z()), to.x(), to.y(), to.z()});
        owners.push_back(owner);
    }
    owned_ = moved;
    for (std::size_t k = 0; k < owned_.size(); ++k) owner_[owned_[k].cell] = owners[k];
}

Cell CpuWater::cell(const Eigen::Vector3i& at) const {
    const long i = place(at.x(), at.y(), at.z());
    return {now_[0][i], Eigen::Vector3d(now_[1][i], now_[2][i], now_[3][i]) / (1 + now_[0][i])};
}

std::vector<Eigen::Vector4f> CpuWater::cells() const {
    std::vector<Eigen::Vector4f> all;
    all.reserve(box_.cells.cast<std::size_t>().prod());
    for (int z = 0; z < box_.cells.z(); ++z)
        for (int y = 0; y < box_.cells.y(); ++y)
            for (int x = 0; x < box_.cells.x(); ++x) {
                const long i = place(x, y, z);
                const float density = 1 + now_[0][i];
                all.emplace_back(density, now_[1][i] / density, now_[2][i] / density, now_[3][i] / density);
            }
    return all;
}

void CpuWater::set_cell(const Eigen::Vector3i& at, const Cell& cell) {
    const long i = place(at.x(), at.y(), at.z());
    float values[moments];
    equilibrium(cell, values);
    for (int e = 0; e < moments; ++e) now_[e][i] = values[e];
}

void CpuWater::set_cells(const Cell& all) {
    float values[moments];
    equilibrium(all, values);
    for_each_row([&](int e, long at) { std::fill_n(&now_[e][at], cells_[0], values[e]); });
}

void CpuWater::save(ByteWriter& to) const {
    to.add(moments);
    to.add(begun_);
    to.add(owned_.size());
    for (const Owned& one : owned_) to.add(Eigen::Vector4i(one.x, one.y, one.z, owner_[one.cell]));
    const auto width = static_cast<std::size_t>(cells_[0]);
    for_each_row([&](int e, long at) { to.add_all(std::span<const float>(&now_[e][at], width)); });
}

void CpuWater::restore(ByteReader from) {
    int kind = 0;
    bool begun = false;
    std::size_t count = 0;
    from.read(kind);
    if (kind != moments) refuse_saved();
    from.read(begun);
    from.read(count);
    const Eigen::Map<const Eigen::Array3i> size(cells_);
    std::vector<Owned> owned;
    std::vector<int> owners;
    for (std::size_t k = 0; k < count; ++k) {
        Eigen::Vector4i one;
        from.read(one);
        if ((one.head<3>().array() < 0).any() || (one.head<3>().array() >= size).any() || one[3] < 0) refuse_saved();
        owned.push_back({place(one[0], one[1], one[2]), one[0], one[1], one[2]});
        owners.push_back(one[3]);
    }
    const std::size_t row = sizeof(float) * static_cast<std::size_t>(cells_[0]);
    if (from.left().size() != row * moments * cells_[1] * cells_[2]) refuse_saved();
    const std::string_view values = from.left();
    bool finite = true;
    for (std::size_t at = 0; at < values.size(); at += sizeof(float)) {
        float value = 0;
        std::memcpy(&value, values.data() + at, sizeof value);
        finite &= std::isfinite(value);
    }
    if (!finite) refuse_saved();
    begun_ = begun;
    for (const Owned& one : owned_) owner_[one.cell] = -1;
    owned_ = std::move(owned);
    for (std::size_t k = 0; k < owned_.size(); ++k) owner_[owned_[k].cell] = owners[k];
    for_each_row([&](int e, long at) { std::memcpy(&now_[e][at], from.take(row).data(), row); });
}

}  // namespace

double Water::bytes_on_cpu(const Eigen::Vector3i& cells, bool several_threads) {
    constexpr double per_cell = moments + 3 + 3;  // numbers: moments, a change of the velocity, whose it is
    const int stride = padded(cells.x()) + 2 * margin, rows = rows_at_once(cells.y(), stride);
    const int parts = several_threads ? std::max(1, cells.z() / least_planes) : 1;
    const double rooms = parts * rows_of_room(rows, cells.y(), cells.z() / static_cast<double>(parts));
    return sizeof(float) * stride * (per_cell * cells.y() * cells.z() + rooms);
}

std::unique_ptr<Water> Water::on_cpu(const Box& box, int threads) {
    return std::make_unique<CpuWater>(box, threads);
}

}  // namespace natator::lattice
