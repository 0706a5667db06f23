#include "core/skinning/spherical_triangles.h"

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <numbers>

// Seen from a centre x, a triangle covers a spherical triangle with corners u_i (unit vectors to
// its vertices). Its mean vector m, the integral of the direction over it, is the sum over its
// edges of theta/2 times the unit normal of the plane through x and the edge:
//   m = sum_k f_k g_k,   g_k = u_i x u_j,   f_k = theta_k / (2 sin theta_k).
// Writing m = sum lambda_i u_i gives lambda_i = m . g_opposite(i) / det(u), and the triangle adds
// lambda_i / |p_i - x| to the weight of vertex i. Over a closed surface the mean vectors sum to
// zero, which is why the normalised weights reproduce x. These are Ju's formulas without his
// trigonometry: f is an analytic function of q = |u_i - u_j|^2, so small triangles need no arcus.
namespace capfit::skinning {
namespace {

// A centre closer to a vertex than this share of the diagonal is that vertex.
constexpr double kVertexShare = 1e-9;
// Half the triangle's perimeter on the sphere comes this close to pi only when the centre lies on
// it: the gap grows with the square of the distance, so 1e-14 is 1e-7 of the triangle's size, and
// twenty times the rounding of the three angles.
constexpr double kHitGap = 1e-14;
// Lower bound for det(u) relative to the squared size of the spherical triangle. Below, the centre
// lies in the triangle's plane but outside it, and the triangle adds nothing; 1e-9 is where
// rounding in det would outweigh what is left out.
constexpr double kEdgeOn = 1e-9;
// The lanes leave what is nearly edge-on or large to the careful path.
constexpr double kCarefulTilt = 1e-7;
constexpr double kSeriesLimit = 0.2;  // q = 0.2: an edge seen under 26 degrees

struct LaneVector {
  Lanes x, y, z;
};

// The compiler would make one of these a call, which costs a tenth of the whole loop.
[[gnu::always_inline]] inline LaneVector operator-(const LaneVector& a, const LaneVector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[gnu::always_inline]] inline LaneVector Cross(const LaneVector& a, const LaneVector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
[[gnu::always_inline]] inline Lanes Dot(const LaneVector& a, const LaneVector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

// A vertex as the four centres see it.
struct Sight {
  LaneVector direction;  // unit vectors
  Lanes inverse_distance;
};

// theta / (2 sin theta) - 1/2 as a function of q = |u - v|^2 = 2 - 2 cos theta: half the sum of
// q^n / ((2n + 1) binomial(2n, n)) from n = 1 on, as the polynomial that meets q^-1 times it best
// on [0, 0.2], to 4e-12 of itself. (That the weights reproduce the centre does not hang on it: both
// triangles at an edge see the same number.)
[[gnu::always_inline]] inline Lanes HalfAngleOverSineBeyondHalf(const Lanes& q) {
  constexpr std::array<double, 6> kCoefficients = {0.08333333333298287,    0.01666666679275094,
                                                   0.0035714212413925396,  0.0007938060749396829,
                                                   0.00017889774738726036, 4.8006032403562365e-05};
  Lanes sum = Lanes::Constant(kCoefficients.back());
  for (std::size_t n = kCoefficients.size() - 1; n-- > 0;) sum = sum * q + kCoefficients[n];
  return sum * q;
}

double Angle(const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
  return 2.0 * std::atan2((u - v).norm(), (u + v).norm());
}

// One triangle and one centre, with all special cases. Edge k lies opposite to corner k.
class CarefulTriangle {
 public:
  CarefulTriangle(const std::array<const Sight*, 3>& corners, int lane) {
    for (int k = 0; k < 3; ++k) {
      const Sight& sight = *corners[k];
      u_[k] = {sight.direction.x[lane], sight.direction.y[lane], sight.direction.z[lane]};
      distance_[k] = 1.0 / sight.inverse_distance[lane];
    }
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d& from = u_[(k + 1) % 3];
      const Eigen::Vector3d& to = u_[(k + 2) % 3];
      theta_[k] = Angle(from, to);
      cross_[k] = from.cross(to - from);
      size_ = std::max(size_, (to - from).squaredNorm());
    }
  }

  [[nodiscard]] bool IsHit() const {
    return std::numbers::pi - 0.5 * (theta_[0] + theta_[1] + theta_[2]) < kHitGap;
  }

  [[nodiscard]] std::array<double, 3> Barycentric() const {
    std::array<double, 3> weights{};
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
      weights[k] = std::sin(theta_[k]) * distance_[(k + 1) % 3] * distance_[(k + 2) % 3];
      sum += weights[k];
    }
    for (double& weight : weights) weight /= sum;
    return weights;
  }

  [[nodiscard]] std::array<double, 3> Weights() const {
    const double determinant = u_[0].dot(cross_[0]);
    if (std::abs(determinant) <= kEdgeOn * size_) return {0.0, 0.0, 0.0};
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k) {
      const double sine = cross_[k].norm();
      if (sine > 0.0) mean += 0.5 * theta_[k] / sine * cross_[k];
    }
    std::array<double, 3> weights{};
    for (int k = 0; k < 3; ++k) weights[k] = mean.dot(cross_[k]) / (determinant * distance_[k]);
    return weights;
  }

