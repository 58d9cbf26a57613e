#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <mutex>

#include "base/combiner.h"
#include "cube_cells.h"
#include "physics/lattice.h"
#include "solver/cuda/device.h"
#include "solver/cuda/host_buffer.h"
#include "solver/cuda/stream.h"
#include "water.h"

namespace natator::lattice {
namespace {

using namespace physics;

constexpr int block = 128;  ///< threads
constexpr unsigned warp = 32, all = ~0u;
constexpr int cube_words = sizeof(Cube) / sizeof(float), push_numbers = sizeof(Push) / sizeof(double);
static_assert(cube_words <= 32 && push_numbers <= 32, "a word each of a warp's threads");

/// Who has a cell: how far out it is in the cube, as bits, which sort like numbers above 0, then the cube.
using Key = unsigned long long;
constexpr Key nobody = ~Key{0};

/// Whose a cell is and was in the last step; -1: nobody's.
struct Owners {
    int now, before;
};

struct Lattice {
    int cells[3];
    unsigned count;
    Face faces[3][2];
    bool periodic[3];

    NATATOR_HD unsigned at(int x, int y, int z) const {
        return (static_cast<unsigned>(z) * cells[1] + y) * cells[0] + x;
    }
    NATATOR_HD int inside(int axis, int at) const { return periodic[axis] ? wrapped(at, cells[axis]) : at; }
    NATATOR_HD unsigned at_inside(int x, int y, int z) const { return at(inside(0, x), inside(1, y), inside(2, z)); }
    NATATOR_HD void place(unsigned at, int (&to)[3]) const {
        const unsigned row = at / cells[0];
        to[0] = static_cast<int>(at - row * cells[0]);
        to[2] = static_cast<int>(row / cells[1]);
        to[1] = static_cast<int>(row - static_cast<unsigned>(to[2]) * cells[1]);
    }
};

/// What a cell has to do with water that bodies come to cover: nothing; it is covered and gives of its surplus to its
/// neighbours, so much by weight; it takes from such.
struct Handover {
    enum { none, gives, takes } role;
    float surplus[3];
};

/// The cells around all bodies, now and before, with their keys; along periodic axes all.
struct Keys {
    CellRange around;
    Key* data;
    Handover* handovers;

