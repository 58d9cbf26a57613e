#include "gpu_water.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "physics/lattice.h"
#include "solver/solids/cuda/sums_of_warp.cuh"

namespace natator::lattice {
namespace {

using namespace physics;

constexpr int block = 128, push_block = 64, range_block = 256;  ///< threads
constexpr unsigned warp = 32, all = ~0u;
constexpr int push_numbers = sizeof(Push) / sizeof(double);
static_assert(push_numbers <= 32, "a number each of a warp's threads");

constexpr Key nobody = ~Key{0};

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

/// The warp's cube; none beyond the last.
__device__ int cube_of_warp(int cubes) {
    const int cube = static_cast<int>((blockIdx.x * block + threadIdx.x) / warp);
    return cube < cubes ? cube : -1;
}
/// The cells around a cube, and so many beyond.
struct CellsAround {
    CellRange range;
    unsigned size;

    __device__ CellsAround(const Lattice& lattice, const Cube& cube, float more) {
        Cube wide = cube;
        for (float& reach : wide.reach) reach += more;
        range = cells_around(wide, lattice.cells, lattice.periodic);
        size = range.size();
    }
    /// Number k: where it is, counted on beyond periodic ends, and inside them; its key.
    __device__ Key* cell(const Step& step, unsigned k, int (&x)[3], int (&here)[3]) const {
        const unsigned row = k / range.count[0], plane = row / range.count[1];
        x[0] = range.low[0] + static_cast<int>(k - row * range.count[0]);
        x[1] = range.low[1] + static_cast<int>(row - plane * range.count[1]);
        x[2] = range.low[2] + static_cast<int>(plane);
        for (int a = 0; a < 3; ++a) here[a] = step.lattice.inside(a, x[a]);
        return step.key_of(here[0], here[1], here[2]);
    }
};
/// Does something with each of them by a warp's threads in turn: work(x, here, key).
template <class Work>
__device__ void each_cell_around(const Step& step, const Cube& cube, float more, const Work& work) {
    const CellsAround around(step.lattice, cube, more);
    for (unsigned k = threadIdx.x % warp; k < around.size; k += warp) {
        int x[3], here[3];
        if (Key* const key = around.cell(step, k, x, here)) work(x, here, *key);
    }
}
/// Whether all cells beside that of a place in a cube are in the cube as well, and not only so by rounding.
__device__ bool has_neighbours_in(const Cube& cube, const PlaceInCube& place) {
    if (cube.round) return false;
    for (int a = 0; a < 3; ++a) {
        const float* const row = cube.to_rest + 3 * a;
        if (!(fabsf(place.xi[a]) + fabsf(row[0]) + fabsf(row[1]) + fabsf(row[2]) <= cube.edge - 1e-4f)) return false;
    }
    return true;
}

/// Finds the cells that each cube holds.
__global__ void hold(const __grid_constant__ LatticeStep of_all, const WaterOnGpu* waters) {
    const Step step(of_all, waters);
    const int p = cube_of_warp(of_all.cubes);
    if (p < 0 || !step.water.goes_on) return;
    const Cube cube = step.water.cubes[p];
    each_cell_around(step, cube, 0, [&](const int(&x)[3], const int(&)[3], Key& key) {
        const PlaceInCube in = place_in(cube, x[0], x[1], x[2]);
        if (in.out <= cube.edge) atomicMin(&key, Key{__float_as_uint(in.out)} << 32 | static_cast<unsigned>(p));
    });
}

/// The moments of cell `at`.
__device__ void load_moments(const float* populations, long count, unsigned at, float (&m)[lattice_moments]) {
    float f[lattice_populations];
    for (int i = 0; i < lattice_populations; ++i) f[i] = populations[i * count + at];
    moments_of(f, m);
}

/// A cell that a cube comes to cover hands its surplus on to the water beside it.
__device__ void hand_on(const Step& step, const Cube& cube, const int (&x)[3], const int (&here)[3], const Key& key) {
    const Lattice& lattice = step.lattice;
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
    float m[lattice_moments];
    load_moments(step.from(), lattice.count, lattice.at(here[0], here[1], here[2]), m);
    const Velocity3 told = velocity_in(cube, place_in(cube, x[0], x[1], x[2]).xi);
    const float density = 1 + m[0] + divergence_of(cube), part = (1 - covered_share) / sum;
    step.handover(key) = {
        Handover::gives,
        {(m[1] - density * told.x) * part, (m[2] - density * told.y) * part, (m[3] - density * told.z) * part}};
}

/// Where bodies come to cover cells, these have more momentum than the body there. The water's part of that is to go to
/// the cells beside them.
__global__ void cover(const __grid_constant__ LatticeStep of_all, const WaterOnGpu* waters) {
    constexpr int at_once = 4;  // whose loads are under way together
    const Step step(of_all, waters);
    const int p = cube_of_warp(of_all.cubes);
    if (p < 0 || !step.water.goes_on || !step.begun()) return;
    const Cube& cube = step.water.cubes[p];
    const CellsAround around(step.lattice, cube, 0);
    for (unsigned first = threadIdx.x % warp; first < around.size; first += at_once * warp) {
        int x[3], here[3];
        const Key* held[at_once];
        bool comes[at_once];
#pragma unroll
        for (int k = 0; k < at_once; ++k) {
            const unsigned number = first + k * warp;
            held[k] = number < around.size ? around.cell(step, number, x, here) : nullptr;
            if (held[k] && (*held[k] == nobody || cube_of(*held[k]) != p)) held[k] = nullptr;
        }
#pragma unroll
        for (int k = 0; k < at_once; ++k) comes[k] = held[k] && step.water.owners[held[k] - step.water.keys].now < 0;
#pragma unroll 1
        for (int k = 0; k < at_once; ++k) {
            if (!comes[k]) continue;
            const Key* const key = around.cell(step, first + k * warp, x, here);
            hand_on(step, cube, x, here, *key);
        }
    }
}

/// Where the populations of a cell go, and what comes in for those that go out at open ends.
class Ways {
public:
    __device__ Ways(const Lattice& lattice, unsigned cell, const int (&place)[3], const Populations& inflow, float* to)
        : count_(lattice.count), inflow_(inflow), back_(to + cell) {
        long stride = 1;
        int axis_of_populations = 1;
        for (int a = 0; a < 3; ++a) {
            const int n = lattice.cells[a];
            for (int end = 0; end < 2; ++end) {
                const int sign = end == 0 ? -1 : 1;
                long by = sign * stride;
                if (place[a] == (end == 0 ? 0 : n - 1)) {
                    const Face face = lattice.faces[a][end];
                    if (face == Face::no_slip) bounces_ |= 1u << (2 * a + end);
                    if (face == Face::open) opens_ |= 1u << (2 * a + end);
                    by = face == Face::periodic ? by - sign * n * stride : -2L * sign * axis_of_populations * count_;
                }
                by_[a][end] = by;
            }
            stride *= n;
            axis_of_populations *= 3;
        }
    }

