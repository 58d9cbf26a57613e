#include "gpu_water.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "physics/lattice.h"

namespace natator::lattice {
namespace {

using namespace physics;

constexpr int block = 128, range_block = 256, warp = 32;  ///< threads
constexpr unsigned cells_of_thread = 4;                   ///< among which it looks for those that bodies have

constexpr Key nobody = ~Key{0};
constexpr int kind_of_saved = 2;  // on a CPU there are moments, before this there were populations that had come

/// A water as the kernels of a step take it.
struct Step {
    const Lattice& lattice;
    const WaterOnGpu& water;

    __device__ Step(const LatticeStep& of_all, const WaterOnGpu* waters)
        : lattice(of_all.lattice), water(waters[blockIdx.y]) {}
    __device__ const float* from() const { return water.populations[(water.steps - 1) % 2]; }
    __device__ float* to() const { return water.populations[water.steps % 2]; }
    __device__ bool begun() const { return water.steps > 1; }
    /// Of a cell around the cubes, now and before; along periodic axes all are; else null.
    __device__ Key* key_of(int x, int y, int z) const {
        const CellRange& around = water.around;
        const int a = x - around.low[0], b = y - around.low[1], c = z - around.low[2];
        if (a < 0 || b < 0 || c < 0 || a >= around.count[0] || b >= around.count[1] || c >= around.count[2])
            return nullptr;
        return water.keys + lattice.at(x, y, z);
    }
    __device__ Handover& handover(const Key& key) const { return water.handovers[&key - water.keys]; }
};
__device__ int cube_of(Key key) {
    return static_cast<int>(key);
}

/// The range of cells from the least to the greatest of both.
__device__ CellRange together(const CellRange& a, const CellRange& b) {
    if (a.size() == 0) return b;
    if (b.size() == 0) return a;
    CellRange both = a;
    for (int k = 0; k < 3; ++k) {
        both.low[k] = min(a.low[k], b.low[k]);
        both.count[k] = max(a.low[k] + a.count[k], b.low[k] + b.count[k]) - both.low[k];
    }
    return both;
}

/// Counts the step and finds the cells around the cubes. A block a water.
__global__ void __launch_bounds__(range_block)
    begin_step(const __grid_constant__ LatticeStep step, WaterOnGpu* waters) {
    WaterOnGpu& water = waters[blockIdx.y];
    if (!water.goes_on) return;
    constexpr float far = std::numeric_limits<float>::infinity();
    __shared__ float ends[6][range_block];  // the least, then the greatest negated
    for (auto& end : ends) end[threadIdx.x] = far;
    for (int p = static_cast<int>(threadIdx.x); p < step.cubes; p += range_block) {
        const Cube& cube = water.cubes[p];
        for (int a = 0; a < 3; ++a) {
            ends[a][threadIdx.x] = fminf(ends[a][threadIdx.x], cube.x[a] - cube.reach[a]);
            ends[3 + a][threadIdx.x] = fminf(ends[3 + a][threadIdx.x], -(cube.x[a] + cube.reach[a]));
        }
    }
    for (unsigned half = range_block / 2; half > 0; half /= 2) {
        __syncthreads();
        if (threadIdx.x < half)
            for (auto& end : ends) end[threadIdx.x] = fminf(end[threadIdx.x], end[threadIdx.x + half]);
    }
    if (threadIdx.x != 0) return;
    Cube whole{};
    for (int a = 0; a < 3; ++a) {
        const float low = ends[a][0], high = -ends[3 + a][0];
        whole.x[a] = (low + high) / 2;
        whole.reach[a] = (high - low) / 2 + 1;
    }
    const bool none[3] = {};
    CellRange own{};
    if (step.cubes > 0) {
        own = cells_around(whole, step.lattice.cells, none);
        for (int a = 0; a < 3; ++a)
            if (step.lattice.periodic[a]) own.low[a] = 0, own.count[a] = step.lattice.cells[a];
        if (own.size() == 0) own = {};
    }
    water.around = together(own, water.last);
    water.last = own;
    ++water.steps;
}

/// Does something with those of the cells around the cubes, now and before, that are wanted: work(place) where
/// wanted(cell). They are few, so a block looks for them among some cells, then its first threads have one each: whole
/// warps.
template <class Wanted, class Work>
__device__ void each_cell_around(const Step& step, const Wanted& wanted, const Work& work) {
    constexpr unsigned of_block = cells_of_thread * block;
    __shared__ unsigned chosen[of_block], count;
    const CellRange& range = step.water.around;
    const auto size = static_cast<unsigned>(range.size());
    for (unsigned first = blockIdx.x * of_block; first < size; first += gridDim.x * of_block) {
        if (threadIdx.x == 0) count = 0;
        __syncthreads();
        bool is_wanted[cells_of_thread];
#pragma unroll
        for (unsigned k = 0; k < cells_of_thread; ++k) {
            const unsigned number = first + k * block + threadIdx.x;
            int x[3];
            range.place(min(number, size - 1), x);
            is_wanted[k] = number < size && wanted(step.lattice.at(x[0], x[1], x[2]));
        }
#pragma unroll
        for (unsigned k = 0; k < cells_of_thread; ++k)
            if (is_wanted[k]) chosen[atomicAdd(&count, 1u)] = first + k * block + threadIdx.x;
        __syncthreads();
        for (unsigned k = threadIdx.x; k < count; k += block) {
            int x[3];
            range.place(chosen[k], x);
            work(x);
        }
        __syncthreads();
    }
}

/// A cell as a cube sees it, the nearest of its copies beyond periodic ends.
struct CellInCube {
    int at[3];
    PlaceInCube in;
    Velocity3 velocity;  ///< of the body there

