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

Place place_in(const Slice& shape, int slice, int iy, int iz) {
    return {slice, iy, iz, 2 * iy - (shape.height - 1), 2 * iz - (shape.row(iy) - 1)};
}

std::vector<Place> places(const Creature& creature, int slice) {
    const Slice& shape = creature.slices[slice];
    std::vector<Place> result;
    for (int iy = 0; iy < shape.height; ++iy) {
        for (int iz = 0; iz < shape.row(iy); ++iz) {
            result.push_back(place_in(shape, slice, iy, iz));
        }
    }
    return result;
}

/// Width of a slice, a stack of rows one spacing high, at y = `y` / `whole` half spacings: of two rows that meet there the
/// lesser; 0 on its outline and beyond.
int width_at(const Slice& shape, int y, int whole) {
    const int above = y + shape.height * whole;  // from the lowest row's lower side
    if (above <= 0 || above >= 2 * shape.height * whole) return 0;
    const int row = above / (2 * whole);
    return above % (2 * whole) == 0 ? std::min(shape.row(row - 1), shape.row(row)) : shape.row(row);
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
        if (std::abs(z) >= width_at(shape, y, whole) * whole) return false;
    }
    return true;
}

/// The places of a row of `count` particles that lie `apart` half spacings from `from`: numbers of particles, ascending.
std::vector<int> at_distance(int count, int from, int apart) {
    std::vector<int> numbers;
    for (const int at : {from - apart, from + apart}) {
        const int twice = at + count - 1;  // at = 2 number - (count - 1)
        const bool there = twice >= 0 && twice % 2 == 0 && twice / 2 < count;
        if (there && (numbers.empty() || numbers.back() != twice / 2)) numbers.push_back(twice / 2);
    }
    return numbers;
}

/// Partners of `giver` in another slice, nearest the axis first.
std::vector<Place> partners(const Creature& creature, const Place& giver, int slice) {
    const Slice& own = creature.slices[giver.slice];
    const Slice& other = creature.slices[slice];
    const int dy = std::abs(own.height - other.height) % 2;  // half a spacing if odd, else none
    const int dz = std::abs(own.width - other.width) % 2;
    std::vector<Place> result;
    for (const int iy : at_distance(other.height, giver.y, dy)) {
        for (const int iz : at_distance(other.row(iy), giver.z, dz)) {
            const Place candidate = place_in(other, slice, iy, iz);
            const bool same_side = giver.z * candidate.z > 0;
            if (same_side && inside_between(creature, giver, candidate)) result.push_back(candidate);
        }
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
        const std::vector<Place> takers = partners(creature, giver, front_gives ? rear_joint : front_joint);
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
                model.springs.push_back({a, b, length, creature.stiffness_of_springs(actuator)});
            }
        }
    }
}

}  // namespace natator