    /// None of a cell outside.
    NATATOR_HD Key* of(int x, int y, int z) const {
        const int a = x - around.low[0], b = y - around.low[1], c = z - around.low[2];
        if (a < 0 || b < 0 || c < 0 || a >= around.count[0] || b >= around.count[1] || c >= around.count[2])
            return nullptr;
        return data + (static_cast<unsigned>(c) * around.count[1] + b) * around.count[0] + a;
    }
    NATATOR_HD Handover& handover(const Key& key) const { return handovers[&key - data]; }
};
__device__ int cube_of(Key key) {
    return static_cast<int>(key);
}

/// A step of one water, as the kernels take it.
struct Step {
    Lattice lattice;
    LatticeRates rates;
    Populations inflow;
    Keys keys;
    const float* from;       ///< populations before it
    float* to;               ///< and after
    const float* from_host;  ///< cubes
    Cube* cubes;
    Owners* owners;
    double* to_host;  ///< pushes
    int count;        ///< of cubes
    bool begun;
};

/// Steps of several waters, which the blocks share by y: small ones would leave most of a GPU idle, and a launch for
/// each takes longer than its work.
constexpr int max_steps = 32;
struct Steps {
    Step of[max_steps];
};

/// The warp's cube; none beyond the last.
__device__ int cube_of_warp(int cubes) {
    const int cube = static_cast<int>((blockIdx.x * block + threadIdx.x) / warp);
    return cube < cubes ? cube : -1;
}
/// Does something with each cell around a cube, and so many beyond, by a warp's threads in turn: work(x, y, z, key),
/// which count on beyond periodic ends.
template <class Work>
__device__ void each_cell_around(const Lattice& lattice, const Keys& keys, const Cube& cube, float more,
                                 const Work& work) {
    Cube wide = cube;
    for (float& reach : wide.reach) reach += more;
    const CellRange range = cells_around(wide, lattice.cells, lattice.periodic);
    const unsigned size = range.size();
    for (unsigned k = threadIdx.x % warp; k < size; k += warp) {
        const unsigned row = k / range.count[0], plane = row / range.count[1];
        const int x = range.low[0] + static_cast<int>(k - row * range.count[0]),
                  y = range.low[1] + static_cast<int>(row - plane * range.count[1]),
                  z = range.low[2] + static_cast<int>(plane);
        Key* const key = keys.of(lattice.inside(0, x), lattice.inside(1, y), lattice.inside(2, z));
        if (key) work(x, y, z, *key);
    }
}

/// Takes the cubes over from the host and finds the cells that they hold.
__global__ void hold(const __grid_constant__ Steps steps) {
    const Step& step = steps.of[blockIdx.y];
    const Lattice& lattice = step.lattice;
    __shared__ Cube of_block[block / warp];
    const int p = cube_of_warp(step.count);
    if (p < 0) return;
    Cube& cube = of_block[threadIdx.x / warp];
    if (const int word = threadIdx.x % warp; word < cube_words) {
        const float value = step.from_host[p * cube_words + word];
        reinterpret_cast<float*>(&cube)[word] = value;
        reinterpret_cast<float*>(step.cubes + p)[word] = value;
    }
    __syncwarp();
    each_cell_around(lattice, step.keys, cube, 0, [&](int x, int y, int z, Key& key) {
        const PlaceInCube in = place_in(cube, x, y, z);
        if (in.out <= cube.edge) atomicMin(&key, Key{__float_as_uint(in.out)} << 32 | static_cast<unsigned>(p));
    });
}

/// The moments of cell `at`.
__device__ void load_moments(const float* populations, long count, unsigned at, float (&m)[lattice_moments]) {
    float f[lattice_populations];
    for (int i = 0; i < lattice_populations; ++i) f[i] = populations[i * count + at];
    moments_of(f, m);
}

/// Where bodies come to cover cells, these have more momentum than the body there. The water's part of that is to go to
/// the cells beside them.
__global__ void cover(const __grid_constant__ Steps steps) {
    const Step& step = steps.of[blockIdx.y];
    const Lattice& lattice = step.lattice;
    const Keys& keys = step.keys;
    const int p = cube_of_warp(step.count);
    if (p < 0 || !step.begun) return;
    const Cube& cube = step.cubes[p];
    each_cell_around(lattice, keys, cube, 0, [&](int x, int y, int z, const Key& key) {
        if (key == nobody || cube_of(key) != p) return;
        const unsigned at = lattice.at_inside(x, y, z);
        if (step.owners[at].now >= 0) return;
        const int here[3] = {lattice.inside(0, x), lattice.inside(1, y), lattice.inside(2, z)};
        float sum = 0;
        for (int i = 0; i < lattice_populations; ++i) {
            int to[3];
            if (!neighbour(i, here, lattice.cells, lattice.periodic, to)) continue;
            const Key* const taker = keys.of(to[0], to[1], to[2]);
            if (!taker || *taker != nobody) continue;
            keys.handover(*taker).role = Handover::takes;
            sum += neighbour_weight(i);
        }
        if (sum == 0) return;
        float m[lattice_moments];
        load_moments(step.from, lattice.count, at, m);
        const Velocity3 told = velocity_in(cube, place_in(cube, x, y, z).xi);
        const float density = 1 + m[0] + divergence_of(cube), part = (1 - covered_share) / sum;
        keys.handover(key) = {
            Handover::gives,
            {(m[1] - density * told.x) * part, (m[2] - density * told.y) * part, (m[3] - density * told.z) * part}};
    });
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

/// Collides and streams: a thread a cell. Of steps whose rates have eddies, or of those without.
template <bool eddies>
__global__ void __launch_bounds__(block) advance_cells(const __grid_constant__ Steps steps) {
    const Step& step = steps.of[blockIdx.y];
    const Lattice& lattice = step.lattice;
    const Keys& keys = step.keys;
    const Cube* __restrict__ const cubes = step.cubes;
    Owners* __restrict__ const owners = step.owners;
    const float* __restrict__ const from = step.from;
    const unsigned cell = blockIdx.x * block + threadIdx.x;
    if (cell >= lattice.count || (step.rates.eddies > 0) != eddies) return;
    float m[lattice_moments];
    load_moments(from, lattice.count, cell, m);
    int place[3];
    lattice.place(cell, place);
    const Ways ways(lattice, cell, place, step.inflow, step.to);
    Velocity3 told{};
    bool held = false;
    if (const Key* const key = keys.of(place[0], place[1], place[2])) {
        const Key of_cell = *key;
        held = of_cell != nobody;
        owners[cell] = {held ? cube_of(of_cell) : -1, owners[cell].now};
        if (held) {
            const Cube& cube = cubes[cube_of(of_cell)];
            for (int a = 0; a < 3; ++a)
                place[a] = nearest_copy(cube.x[a], place[a], lattice.cells[a], lattice.periodic[a]);
            told = velocity_in(cube, place_in(cube, place[0], place[1], place[2]).xi);
            m[0] += divergence_of(cube);
        } else if (Handover& own = keys.handover(*key); own.role == Handover::takes) {
            own.role = Handover::none;
            for (int i = 0; i < lattice_populations; ++i) {
                int from[3];
                if (!neighbour(i, place, lattice.cells, lattice.periodic, from)) continue;
                const Key* const other = keys.of(from[0], from[1], from[2]);
                if (!other || keys.handover(*other).role != Handover::gives) continue;
                for (int a = 0; a < 3; ++a) m[1 + a] += neighbour_weight(i) * keys.handover(*other).surplus[a];
            }
        }
    }
    const float inverse = 1.0f / (m[0] + 1.0f);
    const float ux = held ? told.x : m[1] * inverse, uy = held ? told.y : m[2] * inverse,
                uz = held ? told.z : m[3] * inverse;
    collide<eddies>(m, ux, uy, uz, step.rates, Put{ways});
}

/// Sums what each cube is pushed by, in a fixed order, and forgets who has its cells.
__global__ void push(const __grid_constant__ Steps steps) {
    const Step& step = steps.of[blockIdx.y];
    const Lattice& lattice = step.lattice;
    const Keys& keys = step.keys;
    const float *const before = step.from, *const after = step.to;
    const Owners* const owners = step.owners;
    const int p = cube_of_warp(step.count);
    if (p < 0) return;
    const Cube& cube = step.cubes[p];
    const long cells = lattice.count;
    double sums[push_numbers] = {};  // as Push has them
    each_cell_around(lattice, keys, cube, 1, [&](int x, int y, int z, Key& key) {
        const unsigned at = lattice.at_inside(x, y, z);
        const Owners own = owners[at];
        const bool holds = own.now == p, comes = holds && step.begun && own.before < 0,
                   leaves = own.now < 0 && own.before == p;
        if (!holds && !leaves) return;
        const PlaceInCube in = place_in(cube, x, y, z);
        const Velocity3 told = velocity_in(cube, in.xi);
        const float u[3] = {told.x, told.y, told.z};
        float j[3] = {};
        bool handed = false;
        if (holds) {
            key = nobody;
            Handover& own_handover = keys.handover(key);
            handed = own_handover.role == Handover::gives;
            own_handover.role = Handover::none;
            const int here[3] = {lattice.inside(0, x), lattice.inside(1, y), lattice.inside(2, z)};
            for (int i = 0; i < lattice_populations; ++i) {
                const int c[3] = {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1}, opposite = lattice_populations - 1 - i;
                int from[3];
                if (!neighbour(opposite, here, lattice.cells, lattice.periodic, from)) continue;
                const unsigned source = lattice.at(from[0], from[1], from[2]);
                if (owners[source].now >= 0) continue;
                const float in_ = after[i * cells + at] - moving_population(i, u),
                            out = after[opposite * cells + source] - moving_population(opposite, u);
                for (int a = 0; a < 3; ++a) j[a] += link_push(in_, out, static_cast<float>(c[a]), u[a]);
            }
        }
        if (comes || leaves) {
            float m[lattice_moments];
            load_moments(before, lattice.count, at, m);
            const float density = 1 + m[0] + (comes ? divergence_of(cube) : 0);
            float part = -1;  // of a cell that it leaves
            if (comes) part = handed ? covered_share : 1;
            for (int a = 0; a < 3; ++a) j[a] += part * (m[1 + a] - density * u[a]);
        }
        for (int a = 0; a < 3; ++a) {
            sums[a] += j[a];
            for (int b = 0; b < 3; ++b) sums[3 + 3 * a + b] += static_cast<double>(j[a]) * in.xi[b];
        }
    });
    const unsigned lane = threadIdx.x % warp;
    double own = 0;
    for (int k = 0; k < push_numbers; ++k) {
        double sum = sums[k];
        for (unsigned other = warp / 2; other > 0; other /= 2) sum += __shfl_xor_sync(all, sum, other);
        if (lane == static_cast<unsigned>(k)) own = sum;
    }
    if (lane < push_numbers) step.to_host[p * push_numbers + lane] = own;
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

/// Makes the steps of all waters of a GPU, those together that are asked for at the same time.
class Stepper {
public:
    /// The GPU's, which all waters there share. `device` is the current one.
    static std::shared_ptr<Stepper> of(int device);

    void make(const Step& step) { combiner_.run(step); }

private:
    static void launch(const std::vector<const Step*>& steps, cudaStream_t stream);

    static constexpr int places = 2;
    cuda::Stream streams_[places];  ///< one group's steps begin while another's are under way
    Combiner<Step> combiner_{max_steps, places, [this](const std::vector<const Step*>& steps, int one) {
                                 launch(steps, streams_[one].get());
                             }};
};

std::shared_ptr<Stepper> Stepper::of(int device) {
    static std::mutex mutex;
    static std::map<int, std::weak_ptr<Stepper>> all;
    const std::lock_guard lock(mutex);
    std::shared_ptr<Stepper> found = all[device].lock();
    if (!found) all[device] = found = std::make_shared<Stepper>();
    return found;
}

void Stepper::launch(const std::vector<const Step*>& all, cudaStream_t stream) {
    Steps steps;
    unsigned cells = 0, cubes = 0;
    bool with_eddies = false, without = false, begun = false;
    for (std::size_t k = 0; k < all.size(); ++k) {
        const Step& step = steps.of[k] = *all[k];
        cells = std::max(cells, step.lattice.count);
        cubes = std::max(cubes, static_cast<unsigned>(step.count));
        begun = begun || step.begun;
        (step.rates.eddies > 0 ? with_eddies : without) = true;
    }
    const auto size = static_cast<unsigned>(all.size());
    const dim3 by_cell(blocks_of(cells), size), by_cube(blocks_of(cubes * warp), size);
    if (cubes > 0) hold<<<by_cube, block, 0, stream>>>(steps);
    if (cubes > 0 && begun) cover<<<by_cube, block, 0, stream>>>(steps);
    if (without) advance_cells<false><<<by_cell, block, 0, stream>>>(steps);
    if (with_eddies) advance_cells<true><<<by_cell, block, 0, stream>>>(steps);
    if (cubes > 0) push<<<by_cube, block, 0, stream>>>(steps);
    cuda::check(cudaGetLastError(), "launch");
    cuda::check(cudaStreamSynchronize(stream), "lattice");
}

/// Keeps the populations that have come to each cell. What a body's cells are told, and what its cubes are given, is
/// found by kernels.
class GpuWater : public Water {
public:
    GpuWater(const Box& box, int device);

    void advance(const std::vector<Cube>& cubes, double step, std::vector<Push>& pushes) override;
    void shift(const Eigen::Vector3i& by) override;
    Cell cell(const Eigen::Vector3i& at) const override;
    std::vector<Eigen::Vector4f> cells() const override;
    void set_cell(const Eigen::Vector3i& at, const Cell& cell) override;
    void set_cells(const Cell& all) override;
    void save(ByteWriter& to) const override;
    void restore(ByteReader from) override;

private:
    /// Chooses a device before anything is made there.
    struct Chosen {
        explicit Chosen(int device) { cuda::choose_device(device); }
    };
    void choose() const { cuda::check(cudaSetDevice(device_), "choose device"); }
    void wait() const { cuda::check(cudaStreamSynchronize(stream_.get()), "lattice"); }
    float* now() const { return populations_[now_].data(); }
    float* next() const { return populations_[1 - now_].data(); }
    float* at(const Eigen::Vector3i& place) const { return now() + lattice_.at(place.x(), place.y(), place.z()); }
    Keys keys_around(const std::vector<Cube>& cubes);

    int device_;
    Chosen chosen_{device_};
    std::shared_ptr<Stepper> stepper_ = Stepper::of(device_);
    Lattice lattice_;
    cuda::Stream stream_;  ///< for all but steps
    cuda::DeviceBuffer<float> populations_[2];
    cuda::DeviceBuffer<Owners> owners_[2];    ///< the second is for shifts
    cuda::DeviceBuffer<Key> keys_;            ///< nobody's between steps
    cuda::DeviceBuffer<Handover> handovers_;  ///< by key; none between steps
    cuda::DeviceBuffer<Cube> cubes_;
    cuda::HostBuffer<Cube> cubes_on_host_;
    cuda::HostBuffer<Push> pushes_;
    int now_ = 0;
    bool begun_ = false;  ///< else the water in bodies begins with their velocity
    CellRange around_{};  ///< the bodies of the last step
};

GpuWater::GpuWater(const Box& box, int device) : Water(box), device_(device) {
    const auto count = static_cast<std::size_t>(box.cells.cast<double>().prod());
    if (count > std::numeric_limits<int>::max()) throw std::bad_alloc();  // more than any GPU has room for
    lattice_.count = static_cast<unsigned>(count);
    for (int a = 0; a < 3; ++a) {
        lattice_.cells[a] = box.cells[a];
        for (int end = 0; end < 2; ++end) lattice_.faces[a][end] = box.faces[a][end];
        lattice_.periodic[a] = box.faces[a][0] == Face::periodic;
    }
    for (auto& populations : populations_) populations = cuda::DeviceBuffer<float>(lattice_populations * count);
    for (auto& owners : owners_) owners = cuda::DeviceBuffer<Owners>(count);
    populations_[now_].clear();
    cuda::check(cudaMemset(owners_[0].data(), 0xff, count * sizeof(Owners)), "clear");
    cuda::wait_for_uploads();
}

Keys GpuWater::keys_around(const std::vector<Cube>& cubes) {
    constexpr float far = std::numeric_limits<float>::infinity();
    Cube all{};
    float low[3] = {far, far, far}, high[3] = {-far, -far, -far};
    for (const Cube& cube : cubes)
        for (int a = 0; a < 3; ++a) {
            low[a] = std::min(low[a], cube.x[a] - cube.reach[a]);
            high[a] = std::max(high[a], cube.x[a] + cube.reach[a]);
        }
    for (int a = 0; a < 3; ++a) all.x[a] = (low[a] + high[a]) / 2, all.reach[a] = (high[a] - low[a]) / 2 + 1;
    const bool none[3] = {};
    const CellRange last = around_;
    around_ = cubes.empty() ? CellRange{} : cells_around(all, lattice_.cells, none);
    for (int a = 0; a < 3; ++a)
        if (lattice_.periodic[a] && !cubes.empty()) around_.low[a] = 0, around_.count[a] = lattice_.cells[a];
    if (around_.size() == 0) around_ = {};
    CellRange both = around_.size() > 0 ? around_ : last;
    if (around_.size() > 0 && last.size() > 0)
        for (int a = 0; a < 3; ++a) {
            both.low[a] = std::min(around_.low[a], last.low[a]);
            both.count[a] = std::max(around_.low[a] + around_.count[a], last.low[a] + last.count[a]) - both.low[a];
        }
    const auto size = static_cast<std::size_t>(both.size());
    if (keys_.size() < size) {
        keys_ = {};
        handovers_ = {};
        keys_ = cuda::DeviceBuffer<Key>(std::min<std::size_t>(size + size / 2, lattice_.count));
        handovers_ = cuda::DeviceBuffer<Handover>(keys_.size());
        cuda::check(cudaMemsetAsync(keys_.data(), 0xff, keys_.size() * sizeof(Key), stream_.get()), "clear");
        cuda::check(cudaMemsetAsync(handovers_.data(), 0, handovers_.size() * sizeof(Handover), stream_.get()),
                    "clear");
        wait();
    }
    return {both, keys_.data(), handovers_.data()};
}

void GpuWater::advance(const std::vector<Cube>& cubes, double step, std::vector<Push>& pushes) {
    choose();
    const int count = static_cast<int>(cubes.size());
    const Keys keys = keys_around(cubes);
    if (cubes_.size() < cubes.size()) {
        cubes_ = cuda::DeviceBuffer<Cube>(cubes.size());
        cubes_on_host_ = cuda::HostBuffer<Cube>(cubes.size());
        pushes_ = cuda::HostBuffer<Push>(cubes.size());
    }
    std::ranges::copy(cubes, cubes_on_host_.data());
    stepper_->make({.lattice = lattice_,
                    .rates = rates_in(step),
                    .inflow = inflow(step),
                    .keys = keys,
                    .from = now(),
                    .to = next(),
                    .from_host = reinterpret_cast<const float*>(cubes_on_host_.data()),
                    .cubes = cubes_.data(),
                    .owners = owners_[0].data(),
                    .to_host = reinterpret_cast<double*>(pushes_.data()),
                    .count = count,
                    .begun = begun_});
    now_ = 1 - now_;
    begun_ = true;
    pushes.assign(pushes_.data(), pushes_.data() + count);
}

void GpuWater::shift(const Eigen::Vector3i& by) {
    choose();
    shift_cells<<<blocks_of(lattice_.count), block, 0, stream_.get()>>>(lattice_, now(), next(), owners_[0].data(),
                                                                        owners_[1].data(), by.x(), by.y(), by.z());
    cuda::check(cudaGetLastError(), "launch");
    wait();
    now_ = 1 - now_;
    std::swap(owners_[0], owners_[1]);
    for (int a = 0; a < 3; ++a) {
        const int low = std::max(around_.low[a] - by[a], 0);
        around_.count[a] = std::max(std::min(around_.low[a] + around_.count[a] - by[a], lattice_.cells[a]) - low, 0);
        around_.low[a] = low;
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
    read_cells<<<blocks_of(lattice_.count), block, 0, stream_.get()>>>(lattice_, now(), read.data());
    cuda::check(cudaGetLastError(), "launch");
    std::vector<Eigen::Vector4f> all(lattice_.count);
    static_assert(sizeof(Eigen::Vector4f) == sizeof(float4));
    cuda::check(
        cudaMemcpyAsync(all.data(), read.data(), all.size() * sizeof(float4), cudaMemcpyDeviceToHost, stream_.get()),
        "download");
    wait();
    return all;
}

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
    fill_cells<<<blocks_of(lattice_.count), block, 0, stream_.get()>>>(lattice_, in_equilibrium(all), now());
    cuda::check(cudaGetLastError(), "launch");
    wait();
}

void GpuWater::save(ByteWriter& to) const {
    choose();
    to.add(lattice_populations);
    to.add(begun_);
    for (int a = 0; a < 3; ++a) to.add(around_.low[a]), to.add(around_.count[a]);
    to.add_all(std::span<const float>(populations_[now_].download()));
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
    populations_[now_].upload(populations);
    owners_[0].upload(owners);
    cuda::wait_for_uploads();
    begun_ = begun;
    around_ = around;
}

}  // namespace

std::unique_ptr<Water> Water::on_gpu(const Box& box, int device) {
    return std::make_unique<GpuWater>(box, device);
}

}  // namespace natator::lattice
