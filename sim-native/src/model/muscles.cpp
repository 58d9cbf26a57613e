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
    return {slice, iy, iz, shape.y(iy), shape.z(iy, iz)};
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

/// Number in its row of the particle at z, half spacings; -1 if there is none.
int number_at(const Slice& shape, int iy, int z) {
    if (shape.columns.empty()) {
        const int twice = z + shape.row(iy) - 1;  // z = 2 number - (count - 1)
        return twice >= 0 && twice % 2 == 0 && twice / 2 < shape.row(iy) ? twice / 2 : -1;
    }
    const std::vector<int>& row = shape.columns[static_cast<std::size_t>(iy)];
    const auto found = std::lower_bound(row.begin(), row.end(), z);
    return found != row.end() && *found == z ? static_cast<int>(found - row.begin()) : -1;
}

/// Whether z / `whole` half spacings is inside a row, whose particles are each two half spacings wide: on the border of
/// two, both must be there.
bool row_covers(const Slice& shape, int iy, int z, int whole) {
    const int count = shape.row(iy);
    if (shape.columns.empty()) return std::abs(z) < count * whole;
    const auto covered = [&](int way) {  // just beside it
        for (const int at : shape.columns[static_cast<std::size_t>(iy)]) {
            const int from = (at - 1) * whole, to = (at + 1) * whole;
            if (way < 0 ? z > from && z <= to : z >= from && z < to) return true;
        }
        return false;
    };
    return covered(-1) && covered(1);
}

/// Whether a place, in half spacings / `whole`, is inside a slice, a stack of rows one spacing high. Where two rows
/// meet both must cover it; the outline is outside.
bool covers(const Slice& shape, int y, int z, int whole) {
    const int above = y + (shape.height - shape.lift) * whole;  // from the lowest row's lower side
    if (above <= 0 || above >= 2 * shape.height * whole) return false;
    const int row = above / (2 * whole);
    if (above % (2 * whole) == 0 && !row_covers(shape, row - 1, z, whole)) return false;
    return row_covers(shape, row, z, whole);
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
        if (!covers(shape, y, z, whole)) return false;
    }
    return true;
}

/// The one or two values that lie `apart` from `from`, ascending.
std::vector<int> at_distance(int from, int apart) {
    return apart == 0 ? std::vector<int>{from} : std::vector<int>{from - apart, from + apart};
}

/// The place that counts for bending one way: from the middle of left and right, or of above and below, half spacings.
int across(const Creature& creature, const Place& place, Bend bend) {
    return bend == Bend::sideways ? place.z : place.y - creature.slices[place.slice].lift;
}

/// Partners of `giver` in another slice, nearest the axis first.
std::vector<Place> partners(const Creature& creature, const Place& giver, int slice, Bend bend) {
    const Slice& own = creature.slices[giver.slice];
    const Slice& other = creature.slices[slice];
    const int dy = std::abs(own.y(0) - other.y(0)) % 2;  // half a spacing if odd, else none
    const int dz = std::abs(own.width - other.width) % 2;
    std::vector<Place> result;
    for (const int y : at_distance(giver.y, dy)) {
        const int iy = (y - other.y(0)) / 2;
        if (y < other.y(0) || iy >= other.height) continue;
        for (const int z : at_distance(giver.z, dz)) {
            const int iz = number_at(other, iy, z);
            if (iz < 0) continue;
            const Place candidate = place_in(other, slice, iy, iz);
            const bool same_side = across(creature, giver, bend) * across(creature, candidate, bend) > 0;
            if (same_side && inside_between(creature, giver, candidate)) result.push_back(candidate);
        }
    }
    std::stable_sort(result.begin(), result.end(),
                     [](const Place& a, const Place& b) { return a.y * a.y + a.z * a.z < b.y * b.y + b.z * b.z; });
    return result;
}

std::vector<Pair> pairs_between(const Creature& creature, int front_joint, int rear_joint, Bend bend) {
    const std::vector<Place> front = places(creature, front_joint);
    const std::vector<Place> rear = places(creature, rear_joint);
    const bool front_gives = front.size() <= rear.size();

    std::vector<Pair> pairs;
    for (const Place& giver : front_gives ? front : rear) {
        const std::vector<Place> takers = partners(creature, giver, front_gives ? rear_joint : front_joint, bend);
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

/// z_i: place in the slice across the bend, -1 = left or lower edge, +1 = right or upper edge. Paired particles have
/// slices wider, or higher, than 1.
double lateral(const Creature& creature, const Place& place, Bend bend) {
    const Slice& shape = creature.slices[place.slice];
    return static_cast<double>(across(creature, place, bend)) /
           ((bend == Bend::sideways ? shape.width : shape.height) - 1);
}

/// `springs` equal ones between two particles.
void add_springs(int a, int b, int actuator, double lateral, double stiffness, int springs, Model& model) {
    const double length = (model.position[a] - model.position[b]).norm();
    for (int i = 0; i < springs; ++i) {
        model.muscles.push_back({static_cast<int>(model.springs.size()), actuator, lateral});
        model.springs.push_back({a, b, length, stiffness});
    }
}

}  // namespace

void add_muscles(const Creature& creature, const BodyLayout& layout, Model& model) {
    const std::vector<Actuator> actuators = creature.actuator_list();
    model.actuators = static_cast<int>(actuators.size());
    if (creature.regions) {
        for (const Fibre& fibre : creature.regions->fibres)
            add_springs(fibre.front, fibre.rear, fibre.actuator, fibre.lateral, creature.spring_stiffness,
                        creature.springs_per_particle, model);
        return;
    }
    const std::vector<int>& ends = creature.muscle_ends();
    for (int actuator = 0; actuator < model.actuators; ++actuator) {
        const auto [gap, bend] = actuators[static_cast<std::size_t>(actuator)];
        for (const Pair& pair : pairs_between(creature, ends[gap], ends[gap + 1], bend)) {
            const int a = layout.index(pair.front.slice, pair.front.iy, pair.front.iz);
            const int b = layout.index(pair.rear.slice, pair.rear.iy, pair.rear.iz);
            const double z_m = (lateral(creature, pair.front, bend) + lateral(creature, pair.rear, bend)) / 2;
            add_springs(a, b, actuator, z_m, creature.stiffness_of_springs(gap), pair.springs, model);
        }
    }
}

}  // namespace natator
