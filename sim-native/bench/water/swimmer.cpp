#include "water/swimmer.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/field.h"
#include "base/text.h"
#include "scene/data_files.h"

namespace natator::bench {

using fields::json;
using fields::Place;

namespace {

constexpr int parts = 400;  ///< of the midline that are summed
constexpr double turn = 2 * std::numbers::pi;
constexpr const char* kind = "references/swimmers";

std::vector<double> read_row(const json& value, const Place& place, std::size_t size, const fields::Range& range) {
    if (!value.is_array() || value.size() != size)
        fields::refuse(place, value, "an array of " + std::to_string(size) + " numbers");
    std::vector<double> row(size);
    for (std::size_t i = 0; i < size; ++i) fields::read(value[i], place.item(i), range, row[i]);
    return row;
}

/// Rows of s and `columns` numbers, ascending in s.
std::vector<std::vector<double>> read_table(const json& value, const Place& place, std::size_t columns,
                                            const fields::Range& range) {
    if (!value.is_array() || value.size() < 2) fields::refuse(place, value, "an array of two rows or more");
    std::vector<std::vector<double>> table;
    for (std::size_t i = 0; i < value.size(); ++i) {
        table.push_back(read_row(value[i], place.item(i), 1 + columns, range));
        const double s = table.back()[0];
        if (s < 0 || s > 1 || (i > 0 && s <= table[i - 1][0]))
            fields::refuse(place.item(i).item(0), value[i][0], "in [0, 1] and more than in the row before");
    }
    return table;
}

Profile column(const std::vector<std::vector<double>>& table, std::size_t k) {
    Profile profile;
    for (const auto& row : table) profile.table.emplace_back(row[0], row[k]);
    return profile;
}

Profile read_profile(const json& value, const Place& place) {
    const fields::Range range{-1000, 1000};
    if (value.is_array() && !value.empty() && value[0].is_number())
        return {read_row(value, place, value.size(), range), {}};
    return column(read_table(value, place, 1, range), 1);
}

/// Rows of 18: the orders in x, y and z, then by what three the term is multiplied at each of five functions of time.
Deformation read_deformation(const json& value, const Place& place) {
    if (!value.is_array() || value.empty()) fields::refuse(place, value, "an array of rows of 18 numbers");
    Deformation deformation;
    for (std::size_t i = 0; i < value.size(); ++i) {
        const std::vector<double> row = read_row(value[i], place.item(i), 18, {-1e6, 1e6});
        for (int a = 0; a < 3; ++a)
            if (row[a] < 0 || row[a] > 20 || row[a] != std::floor(row[a]))
                fields::refuse(place.item(i).item(a), value[i][a], "a whole number in [0, 20]");
        Deformation::Term term{Eigen::Vector3d(row[0], row[1], row[2]).cast<int>(), {}};
        for (std::size_t k = 3; k < 18; k += 3) term.by.emplace_back(row[k], row[k + 1], row[k + 2]);
        deformation.terms.push_back(term);
    }
    return deformation;
}

SwimTarget read_target(const json& value, const Place& place, const SwimCase& of) {
    struct Fields {
        std::string quantity, variant, over, zero_of, source;
        double reference = 0, within = 0, least = -std::numeric_limits<double>::infinity(),
               greatest = std::numeric_limits<double>::infinity();
        bool confirmed = false;
    } read;
    const fields::Range any{-1e6, 1e6};
    fields::read_object<Fields>(value, place,
                                {{"quantity", &Fields::quantity},
                                 {"variant", &Fields::variant},
                                 {"over", &Fields::over},
                                 {"zeroOf", &Fields::zero_of},
                                 {"reference", &Fields::reference, any},
                                 {"within", &Fields::within, {0, 10, true}},
                                 {"least", &Fields::least, any},
                                 {"greatest", &Fields::greatest, any},
                                 {"confirmed", &Fields::confirmed},
                                 {"source", &Fields::source}},
                                {}, read);
    for (const char* key : {"quantity", "confirmed", "source"}) fields::required(value, place, key);
    for (const char* key : {"quantity", "over", "zeroOf"})
        if (value.contains(key) && std::ranges::count(swim_quantities(), value[key].get<std::string>()) == 0)
            fields::refuse(place.key(key), value[key], "one of " + fields::listed(swim_quantities()));
    if (!read.variant.empty() &&
        std::ranges::none_of(of.variants, [&](const auto& one) { return one.first == read.variant; }))
        fields::refuse(place.key("variant"), value["variant"], "the name of a variant");
    SwimTarget target{read.quantity, read.variant,  read.over,     read.zero_of, {},
                      read.least,    read.greatest, read.confirmed};
    if (value.contains("reference")) {
        target.reference = read.reference;
        fields::required(value, place, "within");
        const double error = read.within * std::abs(read.reference);
        target.least = read.reference - error;
        target.greatest = read.reference + error;
    } else if (!value.contains("least") && !value.contains("greatest")) {
        fields::refuse(place, "needs reference and within, least or greatest");
    }
    return target;
}

}  // namespace

const std::vector<std::string>& swim_quantities() {
    static const std::vector<std::string> names{
        "speed",           "spread",    "lateral", "slip",  "tail_beat",      "strouhal", "reynolds",
        "swimming_number", "amplitude", "force",   "power", "pressure_force", "thrust"};
    return names;
}

double Profile::at(double s) const {
    if (table.empty()) {
        double value = 0;
        for (std::size_t k = polynomial.size(); k-- > 0;) value = value * s + polynomial[k];
        return value;
    }
    const auto next = std::ranges::find_if(table, [s](const Eigen::Vector2d& point) { return point.x() > s; });
    if (next == table.begin()) return table.front().y();
    if (next == table.end()) return table.back().y();
    const Eigen::Vector2d &a = *(next - 1), &b = *next;
    return a.y() + (s - a.x()) / (b.x() - a.x()) * (b.y() - a.y());
}

double Swimmer::grown(double beats) const {
    if (ramp == "tanh") return std::tanh(std::numbers::pi * beats);
    if (beats >= 1) return 1;
    return ramp == "sine" ? std::sin(std::numbers::pi * beats / 2) : (1 - std::cos(std::numbers::pi * beats)) / 2;
}

double Swimmer::bending(double s, double beats) const {
    return grown(beats) * scale * amplitude.at(s) *
           std::sin(turn * (beats - (phase.given() ? phase.at(s) : waves * s)));
}

double Swimmer::slope(double s, double ds, double beats) const {
    return (bending(s + ds / 2, beats) - bending(s - ds / 2, beats)) / ds;
}

Eigen::Vector2d Swimmer::half_axes(double s, double length, double wider) const {
    return {half_width.at(s) * length + wider, slab ? 0 : half_height.at(s) * length + wider};
}

bool Swimmer::holds(const Eigen::Vector3d& x, double length, double thinnest, double wider) const {
    const double s = -x.x() / length;
    if (s < 0 || (endless ? s >= 1 : s > 1)) return false;
    const Eigen::Vector2d half = half_axes(s, length, wider).cwiseMax(thinnest);
    if (slab) return std::abs(x.z()) <= half.x();
    if (square) return std::abs(x.z()) <= half.x() && std::abs(x.y()) <= half.y();
    return std::hypot(x.z() / half.x(), x.y() / half.y()) <= 1;
}

Eigen::Vector3d Swimmer::normal(const Eigen::Vector3d& x, double length, double wider) const {
    const auto out = [&](double along, double y, double z) {  // 1 on the surface
        const Eigen::Vector2d half = half_axes(std::clamp(-along / length, 0.0, 1.0), length, wider);
        if (slab) return std::abs(z) / half.x();
        return square ? std::max(std::abs(z) / half.x(), std::abs(y) / half.y())
                      : std::hypot(z / half.x(), y / half.y());
    };
    const double d = 1e-4 * length;
    const Eigen::Vector3d gradient(out(x.x() + d, x.y(), x.z()) - out(x.x() - d, x.y(), x.z()),
                                   out(x.x(), x.y() + d, x.z()) - out(x.x(), x.y() - d, x.z()),
                                   out(x.x(), x.y(), x.z() + d) - out(x.x(), x.y(), x.z() - d));
    return gradient.norm() > 0 ? gradient.normalized().eval() : gradient;
}

std::vector<Eigen::Vector3d> Deformation::of(const std::vector<Eigen::Vector3d>& places, double beats) const {
    const double once = turn * beats,
                 time[] = {1, std::cos(once), std::sin(once), std::cos(2 * once), std::sin(2 * once)};
    std::vector<Eigen::Vector3d> now;  // by term
    int most = 0;
    for (const Term& term : terms) {
        Eigen::Vector3d& sum = now.emplace_back(Eigen::Vector3d::Zero());
        for (std::size_t k = 0; k < term.by.size(); ++k) sum += time[k] * term.by[k];
        most = std::max(most, term.order.maxCoeff());
    }
    std::vector<Eigen::Vector3d> result, powers(most + 1, Eigen::Vector3d::Ones());
    for (const Eigen::Vector3d& place : places) {
        const double along = 1 + 2 * place.x();
        for (int i = 1; i <= most; ++i) powers[i] = powers[i - 1].cwiseProduct(place);
        for (int i = 1; i <= most; ++i)
            powers[i].x() = i == 1 ? along : 2 * along * powers[i - 1].x() - powers[i - 2].x();
        Eigen::Vector3d& sum = result.emplace_back(Eigen::Vector3d::Zero());
        for (std::size_t k = 0; k < terms.size(); ++k) {
            const Eigen::Vector3i& order = terms[k].order;
            sum += powers[order.x()].x() * powers[order.y()].y() * powers[order.z()].z() * now[k];
        }
    }
    return result;
}

std::vector<Eigen::Vector3d> Swimmer::bent(const std::vector<Eigen::Vector3d>& straight, double length,
                                           double beats) const {
    if (!deformation.terms.empty()) {
        std::vector<Eigen::Vector3d> places;
        for (const Eigen::Vector3d& at : straight) places.push_back(at / length);
        const std::vector<Eigen::Vector3d> moved = deformation.of(places, beats);
        for (std::size_t i = 0; i < places.size(); ++i) places[i] = straight[i] + length * grown(beats) * moved[i];
        return places;
    }
    const double ds = 1.0 / parts;
    std::vector<double> angle(parts + 1), x(parts + 1),
        z(parts + 1);  // of the midline, by its parts' ends; of the length
    // dz is the sine of the angle times the way along the midline, and its tangent times that along the axis: both keep
    // z and the length.
    const auto angle_at = [&](double s) {
        const double rise = slope(s, ds, beats);
        return wave == Wave::displacement ? std::asin(rise) : std::atan(rise);
    };
    if (wave != Wave::curvature) {
        z[0] = bending(0, beats);
        angle[0] = angle_at(0);
    }
    for (int k = 0; k < parts; ++k) {
        if (wave == Wave::curvature)
            angle[k + 1] = angle[k] + ds * bending((k + 0.5) * ds, beats);
        else
            angle[k + 1] =
                angle_at(wave == Wave::displacement || endless ? (k + 1) * ds : ds * std::cos(angle[k]) - x[k]);
        if (endless) {
            x[k + 1] = -(k + 1) * ds;
            z[k + 1] = bending((k + 1) * ds, beats);
            continue;
        }
        const double between = (angle[k] + angle[k + 1]) / 2;
        x[k + 1] = x[k] - ds * std::cos(between);
        z[k + 1] = z[k] + ds * std::sin(between);
    }
    std::vector<Eigen::Vector3d> places;
    for (const Eigen::Vector3d& at : straight) {
        const double s = std::clamp(-at.x() / length, 0.0, 1.0) * parts;
        const int k = std::min(static_cast<int>(s), parts - 1);
        const auto here = [&, part = s - k](const std::vector<double>& of) {
            return of[k] + part * (of[k + 1] - of[k]);
        };
        const double turned = here(angle);
        places.emplace_back(length * here(x) + at.z() * std::sin(turned), at.y(),
                            length * here(z) + at.z() * std::cos(turned));
    }
    return places;
}

void read_midline(const json& midline, const Place& place, Swimmer& swimmer) {
    fields::read_object<Swimmer>(midline, place,
                                 {{"scale", &Swimmer::scale, {0, 10}}, {"waves", &Swimmer::waves, {-10, 10}}},
                                 {"by", "amplitude", "phase", "ramp"}, swimmer);
    using Wave = Swimmer::Wave;
    swimmer.wave = fields::read_choice<Wave>(fields::required(midline, place, "by"), place.key("by"),
                                             {{"curvature", Wave::curvature},
                                              {"displacement", Wave::displacement},
                                              {"axial displacement", Wave::axial_displacement}});
    swimmer.amplitude = read_profile(fields::required(midline, place, "amplitude"), place.key("amplitude"));
    if (midline.contains("phase")) swimmer.phase = read_profile(midline["phase"], place.key("phase"));
    if (midline.contains("ramp"))
        swimmer.ramp = fields::read_choice<std::string>(midline["ramp"], place.key("ramp"),
                                                        {{"cosine", "cosine"}, {"sine", "sine"}, {"tanh", "tanh"}});
    const double ds = 1.0 / parts;
    for (int t = 0; t < 50 && swimmer.wave == Wave::displacement; ++t)
        for (int k = 0; k <= parts; ++k)
            if (!(std::abs(swimmer.slope(k * ds, ds, 9 + t / 50.0)) < 1))
                fields::refuse(place,
                               "rises by more than its length at s = " + number_text(k * ds) + "; must rise less");
}

Swimmer swimmer_from_json(const json& document, const std::string& name) {
    const Place top{name, ""};
    Swimmer swimmer;
    fields::read_object<Swimmer>(document, top,
                                 {{"slab", &Swimmer::slab},
                                  {"square", &Swimmer::square},
                                  {"endless", &Swimmer::endless},
                                  {"viscosity", &Swimmer::viscosity, {1e-6, 10}}},
                                 {"source", "outline", "midline", "deformation", "towed", "variants", "targets"},
                                 swimmer);
    for (const char* key : {"source", "viscosity"}) fields::required(document, top, key);
    std::string source;
    fields::read(document["source"], top.key("source"), {}, source);
    const auto outline =
        read_table(fields::required(document, top, "outline"), top.key("outline"), swimmer.slab ? 1 : 2, {0, 1});
    swimmer.half_width = column(outline, 1);
    if (!swimmer.slab) swimmer.half_height = column(outline, 2);
    if (document.contains("deformation"))
        swimmer.deformation = read_deformation(document["deformation"], top.key("deformation"));
    else
        read_midline(fields::required(document, top, "midline"), top.key("midline"), swimmer);
    if (swimmer.endless && !(swimmer.slab && swimmer.wave == Swimmer::Wave::axial_displacement))
        fields::refuse(top.key("endless"), "is for a slab with a midline by axial displacement");
    if (document.contains("towed")) {
        double speed = 0;
        fields::read(document["towed"], top.key("towed"), {0, 10, false, "lengths/beat"}, speed);
        swimmer.towed = speed;
    }
    return swimmer;
}

SwimCase swim_case_from_json(const json& document, const std::string& name) {
    const Place top{name, ""};
    if (!document.is_object()) fields::refuse(top, document, "an object");
    if (name.find_first_of(",\n\r") != std::string::npos)
        fields::refuse(top, "has a comma or a line break in its name; must have none");
    SwimCase result{std::filesystem::path(name).stem().string(), {}, {}, {}};
    json base = document;
    base.erase("variants");
    base.erase("targets");
    const json variants = document.value("variants", json::object());
    if (!variants.is_object()) fields::refuse(top.key("variants"), variants, "an object");
    result.base = swimmer_from_json(base, name);
    if (variants.empty()) result.variants.emplace_back("", result.base);
    for (const auto& [variant, patch] : variants.items()) {
        if (variant.find_first_of(",\n\r") != std::string::npos)
            fields::refuse(top.key("variants"), variant, "without a comma or a line break");
        json patched = base;
        patched.merge_patch(patch);
        result.variants.emplace_back(variant, swimmer_from_json(patched, name + " (" + variant + ")"));
    }
    const json targets = document.value("targets", json::array());
    if (!targets.is_array()) fields::refuse(top.key("targets"), targets, "an array");
    for (std::size_t i = 0; i < targets.size(); ++i)
        result.targets.push_back(read_target(targets[i], top.key("targets").item(i), result));
    return result;
}

SwimCase read_swim_case(const std::string& name) {
    return swim_case_from_json(read_data_file(kind, name), name);
}

std::vector<std::string> swim_case_names() {
    return data_file_names(kind);
}

}  // namespace natator::bench
