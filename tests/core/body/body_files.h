// Real bodies and their ground truth, for the tests of this room.
#ifndef CAPFIT_TESTS_CORE_BODY_BODY_FILES_H_
#define CAPFIT_TESTS_CORE_BODY_BODY_FILES_H_

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/body/find_body.h"
#include "core/mesh/body_mesh.h"

namespace capfit::body {

// One pose of one body: its mesh file and where its joints and skin points are, by name.
struct PosedBody {
  std::string file;  // relative to the folder of bodies
  std::map<std::string, Eigen::Vector3d> points;
};

// All whole bodies in all their poses (17 of them), by name.
[[nodiscard]] std::vector<PosedBody> PosedBodies();

// Reads and prepares a file of the folder; fails the test where that does not work.
[[nodiscard]] mesh::BodyMesh LoadBody(const std::string& file);

// Body of the mesh, found on one thread.
[[nodiscard]] absl::StatusOr<Body> Find(const mesh::BodyMesh& mesh,
                                        const BodyOptions& options = {});

// Millimetres between a landmark (back in the caller's frame) and a point; infinity without it.
[[nodiscard]] double ErrorMm(const Body& body, const std::string& name,
                             const Eigen::Vector3d& truth);

// Share of the surface whose segment is that of the labels, one byte for each source vertex.
[[nodiscard]] double LabelledAs(const Body& body, const std::string& labels);
// The same with the labels of a file.
[[nodiscard]] double LabelledRight(const Body& body, const std::string& label_file);

// Joints that the accuracy of the whole is judged by; shoulders and hips have their own limit.
[[nodiscard]] bool IsMainJoint(const std::string& name);
[[nodiscard]] bool IsShoulderOrHip(const std::string& name);

}  // namespace capfit::body

#endif  // CAPFIT_TESTS_CORE_BODY_BODY_FILES_H_