    __device__ void operator()(int i, float f) const {
        const int c[3] = {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
        unsigned crosses = 0;
        long by = i * count_;
        for (int a = 0; a < 3; ++a) {
            if (c[a] == 0) continue;
            const int end = c[a] > 0 ? 1 : 0;
            crosses |= 1u << (2 * a + end);
            by += by_[a][end];
        }
        const int opposite = lattice_populations - 1 - i;
        // Where a wall meets an open end, one along x gives way, as on the CPU.
        const bool comes_in = (opens_ & crosses) != 0 && (bounces_ & crosses & ~along_x) == 0;
        back_[((bounces_ | opens_) & crosses) != 0 ? opposite * count_ : by] = comes_in ? inflow_.of[opposite] : f;
    }

private:
    static constexpr unsigned along_x = 3;
    long count_;
    const Populations& inflow_;
    float* back_;  ///< the cell itself
    /// along each axis down and up: to the cell there, or to the mirrored population of the cell here
    long by_[3][2];
    unsigned bounces_ = 0, opens_ = 0;  ///< bits: ends
};

struct Put {
    const Ways& ways;
    NATATOR_HD void operator()(int i, float f) const {
#if defined(__CUDA_ARCH__)
        ways(i, f);
#endif
    }
};

/// Collides and streams: a thread a cell.
template <bool eddies>
__global__ void __launch_bounds__(block)
    advance_cells(const __grid_constant__ LatticeStep of_all, const WaterOnGpu* waters) {
    const Step step(of_all, waters);
    const Lattice& lattice = step.lattice;
    const unsigned cell = blockIdx.x * block + threadIdx.x;
    if (cell >= lattice.count || !step.water.goes_on) return;
    const Cube* __restrict__ const cubes = step.water.cubes;
    Owners* __restrict__ const owners = step.water.owners;
    const float* __restrict__ const from = step.from();
    float m[lattice_moments];
    load_moments(from, lattice.count, cell, m);
    int place[3];
    lattice.place(cell, place);
    const Ways ways(lattice, cell, place, of_all.inflow, step.to());
    Velocity3 told{};
    bool held = false;
    if (const Key* const key = step.key_of(place[0], place[1], place[2])) {
        const Key of_cell = *key;
        held = of_cell != nobody;
        owners[cell] = {held ? cube_of(of_cell) : -1, owners[cell].now};
        if (held) {
            const Cube& cube = cubes[cube_of(of_cell)];
            for (int a = 0; a < 3; ++a)
                place[a] = nearest_copy(cube.x[a], place[a], lattice.cells[a], lattice.periodic[a]);
            told = velocity_in(cube, place_in(cube, place[0], place[1], place[2]).xi);
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
    collide<eddies>(m, ux, uy, uz, of_all.rates, Put{ways});
}

/// Cells of a cube that have others beside them which are not its, as a warp goes through them.
struct SurfaceCells {
    static constexpr unsigned room = 2 * warp;
    struct {
        int here[3], flag;  ///< number of its flag
        float xi[3], u[3];
    } cell[room];
    unsigned count;
};

/// What is known of the cells around a part of a cube.
struct Flags {
    enum Flag : unsigned char { held = 1, own = 2, was_held = 4, was_own = 8 };
    static constexpr int edge = 8;  ///< of the part; around it lies one more on each side
    CellRange range;
    unsigned char of[(edge + 2) * (edge + 2) * (edge + 2)];

    __device__ int number(int x, int y, int z) const {
        return ((z - range.low[2]) * range.count[1] + y - range.low[1]) * range.count[0] + x - range.low[0];
    }
    __device__ void place(int k, int (&x)[3]) const {
        const int row = k / range.count[0], plane = row / range.count[1];
        x[0] = range.low[0] + k - row * range.count[0];
        x[1] = range.low[1] + row - plane * range.count[1];
        x[2] = range.low[2] + plane;
    }
};

/// Adds j at xi to a Push.
__device__ void add_push(const float (&j)[3], const float (&xi)[3], double (&sums)[push_numbers]) {
    for (int a = 0; a < 3; ++a) {
        sums[a] += j[a];
        for (int b = 0; b < 3; ++b) sums[3 + 3 * a + b] += static_cast<double>(j[a]) * xi[b];
    }
}

/// The flags of the cells from `low` on, and one beside, inside `within`, where all lie that are beside a held one.
__device__ void find_flags(const Step& step, int p, const CellRange& within, const int (&low)[3], Flags& flags) {
    CellRange range;
    for (int a = 0; a < 3; ++a) {
        range.low[a] = max(low[a] - 1, within.low[a]);
        range.count[a] = min(low[a] + Flags::edge + 1, within.low[a] + within.count[a]) - range.low[a];
    }
    const unsigned lane = threadIdx.x % warp;
    if (lane == 0) flags.range = range;
    __syncwarp();
    const int size = range.size();
#pragma unroll 4
    for (int k = static_cast<int>(lane); k < size; k += warp) {
        int x[3];
        flags.place(k, x);
        for (int a = 0; a < 3; ++a) x[a] = step.lattice.inside(a, x[a]);
        const Owners owners = step.water.owners[step.lattice.at(x[0], x[1], x[2])];
        flags.of[k] = static_cast<unsigned char>(
            (owners.now >= 0 ? Flags::held : 0) | (owners.now == p ? Flags::own : 0) |
            (owners.before >= 0 ? Flags::was_held : 0) | (owners.before == p ? Flags::was_own : 0));
    }
    __syncwarp();
}

/// Adds what goes between cells and the water beside them, a thread a cell.
__device__ void add_links(const Step& step, const Flags& flags, SurfaceCells& surface, double (&sums)[push_numbers]) {
    const Lattice& lattice = step.lattice;
    const float* const after = step.to();
    const long cells = lattice.count;
    for (unsigned k = threadIdx.x % warp; k < surface.count; k += warp) {
        const auto& of = surface.cell[k];
        const float* const here = after + lattice.at(of.here[0], of.here[1], of.here[2]);
        // To the cells beside, down and up each axis: cells and flags; bits: ends without any.
        int by[3][2], by_flags[3][2];
        unsigned ends = 0;
        for (int a = 0, stride = 1, of_flags = 1; a < 3; ++a) {
            const bool alone = lattice.periodic[a] && lattice.cells[a] == 1;  // its own neighbour
            for (int up = 0; up < 2; ++up) {
                const int to = lattice.inside(a, of.here[a] + 2 * up - 1);
                if (to < 0 || to >= lattice.cells[a]) ends |= 1u << (2 * a + up);
                by[a][up] = (to - of.here[a]) * stride;
                by_flags[a][up] = alone ? 0 : (2 * up - 1) * of_flags;
            }
            stride *= lattice.cells[a];
            of_flags *= flags.range.count[a];
        }
        float j[3] = {};
#pragma unroll
        for (int part = 0; part < 3; ++part) {  // of the links, so that their loads are under way together
            float in[9], out[9];
            unsigned free = 0;
#pragma unroll
            for (int e = 0; e < 9; ++e) {
                const int i = 9 * part + e, opposite = lattice_populations - 1 - i;
                const int c[3] = {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
                int from = 0, flag = of.flag;
                unsigned crosses = i == opposite ? ~0u : 0;
                for (int a = 0; a < 3; ++a) {
                    if (c[a] == 0) continue;
                    const int up = c[a] < 0 ? 1 : 0;  // where it comes from
                    from += by[a][up];
                    flag += by_flags[a][up];
                    crosses |= 1u << (2 * a + up);
                }
                if (i == opposite || (crosses & ends) != 0 || (flags.of[flag] & Flags::held)) continue;
                free |= 1u << e;
                in[e] = here[i * cells];
                out[e] = here[opposite * cells + from];
            }
#pragma unroll
            for (int e = 0; e < 9; ++e) {
                const int i = 9 * part + e, opposite = lattice_populations - 1 - i;
                const int c[3] = {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
                if (!(free & 1u << e)) continue;
                const float in_ = in[e] - moving_population(i, of.u), out_ = out[e] - moving_population(opposite, of.u);
                for (int a = 0; a < 3; ++a) j[a] += link_push(in_, out_, static_cast<float>(c[a]), of.u[a]);
            }
        }
        add_push(j, of.xi, sums);
    }
}

/// Sums what each cube is pushed by, in a fixed order, and forgets who has its cells.
__global__ void __launch_bounds__(push_block)
    push(const __grid_constant__ LatticeStep of_all, const WaterOnGpu* waters) {
    __shared__ SurfaceCells surface_of_warp[push_block / warp];
    __shared__ Flags flags_of_warp[push_block / warp];
    const Step step(of_all, waters);
    const Lattice& lattice = step.lattice;
    const int p = static_cast<int>((blockIdx.x * push_block + threadIdx.x) / warp);
    if (p >= of_all.cubes || !step.water.goes_on) return;
    const Cube& cube = step.water.cubes[p];
    const bool begun = step.begun();
    const unsigned lane = threadIdx.x % warp;
    SurfaceCells& surface = surface_of_warp[threadIdx.x / warp];
    Flags& flags = flags_of_warp[threadIdx.x / warp];
    double sums[push_numbers] = {};  // as Push has them
    const CellRange around = CellsAround(lattice, cube, 1).range;
    const auto in_part = [&](const int(&low)[3]) {
        if (lane == 0) surface.count = 0;
        find_flags(step, p, around, low, flags);
        int count[3];
        for (int a = 0; a < 3; ++a) count[a] = min(Flags::edge, around.low[a] + around.count[a] - low[a]);
        const int size = count[0] * count[1] * count[2];
        for (int first = 0; first < size; first += warp) {
            const int k = first + static_cast<int>(lane), row = k / count[0], plane = row / count[1];
            const int x[3] = {low[0] + k - row * count[0], low[1] + row - plane * count[1], low[2] + plane};
            const int flag = k < size ? flags.number(x[0], x[1], x[2]) : 0;
            const unsigned known = k < size ? flags.of[flag] : unsigned{Flags::held};
            const bool holds = known & Flags::own, comes = holds && begun && !(known & Flags::was_held),
                       leaves = !(known & Flags::held) && (known & Flags::was_own);
            PlaceInCube in{};
            Velocity3 told{};
            int here[3] = {};
            if (holds || leaves) {
                in = place_in(cube, x[0], x[1], x[2]);
                told = velocity_in(cube, in.xi);
                for (int a = 0; a < 3; ++a) here[a] = lattice.inside(a, x[a]);
            }
            bool handed = false;
            if (holds) {
                const unsigned at = lattice.at(here[0], here[1], here[2]);
                step.water.keys[at] = nobody;
                Handover& own_handover = step.water.handovers[at];
                handed = comes && own_handover.role == Handover::gives;
                if (handed) own_handover.role = Handover::none;
            }
            if (comes || leaves) {
                float m[lattice_moments];
                load_moments(step.from(), lattice.count, lattice.at(here[0], here[1], here[2]), m);
                const float density = 1 + m[0] + (comes ? divergence_of(cube) : 0);
                float part = -1;  // of a cell that it leaves
                if (comes) part = handed ? covered_share : 1;
                add_push({part * (m[1] - density * told.x), part * (m[2] - density * told.y),
                          part * (m[3] - density * told.z)},
                         in.xi, sums);
            }
            const bool at_surface = holds && !has_neighbours_in(cube, in);
            const unsigned lanes = __ballot_sync(all, at_surface), before = surface.count;
            if (at_surface)
                surface.cell[before + __popc(lanes & ((1u << lane) - 1))] = {
                    {here[0], here[1], here[2]}, flag, {in.xi[0], in.xi[1], in.xi[2]}, {told.x, told.y, told.z}};
            __syncwarp();
            if (lane == 0) surface.count = before + __popc(lanes);
            __syncwarp();
            if (surface.count <= SurfaceCells::room - warp && first + static_cast<int>(warp) < size) continue;
            add_links(step, flags, surface, sums);
            __syncwarp();
            if (lane == 0) surface.count = 0;
            __syncwarp();
        }
    };
    for (int z = 0; z < around.count[2]; z += Flags::edge)
        for (int y = 0; y < around.count[1]; y += Flags::edge)
            for (int x = 0; x < around.count[0]; x += Flags::edge)
                in_part({around.low[0] + x, around.low[1] + y, around.low[2] + z});
    const double own = cuda::share_sums_of_warp<push_numbers>(sums, static_cast<int>(lane));
    if (const int e = cuda::value_of_lane<push_numbers>(static_cast<int>(lane)); e >= 0)
        step.water.pushes[p * push_numbers + e] = own;
}

__global__ void __launch_bounds__(block)
    shift_cells(Lattice lattice, const float* __restrict__ from, float* __restrict__ to,
                const Owners* __restrict__ owners_from, Owners* __restrict__ owners_to, int x, int y, int z) {
    const unsigned cell = blockIdx.x * block + threadIdx.x;
    if (cell >= lattice.count) return;
    int place[3];
    lattice.place(cell, place);
    const int by[3] = {x, y, z};
    bool inside = true;
    for (int a = 0; a < 3; ++a) {
        place[a] += by[a];
        inside = inside && place[a] >= 0 && place[a] < lattice.cells[a];
    }
    const long count = lattice.count;
    const unsigned source = inside ? lattice.at(place[0], place[1], place[2]) : 0;
    for (int i = 0; i < lattice_populations; ++i) to[i * count + cell] = inside ? from[i * count + source] : 0;
    owners_to[cell] = inside ? owners_from[source] : Owners{-1, -1};
}

/// Makes all cells the same.
__global__ void __launch_bounds__(block) fill_cells(Lattice lattice, Populations with, float* to) {
    const unsigned cell = blockIdx.x * block + threadIdx.x;
    if (cell >= lattice.count) return;
    const long count = lattice.count;
#pragma unroll
    for (int i = 0; i < lattice_populations; ++i) to[i * count + cell] = with.of[i];
}

/// Density over that at rest and velocity, cells/step, of each cell.
__global__ void __launch_bounds__(block)
    read_cells(Lattice lattice, const float* __restrict__ populations, float4* to) {
    const unsigned cell = blockIdx.x * block + threadIdx.x;
    if (cell >= lattice.count) return;
    float m[lattice_moments];
    load_moments(populations, lattice.count, cell, m);
    const float density = 1 + m[0];
    to[cell] = {density, m[1] / density, m[2] / density, m[3] / density};
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

LatticeStep lattice_step(const Box& box, double h, int cubes) {
    return {lattice_of(box), rates_in(box, h), inflow(box, h), cubes};
}

void launch_step(const LatticeStep& step, WaterOnGpu* waters, int count, cudaStream_t stream) {
    const auto size = static_cast<unsigned>(count);
    const dim3 by_cell(blocks_of(step.lattice.count), size), by_cube(blocks_of(step.cubes * warp), size);
    begin_step<<<dim3(1, size), range_block, 0, stream>>>(step, waters);
    if (step.cubes > 0) hold<<<by_cube, block, 0, stream>>>(step, waters);
    if (step.cubes > 0) cover<<<by_cube, block, 0, stream>>>(step, waters);
    // Behind all else: the small kernels of other waters would wait for all of its blocks.
    cudaLaunchAttribute last{};
    last.id = cudaLaunchAttributePriority;
    last.val.priority = cuda::Stream::lowest_priority();
    cudaLaunchConfig_t of_cells{by_cell, dim3(block), 0, stream, &last, 1};
    cuda::check(cudaLaunchKernelEx(&of_cells, step.rates.eddies > 0 ? advance_cells<true> : advance_cells<false>, step,
                                   static_cast<const WaterOnGpu*>(waters)),
                "launch");
    const auto push_blocks = static_cast<unsigned>((step.cubes * warp + push_block - 1) / push_block);
    if (step.cubes > 0) push<<<dim3(push_blocks, size), push_block, 0, stream>>>(step, waters);
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
        pushes_ = cuda::DeviceBuffer<double>(static_cast<std::size_t>(cubes) * push_numbers);
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
    launch_step(lattice_step(box_, step, count), own_step_.data(), 1, stream_.get());
    copy(&on_gpu_, own_step_.data(), sizeof on_gpu_);
    pushes.resize(cubes.size());
    copy(pushes.data(), pushes_.data(), cubes.size() * sizeof(Push));
    wait();
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

Cell GpuWater::cell(const Eigen::Vector3i& place) const {
    choose();
    float f[lattice_populations], m[lattice_moments];
    cuda::check(cudaMemcpy2DAsync(f, sizeof(float), at(place), lattice_.count * sizeof(float), sizeof(float),
                                  lattice_populations, cudaMemcpyDeviceToHost, stream_.get()),
                "download");
    wait();
    moments_of(f, m);
    return {m[0], Eigen::Vector3d(m[1], m[2], m[3]) / (1 + m[0])};
}

std::vector<Eigen::Vector4f> GpuWater::cells() const {
    choose();
    cuda::DeviceBuffer<float4> read(lattice_.count);
    read_cells<<<blocks_of(lattice_.count), block, 0, stream_.get()>>>(lattice_, now().data(), read.data());
    cuda::check(cudaGetLastError(), "launch");
    std::vector<Eigen::Vector4f> all(lattice_.count);
    static_assert(sizeof(Eigen::Vector4f) == sizeof(float4));
    cuda::check(
        cudaMemcpyAsync(all.data(), read.data(), all.size() * sizeof(float4), cudaMemcpyDeviceToHost, stream_.get()),
        "download");
    wait();
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

void GpuWater::set_cell(const Eigen::Vector3i& place, const Cell& cell) {
    choose();
    const Populations made = in_equilibrium(cell);
    cuda::check(cudaMemcpy2DAsync(at(place), lattice_.count * sizeof(float), made.of, sizeof(float), sizeof(float),
                                  lattice_populations, cudaMemcpyHostToDevice, stream_.get()),
                "upload");
    wait();
}

void GpuWater::set_cells(const Cell& all) {
    choose();
    fill_cells<<<blocks_of(lattice_.count), block, 0, stream_.get()>>>(lattice_, in_equilibrium(all), now().data());
    cuda::check(cudaGetLastError(), "launch");
    wait();
}

void GpuWater::save(ByteWriter& to) const {
    choose();
    to.add(lattice_populations);
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
    if (kind != lattice_populations) refuse_saved();
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