    __device__ CellInCube(const Lattice& lattice, const Cube& cube, const int (&place)[3]) {
        for (int a = 0; a < 3; ++a) at[a] = nearest_copy(cube.x[a], place[a], lattice.cells[a], lattice.periodic[a]);
        in = place_in(cube, at[0], at[1], at[2]);
        velocity = velocity_in(cube, in.xi);
    }
};

/// Whether all cells beside that of a place in a cube are in the cube as well, and not only so by rounding.
__device__ bool has_neighbours_in(const Cube& cube, const PlaceInCube& place) {
    if (cube.round) return false;
    for (int a = 0; a < 3; ++a) {
        const float* const row = cube.to_rest + 3 * a;
        if (!(fabsf(place.xi[a]) + fabsf(row[0]) + fabsf(row[1]) + fabsf(row[2]) <= cube.edge - 1e-4f)) return false;
    }
    return true;
}

/// Finds the cells that each cube holds, by some warps for each, and begins its sums.
__global__ void __launch_bounds__(block) hold(const __grid_constant__ LatticeStep of_all, const WaterOnGpu* waters) {
    const Step step(of_all, waters);
    const unsigned threads = of_all.warps * warp, thread = blockIdx.x * block + threadIdx.x, p = thread / threads,
                   first = thread - p * threads;
    if (p >= static_cast<unsigned>(of_all.cubes) || !step.water.goes_on) return;
    if (first == 0) step.water.pushes[p] = {};
    const Cube cube = step.water.cubes[p];
    const CellRange range = cells_around(cube, step.lattice.cells, step.lattice.periodic);
    const auto size = static_cast<unsigned>(range.size());
    for (unsigned k = first; k < size; k += threads) {
        int x[3], here[3];
        range.place(k, x);
        for (int a = 0; a < 3; ++a) here[a] = step.lattice.inside(a, x[a]);
        Key* const key = step.key_of(here[0], here[1], here[2]);
        const PlaceInCube in = place_in(cube, x[0], x[1], x[2]);
        if (key && in.out <= cube.edge) atomicMin(key, Key{__float_as_uint(in.out)} << 32 | p);
    }
}

/// The population that goes the other way.
__device__ constexpr int opposite(int i) {
    return lattice_populations - 1 - i;
}
/// The ends on whose side population i comes from: bits, along each axis the lower and the upper one.
__device__ constexpr unsigned sides_of(int i) {
    unsigned ends = 0;
    for (int a = 0; a < 3; ++a)
        if (const int c = along(i, a); c != 0) ends |= 1u << (2 * a + (c > 0 ? 0 : 1));
    return ends;
}

/// Where the populations that come to a cell lie. Number: unsigned, holds the number of any population; what goes down
/// is added modulo its size.
template <class Number>
class Sources {
public:
    __device__ Sources(const Lattice& lattice, const int (&place)[3])
        : count_(lattice.count), cell_(lattice.at(place[0], place[1], place[2])) {
        Number stride = 1, axis_of_populations = 1;
        for (int a = 0; a < 3; ++a) {
            const auto n = static_cast<Number>(lattice.cells[a]);
            for (int end = 0; end < 2; ++end) {
                Number by = stride;  // to the end's side
                if (place[a] == (end == 0 ? 0 : lattice.cells[a] - 1)) {
                    const Face face = lattice.faces[a][end];
                    if (face == Face::no_slip) bounces_ |= 1u << (2 * a + end);
                    if (face == Face::open) opens_ |= 1u << (2 * a + end);
                    by = face == Face::periodic ? stride - n * stride : 2 * axis_of_populations * count_;
                }
                by_[a][end] = end == 0 ? Number{} - by : by;
            }
            stride *= n;
            axis_of_populations *= 3;
        }
    }

