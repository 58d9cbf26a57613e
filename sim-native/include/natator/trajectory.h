#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "natator/scene.h"

namespace natator {

class WholeFile;

/// Writes the body's path as CSV while it is computed: one line per slice (or particle) and frame, frame 0 being the
/// settled start. Columns: frame, time (s), slice (0 = head) or particle (by slice from the head, y, z), x, y, z
/// (length). The file takes its place when it is finished; what stood there before stays until then. For one thread at a time.
class TrajectoryCsv {
public:
    enum class Rows { slices, particles };

    /// Throws std::runtime_error when the file can't be written; so do the other members.
    TrajectoryCsv(const std::string& path, const std::vector<Slice>& slices, Rows rows);
    ~TrajectoryCsv();  ///< without finish() there is no file

    /// Throws InputError if there are not as many places as the slices have particles, or a whole number of times so many.
    void add_frame(double time, const std::vector<Eigen::Vector3d>& body_positions);
    void finish();

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
