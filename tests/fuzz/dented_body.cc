#include "tests/fuzz/dented_body.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/mannequin/body_cage.h"

namespace capfit::fuzz {
namespace {

constexpr int kShapes = 8;
constexpr double kHeight_m = 1.7;

// The cage itself, some hundred quads: fast enough for thousands of bodies in a minute.
formats::PolygonSoup CageBody(unsigned shape_number) {
  mannequin::BodyShape shape;
  shape.sex =
      (shape_number & 1) != 0 ? mannequin::MannequinSex::kMale : mannequin::MannequinSex::kFemale;
  shape.arm_angle_rad = (shape_number & 2) != 0 ? 1.5 : 0.6;
  shape.with_head = shape.with_hands = shape.with_feet = (shape_number & 4) == 0;
  const mannequin::QuadMesh cage = mannequin::WithMirrorImage(mannequin::BuildBodyCage(shape).half);
  formats::PolygonSoup soup;
  for (const Eigen::Vector3d& vertex : cage.vertices) soup.positions.push_back(kHeight_m * vertex);
  for (const mannequin::Quad& quad : cage.quads) {
    for (const int corner : {0, 1, 2, 0, 2, 3}) {
      soup.face_vertices.push_back(quad[corner]);
    }
  }
  return soup;
}

const formats::PolygonSoup& StartingBody(unsigned shape_number) {
  static const std::vector<formats::PolygonSoup>& kBodies = *[] {
    auto* const bodies = new std::vector<formats::PolygonSoup>;  // never destroyed: safe at exit
    for (unsigned i = 0; i < kShapes; ++i) bodies->push_back(CageBody(i));
    return bodies;
  }();
  return kBodies[shape_number % kShapes];
}

class Denter {
 public:
  explicit Denter(ByteSource source) : source_(source), soup_(StartingBody(source_.Next())) {}

  formats::PolygonSoup Run() {
    while (!source_.IsEmpty() && !soup_.face_vertices.empty()) Change();
    return std::move(soup_);
  }

 private:
  void Change() {
    switch (source_.Next() % 12u) {
      case 0:
        return MoveOne();
      case 1:
        return Dent();
      case 2:
        return DropFaces();
      case 3:
        return TurnFaces();
      case 4:
        return Stretch();
      case 5:
        return Turn();
      case 6:
        return Cut(/*flat=*/true);
      case 7:
        return Cut(/*flat=*/false);
      case 8:
        return SewTogether();
      case 9:
        return AddFace();
      case 10:
        return Shake();
      default:
        return MoveAll();
    }
  }

  std::uint32_t NextVertex() {
    return source_.NextWord() % static_cast<std::uint32_t>(soup_.positions.size());
  }
  std::size_t NextFace() { return source_.NextWord() % (soup_.face_vertices.size() / 3); }
  double NextCentimetres() { return 0.01 * source_.NextSigned(); }
  Eigen::Vector3d NextVector() {
    Eigen::Vector3d vector;
    for (double& coordinate : vector) coordinate = NextCentimetres();
    return vector;
  }

  void MoveOne() {
    Eigen::Vector3d& vertex = soup_.positions[NextVertex()];
    vertex += NextVector();
  }

  // Moves what is near a vertex, and less what is farther: a dent, a bump or a bent limb.
  void Dent() {
    const Eigen::Vector3d middle = soup_.positions[NextVertex()];
    const double radius = 0.005 * (1 + source_.Next());
    const Eigen::Vector3d by = NextVector();
    for (Eigen::Vector3d& vertex : soup_.positions) {
      vertex += by * std::max(0.0, 1.0 - (vertex - middle).norm() / radius);
    }
  }

  void DropFaces() {
    const auto first = static_cast<std::ptrdiff_t>(3 * NextFace());
    const auto count = static_cast<std::ptrdiff_t>(3 * (1 + source_.Next() % 16u));
    const auto begin = soup_.face_vertices.begin() + first;
    soup_.face_vertices.erase(begin, begin + std::min(count, soup_.face_vertices.end() - begin));
  }

  void TurnFaces() {
    const std::size_t first = 3 * NextFace();
    const std::size_t end = std::min(first + 3 * source_.Next(), soup_.face_vertices.size());
    for (std::size_t i = first; i < end; i += 3) {
      std::swap(soup_.face_vertices[i], soup_.face_vertices[i + 1]);
    }
  }

  void Stretch() {
    const unsigned axis = source_.Next() % 3u;
    const double factor = 0.02 * source_.NextSigned();  // also 0 and negative: flat, mirrored
    for (Eigen::Vector3d& vertex : soup_.positions) vertex[axis] *= factor;
  }

  void Turn() {
    const Eigen::Vector3d axis = NextVector() + Eigen::Vector3d(1e-9, 0.0, 0.0);
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(0.05 * source_.NextSigned(), axis.normalized()).matrix();
    for (Eigen::Vector3d& vertex : soup_.positions) vertex = turn * vertex;
  }

  // What lies beyond a level plane is pressed flat on it, or goes.
  void Cut(bool flat) {
    const unsigned axis = source_.Next() % 3u;
    const double level = 0.02 * source_.NextSigned();
    const double side = (source_.Next() & 1) != 0 ? 1.0 : -1.0;
    if (flat) {
      for (Eigen::Vector3d& vertex : soup_.positions) {
        if (side * (vertex[axis] - level) > 0.0) vertex[axis] = level;
      }
      return;
    }
    std::vector<std::uint32_t> kept;
    for (std::size_t i = 0; i + 2 < soup_.face_vertices.size(); i += 3) {
      const std::uint32_t* const face = &soup_.face_vertices[i];
      const bool goes = std::all_of(face, face + 3, [&](std::uint32_t v) {
        return side * (soup_.positions[v][axis] - level) > 0.0;
      });
      if (!goes) kept.insert(kept.end(), face, face + 3);
    }
    soup_.face_vertices = std::move(kept);
  }

  void SewTogether() {
    const std::uint32_t from = NextVertex();
    const std::uint32_t to = NextVertex();
    std::replace(soup_.face_vertices.begin(), soup_.face_vertices.end(), from, to);
  }

  void AddFace() {
    for (int k = 0; k < 3; ++k) soup_.face_vertices.push_back(NextVertex());
  }

  // Moves each vertex by up to some millimetres, always the same way for the same byte.
  void Shake() {
    std::uint32_t state = source_.Next();
    const double reach = 1e-5 * source_.Next();
    for (Eigen::Vector3d& vertex : soup_.positions) {
      for (double& coordinate : vertex) {
        state = state * 1664525u + 1013904223u;
        coordinate += reach * (static_cast<double>(state >> 24) - 127.5);
      }
    }
  }

  void MoveAll() {
    const double scale = std::pow(10.0, static_cast<double>(source_.Next() % 21u) - 10.0);
    const Eigen::Vector3d by = NextVector() * 1e4;
    for (Eigen::Vector3d& vertex : soup_.positions) vertex = scale * vertex + by;
  }

  ByteSource source_;
  formats::PolygonSoup soup_;
};

}  // namespace

formats::PolygonSoup DentedBody(ByteSource source) { return Denter(source).Run(); }

}  // namespace capfit::fuzz
