#include "server/server_info.h"

#include <functional>
#include <string>

#include "core/base/version.h"
#include "core/export/export.h"
#include "core/pipeline/engines.h"
#include "core/refine/layouts/standard_layouts.h"
#include "proto/wire/enum_conversion.h"

namespace capfit::server {
namespace {

using pipeline::FitOptions;

// An option's word, and how to ask for it.
struct Feature {
  const char* name;
  std::function<void(FitOptions&)> ask;
};

// In the order of the vocabulary in server_info.proto. The forms of weights that the core has no
// word for yet are not here, so they are not promised.
const std::vector<Feature>& Features() {
  static const std::vector<Feature> features = {
      {"call.unary", [](FitOptions&) {}},
      {"budget.max_primitives", [](FitOptions& o) { o.max_primitives = 64; }},
      {"budget.spheres_and_capsules",
       [](FitOptions& o) {
         o.max_spheres = 32;
         o.max_capsules = 32;
       }},
      {"budget.max_polygon_error", [](FitOptions& o) { o.polygon_error = 0.1; }},
      {"budget.engine", [](FitOptions& o) { o.engine = "nvcloth"; }},
      {"fit.enclose", [](FitOptions& o) { o.fit = pipeline::FitMode::kEnclose; }},
      {"fit.best_fit", [](FitOptions& o) { o.fit = pipeline::FitMode::kBestFit; }},
      {"quality.paper", [](FitOptions& o) { o.quality = pipeline::Quality::kPaper; }},
      {"quality.balanced", [](FitOptions& o) { o.quality = pipeline::Quality::kBalanced; }},
      {"quality.tight", [](FitOptions& o) { o.quality = pipeline::Quality::kTight; }},
      {"skinning.dense", [](FitOptions& o) { o.skinning = pipeline::SkinningMode::kDense; }},
      {"skinning.sparse", [](FitOptions& o) { o.skinning = pipeline::SkinningMode::kSparse; }},
      {"skinning.bones", [](FitOptions& o) { o.skinning = pipeline::SkinningMode::kBones; }},
      {"option.landmarks",
       [](FitOptions& o) { o.landmarks[body::LandmarkId::kNeck] = Eigen::Vector3d::Zero(); }},
      {"option.mesh_parts",
       [](FitOptions& o) {
         o.character.exclude = {"hat"};
         o.character.hair = true;
       }},
      {"option.require_parts", [](FitOptions& o) { o.require_parts.torso = true; }},
      {"option.seed", [](FitOptions& o) { o.seed = 1; }},
      {"option.sex", [](FitOptions& o) { o.sex = section::Sex::kFemale; }},
      {"option.tolerance_m", [](FitOptions& o) { o.tolerance_m = 0.001; }},
      {"option.feature_polygons", [](FitOptions& o) { o.want_polygons = true; }},
      {"option.vertex_gaps", [](FitOptions& o) { o.want_vertex_gaps = true; }},
      {"call.layout", [](FitOptions& o) { o.layout = refine::StandardLayouts().front(); }},
      {"call.exports",
       [](FitOptions& o) {
         o.exports = {{"gltf", {}}};
       }},
  };
  return features;
}

void AddFeatures(const FitBackend& backend, v1::GetServerInfoResponse& info) {
  for (const Feature& feature : Features()) {
    FitOptions options;
    feature.ask(options);
    if (backend.validate(options).ok()) info.add_features(feature.name);
  }
}

void AddEngines(v1::GetServerInfoResponse& info) {
  for (const pipeline::Engine& known : pipeline::Engines()) {
    v1::Engine& engine = *info.add_engines();
    engine.set_name(std::string(known.name));
    engine.set_max_spheres(known.max_spheres);
    engine.set_max_capsules(known.max_capsules);
    engine.set_max_shapes(known.max_shapes);
    engine.set_profile(wire::ToWire(known.profile));
  }
}

void AddLayouts(v1::GetServerInfoResponse& info) {
  for (const refine::KeptLayout& known : refine::StandardLayouts()) {
    v1::StandardLayout& layout = *info.add_layouts();
    layout.set_name(known.name);
    layout.set_sphere_count(known.count().spheres);
    layout.set_capsule_count(known.count().capsules);
  }
}

void AddExportFormats(v1::GetServerInfoResponse& info) {
  for (const exports::ExportFormat& known : exports::ExportFormats()) {
    v1::ExportFormat& format = *info.add_export_formats();
    format.set_name(std::string(known.name));
    format.set_summary(std::string(known.summary));
    format.set_needs_original(known.needs_original);
  }
}

}  // namespace

v1::GetServerInfoResponse DescribeServer(const ServerConfig& config, int threads,
                                         const FitBackend& backend) {
  v1::GetServerInfoResponse info;
  info.set_version(std::string(Version()));
  v1::ServerLimits& limits = *info.mutable_limits();
  limits.set_max_upload_bytes(config.upload.max_bytes);
  limits.set_max_vertices(static_cast<std::int64_t>(config.upload.mesh.max_vertices));
  limits.set_max_faces(static_cast<std::int64_t>(config.upload.mesh.max_faces));
  limits.set_max_corners_per_face(static_cast<int>(config.upload.mesh.max_corners_per_face));
  limits.set_max_message_bytes(kMaxMessageBytes);
  limits.set_max_concurrent_fits(config.max_concurrent_fits);
  limits.set_max_queued_fits(config.max_queued_fits);
  limits.set_threads(threads);
  for (const v1::MeshFileFormat format :
       {v1::MESH_FILE_FORMAT_OBJ, v1::MESH_FILE_FORMAT_PLY, v1::MESH_FILE_FORMAT_STL,
        v1::MESH_FILE_FORMAT_OFF, v1::MESH_FILE_FORMAT_GLB}) {
    info.add_formats(format);
  }
  AddEngines(info);
  AddFeatures(backend, info);
  AddLayouts(info);
  AddExportFormats(info);
  return info;
}

}  // namespace capfit::server