 private:
  std::array<Eigen::Vector3d, 3> u_;
  std::array<Eigen::Vector3d, 3> cross_;
  std::array<double, 3> distance_{};
  std::array<double, 3> theta_{};
  double size_ = 0.0;
};

// What four pairs of triangle and centre add to the triangles' corners.
struct LaneTriangles {
  std::array<Lanes, 3> added;
  Lanes care;  // not < 0 where the lane needs care: a large triangle, or one seen nearly edge-on
};

[[gnu::always_inline]] inline LaneTriangles WeighLanes(const Sight& a, const Sight& b,
                                                       const Sight& c) {
  const LaneVector bc = c.direction - b.direction;
  const LaneVector ca = a.direction - c.direction;
  const LaneVector ab = b.direction - a.direction;
  const Lanes q_a = Dot(bc, bc);
  const Lanes q_b = Dot(ca, ca);
  const Lanes q_c = Dot(ab, ab);
  // u x (v - u) instead of u x v: the difference of nearby unit vectors is exact.
  const Lanes determinant = Dot(a.direction, Cross(b.direction, bc));
  // All products of the normals follow from the edges:
  //   |g_a|^2 = q_a - q_a^2 / 4,   g_a . g_b = (q_c - q_a - q_b) / 2 + q_a q_b / 4.
  // With f = 1/2 + h, what m . g_a is made of cancels in the halves and leaves
  //   q_a (q_b + q_c - q_a) / 8 + h_a g_a . g_a + h_b g_b . g_a + h_c g_c . g_a.
  const Lanes h_a = HalfAngleOverSineBeyondHalf(q_a);
  const Lanes h_b = HalfAngleOverSineBeyondHalf(q_b);
  const Lanes h_c = HalfAngleOverSineBeyondHalf(q_c);
  const Lanes e_a = q_b + q_c - q_a;
  const Lanes e_b = q_c + q_a - q_b;
  const Lanes e_c = q_a + q_b - q_c;
  const Lanes g_ab = 0.25 * q_a * q_b - 0.5 * e_c;
  const Lanes g_bc = 0.25 * q_b * q_c - 0.5 * e_a;
  const Lanes g_ca = 0.25 * q_c * q_a - 0.5 * e_b;
  const Lanes m_a = q_a * (0.125 * e_a + h_a * (1.0 - 0.25 * q_a)) + h_b * g_ab + h_c * g_ca;
  const Lanes m_b = q_b * (0.125 * e_b + h_b * (1.0 - 0.25 * q_b)) + h_c * g_bc + h_a * g_ab;
  const Lanes m_c = q_c * (0.125 * e_c + h_c * (1.0 - 0.25 * q_c)) + h_a * g_ca + h_b * g_bc;
  const Lanes size = q_a.max(q_b).max(q_c);
  const Lanes care =
      (size - kSeriesLimit)
          .max(kCarefulTilt * kCarefulTilt * size * size - determinant * determinant);
  const Lanes inverse = determinant.inverse();
  return {{m_a * inverse * a.inverse_distance, m_b * inverse * b.inverse_distance,
           m_c * inverse * c.inverse_distance},
          care};
}

class Accumulator {
 public:
  Accumulator(const mesh::BodyMesh& mesh, const std::array<Eigen::Vector3d, kLanes>& centers)
      : mesh_(mesh), sights_(std::make_unique_for_overwrite<Sight[]>(mesh.vertices().size())) {
    raw_.weights.assign(mesh.vertices().size(), Lanes::Zero());
    LookAtVertices(centers);
  }

  RawWeights Run() && {
    for (const mesh::Triangle& triangle : mesh_.triangles()) Add(triangle);
    return std::move(raw_);
  }

