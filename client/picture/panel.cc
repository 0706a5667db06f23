#include "client/picture/panel.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "client/picture/raster.h"

namespace capfit::client {
namespace {

using Eigen::Vector3d;

constexpr int kSamples = 3;  // along each side of a pixel

std::vector<Vector3d> VertexNormals(const Figure& figure) {
  std::vector<Vector3d> normals(figure.vertices.size(), Vector3d::Zero());
  for (const mesh::Triangle& t : figure.triangles) {
    const Vector3d& a = figure.vertices[t[0]];
    const Vector3d normal = (figure.vertices[t[1]] - a).cross(figure.vertices[t[2]] - a);
    for (const std::uint32_t v : t) normals[v] += normal;
  }
  for (Vector3d& normal : normals) normal.stableNormalize();
  return normals;
}

// Finds the colour of each sample of one panel.
class Painter {
 public:
  Painter(const Figure& figure, const View& view, const PanelOptions& options)
      : figure_(figure),
        options_(options),
        view_(view),
        body_(kSamples * options.width, kSamples * options.height),
        set_(kSamples * options.width, kSamples * options.height) {
    if (ShowsBody()) {
      body_.DrawMesh(figure.vertices, figure.triangles, view_);
      normals_ = VertexNormals(figure);
    }
    if (options.style == PanelStyle::kHeat)
      gaps_ = figure.gaps.empty() ? Gaps(figure) : figure.gaps;
    if (ShowsSet()) set_.DrawCapsules(figure.solids, view_);
  }

  [[nodiscard]] Color At(int i, int j) const {
    const std::optional<Color> body = ShowsBody() ? BodyColor(i, j) : std::nullopt;
    if (options_.style == PanelStyle::kGhost && body) return 0.42f * *body + 0.58f * kPaper;
    if (!ShowsSet() || set_.at(i, j).id < 0) return body.value_or(kPaper);
    const bool is_outline = IsOutline(i, j);
    if (options_.style == PanelStyle::kPrimitives) {
      const Color color = SetColor(i, j);
      return is_outline ? Color(color * 0.62f) : color;
    }
    if (is_outline) return 0.55f * SolidColor(i, j) + 0.12f * body.value_or(kPaper);
    return body ? Color(0.66f * *body + 0.34f * SetColor(i, j))
                : Color(0.45f * kPaper + 0.55f * SetColor(i, j));
  }

 private:
  [[nodiscard]] bool ShowsBody() const { return options_.style != PanelStyle::kPrimitives; }
  [[nodiscard]] bool ShowsSet() const {
    return options_.style == PanelStyle::kPrimitives ||
           options_.style == PanelStyle::kBodyAndOutlines;
  }

  // Weights of the triangle's corners at the sample.
  [[nodiscard]] Vector3d Barycentric(const mesh::Triangle& t, int i, int j) const {
    const Vector3d a = view_.Project(figure_.vertices[t[0]]);
    const Vector3d b = view_.Project(figure_.vertices[t[1]]) - a;
    const Vector3d c = view_.Project(figure_.vertices[t[2]]) - a;
    const double x = i + 0.5 - a.x();
    const double y = j + 0.5 - a.y();
    const double area = b.x() * c.y() - c.x() * b.y();
    const double v = (x * c.y() - c.x() * y) / area;
    const double w = (b.x() * y - x * b.y()) / area;
    return {1.0 - v - w, v, w};
  }

  [[nodiscard]] std::optional<Color> BodyColor(int i, int j) const {
    const Hit& hit = body_.at(i, j);
    if (hit.id < 0) return std::nullopt;
    const mesh::Triangle& t = figure_.triangles[hit.id];
    const Vector3d weights = Barycentric(t, i, j);
    Vector3d normal = Vector3d::Zero();
    double gap = 0.0;
    double fitted = 0.0;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t vertex = t[k];
      normal += weights[k] * normals_[vertex];
      if (!gaps_.empty()) gap += weights[k] * gaps_[vertex];
      if (figure_.is_fitted.empty() || figure_.is_fitted[vertex]) fitted += weights[k];
    }
    return Lit(SurfaceColor(gap, fitted), view_.Turn(normal.stableNormalized()));
  }

  // `fitted`: how much of the place belongs to parts that the solids stand for.
  [[nodiscard]] Color SurfaceColor(double gap, double fitted) const {
    // Warm where the primitives stand off from the covered surface, blue where it sticks out.
    if (options_.style == PanelStyle::kHeat) {
      return std::isnan(gap) ? kNotFitted : SignedColor(-gap / options_.heat_limit);
    }
    return fitted > 0.5 ? kSkin : kNotFitted;
  }

  [[nodiscard]] const Color& SolidColor(int i, int j) const {
    return figure_.solid_colors[set_.at(i, j).id];
  }
  [[nodiscard]] Color SetColor(int i, int j) const {
    const Hit& hit = set_.at(i, j);
    const Vector3d point =
        view_.PointAt(i + 0.5, j + 0.5) + static_cast<double>(hit.depth) * view_.toward_eye();
    const auto& solid = figure_.solids[hit.id];
    return Lit(SolidColor(i, j), view_.Turn(solid.Locate(point).normal));
  }

  // Where the neighbour to the right or below shows something else.
  [[nodiscard]] bool IsOutline(int i, int j) const {
    const std::int32_t id = set_.at(i, j).id;
    for (const auto& [di, dj] : {std::pair{1, 0}, {0, 1}, {-1, 0}, {0, -1}}) {
      const int x = std::clamp(i + di, 0, set_.width() - 1);
      const int y = std::clamp(j + dj, 0, set_.height() - 1);
      if (set_.at(x, y).id != id) return true;
    }
    return false;
  }

  const Figure& figure_;
  const PanelOptions& options_;
  View view_;
  Raster body_;
  Raster set_;
  std::vector<Vector3d> normals_;
  std::vector<double> gaps_;
};

std::uint32_t Pack(const Color& color) {
  std::uint32_t packed = 0xffu;
  for (int k = 0; k < 3; ++k) {
    packed = (packed << 8) |
             static_cast<std::uint32_t>(std::lround(255.0f * std::clamp(color[k], 0.0f, 1.0f)));
  }
  return packed;
}

}  // namespace

Pixels RenderPanel(const Figure& figure, const View& view, const PanelOptions& options) {
  const Painter painter(figure, view.Scaled(kSamples), options);
  Pixels pixels{options.width, options.height, {}};
  pixels.argb.reserve(static_cast<std::size_t>(options.width) *
                      static_cast<std::size_t>(options.height));
  for (int y = 0; y < options.height; ++y) {
    for (int x = 0; x < options.width; ++x) {
      Color sum = Color::Zero();
      for (int s = 0; s < kSamples * kSamples; ++s) {
        sum += painter.At(kSamples * x + s % kSamples, kSamples * y + s / kSamples);
      }
      pixels.argb.push_back(Pack(sum / static_cast<float>(kSamples * kSamples)));
    }
  }
  return pixels;
}

}  // namespace capfit::client
