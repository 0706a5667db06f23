// Bodies with something cut off, for the tests of this room.
#ifndef CAPFIT_TESTS_CORE_BODY_CUT_BODIES_H_
#define CAPFIT_TESTS_CORE_BODY_CUT_BODIES_H_

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string>

#include "core/body/body.h"
#include "core/formats/polygon_soup.h"
#include "core/mesh/body_mesh.h"

namespace capfit::body {

// A mannequin of 12,000 faces.
[[nodiscard]] formats::PolygonSoup MannequinSoup();

// An OBJ file of the folder of bodies.
[[nodiscard]] formats::PolygonSoup RealSoup(const std::string& file);

// Fails the test where it cannot be prepared.
[[nodiscard]] mesh::BodyMesh Prepared(const formats::PolygonSoup& soup);

// Where the body has a landmark, in the caller's frame.
[[nodiscard]] Eigen::Vector3d At(const Body& body, LandmarkId id);

// Without the faces that are cut off, as told by their middle and one of their corners.
[[nodiscard]] formats::PolygonSoup Without(
    const formats::PolygonSoup& soup,
    const std::function<bool(const Eigen::Vector3d& middle, std::uint32_t corner)>& is_cut_off);

}  // namespace capfit::body

#endif  // CAPFIT_TESTS_CORE_BODY_CUT_BODIES_H_
