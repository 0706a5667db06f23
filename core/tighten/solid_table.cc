#include "core/tighten/solid_table.h"

#include <algorithm>

namespace capfit::tighten {

SolidTable::SolidTable(std::span<const geometry::TaperedCapsule> solids)
    : kernels_(solids.begin(), solids.end()), lanes_((solids.size() + kLane - 1) / kLane) {
  for (std::size_t k = 0; k < kLane * lanes_.size(); ++k) {
    // The last lanes are filled up with the last solid.
    const DistanceKernel& from = kernels_[std::min(k, size() - 1)];
    Lanes& to = lanes_[k / kLane];
    const auto i = static_cast<Eigen::Index>(k % kLane);
    to.ax[i] = from.ax, to.ay[i] = from.ay, to.az[i] = from.az;
    to.ux[i] = from.ux, to.uy[i] = from.uy, to.uz[i] = from.uz;
    to.ra[i] = from.ra, to.dr[i] = from.dr, to.slope[i] = from.slope;
    to.length[i] = from.length, to.inverse_length[i] = from.inverse_length;
  }
}

// DistanceKernel::SignedDistance for whole lanes.
void SolidTable::DistancesFrom(const Eigen::Vector3d& place_m,
                               std::vector<double>& distance_m) const {
  distance_m.resize(kLane * lanes_.size());
  double* out = distance_m.data();
  for (const Lanes& s : lanes_) {
    const Lane dx = place_m.x() - s.ax;
    const Lane dy = place_m.y() - s.ay;
    const Lane dz = place_m.z() - s.az;
    const Lane axial = dx * s.ux + dy * s.uy + dz * s.uz;
    const Lane squared = (dx * dx + dy * dy + dz * dz - axial * axial).max(0.0);
    const Lane slant = (axial - squared.sqrt() * s.slope) * s.inverse_length;
    const Lane t = slant.max(0.0).min(1.0);
    const Lane off = axial - t * s.length;
    const Lane distance = (squared + off * off).sqrt() - (s.ra + t * s.dr);
    std::copy_n(distance.data(), kLane, out);
    out += kLane;
  }
}

}  // namespace capfit::tighten