    /// The number of the population that comes as population i.
    __device__ Number operator()(int i) const {
        Number from = cell_ + i * count_;
        for (int a = 0; a < 3; ++a)
            if (const int c = along(i, a); c != 0) from += by_[a][c > 0 ? 0 : 1];
        return ((bounces_ | opens_) & sides_of(i)) != 0 ? cell_ + opposite(i) * count_ : from;
    }
    /// Population i as the water of this cell has it, which is on its way to others.
    __device__ Number own(int i) const { return cell_ + i * count_; }
    __device__ bool at_open_end() const { return opens_ != 0; }
    /// Whether population i comes in from outside. Where a wall meets an open end, one along x gives way, as on the
    /// CPU.
    __device__ bool comes_in(int i) const {
        constexpr unsigned along_x = 3;
        return (opens_ & sides_of(i)) != 0 && (bounces_ & sides_of(i) & ~along_x) == 0;
    }

private:
    Number count_, cell_;
    /// along each axis down and up: to the cell there, or to the mirrored population of the cell here
    Number by_[3][2];
    unsigned bounces_ = 0, opens_ = 0;  ///< bits: ends
};

/// The moments of what comes to a cell.
template <class Number>
__device__ void load_moments(const float* __restrict__ populations, const Sources<Number>& sources,
                             float (&m)[lattice_moments]) {
    float f[lattice_populations];
#pragma unroll
    for (int i = 0; i < lattice_populations; ++i) f[i] = __ldg(populations + sources(i));
    moments_of(f, m);
}
using AnySources = Sources<std::size_t>;

/// Density less that at rest, and momentum, of what comes to a cell. Rarely asked, and so apart: the kernels have few
/// registers to give.
__device__ __noinline__ float4 arrived_at(const Lattice& lattice, const float* populations, int x, int y, int z) {
    const int place[3] = {x, y, z};
    const AnySources sources(lattice, place);
    float4 sum{};
#pragma unroll 1
    for (int plane = 0; plane < 3; ++plane) {
        float f[9];
#pragma unroll
        for (int e = 0; e < 9; ++e) f[e] = __ldg(populations + sources(9 * plane + e));
        const float low = f[0] + f[1] + f[2], middle = f[3] + f[4] + f[5], high = f[6] + f[7] + f[8];
        const float of_plane = low + middle + high;
        sum.x += of_plane;
        sum.y += (f[2] + f[5] + f[8]) - (f[0] + f[3] + f[6]);
        sum.z += high - low;
        sum.w += static_cast<float>(plane - 1) * of_plane;
    }
    return sum;
}

/// Where bodies come to cover cells, these have more momentum than the body there. The water's part of that is to go to
/// the cells beside them.
__global__ void __launch_bounds__(block) cover(const __grid_constant__ LatticeStep of_all, const WaterOnGpu* waters) {
    const Step step(of_all, waters);
    if (!step.water.goes_on || !step.begun()) return;
    const Lattice& lattice = step.lattice;
    const auto comes = [&](unsigned cell) {
        return step.water.keys[cell] != nobody && step.water.owners[cell].now < 0;
    };
    each_cell_around(step, comes, [&](const int(&here)[3]) {
        const unsigned at = lattice.at(here[0], here[1], here[2]);
        const Cube& cube = step.water.cubes[cube_of(step.water.keys[at])];
        float sum = 0;
        for (int i = 0; i < lattice_populations; ++i) {
            int to[3];
            if (!neighbour(i, here, lattice.cells, lattice.periodic, to)) continue;
            const Key* const taker = step.key_of(to[0], to[1], to[2]);
            if (!taker || *taker != nobody) continue;
            step.handover(*taker).role = Handover::takes;
            sum += neighbour_weight(i);
        }
        if (sum == 0) return;
        const Velocity3 told = CellInCube(lattice, cube, here).velocity;
        const auto [excess, mx, my, mz] = arrived_at(lattice, step.from(), here[0], here[1], here[2]);
        const float density = 1 + excess + divergence_of(cube), part = (1 - covered_share) / sum;
        step.water.handovers[at] = {
            Handover::gives,
            {(mx - density * told.x) * part, (my - density * told.y) * part, (mz - density * told.z) * part}};
    });
}

template <class Number>
struct Put {
    const Sources<Number>& sources;
    float* to;
    NATATOR_HD void operator()(int i, float f) const {
#if defined(__CUDA_ARCH__)
        to[sources.own(i)] = f;
#endif
    }
};

/// Streams and collides: a thread a cell. It reads what comes from the cells beside and writes its own: the other way
/// round writes are not aligned, at two thirds of the speed (H200).
template <bool eddies, class Number>
__global__ void __launch_bounds__(block)
    advance_cells(const __grid_constant__ LatticeStep of_all, const WaterOnGpu* waters) {
    const Step step(of_all, waters);
    const Lattice& lattice = step.lattice;
    const unsigned cell = blockIdx.x * block + threadIdx.x;
    if (cell >= lattice.count || !step.water.goes_on) return;
    const Cube* __restrict__ const cubes = step.water.cubes;
    Owners* __restrict__ const owners = step.water.owners;
    int place[3];
    lattice.place(cell, place);
    const Sources<Number> sources(lattice, place);
    float m[lattice_moments];
    load_moments(step.from(), sources, m);
    Velocity3 told{};
    bool held = false;
    if (const Key* const key = step.key_of(place[0], place[1], place[2])) {
        const Key of_cell = *key;
        held = of_cell != nobody;
        owners[cell] = {held ? cube_of(of_cell) : -1, owners[cell].now};
        if (held) {
            const Cube& cube = cubes[cube_of(of_cell)];
            told = CellInCube(lattice, cube, place).velocity;
            m[0] += divergence_of(cube);
        } else if (Handover& own = step.handover(*key); own.role == Handover::takes) {
            own.role = Handover::none;
            for (int i = 0; i < lattice_populations; ++i) {
                int from[3];
                if (!neighbour(i, place, lattice.cells, lattice.periodic, from)) continue;
                const Key* const other = step.key_of(from[0], from[1], from[2]);
                if (!other || step.handover(*other).role != Handover::gives) continue;
                for (int a = 0; a < 3; ++a) m[1 + a] += neighbour_weight(i) * step.handover(*other).surplus[a];
            }
        }
    }
    const float inverse = 1.0f / (m[0] + 1.0f);
    const float ux = held ? told.x : m[1] * inverse, uy = held ? told.y : m[2] * inverse,
                uz = held ? told.z : m[3] * inverse;
    float* const to = step.to();
    collide<eddies>(m, ux, uy, uz, of_all.rates, Put<Number>{sources, to});
    if (!sources.at_open_end()) return;
#pragma unroll
    for (int i = 0; i < lattice_populations; ++i)
        if (sources.comes_in(i)) to[sources(i)] = of_all.inflow.of[i];  // in place of what goes out there
}

/// What goes between a cell of a body that moves at u and the water beside it.
__device__ void add_links(const Step& step, const int (&here)[3], const float (&u)[3], float (&j)[3]) {
    const Lattice& lattice = step.lattice;
    const long cells = lattice.count;
    const unsigned at = lattice.at(here[0], here[1], here[2]);
    const float* const after = step.to() + at;
    const Owners* const owners = step.water.owners + at;
    // To the cells beside, down and up each axis; bits: ends without any.
    int by[3][2];
    unsigned ends = 0;
    for (int a = 0, stride = 1; a < 3; ++a) {
        for (int up = 0; up < 2; ++up) {
            const int to = lattice.inside(a, here[a] + 2 * up - 1);
            if (to < 0 || to >= lattice.cells[a]) ends |= 1u << (2 * a + up);
            by[a][up] = (to - here[a]) * stride;
        }
        stride *= lattice.cells[a];
    }
    // All loads of a kind are under way together.
    const auto beside = [&](int i) {  // where population i comes from; 0, which is held, beyond an end
        int from = 0;
        for (int a = 0; a < 3; ++a)
            if (const int c = along(i, a); c != 0) from += by[a][c < 0 ? 1 : 0];
        return (sides_of(i) & ends) != 0 ? 0 : from;
    };
    unsigned free = 0;
#pragma unroll
    for (int i = 0; i < lattice_populations; ++i) free |= (owners[beside(i)].now < 0 ? 1u : 0u) << i;
#pragma unroll
    for (int part = 0; part < 3; ++part) {
        float in[9], out[9];
#pragma unroll
        for (int e = 0; e < 9; ++e) {
            const int i = 9 * part + e;
            const bool is_free = (free & 1u << i) != 0;
            in[e] = is_free ? after[i * cells + beside(i)] : 0;
            out[e] = is_free ? after[opposite(i) * cells] : 0;
        }
#pragma unroll
        for (int e = 0; e < 9; ++e) {
            const int i = 9 * part + e;
            if (!(free & 1u << i)) continue;
            const float in_ = in[e] - moving_population(i, u), out_ = out[e] - moving_population(opposite(i), u);
            for (int a = 0; a < 3; ++a) j[a] += link_push(in_, out_, static_cast<float>(along(i, a)), u[a]);
        }
    }
}

/// Adds j at xi to the sums of a cube.
__device__ void add_push(const float (&j)[3], const float (&xi)[3], PushSums& sums) {
    for (int a = 0; a < 3; ++a) {
        sums.add(a, j[a]);
        for (int b = 0; b < 3; ++b) sums.add(PushSums::moment(a, b), static_cast<double>(j[a]) * xi[b]);
    }
}

/// Sums what each cube is pushed by, and forgets who has its cells.
__global__ void __launch_bounds__(block) push(const __grid_constant__ LatticeStep of_all, const WaterOnGpu* waters) {
    const Step step(of_all, waters);
    if (!step.water.goes_on) return;
    const Lattice& lattice = step.lattice;
    const bool begun = step.begun();
    const auto pushes = [&](unsigned cell) {
        const auto [now, before] = step.water.owners[cell];
        return now >= 0 || (begun && before >= 0 && before < of_all.cubes);
    };
    each_cell_around(step, pushes, [&](const int(&here)[3]) {
        const unsigned at = lattice.at(here[0], here[1], here[2]);
        const auto [now, before] = step.water.owners[at];
        const bool holds = now >= 0, changes = begun && holds != (before >= 0);
        const int p = holds ? now : before;
        const Cube& cube = step.water.cubes[p];
        const CellInCube cell(lattice, cube, here);
        const float u[3] = {cell.velocity.x, cell.velocity.y, cell.velocity.z};
        float j[3] = {};
        float part = -1;  // of the surplus of a cell that the body leaves
        if (holds) {
            step.water.keys[at] = nobody;
            Handover& handover = step.water.handovers[at];
            const bool gives = changes && handover.role == Handover::gives;
            if (gives) handover.role = Handover::none;
            part = gives ? covered_share : 1;
        }
        bool near = true;  // a body that has been put elsewhere is not pushed by what it left
        for (int a = 0; a < 3 && !holds; ++a)
            near = near && fabsf(static_cast<float>(cell.at[a]) - cube.x[a]) <= cube.reach[a] + 1;
        if (changes && near) {
            const auto [excess, mx, my, mz] = arrived_at(lattice, step.from(), here[0], here[1], here[2]);
            const float density = 1 + excess + (holds ? divergence_of(cube) : 0), momentum[3] = {mx, my, mz};
            for (int a = 0; a < 3; ++a) j[a] = part * (momentum[a] - density * u[a]);
        }
        const bool at_surface = holds && !has_neighbours_in(cube, cell.in);
        if (at_surface) add_links(step, here, u, j);
        if (at_surface || changes) add_push(j, cell.in.xi, step.water.pushes[p]);
    });
}

/// Has these populations come to a cell.
__device__ void set_arrivals(const AnySources& sources, const Populations& with, float* populations) {
#pragma unroll
    for (int i = 0; i < lattice_populations; ++i) populations[sources(i)] = with.of[i];
}

__global__ void __launch_bounds__(block)
    shift_cells(Lattice lattice, const float* __restrict__ from, float* __restrict__ to,
                const Owners* __restrict__ owners_from, Owners* __restrict__ owners_to, int x, int y, int z) {
    const unsigned cell = blockIdx.x * block + threadIdx.x;
    if (cell >= lattice.count) return;
    int here[3], there[3];
    lattice.place(cell, here);
    const int by[3] = {x, y, z};
    bool inside = true;
    for (int a = 0; a < 3; ++a) {
        there[a] = here[a] + by[a];
        inside = inside && there[a] >= 0 && there[a] < lattice.cells[a];
    }
    Populations arrived{};
    if (inside) {
        const AnySources sources(lattice, there);
#pragma unroll
        for (int i = 0; i < lattice_populations; ++i) arrived.of[i] = from[sources(i)];
    }
    set_arrivals(AnySources(lattice, here), arrived, to);
    owners_to[cell] = inside ? owners_from[lattice.at(there[0], there[1], there[2])] : Owners{-1, -1};
}

/// Makes so many cells from one on the same.
__global__ void __launch_bounds__(block)
    fill_cells(Lattice lattice, unsigned first, unsigned count, Populations with, float* populations) {
    const unsigned k = blockIdx.x * block + threadIdx.x;
    if (k >= count) return;
    int place[3];
    lattice.place(first + k, place);
    set_arrivals(AnySources(lattice, place), with, populations);
}

/// Density less that at rest and velocity, cells/step, of each of so many cells from one on.
__global__ void __launch_bounds__(block)
    read_cells(Lattice lattice, unsigned first, unsigned count, const float* __restrict__ populations, float4* to) {
    const unsigned k = blockIdx.x * block + threadIdx.x;
    if (k >= count) return;
    int place[3];
    lattice.place(first + k, place);
    const auto [excess, x, y, z] = arrived_at(lattice, populations, place[0], place[1], place[2]);
    const float density = 1 + excess;
    to[k] = {excess, x / density, y / density, z / density};
}

unsigned blocks_of(std::size_t threads) {
    return static_cast<unsigned>((threads + block - 1) / block);
}

}  // namespace

Lattice lattice_of(const Box& box) {
    const auto count = static_cast<std::size_t>(box.cells.cast<double>().prod());
    if (count > std::numeric_limits<int>::max()) throw std::bad_alloc();  // more than any GPU has room for
    Lattice lattice{};
    lattice.count = static_cast<unsigned>(count);
    for (int a = 0; a < 3; ++a) {
        lattice.cells[a] = box.cells[a];
        for (int end = 0; end < 2; ++end) lattice.faces[a][end] = box.faces[a][end];
        lattice.periodic[a] = box.faces[a][0] == Face::periodic;
    }
    return lattice;
}

LatticeStep lattice_step(const Box& box, double h, const std::vector<Cube>& cubes) {
    constexpr double of_warp = 4 * warp;  // cells that a warp looks at for a cube
    constexpr double around = 3;          // cells around all bodies, for one around a particle
    constexpr double threads = 4e9;       // at most, of all cubes
    const Lattice lattice = lattice_of(box);
    const double most = threads / warp / std::max(1.0, static_cast<double>(cubes.size())), all = lattice.count;
    double largest = 0, sum = 0;  // cells in the boxes around cubes
    for (const Cube& cube : cubes) {
        double cells = 1;
        for (int a = 0; a < 3; ++a) cells *= std::clamp<double>(2 * cube.reach[a] + 1, 1, box.cells[a]);
        largest = std::max(largest, cells);
        sum += cells;
    }
    return {lattice,
            rates_in(box, h),
            inflow(box, h),
            static_cast<int>(cubes.size()),
            static_cast<int>(std::clamp(std::ceil(largest / of_warp), 1.0, std::clamp(most, 1.0, 256.0))),
            static_cast<unsigned>(std::ceil(std::min(around * sum, all) / cells_of_thread))};
}

void launch_step(const LatticeStep& step, WaterOnGpu* waters, int count, cudaStream_t stream) {
    const auto size = static_cast<unsigned>(count);
    const dim3 by_cell(blocks_of(step.lattice.count), size), around(blocks_of(step.threads_around), size),
        by_cube(blocks_of(static_cast<std::size_t>(step.cubes) * step.warps * warp), size);
    begin_step<<<dim3(1, size), range_block, 0, stream>>>(step, waters);
    if (step.cubes > 0) hold<<<by_cube, block, 0, stream>>>(step, waters);
    if (step.cubes > 0) cover<<<around, block, 0, stream>>>(step, waters);
    // Behind all else: the small kernels of other waters would wait for all of its blocks.
    cudaLaunchAttribute last{};
    last.id = cudaLaunchAttributePriority;
    last.val.priority = cuda::Stream::lowest_priority();
    cudaLaunchConfig_t of_cells{by_cell, dim3(block), 0, stream, &last, 1};
    const auto with = [&](auto number) {
        using Number = decltype(number);
        return step.rates.eddies > 0 ? advance_cells<true, Number> : advance_cells<false, Number>;
    };
    const bool few = step.lattice.count <= std::numeric_limits<unsigned>::max() / lattice_populations;
    cuda::check(cudaLaunchKernelEx(&of_cells, few ? with(unsigned{}) : with(std::size_t{}), step,
                                   static_cast<const WaterOnGpu*>(waters)),
                "launch");
    if (step.cubes > 0) push<<<around, block, 0, stream>>>(step, waters);
    cuda::check(cudaGetLastError(), "launch");
}

GpuWater::GpuWater(const Box& box, int device) : Water(box), device_(device), lattice_(lattice_of(box)) {
    const std::size_t count = lattice_.count;
    for (auto& populations : populations_) populations = cuda::DeviceBuffer<float>(lattice_populations * count);
    for (auto& owners : owners_) owners = cuda::DeviceBuffer<Owners>(count);
    keys_ = cuda::DeviceBuffer<Key>(count);
    handovers_ = cuda::DeviceBuffer<Handover>(count);
    begin();
}

void GpuWater::begin() {
    choose();
    const auto fill = [&](const auto& buffer, int byte) {
        if (buffer.size() > 0)
            cuda::check(cudaMemsetAsync(buffer.data(), byte, buffer.size() * sizeof(*buffer.data()), stream_.get()),
                        "clear");
    };
    on_gpu_.steps = 0;
    on_gpu_.last = on_gpu_.around = {};
    on_gpu_.fastest = 0;
    on_gpu_.goes_on = 1;
    fill(now(), 0);
    fill(owners_[0], 0xff);
    fill(keys_, 0xff);
    fill(handovers_, 0);
    point_to_buffers();
    wait();
}

void GpuWater::point_to_buffers() {
    for (int k = 0; k < 2; ++k) on_gpu_.populations[k] = populations_[k].data();
    on_gpu_.owners = owners_[0].data();
    on_gpu_.keys = keys_.data();
    on_gpu_.handovers = handovers_.data();
    on_gpu_.cubes = cubes_.data();
    on_gpu_.pushes = pushes_.data();
}

void GpuWater::make_room(int cubes, const std::vector<Cube>& last) {
    choose();
    if (cubes_.size() < static_cast<std::size_t>(cubes)) {
        cuda::DeviceBuffer<Cube> more_cubes(cubes);
        pushes_ = cuda::DeviceBuffer<PushSums>(cubes);
        cubes_ = std::move(more_cubes);
        point_to_buffers();
    }
    if (last.empty()) return;
    cuda::check(cudaMemcpyAsync(cubes_.data() + cubes - last.size(), last.data(), last.size() * sizeof(Cube),
                                cudaMemcpyHostToDevice, stream_.get()),
                "upload");
    wait();
}

void GpuWater::advance(const std::vector<Cube>& cubes, double step, std::vector<Push>& pushes) {
    const int count = static_cast<int>(cubes.size());
    make_room(count, cubes);
    const auto copy = [&](void* to, const void* from, std::size_t bytes) {
        if (bytes > 0) cuda::check(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDefault, stream_.get()), "copy");
    };
    copy(own_step_.data(), &on_gpu_, sizeof on_gpu_);
    launch_step(lattice_step(box_, step, cubes), own_step_.data(), 1, stream_.get());
    copy(&on_gpu_, own_step_.data(), sizeof on_gpu_);
    std::vector<PushSums> sums(cubes.size());
    copy(sums.data(), pushes_.data(), cubes.size() * sizeof(PushSums));
    wait();
    pushes.clear();
    for (const PushSums& sum : sums) pushes.push_back(sum.push());
}

