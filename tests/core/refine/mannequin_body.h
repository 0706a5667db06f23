// A body of our own, for the tests of core/refine.
#ifndef CAPFIT_TESTS_CORE_REFINE_MANNEQUIN_BODY_H_
#define CAPFIT_TESTS_CORE_REFINE_MANNEQUIN_BODY_H_

#include "core/body/find_body.h"
#include "core/mannequin/mannequin.h"
#include "core/mesh/prepare_mesh.h"

namespace capfit::refine {

inline const body::Body& MannequinBody() {
  static const body::Body body = [] {
    mannequin::MannequinOptions options;
    options.faces = 5000;
    const auto prepared = mesh::PrepareMesh(*mannequin::MakeMannequin(options));
    return *body::FindBody(prepared->mesh, {}, ThreadPool(1), NullObserver());
  }();
  return body;
}

}  // namespace capfit::refine

#endif  // CAPFIT_TESTS_CORE_REFINE_MANNEQUIN_BODY_H_
