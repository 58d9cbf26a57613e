#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "base/text.h"
#include "curve.h"
#include "profile_slices.h"
#include "readers.h"

namespace natator::fields {
namespace {

constexpr int max_profile_slices = 10000;
constexpr int max_across = 1000;    // particles
constexpr double on_border = 1e-9;  // slices: a part that is written in decimals lies in the slice that begins there
constexpr Range extent{0, 1000, false, "length"};

struct Fin {
    Curve height;
    double thickness;
};

/// Where a body's slices are, and how large, in parts of its length and in spacings.
struct Lattice {
    int slices;
    double spacing;

    double part(int slice) const { return (slice + 0.5) / slices; }
};

Lattice read_lattice(const json& value, const Place& place, double spacing) {
    double length = 0;
    read(required(value, place, "length"), place.key("length"), {0, 1000, true, "length"}, length);
    const double slices = std::round(length / spacing);
    if (slices < 2 || slices > max_profile_slices) {
        refuse(place.key("length"), value.at("length"),
               "2 to " + std::to_string(max_profile_slices) + " spacings of " + number_text(spacing));
    }
    return {static_cast<int>(slices), spacing};
}

std::optional<Fin> read_fin(const json& profile, const Place& place, const Lattice& lattice) {
    if (!has(profile, "fin")) return std::nullopt;
    const json& value = profile.at("fin");
    const Place at = place.key("fin");
    check_keys(value, at, {"height", "thickness"});
    const json& height = required(value, at, "height");
    if (!height.is_array()) refuse(at.key("height"), height, "a curve from where the fin begins to 1");
    Fin fin{read_curve(height, at.key("height"), extent, 1, 1), lattice.spacing};
    const double latest = lattice.part(lattice.slices - 1), earliest = lattice.part(0);
    if (!(fin.height.first() > earliest && fin.height.first() <= latest)) {
        refuse(at.key("height").item(0).item(0), height[0][0],
               "more than " + computed_text(earliest) + " and at most " + computed_text(latest) +
                   " of the length, where the first and the last slice are: a fin has a body before it and a slice of "
                   "its own");
    }
    if (value.contains("thickness")) {
        read(value.at("thickness"), at.key("thickness"), extent, fin.thickness);
        if (fin.thickness < lattice.spacing / 2 || fin.thickness > max_across * lattice.spacing) {
            refuse(at.key("thickness"), value.at("thickness"),
                   "half a spacing of " + number_text(lattice.spacing) + " to " + std::to_string(max_across) +
                       " spacings");
        }
    }
    return fin;
}

/// A section's height or width, in spacings: two particles at least.
double across(const Curve& curve, const Place& place, const Lattice& lattice, int slice) {
    const double value = curve.at(lattice.part(slice));
    const double spacings = value / lattice.spacing;
    if (spacings >= min_across && spacings <= max_across) return spacings;
    std::ostringstream text;
    text << computed_text(value) << " at " << lattice.part(slice) << " of the length, slice " << slice << " of "
         << lattice.slices << ": ";
    if (spacings < min_across)
        text << "thinner than two particles across; must be at least " << computed_text(min_across * lattice.spacing)
             << ", " << min_across << " spacings";
    else
        text << "must be at most " << max_across << " spacings of " << number_text(lattice.spacing);
    refuse(place, text.str());
}

std::vector<Slice> read_sections(const json& value, const Place& place, const Lattice& lattice) {
    const std::optional<Fin> fin = read_fin(value, place, lattice);
    const double end = fin ? fin->height.first() : 1;
    const Curve height = read_curve(required(value, place, "height"), place.key("height"), extent, 0, end);
    const Curve width = read_curve(required(value, place, "width"), place.key("width"), extent, 0, end);
    std::vector<Slice> slices;
    for (int i = 0; i < lattice.slices; ++i) {
        if (fin && lattice.part(i) >= fin->height.first()) {
            const double tall = across(fin->height, place.key("fin").key("height"), lattice, i);
            slices.push_back(plate_slice(tall, fin->thickness / lattice.spacing));
        } else {
            const double tall = across(height, place.key("height"), lattice, i);
            slices.push_back(ellipse_slice(tall, across(width, place.key("width"), lattice, i)));
        }
    }
    return slices;
}

}  // namespace

std::vector<int> read_joint_parts(const json& value, const Place& place, int slices) {
    if (!value.is_array()) refuse(place, value, "an array of parts of the length");
    std::vector<int> joints;
    for (std::size_t i = 0; i < value.size(); ++i) {
        double part = 0;
        read(value[i], place.item(i), {0, 1, false, "part of the length"}, part);
        const int slice = std::min(static_cast<int>(part * slices + on_border), slices - 1);
        if (joints.empty() ? slice > 0 && slice < slices - 1 : slice > joints.back() && slice < slices - 1) {
            joints.push_back(slice);
            continue;
        }
        std::ostringstream text;
        text << "in a slice of its own behind ";
        if (joints.empty())
            text << "the first";
        else
            text << "slice " << joints.back() << ", that of the joint before";
        text << ", and not in the last; it is in slice " << slice << " of " << slices << ", numbered from 0";
        refuse(place.item(i), value[i], text.str());
    }
    return joints;
}

void read_profile(const json& value, const Place& place, Creature& creature) {
    check_keys(value, place, {"length", "height", "width", "fin", "joints"});
    const Lattice lattice = read_lattice(value, place, creature.spacing);
    creature.of_profile = true;
    creature.slices = read_sections(value, place, lattice);
    creature.joints = read_joint_parts(required(value, place, "joints"), place.key("joints"), lattice.slices);
}

}  // namespace natator::fields