void GpuWater::shift(const Eigen::Vector3i& by) {
    choose();
    const int of_now = on_gpu_.steps % 2;
    shift_cells<<<blocks_of(lattice_.count), block, 0, stream_.get()>>>(
        lattice_, now().data(), populations_[1 - of_now].data(), owners_[0].data(), owners_[1].data(), by.x(), by.y(),
        by.z());
    cuda::check(cudaGetLastError(), "launch");
    wait();
    std::swap(populations_[0], populations_[1]);
    std::swap(owners_[0], owners_[1]);
    point_to_buffers();
    CellRange& last = on_gpu_.last;
    for (int a = 0; a < 3; ++a) {
        const int low = std::max(last.low[a] - by[a], 0);
        last.count[a] = std::max(std::min(last.low[a] + last.count[a] - by[a], lattice_.cells[a]) - low, 0);
        last.low[a] = low;
    }
}

std::vector<Eigen::Vector4f> GpuWater::read_from(unsigned first, unsigned count) const {
    choose();
    cuda::DeviceBuffer<float4> read(count);
    read_cells<<<blocks_of(count), block, 0, stream_.get()>>>(lattice_, first, count, now().data(), read.data());
    cuda::check(cudaGetLastError(), "launch");
    std::vector<Eigen::Vector4f> all(count);
    static_assert(sizeof(Eigen::Vector4f) == sizeof(float4));
    cuda::check(
        cudaMemcpyAsync(all.data(), read.data(), all.size() * sizeof(float4), cudaMemcpyDeviceToHost, stream_.get()),
        "download");
    wait();
    return all;
}

