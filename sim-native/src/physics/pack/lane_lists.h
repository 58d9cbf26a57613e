// Of pack.h: for sets without an instruction that puts chosen lanes one behind the other.
#pragma once

namespace natator::physics::inline NATATOR_SET {

/// For each set of lanes their numbers, one behind the other, and how many they are.
template <class Number>
struct LaneLists {
    Number lane[1 << width][width];
    std::uint8_t count[1 << width];
};
template <class Number>
constexpr LaneLists<Number> list_lanes() {
    LaneLists<Number> lists{};
    for (int chosen = 0; chosen < 1 << width; ++chosen)
        for (int lane = 0; lane < width; ++lane)
            if (chosen >> lane & 1) lists.lane[chosen][lists.count[chosen]++] = static_cast<Number>(lane);
    return lists;
}

}  // namespace natator::physics::inline NATATOR_SET
