#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Dense>

namespace natator::fields {
struct Place;
}

namespace natator::bench {

/// A number along the body, by the distance from the nose in parts of the length: a polynomial, or a table with
/// straight lines between its points and their values beyond them.
struct Profile {
    std::vector<double> polynomial;
    std::vector<Eigen::Vector2d> table;

    double at(double s) const;
    bool given() const { return !polynomial.empty() || !table.empty(); }
};

/// A displacement of a body's places that repeats each beat, in lengths, by the place x, y, z from the nose of the
/// straight body.
struct Deformation {
    /// T_i(1 + 2x) y^j z^k, Chebyshev's of the first kind, and what it is multiplied with: constant, cos and sin of
    /// once, cos and sin of twice a beat.
    struct Term {
        Eigen::Vector3i order;
        std::vector<Eigen::Vector3d> by;
    };
    std::vector<Term> terms;

    std::vector<Eigen::Vector3d> of(const std::vector<Eigen::Vector3d>& places, double beats) const;
};

/// A body whose shape is given as a function of time. Straight it lies along x, the nose at the origin and the tail at
/// -length; it bends in the plane of x and z. Its midline keeps its length, its sections stay plane, turn with it and
/// keep their shape. Lengths are in parts of the body's, times in beats.
struct Swimmer {
    Profile half_width, half_height;  ///< ellipses
    bool square = false;              ///< rectangles instead
    bool slab = false;                ///< spans the box along y instead: plane flow
    /// It goes on along x without end, in copies: its places move across and turn with the midline, which becomes
    /// longer, and the body as a whole doesn't turn.
    bool endless = false;
    /// What the wave is of: of curvature, or of lateral displacement, as a function of the distance along the midline,
    /// or of that along the axis from which it is measured.
    enum class Wave { curvature, displacement, axial_displacement } wave = Wave::curvature;
    Profile amplitude;
    double scale = 1;             ///< of the amplitude
    double waves = 1;             ///< along the body: amplitude * sin 2 pi (t - waves s)
    Profile phase;                ///< if given, in place of waves s, beats
    Deformation deformation;      ///< if given, in place of the midline
    std::string ramp = "cosine";  ///< how it grows: "cosine" and "sine" in the first beat, "tanh" as tanh pi t
    double viscosity = 0.001;     ///< length^2/beat
    std::optional<double> towed;  ///< at this speed, length/beat; else it moves freely

    /// Whether the straight body of this length holds this place. Its sections' half axes are longer by `wider`, then
    /// nowhere less than `thinnest`.
    bool holds(const Eigen::Vector3d& x, double length, double thinnest, double wider = 0) const;
    /// Outward from its surface where this place of the straight body is on it, of length 1; else from a body of the
    /// same form that is smaller there. 0 on the midline. Of the outline in `holds`.
    Eigen::Vector3d normal(const Eigen::Vector3d& x, double length, double wider) const;
    /// Where places of the straight body are after so many beats.
    std::vector<Eigen::Vector3d> bent(const std::vector<Eigen::Vector3d>& straight, double length, double beats) const;

private:
    /// Half width and height of a section.
    Eigen::Vector2d half_axes(double s, double length, double wider) const;
    double grown(double beats) const;
    double bending(double s, double beats) const;
    double slope(double s, double ds, double beats) const;
    friend void read_midline(const nlohmann::json& midline, const fields::Place& place, Swimmer& swimmer);
};

/// What is measured of a swimmer, and what targets are of.
const std::vector<std::string>& swim_quantities();

/// What a figure of a swimmer should be.
struct SwimTarget {
    std::string quantity;  ///< one of swim_quantities()
    std::string variant;   ///< of this one; empty: of each
    std::string over;      ///< if not empty: the exponent of `quantity` as a power of this one over all variants
    std::string zero_of;   ///< if not empty: `quantity` where this one is 0, between variants
    std::optional<double> reference;
    double least, greatest;
    bool confirmed = false;  ///< the figure was seen in the source or a text that cites it
};

/// A file of references/swimmers, as its README.md tells.
struct SwimCase {
    std::string name;
    Swimmer base;
    std::vector<std::pair<std::string, Swimmer>> variants;  ///< by name; without any the base, nameless
    std::vector<SwimTarget> targets;
};

/// By its name, or by its path if that ends in `.json`. Throws InputError.
SwimCase read_swim_case(const std::string& name);
SwimCase swim_case_from_json(const nlohmann::json& document, const std::string& name);
std::vector<std::string> swim_case_names();

}  // namespace natator::bench
