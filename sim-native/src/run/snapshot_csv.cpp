#include "base/whole_file.h"
#include "natator/error.h"
#include "natator/record.h"

namespace natator {

void write_snapshot(const std::string& path, const Model& model, const Snapshot& snapshot) {
    const auto particles = static_cast<std::size_t>(model.particles());
    if (snapshot.position.size() != particles || snapshot.velocity.size() != particles ||
        snapshot.density.size() != particles)
        throw InputError("snapshot of " + std::to_string(snapshot.position.size()) + " places, " +
                         std::to_string(snapshot.velocity.size()) + " velocities, " +
                         std::to_string(snapshot.density.size()) + " densities: must have " +
                         std::to_string(particles) + " of each as its model");
    WholeFile whole(path);
    std::ofstream& file = whole.stream();
    file.precision(9);
    file << "time,kind,mass,x,y,z,vx,vy,vz,density\n";
    for (int i = 0; i < model.particles(); ++i) {
        const Eigen::Vector3d& x = snapshot.position[i];
        const Eigen::Vector3d& v = snapshot.velocity[i];
        file << snapshot.time << ',' << (model.is_fluid(i) ? "fluid" : "body") << ',' << 1 / model.inverse_mass[i]
             << ',' << x.x() << ',' << x.y() << ',' << x.z() << ',' << v.x() << ',' << v.y() << ',' << v.z() << ','
             << snapshot.density[i] << '\n';
    }
    if (!whole.finish()) throw cannot_be_written(path);
}

}  // namespace natator
