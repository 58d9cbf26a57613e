#pragma once

#include <limits>
#include <vector>

#include "cube_cells.h"
#include "physics/vec3.h"
#include "solver/cuda/device.h"
#include "solver/cuda/host_buffer.h"
#include "solver/cuda/stream.h"
#include "water.h"

namespace natator::lattice {

/// Who has a cell: how far out it is in the cube, as bits, which sort like numbers above 0, then the cube.
using Key = unsigned long long;

/// Whose a cell is and was in the last step; -1: nobody's.
struct Owners {
    int now, before;
};

/// What a cell has to do with water that bodies come to cover: nothing; it is covered and gives of its surplus to its
/// neighbours, so much by weight; it takes from such.
struct Handover {
    enum { none, gives, takes } role;
    float surplus[3];
};

/// What pushes a cube, summed as whole numbers: the same bits in any order.
struct PushSums {
    static constexpr double unit = 1.0 / (1ll << 40);  ///< of the momentum of a cell at 1 cell/step
    static constexpr double most = 16;                 ///< that a cell adds: more is no water

    unsigned long long sum[12];  ///< numbers as Push has them
    unsigned long long bad;      ///< whether something had no number, or too large a one

    static NATATOR_HD constexpr int moment(int a, int b) { return 3 + 3 * a + b; }
#if defined(__CUDACC__)
    __device__ void add(int number, double value) {
        if (fabs(value) < most)
            atomicAdd(sum + number, static_cast<unsigned long long>(__double2ll_rn(value / unit)));
        else
            bad = 1;
    }
#endif
    NATATOR_HD double operator[](int number) const {
        return bad != 0 ? std::numeric_limits<double>::quiet_NaN()
                        : unit * static_cast<double>(static_cast<long long>(sum[number]));
    }
    Push push() const {
        Push all;
        for (int a = 0; a < 3; ++a) {
            all.j[a] = (*this)[a];
            for (int b = 0; b < 3; ++b) all.moment[3 * a + b] = (*this)[moment(a, b)];
        }
        return all;
    }
};

/// A water and its bodies in device memory, as steps take and leave them.
struct WaterOnGpu {
    /// As cells send them out, at open ends with what comes in there; those of now are number steps % 2.
    float* populations[2];
    Owners* owners;
    Key* keys;                        ///< by cell; nobody's between steps
    Handover* handovers;              ///< by cell; none between steps
    Cube* cubes;                      ///< of bodies, then of obstacles
    PushSums* pushes;                 ///< by cube
    physics::Vec3<double>* impulses;  ///< by particle of the bodies, mass length/s: see Coupling
    physics::Vec3<double>* forces;    ///< sums of them by cube, null unless asked for
    CellRange last, around;           ///< the cells around all cubes of the last step; of these and those before
    unsigned long long fastest;       ///< the greatest speed of a particle so far, cells/step, as bits, and ~particle
    int steps;                        ///< so far; in the first one the water in bodies begins with their velocity
    int goes_on;                      ///< 0: steps leave it as it is
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
    NATATOR_HD void place(unsigned at, int (&to)[3]) const {
        CellRange{{0, 0, 0}, {cells[0], cells[1], cells[2]}}.place(at, to);
    }
};
/// Throws std::bad_alloc if no GPU has room for so many cells.
Lattice lattice_of(const Box& box);

/// What a step is for all waters of a box.
struct LatticeStep {
    Lattice lattice;
    physics::LatticeRates rates;
    Populations inflow;
    int cubes, warps;         ///< and warps to find the cells of each
    unsigned threads_around;  ///< for the cells around all of them
};
/// Of so long, s, with as many cubes as these, which are about as large.
LatticeStep lattice_step(const Box& box, double h, const std::vector<Cube>& cubes);
/// Asks for a step of so many waters.
void launch_step(const LatticeStep& step, WaterOnGpu* waters, int count, cudaStream_t stream);

/// That a cell takes: populations, owners and the room for shifts of both, a key and what is handed over.
constexpr std::size_t bytes_of_cell =
    2 * physics::lattice_populations * sizeof(float) + 2 * sizeof(Owners) + sizeof(Key) + sizeof(Handover);

/// A water in memory of a GPU.
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

    /// At rest, as it was made.
    void begin();
    /// Room for so many cubes; these are the last ones, and stay there.
    void make_room(int cubes, const std::vector<Cube>& last);
    /// Of the host: what steps begin with, and what those that others launch have left.
    WaterOnGpu& on_gpu() { return on_gpu_; }

private:
    /// Chooses a device before anything is made there.
    struct Chosen {
        explicit Chosen(int device) { cuda::choose_device(device); }
    };
    void choose() const { cuda::check(cudaSetDevice(device_), "choose device"); }
    void wait() const { cuda::check(cudaStreamSynchronize(stream_.get()), "lattice"); }
    cuda::DeviceBuffer<float>& now() { return populations_[on_gpu_.steps % 2]; }
    const cuda::DeviceBuffer<float>& now() const { return populations_[on_gpu_.steps % 2]; }
    /// Of so many cells from one on: density less that at rest, of that at rest, and velocity, cells/step.
    std::vector<Eigen::Vector4f> read_from(unsigned first, unsigned count) const;
    /// Makes as many the same.
    void fill_from(unsigned first, unsigned count, const Cell& with);
    void point_to_buffers();

    int device_;
    Chosen chosen_{device_};
    Lattice lattice_;
    cuda::Stream stream_;
    cuda::DeviceBuffer<float> populations_[2];
    cuda::DeviceBuffer<Owners> owners_[2];  ///< the second is for shifts
    cuda::DeviceBuffer<Key> keys_;
    cuda::DeviceBuffer<Handover> handovers_;
    cuda::DeviceBuffer<Cube> cubes_;
    cuda::DeviceBuffer<PushSums> pushes_;
    cuda::DeviceBuffer<WaterOnGpu> own_step_{1};
    WaterOnGpu on_gpu_{};
};

}  // namespace natator::lattice
