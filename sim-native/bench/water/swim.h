#pragma once

#include <deque>

#include "water/free_motion.h"
#include "water/swimmer.h"
#include "water/water_tank.h"

namespace natator::bench {

/// How a swimmer is put into the tank.
struct SwimScene {
    double length = water_length;        ///< of the body
    double beat = 2;                     ///< s
    Eigen::Vector3d box{2.3, 0.8, 1.2};  ///< of the body's length
    double gravity = 5;                  ///< length/s^2: enough for the water to follow the tail
};

/// Where a body's centre and its tail's end were.
struct Track {
    std::vector<Eigen::Vector3d> centre, tail;

    /// Of the tail, from side to side of the centre's way, or along z if it has none.
    double beat(const Eigen::Vector3d& side) const;
};

/// Keeps a body on its course along x and in the middle: every beat throws it off by a degree or so; it is turned back
/// slowly, by what it does in the mean over a beat.
class Helm {
public:
    explicit Helm(long frames_per_beat) : size_(static_cast<std::size_t>(frames_per_beat)) {}

    /// The rate to turn by, 1/s, after a frame; `out`: from the middle, along z, of the length.
    double rate(double angle, double out);
    double drift() const { return drift_; }  ///< the most, of the length

private:
    std::size_t size_;
    std::deque<Eigen::Vector2d> seen_;
    double drift_ = 0;
};

/// A swimmer in a box of water that goes along with it: what is the same in any water. A frame is what the water is
/// looked at by.
class SwimBody {
public:
    /// Particles of mass 1 at `places`, straight; `nose`: where its nose is.
    SwimBody(const Swimmer& swimmer, const SwimScene& scene, const Eigen::Vector3d& nose,
             std::vector<Eigen::Vector3d> places, double frame, double kept);

    long frames_per_beat() const { return frames_per_beat_; }
    void begin_frame();
    /// A step of h, s, begins: the body bends on. Velocities of its particles.
    const std::vector<Eigen::Vector3d>& set_off(double h);
    /// It is over; `forces` are the water's, by particle.
    void arrive(const std::vector<Eigen::Vector3d>& forces, double h);
    /// How far the box is to be moved along now, in whole spacings: not until the body has gone `far`, of the length.
    double end_frame(double spacing, double far);

    double time() const { return time_; }  ///< s, of whole frames
    const std::vector<Eigen::Vector3d>& places() const { return motion_.places(); }
    const Eigen::Vector3d& velocity() const { return motion_.velocity(); }
    double drift() const { return helm_.drift(); }
    Eigen::Vector3d centre() const { return motion_.centre() + Eigen::Vector3d(shifted_, 0, 0); }
    Eigen::Vector3d tail() const { return motion_.places()[tail_] + Eigen::Vector3d(shifted_, 0, 0); }
    /// Of the water's on the body along x in the last frame, mass length/s^2, and what the body gave the water, mass
    /// length^2/s^3.
    double force() const { return force_; }
    double power() const { return power_; }

private:
    Swimmer swimmer_;
    SwimScene scene_;
    Eigen::Vector3d start_;  ///< of the nose
    double frame_;
    long frames_per_beat_;
    FreeMotion motion_;
    std::vector<Eigen::Vector3d> straight_, velocities_;  ///< straight_: as Swimmer has them
    std::size_t tail_ = 0;                                ///< the rearmost
    Helm helm_;
    double time_ = 0, bending_time_ = 0;  ///< s
    double towed_ = 0;                    ///< how far
    double shifted_ = 0, unshifted_ = 0;  ///< how far the box was moved along, and has still to be
    double before_ = 0;                   ///< the frame: the centre's x
    double force_ = 0, power_ = 0;
};

/// A swimmer in a tank of particles.
template <class Real>
class Swim {
public:
    Swim(const Swimmer& swimmer, const SwimScene& scene, const WaterSetting& setting);

    const SwimBody& body() const { return *body_; }
    double spacing() const { return spacing_; }  ///< a particle of water has mass 1
    /// False if the water is unstable.
    bool frame();
    /// As WaterTank's.
    [[nodiscard]] bool set_kinematic_viscosity(double viscosity) { return tank_.set_kinematic_viscosity(viscosity); }
    WaterRun run() const { return tank_.run(); }

private:
    double spacing_;
    Eigen::Vector3i count_;
    Eigen::Vector3d start_;  ///< of the nose
    std::vector<int> held_;  ///< the body's particles
    WaterTank<Real> tank_;
    std::optional<SwimBody> body_;
};

extern template class Swim<float>;
extern template class Swim<double>;

/// f A / U against the Reynolds number U L / nu, A the tail's beat from side to side: of larvae that swim (van Leeuwen,
/// Voesenek, Müller, 2015), 2.5 at Re 60 and 0.72 at Re 1400, as a power of Re between.
double strouhal_of_larvae(double reynolds);
/// The Reynolds number that this line gives where f A L / nu is so much.
double reynolds_of_larvae(double beating);

}  // namespace natator::bench
