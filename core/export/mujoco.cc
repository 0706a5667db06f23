#include "core/export/mujoco.h"

#include <algorithm>
#include <map>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/export/file_text.h"
#include "core/export/frame.h"
#include "core/export/joint_frame.h"
#include "core/export/lathe.h"
#include "core/export/solids.h"

namespace capfit::exports {
namespace {

constexpr char kMujocoAxis[] =
    "capsules by fromto: the centres of their two ends, in the body's frame";
constexpr int kMeshSegments = 24;  // 1.7 % of the radius too large, 300 vertices

std::string QuaternionText(const Eigen::Isometry3d& frame) {
  Eigen::Quaterniond q(frame.linear());
  if (q.w() < 0.0) q.coeffs() *= -1.0;
  return absl::StrCat(NumberText(q.w()), " ", NumbersText(q.vec()));
}

class MujocoWriter {
 public:
  MujocoWriter(const ColliderSet& set, const MujocoOptions& options)
      : options_(options),
        upright_(Upright(set)),
        statement_(StatementOf(set, "capfit-mujoco", ZUpFrame(), kMujocoAxis)) {}

  Exported Run() {
    const std::vector<Solid> solids = SolidsOf(upright_);
    std::map<std::int32_t, std::string> geoms_of_joint;
    for (const Solid& solid : solids) Add(solid, geoms_of_joint[solid.joint]);
    const std::vector<std::string> names = JointNames(upright_);
    std::string bodies;
    for (const auto& [joint, geoms] : geoms_of_joint) {
      const std::string name = joint < 0 ? "capfit" : names[joint];
      const Eigen::Isometry3d frame = JointFrameIn(ZUpFrame(), upright_, joint);
      absl::StrAppend(&bodies, "    <body name=\"", XmlText(name), "\" mocap=\"true\" pos=\"",
                      NumbersText(frame.translation()), "\" quat=\"", QuaternionText(frame),
                      "\">\n", geoms, "    </body>\n");
    }
    return {{{"mujoco_colliders.xml", Document(bodies)}}, Warnings(solids)};
  }

 private:
  [[nodiscard]] std::string Document(const std::string& bodies) const {
    std::string xml = "<mujoco model=\"capfit colliders\">\n";
    absl::StrAppend(&xml, "  <!--\n", StatementLines(statement_, "    ", ""), "  -->\n");
    if (!meshes_.empty()) absl::StrAppend(&xml, "  <asset>\n", meshes_, "  </asset>\n");
    return absl::StrCat(xml, "  <worldbody>\n", bodies, "  </worldbody>\n</mujoco>\n");
  }

  void Add(const Solid& solid, std::string& geoms) {
    const bool is_tapered = !solid.IsBall() && solid.hull.a().radius_m != solid.hull.b().radius_m;
    if (is_tapered) ++tapered_count_;
    if (is_tapered && options_.as_meshes) return AddMesh(solid, geoms);
    const Eigen::Isometry3d to_joint = JointFrame(upright_, solid.joint).inverse();
    const std::vector<UniformPiece> pieces = UniformPieces(solid.hull, options_.max_overshoot_m);
    if (is_tapered) piece_count_ += static_cast<std::int64_t>(pieces.size());
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const std::string suffix = k == 0 ? "" : absl::StrCat("_", k + 1);
      AddPiece(solid.name + suffix, to_joint, pieces[k], geoms);
    }
  }

  static void AddPiece(const std::string& name, const Eigen::Isometry3d& to_joint,
                       const UniformPiece& piece, std::string& geoms) {
    const Eigen::Vector3d a = to_joint * piece.a;
    absl::StrAppend(&geoms, "      <geom name=\"", XmlText(name), "\" ");
    if (piece.IsBall()) {
      absl::StrAppend(&geoms, "type=\"sphere\" pos=\"", NumbersText(a));
    } else {
      absl::StrAppend(&geoms, "type=\"capsule\" fromto=\"", NumbersText(a), " ",
                      NumbersText(to_joint * piece.b));
    }
    absl::StrAppend(&geoms, "\" size=\"", NumberText(piece.radius_m), "\"/>\n");
  }

  void AddMesh(const Solid& solid, std::string& geoms) {
    const Eigen::Isometry3d place = JointFrame(upright_, solid.joint).inverse() * solid.Place();
    const std::string name = XmlText(solid.name);
    absl::StrAppend(&meshes_, "    <mesh name=\"", name, "\" vertex=\"");
    for (const Eigen::Vector3d& vertex :
         Lathe(solid, kMeshSegments, LatheKind::kEnclosing).vertices) {
      absl::StrAppend(&meshes_, NumbersText(vertex), " ");
    }
    absl::StrAppend(&meshes_, "\"/>\n");
    absl::StrAppend(&geoms, "      <geom name=\"", name, "\" type=\"mesh\" mesh=\"", name,
                    "\" pos=\"", NumbersText(place.translation()), "\" quat=\"",
                    QuaternionText(place), "\"/>\n");
  }

  [[nodiscard]] std::vector<Warning> Warnings(const std::vector<Solid>& solids) const {
    if (tapered_count_ == 0) return {};
    const std::string start =
        absl::StrCat("MuJoCo has no tapered capsule: ", tapered_count_, " became ");
    if (!options_.as_meshes) {
      return {
          {"CAPSULES_REPLACED",
           absl::StrCat(start, piece_count_, " capsules of one radius that enclose them, up to ",
                        options_.max_overshoot_m, " m too large"),
           tapered_count_}};
    }
    double radius_m = 0.0;
    for (const Solid& solid : solids) {
      radius_m = std::max({radius_m, solid.hull.a().radius_m, solid.hull.b().radius_m});
    }
    return {{"CAPSULES_REPLACED",
             absl::StrCat(start, "convex meshes around them, up to ",
                          LatheDeviation(kMeshSegments) * radius_m, " m too large"),
             tapered_count_}};
  }

  const MujocoOptions options_;
  const ColliderSet upright_;
  const Statement statement_;
  std::string meshes_;
  std::int64_t tapered_count_ = 0;
  std::int64_t piece_count_ = 0;
};

}  // namespace

absl::StatusOr<Exported> WriteMujoco(const ColliderSet& set, const MujocoOptions& options) {
  CAPFIT_RETURN_IF_ERROR(CheckOvershoot(options.max_overshoot_m));
  return MujocoWriter(set, options).Run();
}

}  // namespace capfit::exports