Cell GpuWater::cell(const Eigen::Vector3i& at) const {
    const Eigen::Vector4f one = read_from(lattice_.at(at.x(), at.y(), at.z()), 1).front();
    return {one[0], one.tail<3>().cast<double>()};
}

std::vector<Eigen::Vector4f> GpuWater::cells() const {
    std::vector<Eigen::Vector4f> all = read_from(0, lattice_.count);
    for (Eigen::Vector4f& one : all) one[0] += 1;
    return all;
}

namespace {

Populations in_equilibrium(const Cell& cell) {
    Populations made;
    float m[lattice_moments];
    equilibrium(cell, m);
    const float inverse = 1 / (1 + m[0]);
    // All cumulants of a collision that keeps nothing are 0.
    collide<false>(m, m[1] * inverse, m[2] * inverse, m[3] * inverse, LatticeRates{},
                   [&](int i, float value) { made.of[i] = value; });
    return made;
}

}  // namespace

void GpuWater::fill_from(unsigned first, unsigned count, const Cell& with) {
    choose();
    fill_cells<<<blocks_of(count), block, 0, stream_.get()>>>(lattice_, first, count, in_equilibrium(with),
                                                              now().data());
    cuda::check(cudaGetLastError(), "launch");
    wait();
}

void GpuWater::set_cell(const Eigen::Vector3i& at, const Cell& cell) {
    fill_from(lattice_.at(at.x(), at.y(), at.z()), 1, cell);
}

