// Puts the messages of an upload together to one mesh. Knows the wire's messages, not gRPC.
#ifndef CAPFIT_SERVER_MESH_UPLOAD_H_
#define CAPFIT_SERVER_MESH_UPLOAD_H_

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "absl/status/statusor.h"
#include "capfit/v1/service.pb.h"
#include "core/formats/polygon_soup.h"
#include "core/mesh/prepare_mesh.h"
#include "server/content_hash.h"

namespace capfit::server {

// Of a face in a file, for guesses: OBJ takes some 60 bytes for a triangle and its half of a
// vertex, binary STL 50, PLY and GLB 20 or less.
inline constexpr std::int64_t kFileBytesOfAFace = 40;

struct UploadLimits {
  formats::MeshLimits mesh;
  std::int64_t max_bytes = 128LL * 1024 * 1024;  // of file bytes, or of array elements
};

// Use: Add() each message in order, or AddWhole() the one of a unary call, then Finish(). After an
// error the upload is of no further use.
// Claimed sizes are checked against the limits, but memory is taken only for what has arrived: at
// most twice as much, and no more than was claimed where the claim is true.
//
// Errors are INVALID_ARGUMENT and name the field, what is wrong and the limit: chunk before header,
// second header, chunk of the wrong kind or beyond what was declared, mixed kinds of arrays, empty
// chunk, too many bytes, vertices or faces, claimed sizes not met, nothing uploaded.
class MeshUpload {
 public:
  explicit MeshUpload(const UploadLimits& limits = {}) : limits_(limits) {}

  [[nodiscard]] absl::Status Add(const v1::ApproximateBodyRequest& request);
  // `header` then has the options and the request id of the request. O(bytes): not for a thread
  // that must not block.
  [[nodiscard]] absl::Status AddWhole(const v1::ApproximateBodyUnaryRequest& request);

  // Whether all that the header declares has arrived; false as long as it declares nothing.
  [[nodiscard]] bool is_complete() const;

  // That something has arrived, and as much as the header claims. Finish() asks it too.
  [[nodiscard]] absl::Status CheckComplete() const;

  // Whether the header has arrived; `header` is empty before.
  [[nodiscard]] bool has_header() const { return has_header_; }
  [[nodiscard]] const v1::ApproximateBodyHeader& header() const { return header_; }
  [[nodiscard]] std::int64_t received_bytes() const { return received_bytes_; }
  // What the mesh takes of memory now, and will take if the header's claims are true.
  [[nodiscard]] std::int64_t held_bytes() const;
  [[nodiscard]] std::int64_t claimed_bytes() const;
  // How many faces and vertices have come; guessed from the size where they came as a file.
  [[nodiscard]] std::int64_t face_count() const;
  [[nodiscard]] std::int64_t vertex_count() const;

  // An error about the mesh that Finish gave, in the words of the upload: the core does not know in
  // which precision the positions came.
  [[nodiscard]] absl::Status InCallersWords(const absl::Status& status) const;

  // Reads the file, or hands out the arrays. O(bytes): not for a thread that must not block.
  [[nodiscard]] absl::StatusOr<formats::PolygonSoup> Finish() &&;
  // What tells this mesh and what is asked of it from any other: the header without its claims and
  // its request id, and all that has come. Before Finish(). O(bytes).
  void AddTo(ContentHash& hash) const;
  // Lets go of the file; file() is empty then.
  void DropFile() { file_bytes_ = {}; }
  // The file as it came, also after Finish(); empty where the mesh came as arrays.
  [[nodiscard]] std::span<const std::byte> file() const {
    return std::as_bytes(std::span(file_bytes_));
  }

 private:
  [[nodiscard]] absl::Status AddHeader(const v1::ApproximateBodyHeader& header);
  [[nodiscard]] absl::Status AddChunk(const v1::MeshChunk& chunk);
  // `field`: where in the request they stand.
  [[nodiscard]] absl::Status AddFileBytes(const char* field, const std::string& bytes);
  [[nodiscard]] absl::Status AddArrays(const char* field, const v1::MeshArrays& arrays);
  [[nodiscard]] absl::Status CountBytes(const char* field, std::size_t bytes);
  [[nodiscard]] absl::Status CheckArraySizes() const;
  // How many corners the faces that have been declared or announced by their sizes take.
  [[nodiscard]] std::uint64_t CornersOfFaces() const;
  [[nodiscard]] const char* positions_field() const;

  UploadLimits limits_;
  bool has_header_ = false;
  v1::ApproximateBodyHeader header_;
  std::int64_t received_bytes_ = 0;
  std::string file_bytes_;
  formats::PolygonSoup soup_;
  std::size_t coordinate_count_ = 0;  // of soup_.positions; not a multiple of 3 within a vertex
  std::uint64_t corner_count_ = 0;    // that soup_.face_sizes add up to
  bool has_float_ = false;
  bool has_double_ = false;
  bool has_triangles_ = false;
  bool has_polygons_ = false;
};

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_MESH_UPLOAD_H_
