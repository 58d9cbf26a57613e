#pragma once

#include <memory>
#include <optional>

#include "base/byte_reader.h"
#include "base/byte_writer.h"
#include "natator/gait.h"
#include "natator/model.h"
#include "natator/solver.h"

namespace natator {

namespace physics {
struct LawLimits;
struct LawMeasures;
}  // namespace physics

/// What a State has come to by the measures of physics/laws.h. No energies in scheme `flex`.
template <class Real>
physics::LawMeasures measure_laws(const Model& model, const State<Real>& state);

/// The part that a run has used of what it may come to, see physics::LawLimits: a law is broken above 1.
struct LawMargins {
    double particle_energy = 0, energy = 0, depth = 0, reach = 0, compression = 0;
    double largest() const;
};

/// Watches that a run keeps to laws of mechanics that no water and no body can break: nobody is behind a plane, no
/// particle has more energy than gravity and muscles can give it, all together have no more than they began with and
/// muscles gave (scheme `conserving`), no body is stretched to several times its length, no fluid compressed to a
/// fraction of its volume. One for each run, in one thread at a time.
class LawWatch {
public:
    /// Watches a run that begins where the model does, with muscles at rest.
    explicit LawWatch(const Model& model);
    ~LawWatch();
    LawWatch(const LawWatch& other);
    LawWatch(LawWatch&&) noexcept;
    LawWatch& operator=(LawWatch&&) noexcept;

    /// Muscles are driven by a gait, too, from here on.
    void drive_by(const Gait& gait);
    /// Muscles are driven by whatever, too: they may move a body by its length in a frame.
    void drive_freely();

    /// Looks at the start of the frames, once it has settled. The energy counts from here.
    std::optional<Instability> start(const physics::LawMeasures& measures);
    /// Looks at the end of a frame. `work`: of the muscles since `start` (Solver::muscle_work), mass length^2/s^2;
    /// `time`: s.
    std::optional<Instability> look(const physics::LawMeasures& measures, double work, double time);
    /// Looks at the mean of max(density - 1, 0) over the fluid, in rest densities.
    std::optional<Instability> look_at_compression(double mean_excess, double time);
    /// The run goes on from what it has come to in another model: that is allowed, and energy counts from here.
    void go_on(const physics::LawMeasures& measures);
    /// The tank has moved: energy counts anew, from the end of the next frame; not that of a weightless body on a
    /// lattice, which no water takes along.
    void restart();

    /// What it has come to, besides what its model says.
    void save(ByteWriter& to) const;
    /// Takes what `save` of a watch of the same model wrote. Throws InputError where there is none, and then nothing
    /// has changed.
    void restore(ByteReader& from);

    /// The limits that hold now, without what they grow by with time.
    const physics::LawLimits& limits() const;
    /// The largest parts so far.
    const LawMargins& margins() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

/// The broken law of compression, at `time` (s), if `mean_excess`, the mean of max(density - 1, 0) over the fluid in
/// rest densities, is too large; else none.
std::optional<Instability> broken_by_compression(double mean_excess, double time);

/// The law that water in scheme `lattice` breaks, if it does: cells are finite, slower than sound and not compressed or
/// thinned to a fraction of their volume. What has exploded takes some frames to reach a body. `time`: of the State, s.
template <class Real>
std::optional<Instability> broken_by_water(const Model& model, const Solver<Real>& solver, double time);

/// Gravity without its part along periodic axes, length/s^2: what falls along those comes back to where it was.
Eigen::Vector3d bounded_gravity(const Model& model);

}  // namespace natator
