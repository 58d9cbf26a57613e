#include "fluid_block.h"

#include <algorithm>
#include <cmath>

namespace natator {
namespace {

constexpr std::uint32_t fluid_phase = 0 | phase::self_collide | phase::fluid;  // group 0

/// Which lattice points are too close to what the model holds so far: bodies and obstacles.
class Clearing {
public:
    Clearing(const FluidBlock& block, const Model& model) : block_(block) {
        closed_.resize(static_cast<std::size_t>(block.count.x()) * block.count.y() * block.count.z());
        std::vector<Eigen::Vector3d> solids = model.position;
        for (const PeriodicAxis& periodic : model.periodic) {  // also through the ends
            const std::size_t count = solids.size();
            for (const double way : {-periodic.length(), periodic.length()})
                for (std::size_t i = 0; i < count; ++i)
                    solids.push_back(solids[i] + way * Eigen::Vector3d::Unit(periodic.axis));
        }
        for (const Eigen::Vector3d& solid : solids) close_around(solid);
    }

    bool closed(int x, int y, int z) const { return closed_[index(x, y, z)]; }

private:
    std::size_t index(int x, int y, int z) const {
        return (static_cast<std::size_t>(x) * block_.count.y() + y) * block_.count.z() + z;
    }

    void close_around(const Eigen::Vector3d& centre) {
        const Eigen::Vector3d reach = Eigen::Vector3d::Constant(block_.clearance);
        const Eigen::Array3d first = ((centre - reach - block_.origin) / block_.spacing).array().floor().max(0);
        const Eigen::Array3d limit = (block_.count.array() - 1).cast<double>();
        const Eigen::Array3d last = ((centre + reach - block_.origin) / block_.spacing).array().ceil().min(limit);
        for (double x = first.x(); x <= last.x(); ++x) {
            for (double y = first.y(); y <= last.y(); ++y) {
                for (double z = first.z(); z <= last.z(); ++z) {
                    const Eigen::Vector3d point = block_.origin + block_.spacing * Eigen::Vector3d(x, y, z);
                    if ((point - centre).norm() >= block_.clearance) continue;
                    closed_[index(static_cast<int>(x), static_cast<int>(y), static_cast<int>(z))] = true;
                }
            }
        }
    }

    const FluidBlock& block_;
    std::vector<bool> closed_;
};

double layer_inverse_mass(const FluidBlock& block, int layer) {
    const double height = block.count.y() > 1 ? layer / (block.count.y() - 1.0) : 0;  // 0 = lowest, 1 = highest
    switch (block.gradient) {
        case MassGradient::mass_linear:
            return 1 / std::lerp(block.bottom_mass, block.top_mass, height);
        case MassGradient::inverse_mass_linear:
            return std::lerp(1 / block.bottom_mass, 1 / block.top_mass, height);
        case MassGradient::uniform:
            break;
    }
    return 1 / block.bottom_mass;
}

}  // namespace

void add_fluid(const FluidBlock& block, Model& model) {
    const Clearing clearing(block, model);
    for (int x = 0; x < block.count.x(); ++x) {
        for (int y = 0; y < block.count.y(); ++y) {
            for (int z = 0; z < block.count.z(); ++z) {
                if (clearing.closed(x, y, z)) continue;
                model.position.push_back(block.origin + block.spacing * Eigen::Vector3d(x, y, z));
                model.velocity.push_back(Eigen::Vector3d::Zero());
                model.inverse_mass.push_back(layer_inverse_mass(block, y));
                model.phase.push_back(fluid_phase);
            }
        }
    }
}

}  // namespace natator
