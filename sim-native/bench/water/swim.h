#pragma once

#include <deque>

#include "water/free_motion.h"
#include "water/swimmer.h"
#include "water/water_tank.h"

namespace natator::bench {

/// How a swimmer is put into the tank.
struct SwimScene {
    double length = water_length;          ///< of the body
    double beat = 2;                       ///< s
    Eigen::Vector3d box{2.3, 0.8, 1.2};    ///< of the body's length
    double gravity = 5;                    ///< length/s^2: enough for the water to follow the tail
};

/// Where a body's centre and its tail's end were.
struct Track {
    std::vector<Eigen::Vector3d> centre, tail;

    /// Of the tail, from side to side of the centre's way, or along z if it has none.
    double beat(const Eigen::Vector3d& side) const;
};

/// Keeps a body on its course along x and in the middle: every beat throws it off by a degree or so; it is turned back slowly, by
/// what it does in the mean over a beat.
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

/// A swimmer in a box of water that goes along with it.
template <class Real>
class Swim {
public:
    Swim(const Swimmer& swimmer, const SwimScene& scene, const WaterSetting& setting);

    long frames_per_beat() const { return frames_per_beat_; }
    /// False if the water is unstable.
    bool frame();
    /// As WaterTank's.
    [[nodiscard]] bool set_kinematic_viscosity(double viscosity) { return tank_.set_kinematic_viscosity(viscosity); }
    WaterRun run() const { return tank_.run(); }

    double time() const { return time_; }  ///< s
    const FreeMotion& motion() const { return motion_; }
    Eigen::Vector3d centre() const { return motion_.centre() + Eigen::Vector3d(shifted_, 0, 0); }
    Eigen::Vector3d tail() const { return motion_.places()[tail_] + Eigen::Vector3d(shifted_, 0, 0); }
    double drift() const { return helm_.drift(); }
    /// Of the water's on the body along x in the last frame, mass length/s^2, and what the body gave the water, mass length^2/s^3. A
    /// particle of water has mass 1.
    double force() const { return force_; }
    double power() const { return power_; }
    double spacing() const { return spacing_; }

private:
    void immerse(Model& model);
    std::vector<Eigen::Vector3d> places_of_body() const;
    void set_off(double h);
    void arrive(const std::vector<Vector3<Real>>& forces, double h);
    void move_box_along();

    double spacing_;
    Swimmer swimmer_;
    SwimScene scene_;
    Eigen::Vector3i count_;
    Eigen::Vector3d start_;  ///< of the nose
    std::vector<int> body_;  ///< its particles
    WaterTank<Real> tank_;
    FreeMotion motion_;
    std::vector<Eigen::Vector3d> straight_, velocities_;  ///< of the body's particles; straight_: as Swimmer has them
    std::size_t tail_ = 0;                                ///< the rearmost of them
    long frames_per_beat_;
    Helm helm_;
    double time_ = 0, bending_time_ = 0;  ///< s
    double towed_ = 0;                    ///< how far
    double shifted_ = 0, unshifted_ = 0;  ///< how far the box was moved along, and has still to be
    double force_ = 0, power_ = 0;
};

extern template class Swim<float>;
extern template class Swim<double>;

/// f A / U against the Reynolds number U L / nu, A the tail's beat from side to side: of larvae that swim (van Leeuwen, Voesenek,
/// Müller, 2015), 2.5 at Re 60 and 0.72 at Re 1400, as a power of Re between.
double strouhal_of_larvae(double reynolds);
/// The Reynolds number that this line gives where f A L / nu is so much.
double reynolds_of_larvae(double beating);

}  // namespace natator::bench
