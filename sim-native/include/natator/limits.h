#pragma once

#include <cstddef>

/// Most that may be asked for, each refused with one line beyond it: no small request keeps a program busy for hours or
/// takes all memory. Two of them, `work` and memory, can be raised by the environment; see cost.h.
namespace natator::limits {

/// Bytes of a JSON document: a request, a scene file, a file of experiments.
inline constexpr std::size_t document_bytes = 16 << 20;
/// Bytes of requests that wait in `serve` before it reads on (and one request more).
inline constexpr std::size_t waiting_bytes = 64 << 20;
/// Bytes of all overrides that are in force in a stream.
inline constexpr std::size_t live_overrides_bytes = 1 << 20;

/// Particles of a scene: their numbers, and those of their neighbours, stay well within 32 bits.
inline constexpr long particles = 16'000'000;
/// Other swimmers in a scene, beside the first.
inline constexpr std::size_t companions = 64;
/// Springs of a creature; the largest of the thesis has 96. Some 100 bytes each.
inline constexpr long springs = 16'000'000;
/// Entries of all neighbour lists together: they are counted in 32 bits.
inline constexpr double neighbours = 2e9;
/// radius / fluid_rest_distance: the rest density is a sum over that many particles cubed, and fluid at rest has 3000
/// neighbours at a ratio of 8 already. Room for four times those at 20 is still counted in 32 bits.
inline constexpr int radius_ratio = 20;
/// kernel_support, rest distances of the fluid: in a kernel of fewer a particle has too few neighbours for a density;
/// the volume of a particle is a sum over the cube of so many.
inline constexpr double min_kernel_support = 2;
inline constexpr double max_kernel_support = 4;  ///< see min_kernel_support
/// Threads of a solver: they meet several times in each iteration, and more of them than processors only wait for each
/// other.
inline constexpr int threads = 1024;
/// Lattice points that are looked at when the fluid is kept clear of a body, a minute's worth.
inline constexpr double clearance_points = 1e10;

/// Time steps of an evaluation, or of a stream that has an end: they are counted in 32 bits, and a file of a path has a
/// line for each.
inline constexpr double time_steps = 1e7;
/// Visits of a pair of particles in one evaluation, an estimate that is rather too high (cost.h): a core does one to
/// two thousand million a second, so this is about an hour of one. 4 s of the thesis' tank are 3e9, of 10 million
/// particles 5e12. $NATATOR_MOST_WORK replaces it.
inline constexpr double work = 5e12;
/// Part of this machine's memory that one evaluation may take. $NATATOR_MOST_MEMORY (GiB) replaces it.
inline constexpr double part_of_memory = 0.9;
/// Frames that a stream must be able to compute within `work`.
inline constexpr double live_frames = 100;

/// Bytes of a mesh's file, its triangles, and pairs of them that are looked at for intersections, some seconds' worth.
inline constexpr std::size_t mesh_bytes = 64 << 20;
inline constexpr long mesh_faces = 200'000;        ///< see mesh_bytes
inline constexpr long mesh_pairs = 1'000'000'000;  ///< see mesh_bytes

/// Particles of which a settled start is kept in the cache of starts, whose files else fill the disk.
inline constexpr int cached_particles = 250'000;

}  // namespace natator::limits
