#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "natator/model.h"
#include "natator/scene.h"

namespace natator {

/// All particles at the end of a frame, in the order of the Model. Places are in the coordinates of the tank, also
/// where it moves along with the swimmer (Scene::moving_tank); a trajectory's are over ground. Densities as
/// Solver::densities gives them.
struct Snapshot {
    double time = 0;                        ///< s since the end of settling
    std::vector<Eigen::Vector3d> position;  ///< length
    std::vector<Eigen::Vector3d> velocity;  ///< length/s
    std::vector<double> density;            ///< in units of rest density; 0 for solids
};

/// Request for one snapshot at a given time. Taking it changes nothing in the run.
struct SnapshotRequest {
    /// s; taken after the first frame that ends at this time or later, of time 0 after the first frame. Without it
    /// taken after the last frame: that of the duration, or the one that ends the run before.
    std::optional<double> at;
    /// empty = no snapshot; not called if the run ends before
    std::function<void(const Model&, const Snapshot&)> take;
};

/// Writes a snapshot as CSV. Columns: time (s), kind (body or fluid), mass, x, y, z (length), vx, vy, vz (length/s),
/// density (rest densities). The mass of a particle that is held in place is inf.
/// The file takes its place when it is whole; what stood there before stays until then.
/// Throws InputError if it is not of so many particles as the model, std::runtime_error when the file can't be written.
void write_snapshot(const std::string& path, const Model& model, const Snapshot& snapshot);

class WholeFile;

/// Writes the body's path as CSV while it is computed: one line per slice (or particle) and frame, frame 0 being the
/// settled start. Columns: frame, time (s), slice (0 = head) or particle (by slice from the head, y, z), x, y, z
/// (length). The file takes its place when it is finished; what stood there before stays until then. For one thread at
/// a time.
class TrajectoryCsv {
public:
    /// What has a line in each frame.
    enum class Rows { slices, particles };

    /// Throws std::runtime_error when the file can't be written; so do the other members.
    TrajectoryCsv(const std::string& path, const std::vector<Slice>& slices, Rows rows);
    ~TrajectoryCsv();  ///< without finish() there is no file

    /// Throws InputError if there are not as many places as the slices have particles, or a whole number of times so
    /// many.
    void add_frame(double time, const std::vector<Eigen::Vector3d>& body_positions);
    void finish();  ///< puts the file in its place; nothing may be added after it

private:
    void add_row(double time, std::size_t index, const Eigen::Vector3d& x);
    void check(bool written) const;

    std::string path_;
    std::vector<Slice> slices_;
    Rows rows_;
    std::unique_ptr<WholeFile> file_;
    int frame_ = 0;
};

}  // namespace natator