 private:
  void LookAtVertices(const std::array<Eigen::Vector3d, kLanes>& centers) {
    LaneVector center;
    for (int lane = 0; lane < kLanes; ++lane) {
      center.x[lane] = centers[lane].x();
      center.y[lane] = centers[lane].y();
      center.z[lane] = centers[lane].z();
    }
    const double touching = kVertexShare * mesh_.diagonal();
    for (std::size_t i = 0; i < mesh_.vertices().size(); ++i) {
      const Eigen::Vector3d& p = mesh_.vertices()[i];
      const LaneVector to = {p.x() - center.x, p.y() - center.y, p.z() - center.z};
      const Lanes distance = Dot(to, to).sqrt();
      if (distance.minCoeff() <= touching) RecordVertexHits(i, distance, touching);
      const Lanes inverse = distance.max(touching).inverse();
      sights_[i] = {{to.x * inverse, to.y * inverse, to.z * inverse}, inverse};
    }
  }

  void RecordVertexHits(std::size_t vertex, const Lanes& distance, double touching) {
    const auto index = static_cast<std::uint32_t>(vertex);
    for (int lane = 0; lane < kLanes; ++lane) {
      if (distance[lane] > touching || raw_.hits[lane]) continue;
      raw_.hits[lane] = SurfaceHit{{index, index, index}, {1.0, 0.0, 0.0}};
    }
  }

  void Add(const mesh::Triangle& triangle) {
    const std::array<const Sight*, 3> corners = {&sights_[triangle[0]], &sights_[triangle[1]],
                                                 &sights_[triangle[2]]};
    LaneTriangles lanes = WeighLanes(*corners[0], *corners[1], *corners[2]);
    if (!(lanes.care.maxCoeff() < 0.0)) TakeCare(triangle, corners, lanes);
    for (std::size_t k = 0; k < 3; ++k) raw_.weights[triangle[k]] += lanes.added[k];
  }

  void TakeCare(const mesh::Triangle& triangle, const std::array<const Sight*, 3>& corners,
                LaneTriangles& lanes) {
    for (int lane = 0; lane < kLanes; ++lane) {
      if (lanes.care[lane] < 0.0) continue;
      const CarefulTriangle careful(corners, lane);
      std::array<double, 3> weights{};
      if (!raw_.hits[lane] && careful.IsHit()) {
        raw_.hits[lane] = SurfaceHit{triangle, careful.Barycentric()};
      } else if (!raw_.hits[lane]) {
        weights = careful.Weights();
      }
      for (std::size_t k = 0; k < 3; ++k) lanes.added[k][lane] = weights[k];
    }
  }

  const mesh::BodyMesh& mesh_;
  std::unique_ptr<Sight[]> sights_;  // by vertex
  RawWeights raw_;
};

}  // namespace

std::array<TriangleWeights, kLanes> MeanValueTriangles(
    std::span<const std::array<Eigen::Vector3d, 3>> corners) {
  std::array<Sight, 3> sights;
  for (int lane = 0; lane < kLanes; ++lane) {
    const std::size_t at = std::min(static_cast<std::size_t>(lane), corners.size() - 1);
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d& to = corners[at][k];
      const double inverse = 1.0 / to.norm();
      sights[k].inverse_distance[lane] = inverse;
      sights[k].direction.x[lane] = to.x() * inverse;
      sights[k].direction.y[lane] = to.y() * inverse;
      sights[k].direction.z[lane] = to.z() * inverse;
    }
  }
  const LaneTriangles lanes = WeighLanes(sights[0], sights[1], sights[2]);
  std::array<TriangleWeights, kLanes> result;
  for (int lane = 0; lane < kLanes; ++lane) {
    TriangleWeights& weights = result[lane];
    for (std::size_t k = 0; k < 3; ++k) weights.weights[k] = lanes.added[k][lane];
    if (lanes.care[lane] < 0.0) continue;
    const CarefulTriangle careful({&sights[0], &sights[1], &sights[2]}, lane);
    weights.is_hit = careful.IsHit();
    weights.weights = weights.is_hit ? careful.Barycentric() : careful.Weights();
  }
  return result;
}

RawWeights MeanValueRawWeights(const mesh::BodyMesh& mesh,
                               const std::array<Eigen::Vector3d, kLanes>& centers) {
  return Accumulator(mesh, centers).Run();
}

}  // namespace capfit::skinning
