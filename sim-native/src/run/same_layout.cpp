#include "same_layout.h"

#include <algorithm>

namespace natator {
namespace {

bool same(const Spring& a, const Spring& b) {
    return a.a == b.a && a.b == b.b && a.rest_length == b.rest_length;
}

bool same(const Cluster& a, const Cluster& b) {
    return a.particles == b.particles && a.rest_offset == b.rest_offset;
}

bool same(const PeriodicAxis& a, const PeriodicAxis& b) {
    return a.axis == b.axis && a.low == b.low && a.high == b.high;
}

bool same(const Muscle& a, const Muscle& b) {
    return a.spring == b.spring && a.actuator == b.actuator && a.lateral == b.lateral;
}

template <class T>
bool all_same(const std::vector<T>& a, const std::vector<T>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const T& x, const T& y) { return same(x, y); });
}

}  // namespace

bool same_layout(const Model& a, const Model& b) {
    return a.position == b.position && a.velocity == b.velocity && a.phase == b.phase &&
           a.rest_position == b.rest_position && all_same(a.periodic, b.periodic) && all_same(a.springs, b.springs) &&
           all_same(a.clusters, b.clusters) && all_same(a.muscles, b.muscles) && a.actuators == b.actuators &&
           a.body.slices == b.body.slices;
}

}  // namespace natator
