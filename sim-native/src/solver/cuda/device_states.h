#pragma once

#include <vector>

#include "device_model.h"
#include "host_buffer.h"
#include "natator/model.h"
#include "state_team.cuh"

namespace natator::cuda {

/// States of one Model in device memory, slots in any order: a position's w holds the particle's device number.
template <class Real>
class DeviceStates {
public:
    DeviceStates(const DeviceModel<Real>& model, int count);

    int count() const { return count_; }
    Vec4<Real>* position() const { return position_.data(); }
    Vec4<Real>* velocity() const { return velocity_.data(); }
    ClusterFit<Real>* fit() const { return fit_.data(); }
    const Real* rest_length() const { return rest_length_.data(); }

    /// As many States as there are.
    void upload(const std::vector<State<Real>>& states);
    /// `start` holds the index of the State that each is to be a copy of.
    void copy_from(const DeviceStates& starts, const std::vector<int>& start);
    /// Room on the host for a copy of all of them, to take States out of. It takes as long to get as a copy does.
    class Copy {
    public:
        explicit Copy(const DeviceStates& states);
        /// Copies them as they are now.
        void fetch();
        /// State k; spring rest lengths and time are those of `like`.
        State<Real> state(int k, State<Real> like) const;

    private:
        const DeviceStates& states_;
        HostBuffer<Vec4<Real>> position_, velocity_;
        HostBuffer<ClusterFit<Real>> fits_;
    };

private:
    const DeviceModel<Real>& model_;
    int count_;
    DeviceBuffer<Vec4<Real>> position_, velocity_;
    DeviceBuffer<ClusterFit<Real>> fit_;
    DeviceBuffer<Real> rest_length_;
};

/// Vectors by particle of the Model, out of rows by slot with device numbers in w of `numbers`.
template <class Real>
std::vector<Vector3<Real>> by_particle(const DeviceModel<Real>& model, const Vec4<Real>* rows,
                                       const Vec4<Real>* numbers);

}  // namespace natator::cuda
