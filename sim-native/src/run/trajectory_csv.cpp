#include "base/whole_file.h"
#include "natator/error.h"
#include "natator/record.h"

namespace natator {

TrajectoryCsv::TrajectoryCsv(const std::string& path, const std::vector<Slice>& slices, Rows rows)
    : path_(path), slices_(slices), rows_(rows), file_(std::make_unique<WholeFile>(path)) {
    file_->stream().precision(9);
    file_->stream() << "frame,time," << (rows == Rows::slices ? "slice" : "particle") << ",x,y,z\n";
    check(file_->stream().good());
}

TrajectoryCsv::~TrajectoryCsv() = default;

void TrajectoryCsv::add_frame(double time, const std::vector<Eigen::Vector3d>& body_positions) {
    if (rows_ == Rows::particles) {
        for (std::size_t i = 0; i < body_positions.size(); ++i) add_row(time, i, body_positions[i]);
    } else {
        int described = 0;
        for (const Slice& slice : slices_) described += slice.particles();
        if (described == 0 ? !body_positions.empty() : body_positions.empty() || body_positions.size() % described != 0)
            throw InputError("trajectory: " + std::to_string(body_positions.size()) + " places of a body: must be " +
                             std::to_string(described) + ", or so many times a whole number");
        const int parts = described > 0 ? static_cast<int>(body_positions.size()) / described : 1;
        auto particle = body_positions.begin();
        for (std::size_t i = 0; i < slices_.size(); ++i) {
            const int count = slices_[i].particles() * parts;
            Eigen::Vector3d sum = Eigen::Vector3d::Zero();
            for (int k = 0; k < count; ++k) sum += *particle++;
            add_row(time, i, sum / count);
        }
    }
    ++frame_;
    check(file_->stream().good());
}

void TrajectoryCsv::finish() {
    check(file_->finish());
}

void TrajectoryCsv::add_row(double time, std::size_t index, const Eigen::Vector3d& x) {
    file_->stream() << frame_ << ',' << time << ',' << index << ',' << x.x() << ',' << x.y() << ',' << x.z() << '\n';
}

void TrajectoryCsv::check(bool written) const {
    if (!written) throw cannot_be_written(path_);
}

}  // namespace natator
