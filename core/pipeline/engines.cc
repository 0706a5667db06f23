#include "core/pipeline/engines.h"

#include <algorithm>
#include <array>
#include <optional>

#include "core/pipeline/fit.h"

namespace capfit::pipeline {
namespace {

using capsule::CapsuleProfile;

// Limits and profiles as the engines' own documentation and sources have them.
constexpr std::array<Engine, 9> kEngines = {{
    // 32-bit masks inside: 32 spheres, 32 pairs of them.
    {"nvcloth", 32, 32, 0, CapsuleProfile::kTangentHull},
    {"unity_cloth", 32, 32, 0, CapsuleProfile::kTangentHull},
    // Chaos Cloth: tapered capsules on bones, counts unlimited.
    {"unreal", 0, 0, 0, CapsuleProfile::kTangentHull},
    // btMultiSphereShape of two spheres each.
    {"bullet", 0, 0, 0, CapsuleProfile::kTangentHull},
    // TaperedCapsuleShape.
    {"jolt", 0, 0, 0, CapsuleProfile::kTangentHull},
    // Tapered limits: the radius is interpolated at the nearest point of the axis.
    {"kawaii_physics", 0, 0, 0, CapsuleProfile::kLerpedRadius},
    // VRMC_springBone: spheres and capsules of one radius.
    {"vrm", 0, 0, 0, CapsuleProfile::kUniformRadius},
    // At most 16 collision shapes on a character.
    {"iclone", 0, 0, 16, CapsuleProfile::kUniformRadius},
    // <geom type="capsule" fromto size>.
    {"mujoco", 0, 0, 0, CapsuleProfile::kUniformRadius},
}};

constexpr int kPrimitivesOfOwnCapsule = 3;

void Lower(int limit, std::optional<int>& value) {
  if (limit > 0) value = std::min(value.value_or(limit), limit);
}

// At least 1 where `count` is above `limit`; a capsule that goes frees `each`.
int Excess(int count, const std::optional<int>& limit, int each) {
  return limit.has_value() && count > *limit ? (count - *limit + each - 1) / each : 0;
}

}  // namespace

std::span<const Engine> Engines() { return kEngines; }

const Engine* FindEngine(std::string_view name) {
  const auto found = std::find_if(kEngines.begin(), kEngines.end(),
                                  [&](const Engine& engine) { return engine.name == name; });
  return found == kEngines.end() ? nullptr : &*found;
}

CapsuleProfile ProfileOf(const FitOptions& options) {
  const Engine* const engine = FindEngine(options.engine);
  return engine == nullptr ? CapsuleProfile::kTangentHull : engine->profile;
}

std::string EngineNames() {
  std::string names;
  for (const Engine& engine : kEngines) {
    if (!names.empty()) names += ", ";
    names += engine.name;
  }
  return names;
}

FitOptions WithEngineLimits(const FitOptions& options) {
  FitOptions limited = options;
  const Engine* const engine = FindEngine(options.engine);
  if (engine == nullptr) return limited;
  Lower(engine->max_spheres, limited.max_spheres);
  Lower(engine->max_capsules, limited.max_capsules);
  if (engine->profile != CapsuleProfile::kUniformRadius) return limited;
  Lower(engine->max_shapes, limited.max_capsules);
  const bool has_limit = limited.max_spheres.has_value() || limited.max_capsules.has_value() ||
                         limited.polygon_error.has_value();
  if (limited.max_primitives.has_value() || !has_limit) {
    Lower(limited.max_primitives.value_or(kDefaultMaxPrimitives) / kPrimitivesOfOwnCapsule,
          limited.max_capsules);
  }
  Lower(limited.max_spheres.value_or(kMaxSpheresRange.high) / 2, limited.max_capsules);
  limited.max_primitives.reset();
  limited.max_spheres.reset();
  return limited;
}

int ExcessCapsules(const FitOptions& options, const capsule::PrimitiveSet& set) {
  const Engine* const engine = FindEngine(options.engine);
  if (engine == nullptr || engine->profile != CapsuleProfile::kUniformRadius) return 0;
  std::optional<int> max_spheres = options.max_spheres;
  Lower(kMaxSpheresRange.high, max_spheres);
  std::optional<int> max_shapes;
  Lower(engine->max_shapes, max_shapes);
  std::optional<int> max_primitives = options.max_primitives;
  const bool has_budget = max_primitives.has_value() || options.max_spheres.has_value() ||
                          options.max_capsules.has_value() || options.polygon_error.has_value() ||
                          max_shapes.has_value();
  if (!has_budget) Lower(kDefaultMaxPrimitives, max_primitives);
  return std::max({Excess(capsule::ShapeCount(set), max_shapes, 1),
                   Excess(set.primitive_count(), max_primitives, kPrimitivesOfOwnCapsule),
                   Excess(static_cast<int>(set.spheres.size()), max_spheres, 2)});
}

}  // namespace capfit::pipeline
