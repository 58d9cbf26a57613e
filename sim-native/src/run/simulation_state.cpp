// Simulation::save and restore: the format of a saved moment.
#include <bit>
#include <cstring>

#include "base/byte_reader.h"
#include "base/byte_writer.h"
#include "base/strict_json.h"
#include "base/text.h"
#include "model/check_gait.h"
#include "model/check_model.h"
#include "model/model_key.h"
#include "natator/error.h"
#include "natator/evaluate.h"
#include "natator/version.h"
#include "simulation_run.h"

namespace natator {
namespace {

static_assert(std::endian::native == std::endian::little, "states are written as numbers are in memory");

/// A saved moment begins with these letters and the number of all its bytes, and ends with their checksum.
constexpr std::string_view letters{"natator state\0\0\0", 16};
constexpr std::size_t head_size = letters.size() + sizeof(std::uint64_t), tail_size = sizeof(std::uint64_t);

/// As FNV-1a, by words of 8 bytes; what is left of the last one counts as filled up with zeros.
std::uint64_t checksum(std::string_view bytes) {
    std::uint64_t sum = 0xcbf29ce484222325;
    for (std::size_t at = 0; at < bytes.size(); at += sizeof(std::uint64_t)) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data() + at, std::min(sizeof word, bytes.size() - at));
        sum = (sum ^ word) * 0x100000001b3;
    }
    return sum;
}

[[noreturn]] void refuse_saved(const std::string& what) {
    throw InputError("state: " + what);
}

void add_gait(ByteWriter& to, const Gait& gait) {
    const auto& [frequency, amplitude, phase, power, offset] = gait;
    to.add(frequency), to.add(amplitude), to.add(phase), to.add(power), to.add(offset);
}
void read_gait(ByteReader& from, Gait& gait) {
    auto& [frequency, amplitude, phase, power, offset] = gait;
    from.read(frequency), from.read(amplitude), from.read(phase), from.read(power), from.read(offset);
}

void add_steering(ByteWriter& to, const Steering& steering) {
    to.add(steering.scale), to.add(steering.offset);
}
void read_steering(ByteReader& from, Steering& steering) {
    from.read(steering.scale), from.read(steering.offset);
}

template <class Real>
void add_particles(ByteWriter& to, const State<Real>& state) {
    const auto& [position, velocity, rotation, centre, rest_length, origin, time] = state;
    to.add(position), to.add(velocity), to.add(rotation), to.add(centre), to.add(rest_length), to.add(origin),
        to.add(time);
}
template <class Real>
void read_particles(ByteReader& from, State<Real>& state) {
    auto& [position, velocity, rotation, centre, rest_length, origin, time] = state;
    from.read(position), from.read(velocity), from.read(rotation), from.read(centre), from.read(rest_length),
        from.read(origin), from.read(time);
}

bool same_overrides(const std::string& a, const std::string& b) {
    const auto parsed = [](const std::string& text) { return parse_json(text.empty() ? "{}" : text, "overrides"); };
    return a == b || parsed(a) == parsed(b);
}

/// What stands between head and tail, of bytes that are whole.
std::string_view content_of(std::string_view saved) {
    if (saved.size() < letters.size() || !saved.starts_with(letters))
        refuse_saved("is no saved state; must be a STAT body, as save sends it");
    std::uint64_t size = 0, sum = 0;
    if (saved.size() >= head_size) std::memcpy(&size, saved.data() + letters.size(), sizeof size);
    if (saved.size() < head_size + tail_size || saved.size() < size)
        refuse_saved("is cut off: has " + std::to_string(saved.size()) + " bytes" +
                     (size > 0 ? " of " + std::to_string(size) : ""));
    const std::string_view covered = saved.substr(0, saved.size() - tail_size);
    std::memcpy(&sum, saved.data() + covered.size(), sizeof sum);
    if (saved.size() != size || sum != checksum(covered)) refuse_saved("is damaged: its checksum is another");
    return covered.substr(head_size);
}

}  // namespace

/// What `save` writes, read.
template <class Real>
struct Simulation<Real>::Moment {
    SimulationSetup setup;
    std::uint64_t digest = 0;
    State<Real> state;
    std::optional<std::vector<Real>> densities;
    int frames = 0, base_frame = 0;
    double base_time = 0;
    // By swimmer; `read` reads those of the first, the others' stand behind the laws.
    std::vector<double> start_x{0}, earlier_work{0};
    std::vector<Steering> steering{{}}, applied{{}};
    std::string solver;
    std::string_view laws;  ///< and what stands behind them
};

template <class Real>
std::uint64_t Simulation<Real>::digest(Run& run) const {
    if (!run.digest) {
        ByteWriter key;
        key.add(model_key(run.model));
        if (const auto& tank = run.scene.moving_tank) {
            key.add(tank->along_z);
            key.add(tank->step);
            key.add(tank->current);
        }
        run.digest = checksum(key.bytes());
    }
    return *run.digest;
}

template <class Real>
std::string Simulation<Real>::save() {
    if (instability_) refuse_saved("the simulation is unstable; must be saved before that");
    ByteWriter to;
    to.add_all(std::span(letters));
    to.add(std::uint64_t{0});
    to.add(std::string(NATATOR_VERSION));
    to.add(std::uint32_t{sizeof(Real)});
    to.add(std::string(to_string(model().scheme)));
    to.add(setup_.scene);
    to.add(digest(*run_));
    to.add(setup_.overrides);
    to.add(setup_.start.has_value());
    to.add(setup_.start.value_or(0));
    add_gait(to, gait());
    add_particles(to, state_);
    to.add(updated_);
    if (updated_) to.add(densities());
    for (const int frame : {frames_, base_frame_}) to.add(frame);
    for (const double value : {base_time_, start_x_[0], earlier_work_[0]}) to.add(value);
    add_steering(to, steering_[0]), add_steering(to, applied_[0]);
    to.add(run_->solver.save());
    run_->laws.save(to);
    for (int k = 1; k < model().swimmers(); ++k) {
        add_gait(to, gait(k));
        to.add(start_x_[k]), to.add(earlier_work_[k]);
        add_steering(to, steering_[k]), add_steering(to, applied_[k]);
    }
    std::string bytes = to.take();
    bytes.resize((bytes.size() + 7) / 8 * 8, '\0');
    const std::uint64_t size = bytes.size() + tail_size;
    std::memcpy(bytes.data() + letters.size(), &size, sizeof size);
    const std::uint64_t sum = checksum(bytes);
    bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
    return bytes;
}

