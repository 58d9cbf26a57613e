#include "water/swimmer_study.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "natator/error.h"
#include "natator/evaluate.h"
#include "water/lattice_swim.h"

namespace natator::bench {
namespace {

constexpr double slab_height = 0.25;  ///< of the box of particles, of the body's length

using Figures = std::map<std::string, double>;

/// Water in its box: on a lattice at this Mach number, else of particles.
struct Pool {
    double box;
    std::optional<double> mach, pressure;
    WaterSetting water;
};

/// What a beat gave, in lengths and beats.
struct Beat {
    double speed = 0, lateral = 0, force = 0, power = 0;
    double pressure = 0, thrust = 0;  ///< on a lattice
};

struct SwimResult {
    WaterRun run;
    std::vector<Beat> beats;
    double tail_beat = 0;  ///< in the counted beats
    long steps = 0;        ///< in a beat
    bool viscous = false;
};

/// `height`: of a slab, in lengths.
template <class AnySwim>
void follow(AnySwim& swim, const Swimmer& swimmer, const SwimScene& scene, double height, const SwimmerStudy& study,
            SwimResult& swum) {
    const SwimBody& body = swim.body();
    const double length = scene.length, beat = scene.beat;
    const double mass =
        std::pow(length / swim.spacing(), 3) * (swimmer.slab ? height : 1);  // of a cubic length of water
    const auto frames = static_cast<double>(body.frames_per_beat());
    Track counted;
    for (int k = 0; k < study.beats; ++k) {
        const Eigen::Vector3d from = body.centre();
        Beat sum;
        for (long f = 0; f < body.frames_per_beat(); ++f) {
            if (!swim.frame()) {
                swum.run = swim.run();
                return;
            }
            sum.force += body.force() / frames / mass * beat * beat / length;
            if constexpr (requires { swim.pressure(); }) {
                const double unit = frames * mass * length / (beat * beat);
                sum.pressure += swim.pressure() / unit;
                sum.thrust += (std::max(0.0, swim.pressure()) + std::max(0.0, body.force() - swim.pressure())) / unit;
            }
            sum.power += body.power() / frames / mass * std::pow(beat, 3) / (length * length);
            if (k < study.beats - study.counted) continue;
            counted.centre.push_back(body.centre());
            counted.tail.push_back(body.tail());
        }
        const Eigen::Vector3d way = (body.centre() - from) / length;
        sum.speed = way.x();
        sum.lateral = way.z();
        swum.beats.push_back(sum);
    }
    swum.run = swim.run();
    swum.tail_beat = counted.beat(Eigen::Vector3d::UnitZ()) / length;
}

template <class Real>
SwimResult swim_among_particles(const Swimmer& swimmer, const SwimmerStudy& study, const Pool& pool) {
    SwimScene scene;
    scene.box *= pool.box;
    if (swimmer.slab) scene.box.y() = slab_height;
    const double length = scene.length, beat = scene.beat;
    scene.gravity = 2 * *pool.pressure / scene.box.y() * length / (beat * beat);
    Swim<Real> swim(swimmer, scene, pool.water);
    SwimResult swum;
    swum.steps = swim.body().frames_per_beat() * pool.water.solver.substeps;
    swum.viscous = !swim.set_kinematic_viscosity(swimmer.viscosity * length * length / beat);
    if (swum.viscous)
        swum.run = swim.run();
    else
        follow(swim, swimmer, scene, scene.box.y(), study, swum);
    return swum;
}

SwimResult swim_on_lattice(const Swimmer& swimmer, const SwimmerStudy& study, const Pool& pool) {
    const int resolution = pool.water.resolution;
    SwimScene scene;
    scene.box = pool.box * Eigen::Vector3d(4, 1, 2);
    LatticeSwim swim(swimmer, scene, resolution, *pool.mach, pool.water.gpu);
    SwimResult swum;
    swum.steps = swim.body().frames_per_beat();
    follow(swim, swimmer, scene, 1.0 / resolution, study, swum);
    return swum;
}

bool only_on_lattice(const std::string& quantity) {
    return quantity == "pressure_force" || quantity == "thrust";
}

/// The columns that tell a row from others, empty where its water has no such thing.
Row key_of(const SwimCase& one, const std::string& variant, const SwimmerStudy& study, const Pool& pool) {
    const WaterSetting& water = pool.water;
    const Setting& solver = water.solver;
    const auto number = [](const std::optional<double>& value) { return value ? number_text(*value) : ""; };
    Row key{one.name,
            variant,
            std::to_string(water.resolution),
            number_text(pool.box),
            number(pool.pressure),
            std::to_string(study.beats),
            pool.mach ? "lattice" : to_string(solver.scheme),
            to_string(solver.precision),
            water.gpu ? "cuda" : "cpu"};
    if (pool.mach)
        key = joined_rows(key, Row(5));
    else
        key = joined_rows(
            key, {std::to_string(solver.substeps), std::to_string(solver.iterations),
                  yes_or_no(solver.modified_pressure), number_text(water.support), std::to_string(water.start)});
    key.push_back(number(pool.mach));
    return key;
}

Figures figures_of(const SwimResult& swum, const Swimmer& swimmer, int counted) {
    const auto mean = [&](double Beat::* of) {
        double sum = 0;
        for (auto beat = swum.beats.end() - counted; beat != swum.beats.end(); ++beat) sum += (*beat).*of / counted;
        return sum;
    };
    const double speed = swimmer.towed.value_or(mean(&Beat::speed));
    double square = 0;
    for (auto beat = swum.beats.end() - counted; beat != swum.beats.end(); ++beat)
        square += std::pow(beat->speed - speed, 2);
    return {{"speed", speed},
            {"spread", counted > 1 ? std::sqrt(square / (counted - 1)) : 0},
            {"lateral", mean(&Beat::lateral)},
            {"slip", speed * std::abs(swimmer.waves)},
            {"tail_beat", swum.tail_beat},
            {"strouhal", swum.tail_beat / std::abs(speed)},
            {"reynolds", std::abs(speed) / swimmer.viscosity},
            {"swimming_number", std::numbers::pi * swum.tail_beat / swimmer.viscosity},
            {"amplitude", swimmer.scale},
            {"force", mean(&Beat::force)},
            {"power", mean(&Beat::power)},
            {"pressure_force", mean(&Beat::pressure)},
            {"thrust", mean(&Beat::thrust)}};
}

Row judged(double value, const SwimTarget& target) {
    const bool compared = target.reference && *target.reference != 0;
    return {target.reference ? measured_text(*target.reference) : "",
            compared ? measured_text(value / *target.reference - 1) : "",
            yes_or_no(target.least <= value && value <= target.greatest), yes_or_no(target.confirmed)};
}

void run_one(const SwimCase& one, const std::pair<std::string, Swimmer>& variant, const SwimmerStudy& study,
             const Pool& pool, ResultTable& table, ResultTable& beats,
             const std::function<void(const std::string&)>& report) {
    const Swimmer& swimmer = variant.second;
    const Row key = key_of(one, variant.first, study, pool);
    if (table.has(key)) return;
    const SwimResult swum =
        pool.mach ? swim_on_lattice(swimmer, study, pool) : in_precision(pool.water.solver.precision, [&](auto real) {
            return swim_among_particles<decltype(real)>(swimmer, study, pool);
        });
    for (std::size_t k = 0; k < swum.beats.size(); ++k) {
        const Beat& beat = swum.beats[k];
        Row row = joined_rows(key, {std::to_string(k + 1)});
        if (beats.has(row)) continue;
        beats.add(joined_rows(row, {measured_text(beat.speed), measured_text(beat.lateral), measured_text(beat.force),
                                    measured_text(beat.power)}));
    }
    double widest = 0;
    for (const Eigen::Vector2d& point : swimmer.half_width.table) widest = std::max(widest, 2 * point.y());
    const bool ok = !swum.viscous && !swum.run.instability;
    Figures figures;
    if (ok) figures = figures_of(swum, swimmer, study.counted);
    Row row = joined_rows(key, {ok             ? "ok"
                                : swum.viscous ? "too viscous"
                                               : "unstable",
                                measured_text(widest * pool.water.resolution), std::to_string(swum.steps),
                                number_text(swimmer.viscosity)});
    for (const std::string& name : swim_quantities())
        row.push_back(ok && (pool.mach || !only_on_lattice(name)) ? measured_text(figures[name]) : "");
    row = joined_rows(row, {std::to_string(swum.run.particles), measured_text(swum.run.seconds)});
    const auto target = std::ranges::find_if(one.targets, [&](const SwimTarget& of) {
        return of.over.empty() && of.zero_of.empty() && (of.variant.empty() || of.variant == variant.first);
    });
    row = joined_rows(row, ok && target != one.targets.end() ? judged(figures[target->quantity], *target) : Row(4));
    table.add(row);
    report(joined(row, " "));
}

std::vector<Pool> pools_of(const SwimmerStudy& study, int resolution, double box) {
    std::vector<Pool> pools;
    for (const double pressure : study.pressures)
        for (const Setting& setting : study.settings)
            for (const double support : study.supports)
                for (const int start : study.starts)
                    pools.push_back({box, {}, pressure, {setting, resolution, study.gpu, support, start}});
    for (const double mach : study.machs)
        pools.push_back({box, mach, {}, {.solver = {}, .resolution = resolution, .gpu = study.gpu}});
    return pools;
}

/// By least squares, of |y| as a power of x.
double exponent(const std::vector<Eigen::Vector2d>& points) {
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    std::vector<Eigen::Vector2d> logs;
    for (const Eigen::Vector2d& point : points)
        logs.emplace_back(std::log(std::abs(point.x())), std::log(std::abs(point.y())));
    for (const Eigen::Vector2d& point : logs) mean += point / static_cast<double>(logs.size());
    double along = 0, across = 0;
    for (const Eigen::Vector2d& point : logs) {
        along += std::pow(point.x() - mean.x(), 2);
        across += (point.x() - mean.x()) * (point.y() - mean.y());
    }
    return across / along;
}

/// y where x changes its sign; NaN where it does not.
double at_zero(std::vector<Eigen::Vector2d> points) {
    std::ranges::sort(points, {}, [](const Eigen::Vector2d& point) { return point.y(); });
    for (std::size_t k = 1; k < points.size(); ++k) {
        const Eigen::Vector2d &a = points[k - 1], &b = points[k];
        if (a.x() * b.x() <= 0 && a.x() != b.x()) return a.y() + a.x() / (a.x() - b.x()) * (b.y() - a.y());
    }
    return std::nan("");
}

}  // namespace

Row swimmer_columns() {
    Row columns =
        joined_rows(fields("case,variant,resolution,box,pressure,beats,scheme,precision,backend,substeps,iterations,"
                           "modified_pressure,support,start,mach,status,across,steps,viscosity"),
                    swim_quantities());
    return joined_rows(columns, {"particles", "run_time", "reference", "deviation", "met", "confirmed"});
}

Row swimmer_beat_columns() {
    Row columns = swimmer_columns();
    columns.resize(swimmer_key_columns);
    return joined_rows(columns, {"beat", "speed", "lateral", "force", "power"});
}

void run_swimmer_study(const SwimmerStudy& study, ResultTable& table, ResultTable& beats,
                       const std::function<void(const std::string&)>& report) {
    std::vector<SwimCase> cases;
    for (const std::string& name : study.cases) {
        cases.push_back(read_swim_case(name));
        if (std::ranges::count(cases, cases.back().name, &SwimCase::name) > 1)
            throw InputError(name + ": another case is named \"" + cases.back().name +
                             "\" too; must have a name of its own");
    }
    for (const SwimCase& one : cases)
        for (const int resolution : study.resolutions)
            for (const double box : study.boxes)
                for (const Pool& pool : pools_of(study, resolution, box))
                    for (const auto& variant : one.variants) {
                        if (variant.second.endless && !pool.mach) {
                            report(one.name + " is endless: not in scheme conserving");
                            break;
                        }
                        run_one(one, variant, study, pool, table, beats, report);
                        if (study.quick) break;
                    }
}

ResultTable swimmer_targets(const SwimmerStudy& study, const ResultTable& table) {
    const Row columns = swimmer_columns();
    const auto column = [&](const std::string& name) { return std::ranges::find(columns, name) - columns.begin(); };
    Row header(columns.begin(), columns.begin() + swimmer_key_columns);
    header = joined_rows(header, {"quantity", "over", "zero_of", "value", "least", "greatest", "reference", "deviation",
                                  "met", "confirmed"});
    ResultTable targets("", header, swimmer_key_columns + 3);
    std::vector<SwimCase> cases;
    for (const std::string& name : study.cases) cases.push_back(read_swim_case(name));
    for (const std::string& name : swim_case_names())  // rows of an earlier run
        if (std::ranges::count(cases, name, &SwimCase::name) == 0) cases.push_back(read_swim_case(name));
    for (const SwimCase& one : cases) {
        for (const SwimTarget& target : one.targets) {
            const bool of_each = target.over.empty() && target.zero_of.empty();
            std::map<Row, std::vector<Eigen::Vector2d>> groups;
            for (const Row& row : table.rows()) {
                if (row[0] != one.name || row[column("status")] != "ok") continue;
                if (!target.variant.empty() && row[1] != target.variant) continue;
                Row key(row.begin(), row.begin() + swimmer_key_columns);
                if (!of_each) key[1] = "all";
                const std::string& x = target.over.empty() ? target.zero_of : target.over;
                const std::string &at = of_each ? "0" : row[column(x)], &value = row[column(target.quantity)];
                if (!at.empty() && !value.empty()) groups[key].emplace_back(std::stod(at), std::stod(value));
            }
            for (const auto& [key, points] : groups) {
                if (!of_each && points.size() < 2) continue;
                const double value = of_each ? points[0].y() : target.over.empty() ? at_zero(points) : exponent(points);
                const Row limits{measured_text(value), measured_text(target.least), measured_text(target.greatest)};
                const Row name = joined_rows(key, {target.quantity, target.over, target.zero_of});
                targets.add(joined_rows(joined_rows(name, limits), judged(value, target)));
            }
        }
    }
    return targets;
}

}  // namespace natator::bench