void GpuWater::set_cells(const Cell& all) {
    fill_from(0, lattice_.count, all);
}

void GpuWater::save(ByteWriter& to) const {
    choose();
    to.add(kind_of_saved);
    to.add(on_gpu_.steps > 0);
    for (int a = 0; a < 3; ++a) to.add(on_gpu_.last.low[a]), to.add(on_gpu_.last.count[a]);
    to.add_all(std::span<const float>(now().download()));
    to.add_all(std::span<const Owners>(owners_[0].download()));
}

void GpuWater::restore(ByteReader from) {
    int kind = 0;
    bool begun = false;
    CellRange around{};
    from.read(kind);
    if (kind != kind_of_saved) refuse_saved();
    from.read(begun);
    for (int a = 0; a < 3; ++a) {
        from.read(around.low[a]);
        from.read(around.count[a]);
        const int low = around.low[a], cells = lattice_.cells[a];
        if (low < 0 || low > cells || around.count[a] < 0 || around.count[a] > cells - low) refuse_saved();
    }
    std::vector<float> populations(static_cast<std::size_t>(lattice_populations) * lattice_.count);
    std::vector<Owners> owners(lattice_.count);
    const std::size_t of_populations = populations.size() * sizeof(float), of_owners = owners.size() * sizeof(Owners);
    if (from.left().size() != of_populations + of_owners) refuse_saved();
    std::memcpy(populations.data(), from.take(of_populations).data(), of_populations);
    std::memcpy(owners.data(), from.take(of_owners).data(), of_owners);
    if (!std::ranges::all_of(populations, [](float value) { return std::isfinite(value); })) refuse_saved();
    choose();
    begin();
    populations_[0].upload(populations);
    owners_[0].upload(owners);
    cuda::wait_for_uploads();
    on_gpu_.steps = begun ? 2 : 0;  // an even number: the first buffer
    on_gpu_.last = around;
}

std::unique_ptr<Water> Water::on_gpu(const Box& box, int device) {
    return std::make_unique<GpuWater>(box, device);
}

}  // namespace natator::lattice