template <class Real>
auto Simulation<Real>::read(std::string_view saved) const -> Moment {
    ByteReader from(content_of(saved));
    Moment moment;
    std::string version, scheme;
    std::uint32_t real_bytes = 0;
    from.read(version);
    if (version != NATATOR_VERSION)
        refuse_saved("of version " + natator::quoted(version) + "; must be of " + NATATOR_VERSION);
    from.read(real_bytes);
    if (real_bytes != sizeof(Real))
        refuse_saved(std::string("in precision ") + (real_bytes == sizeof(double) ? "double" : "float") +
                     "; must be that which runs, " + (sizeof(Real) == sizeof(double) ? "double" : "float"));
    from.read(scheme);
    if (scheme != to_string(model().scheme))
        refuse_saved("of scheme " + scheme + "; must be that which runs, " + to_string(model().scheme));
    from.read(moment.setup.scene);
    from.read(moment.digest);
    from.read(moment.setup.overrides);
    bool flag = false;
    int start = 0;
    from.read(flag);
    from.read(start);
    if (flag) moment.setup.start = start;
    read_gait(from, moment.setup.gait.emplace());
    read_particles(from, moment.state);
    from.read(flag);
    if (flag) from.read(moment.densities.emplace());
    for (int* frame : {&moment.frames, &moment.base_frame}) from.read(*frame);
    for (double* value : {&moment.base_time, &moment.start_x[0], &moment.earlier_work[0]}) from.read(*value);
    read_steering(from, moment.steering[0]), read_steering(from, moment.applied[0]);
    from.read(moment.solver);
    moment.laws = from.left();
    return moment;
}

template <class Real>
bool Simulation<Real>::restore(std::string_view saved, const ModelCheck& check) {
    Moment moment = read(saved);
    SimulationSetup next = setup_;
    next.overrides = moment.setup.overrides;
    next.start = moment.setup.start;
    next.gait = moment.setup.gait;
    const bool same_scene = same_overrides(next.overrides, setup_.overrides) && next.start == setup_.start;
    const std::string of_another = "of scene " + natator::quoted(moment.setup.scene) +
                                   "; must be of the scene that runs, " + natator::quoted(setup_.scene) +
                                   ", with the same content";
    std::unique_ptr<Run> made;
    if (!same_scene) {
        try {
            made = make_run(next);
        } catch (const InputError&) {
            refuse_saved(of_another);
        }
    }
    Run& run = made ? *made : *run_;
    if (digest(run) != moment.digest) refuse_saved(of_another);
    if (check) check(run.model);
    const int particles = run.model.particles();
    check_state(run.model, moment.state);
    if (moment.densities && moment.densities->size() != static_cast<std::size_t>(particles)) refuse_saved(of_another);
    if (moment.base_frame < 0 || moment.frames < moment.base_frame) refuse_saved("its frames are not from 0 on");
    ByteReader laws(moment.laws);
    LawWatch watch = run.laws;
    watch.restore(laws);
    std::vector<Gait> company(run.model.companions.size());
    for (Gait& gait : company) {
        read_gait(laws, gait);
        laws.read(moment.start_x.emplace_back()), laws.read(moment.earlier_work.emplace_back());
        read_steering(laws, moment.steering.emplace_back()), read_steering(laws, moment.applied.emplace_back());
    }
    for (int k = 0; k < run.model.swimmers(); ++k) {
        const Gait& gait = k == 0 ? *next.gait : company[k - 1];
        const int actuators = run.model.actuators_of(k);
        check_gait(gait, actuators);
        for (const auto* list : {&moment.steering, &moment.applied}) check_steering((*list)[k], gait, actuators);
    }
    run.solver.restore(moment.solver);

    const bool changed = !same_scene || *next.gait != gait() || company != company_;
    if (made) run_ = std::move(made);
    run_->laws = std::move(watch);
    if (run_->follower) run_->follower->set_origin(moment.state.origin);
    setup_ = std::move(next);
    state_ = std::move(moment.state);
    updated_ = moment.densities.has_value();
    restored_densities_ = std::move(moment.densities);
    frames_ = moment.frames;
    base_frame_ = moment.base_frame;
    base_time_ = moment.base_time;
    start_x_ = std::move(moment.start_x);
    earlier_work_ = std::move(moment.earlier_work);
    steering_ = std::move(moment.steering);
    applied_ = std::move(moment.applied);
    company_ = std::move(company);
    instability_.reset();
    return changed;
}

template std::uint64_t Simulation<float>::digest(Simulation<float>::Run&) const;
template Simulation<float>::Moment Simulation<float>::read(std::string_view) const;
template std::uint64_t Simulation<double>::digest(Simulation<double>::Run&) const;
template Simulation<double>::Moment Simulation<double>::read(std::string_view) const;
template std::string Simulation<float>::save();
template std::string Simulation<double>::save();
template bool Simulation<float>::restore(std::string_view, const ModelCheck&);
template bool Simulation<double>::restore(std::string_view, const ModelCheck&);

}  // namespace natator
