#pragma once

#include <vector>

#include <Eigen/Dense>

namespace natator::bench {

/// A slender body like a larva of a zebrafish, whose midline bends by a travelling wave: bending and lengths as Müller and
/// van Leeuwen (2004) measured them, see larva.cpp. It is given in a frame of its own: straight it lies along x, the nose at
/// the origin and the tail at -length; it bends in the plane of x and z.
class Larva {
public:
    /// `thinnest`: that it is half as thick at least everywhere, length.
    Larva(double length, double frequency, double thinnest);

    double length() const { return length_; }
    double frequency() const { return frequency_; }
    double beat() const { return 1 / frequency_; }  ///< s

    /// Whether the straight body holds this place.
    bool holds(const Eigen::Vector3d& x) const;
    /// Where places of the straight body are at time t, s. The wave grows from nothing in the first beat.
    std::vector<Eigen::Vector3d> bent(const std::vector<Eigen::Vector3d>& straight, double time) const;

private:
    double length_, frequency_, thinnest_;
};

/// f A / U against the Reynolds number U L / nu, A the tail's beat from side to side: of larvae that swim (van Leeuwen, Voesenek,
/// Müller, 2015), 2.5 at Re 60 and 0.72 at Re 1400, as a power of Re between.
double strouhal_of_larvae(double reynolds);
/// The Reynolds number that this line gives where f A L / nu is so much.
double reynolds_of_larvae(double beating);

}  // namespace natator::bench
