#include "stream_batch.h"

#include <algorithm>
#include <optional>

#include "base/side_by_side.h"
#include "base/strict_json.h"
#include "base/text.h"
#include "commands.h"
#include "natator/error.h"
#include "protocol/protocol.h"

namespace natator::cli {
namespace {

using nlohmann::json;

constexpr std::size_t nobody = UINT32_MAX;  ///< in place of a swim, before a message of none

json parse_command(const std::string& line) {
    if (line.size() > stream::max_command) throw InputError("command: longer than 1 MiB");
    return parse_json(line, "command");
}

}  // namespace

template <class Real>
StreamBatch<Real>::StreamBatch(const SimulationSetup& setup, const Execution& execution, const StreamSettings& settings,
                               BatchSize size)
    : size_(size),
      together_(execution.shared != nullptr),
      swims_(static_cast<std::size_t>(size.swims)),
      waiting_(swims_.size()) {
    const auto make = [&](std::size_t i) {
        swims_[i] = std::make_unique<StreamSession<Real>>(setup, execution, settings);
    };
    make(0);  // which keeps the start for the others
    Swims others;
    for (std::size_t i = 1; i < swims_.size(); ++i) others.push_back(i);
    at_once(others, make);
}

template <class Real>
template <class Work>
void StreamBatch<Real>::at_once(const Swims& swims, const Work& work) {
    if (swims.size() == 1) return work(swims.front());
    side_by_side(swims.size(), [&](std::size_t k) { work(swims[k]); }, static_cast<std::size_t>(size_.threads));
}

template <class Real>
template <class Test>
auto StreamBatch<Real>::those(const Test& test) const -> Swims {
    Swims found;
    for (std::size_t i = 0; i < swims_.size(); ++i)
        if (test(i)) found.push_back(i);
    return found;
}

template <class Real>
void StreamBatch<Real>::restore(const std::string& saved) {
    for (auto& swim : swims_) swim->restore(saved);
}

template <class Real>
void StreamBatch<Real>::run(LineQueue& commands) {
    for (auto& swim : swims_) swim->begin();
    for (;;) {
        for (const std::string& line : commands.take_waiting()) take(line);
        carry_out_waiting();
        for (auto& swim : swims_) swim->offer();
        write();
        const bool ended = std::all_of(swims_.begin(), swims_.end(), [](const auto& swim) { return swim->ended(); });
        if (ended || commands.exhausted()) return;
        std::optional<LineQueue::Clock::time_point> next;
        for (const auto& swim : swims_)
            if (const auto own = swim->next_frame(); own && (!next || *own < *next)) next = own;
        const auto now = LineQueue::Clock::now();
        if (!next)
            commands.wait();
        else if (now < *next)
            commands.wait_until(*next);
        else
            at_once(those([&](std::size_t i) {
                        const auto own = swims_[i]->next_frame();
                        return own && *own <= now;
                    }),
                    [this](std::size_t i) { swims_[i]->go_on(); });
    }
}

/// What stands in the input before a message is done before it.
template <class Real>
void StreamBatch<Real>::take(const std::string& line) {
    if (line.starts_with(stream::state_letters)) {
        carry_out_waiting();
        const auto state =
            std::make_shared<const std::string>(line.substr(std::min(line.size(), stream::message_head)));
        for (auto& swim : swims_) swim->hold(state);
        return;
    }
    if (line.starts_with(stream::action_letters)) {
        carry_out_waiting();
        return act(line);
    }
    if (line.size() <= stream::max_command && line.find_first_not_of(" \t\r") == std::string::npos) return;
    json id;
    try {
        json command = parse_command(line);
        id = request_id(command);
        hand_over(std::move(command));
        if (single()) carry_out_waiting();  // each answer at once; several swims go on at the same time
    } catch (const InputError& error) {
        refuse(id, error.what());
    }
}

/// To the swim that it names, or to all.
template <class Real>
void StreamBatch<Real>::hand_over(json command) {
    if (!command.is_object() || !command.contains("swim")) {
        for (auto& own : waiting_) own.push_back(command);
        return;
    }
    int swim = 0;
    fields::read(command.at("swim"), fields::Place{"command", "swim"}, {0, static_cast<double>(swims_.size() - 1)},
                 swim);
    command.erase("swim");
    waiting_[static_cast<std::size_t>(swim)].push_back(std::move(command));
}

/// The commands of each in their order.
template <class Real>
void StreamBatch<Real>::carry_out_waiting() {
    at_once(those([this](std::size_t i) { return !waiting_[i].empty(); }), [this](std::size_t i) {
        for (const json& command : waiting_[i]) swims_[i]->carry_out(command);
        waiting_[i].clear();
    });
    write();
}

template <class Real>
void StreamBatch<Real>::act(std::string_view message) {
    json id;
    try {
        const stream::Actions actions = parse_stream_actions(message, swims_.size());
        id = actions.id;
        std::vector<stream::Outcome> outcomes(swims_.size());
        const auto all = [](std::size_t) { return true; };
        if (together_)
            act_together(actions, outcomes);
        else
            at_once(those(all), [&](std::size_t i) { outcomes[i] = swims_[i]->act(actions.of[i]); });
        write();
        own_ += stream_outcomes(actions.id, outcomes);
    } catch (const InputError& error) {
        refuse(id, error.what());
    }
    write();
}

/// In groups that do not wait for each other: while the GPU computes frames of some, processors do what comes between
/// those of others.
template <class Real>
void StreamBatch<Real>::act_together(const stream::Actions& actions, std::vector<stream::Outcome>& outcomes) {
    constexpr std::size_t of_a_group = 64;  // fewer take a GPU nearly as long
    const std::size_t groups = std::clamp<std::size_t>(swims_.size() / of_a_group, 1, 3);
    side_by_side(
        groups,
        [&](std::size_t group) {
            const auto own = [&](std::size_t i) { return i * groups / swims_.size() == group; };
            act_together(those(own), actions, outcomes);
        },
        groups);
}

/// The actions of these swims: the first frame of each by the same kernels, then the second, and so on.
template <class Real>
void StreamBatch<Real>::act_together(Swims swims, const stream::Actions& actions,
                                     std::vector<stream::Outcome>& outcomes) {
    std::vector<Simulation<Real>*> next(swims_.size());
    const auto go_on_or_end = [&](std::size_t i) {
        next[i] = swims_[i]->next_of_act();
        if (!next[i]) outcomes[i] = swims_[i]->end_act();
    };
    {
        const std::lock_guard one_after_the_other(beginning_);  // so that the GPU has something to do the sooner
        at_once(swims, [&](std::size_t i) {
            swims_[i]->begin_act(actions.of[i]);
            go_on_or_end(i);
        });
    }
    for (;;) {
        std::erase_if(swims, [&](std::size_t i) { return next[i] == nullptr; });
        if (swims.empty()) return;
        std::vector<Simulation<Real>*> going;
        for (const std::size_t i : swims) going.push_back(next[i]);
        const auto begin = Pace::Clock::now();
        const std::vector<bool> stable = step_together(going, size_.threads);
        const double seconds = std::chrono::duration<double>(Pace::Clock::now() - begin).count();
        side_by_side(
            swims.size(),
            [&](std::size_t k) {
                swims_[swims[k]]->end_frame_of_act(stable[k], seconds);
                go_on_or_end(swims[k]);
            },
            static_cast<std::size_t>(size_.threads));
    }
}

/// A command that is for no swim. As each is answered after those before it, these are done before it.
template <class Real>
void StreamBatch<Real>::refuse(const json& id, const std::string& why) {
    carry_out_waiting();
    own_ += stream_message("ANSW", {{"id", id}, {"error", why}});
    write();
}

/// A message of another swim than the one before says of which it is.
template <class Real>
void StreamBatch<Real>::write() {
    std::string all;
    const auto add = [&](std::string text, std::size_t of) {
        if (text.empty()) return;
        if (!single() && told_ != of) all += stream_swim(static_cast<std::uint32_t>(of));
        told_ = of;
        all.empty() ? all = std::move(text) : all += text;
    };
    for (std::size_t i = 0; i < swims_.size(); ++i) add(swims_[i]->take_messages(), i);
    add(std::exchange(own_, {}), nobody);
    if (!all.empty()) print(all);
}

template class StreamBatch<float>;
template class StreamBatch<double>;

}  // namespace natator::cli
