#include "muscles.h"

#include <algorithm>
#include <cstdlib>
#include <tuple>

namespace natator {
namespace {

/// A particle's place in its slice. Distances from the axis are in half spacings, so that all tests are exact.
struct Place {
    int slice, iy, iz;
    int y, z;  ///< from the axis, half spacings
};

/// A pair of particles that muscles join, with the number of coincident springs.
struct Pair {
    Place front, rear;
    int springs = 0;
};

std::vector<Place> places(const Creature& creature, int slice) {
    const Slice& shape = creature.slices[slice];
    std::vector<Place> result;
    for (int iy = 0; iy < shape.height; ++iy) {
        for (int iz = 0; iz < shape.width; ++iz) {
            result.push_back({slice, iy, iz, 2 * iy - (shape.height - 1), 2 * iz - (shape.width - 1)});
        }
    }
    return result;
}

/// Whether the segment from `a` to `b` stays inside every slice strictly between them.
bool inside_between(const Creature& creature, const Place& a, const Place& b) {
    const Place& front = a.slice < b.slice ? a : b;
    const Place& rear = a.slice < b.slice ? b : a;
    const int whole = rear.slice - front.slice;
    for (int part = 1; part < whole; ++part) {
        const Slice& shape = creature.slices[front.slice + part];
        const int y = front.y * (whole - part) + rear.y * part;  // times `whole`
        const int z = front.z * (whole - part) + rear.z * part;
        if (std::abs(y) >= shape.height * whole || std::abs(z) >= shape.width * whole) return false;
    }
    return true;
}

bool may_pair(const Creature& creature, const Place& a, const Place& b) {
    const Slice& shape_a = creature.slices[a.slice];
    const Slice& shape_b = creature.slices[b.slice];
    const int dy = std::abs(shape_a.height - shape_b.height) % 2;  // half a spacing if odd, else none
    const int dz = std::abs(shape_a.width - shape_b.width) % 2;
    const bool same_side = a.z * b.z > 0;
    return same_side && std::abs(a.y - b.y) == dy && std::abs(a.z - b.z) == dz && inside_between(creature, a, b);
}

/// Partners of `giver`, nearest the axis first.
std::vector<Place> partners(const Creature& creature, const Place& giver, const std::vector<Place>& candidates) {
    std::vector<Place> result;
    for (const Place& candidate : candidates) {
        if (may_pair(creature, giver, candidate)) result.push_back(candidate);
    }
    std::stable_sort(result.begin(), result.end(),
                     [](const Place& a, const Place& b) { return a.y * a.y + a.z * a.z < b.y * b.y + b.z * b.z; });
    return result;
}

std::vector<Pair> pairs_between(const Creature& creature, int front_joint, int rear_joint) {
    const std::vector<Place> front = places(creature, front_joint);
    const std::vector<Place> rear = places(creature, rear_joint);
    const bool front_gives = front.size() <= rear.size();

    std::vector<Pair> pairs;
    for (const Place& giver : front_gives ? front : rear) {
        const std::vector<Place> takers = partners(creature, giver, front_gives ? rear : front);
        const int count = static_cast<int>(takers.size());
        for (int i = 0; i < count; ++i) {
            const int share = creature.springs_per_particle / count;
            const int rest = creature.springs_per_particle % count;
            const Place& taker = takers[i];
            pairs.push_back({front_gives ? giver : taker, front_gives ? taker : giver, share + (i < rest ? 1 : 0)});
        }
    }
    const auto key = [](const Pair& p) { return std::tuple(p.front.iy, p.front.iz, p.rear.iy, p.rear.iz); };
    std::sort(pairs.begin(), pairs.end(), [&](const Pair& a, const Pair& b) { return key(a) < key(b); });
    return pairs;
}

/// z_i: lateral place in the slice, -1 = left edge, +1 = right edge. Paired particles have slices wider than 1.
double lateral(const Creature& creature, const Place& place) {
    return static_cast<double>(place.z) / (creature.slices[place.slice].width - 1);
}

}  // namespace

void add_muscles(const Creature& creature, const BodyLayout& layout, Model& model) {
    model.actuators = creature.actuators();
    const std::vector<int>& ends = creature.muscle_ends();
    for (int actuator = 0; actuator < model.actuators; ++actuator) {
        for (const Pair& pair : pairs_between(creature, ends[actuator], ends[actuator + 1])) {
            const int a = layout.index(pair.front.slice, pair.front.iy, pair.front.iz);
            const int b = layout.index(pair.rear.slice, pair.rear.iy, pair.rear.iz);
            const double length = (model.position[a] - model.position[b]).norm();
            const double z_m = (lateral(creature, pair.front) + lateral(creature, pair.rear)) / 2;
            for (int i = 0; i < pair.springs; ++i) {
                model.muscles.push_back({static_cast<int>(model.springs.size()), actuator, z_m});
                model.springs.push_back({a, b, length, creature.spring_stiffness});
            }
        }
    }
}

}  // namespace natator
