// A mesh file and RESULT.json brought into the body frame, to be measured there.
#ifndef CAPFIT_CLIENT_PICTURE_RESULT_BODY_H_
#define CAPFIT_CLIENT_PICTURE_RESULT_BODY_H_

#include <string>

#include "absl/status/statusor.h"
#include "client/picture/result_set.h"
#include "core/base/thread_pool.h"
#include "core/body/find_body.h"
#include "core/capsule/primitive_set.h"
#include "core/formats/polygon_soup.h"
#include "core/pipeline/take_body.h"

namespace capfit::client {

// The mesh of a file, or of standard input, whose format the bytes tell.
[[nodiscard]] absl::StatusOr<formats::PolygonSoup> ReadBodyFile(const std::string& path);

// The mesh checked, mended and understood, as a fit does it: with the parts of the file that the
// result was asked for, in the unit and with the up axis that are told.
[[nodiscard]] absl::StatusOr<pipeline::TakenBody> UnderstandBody(
    const formats::PolygonSoup& soup, const character::CharacterOptions& character, body::Unit unit,
    body::UpAxis up, const ThreadPool& pool);

// The result as the core knows it, in the body frame.
[[nodiscard]] capsule::PrimitiveSet InBodyFrame(const ResultSet& result,
                                                const geometry::Similarity& body_from_caller);

// The parts that the result was asked to cover; of another program's, those that it has spheres
// for; torso, arms and legs where it does not say.
[[nodiscard]] body::PartSelection PartsOfResult(const ResultSet& result);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_PICTURE_RESULT_BODY_H_
