#include "tests/core/body/cut_bodies.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "core/formats/read_mesh.h"
#include "core/mannequin/mannequin.h"
#include "core/mesh/prepare_mesh.h"
#include "tests/support/bodies.h"

namespace capfit::body {

using Eigen::Vector3d;
using formats::PolygonSoup;

PolygonSoup MannequinSoup() {
  mannequin::MannequinOptions options;
  options.faces = 12'000;
  const auto soup = mannequin::MakeMannequin(options);
  EXPECT_TRUE(soup.ok()) << soup.status();
  return *soup;
}

PolygonSoup RealSoup(const std::string& file) {
  const std::string bytes = test_support::ReadFile(test_support::BodiesFolder() / file);
  const auto soup = formats::ReadMesh(std::as_bytes(std::span(bytes)), formats::MeshFormat::kObj);
  EXPECT_TRUE(soup.ok()) << soup.status();
  return *soup;
}

mesh::BodyMesh Prepared(const PolygonSoup& soup) {
  auto prepared = mesh::PrepareMesh(soup);
  EXPECT_TRUE(prepared.ok()) << prepared.status();
  return std::move(prepared->mesh);
}

Vector3d At(const Body& body, LandmarkId id) {
  return body.body_from_caller.Inverse().Apply(body.landmark(id)->position_m);
}

PolygonSoup Without(const PolygonSoup& soup,
                    const std::function<bool(const Vector3d&, std::uint32_t)>& is_cut_off) {
  PolygonSoup rest = soup;
  rest.face_vertices.clear();
  rest.face_sizes.clear();
  std::size_t begin = 0;
  for (std::size_t f = 0; f < soup.face_count(); ++f) {
    const std::size_t corners = soup.face_sizes.empty() ? 3 : soup.face_sizes[f];
    Vector3d middle = Vector3d::Zero();
    for (std::size_t k = 0; k < corners; ++k) {
      middle += soup.positions[soup.face_vertices[begin + k]] / static_cast<double>(corners);
    }
    if (!is_cut_off(middle, soup.face_vertices[begin])) {
      rest.face_sizes.push_back(static_cast<std::uint32_t>(corners));
      for (std::size_t k = 0; k < corners; ++k) {
        rest.face_vertices.push_back(soup.face_vertices[begin + k]);
      }
    }
    begin += corners;
  }
  return rest;
}

}  // namespace capfit::body
