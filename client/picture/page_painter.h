// A page that has been laid out as the bytes of a PNG or SVG file.
#ifndef CAPFIT_CLIENT_PICTURE_PAGE_PAINTER_H_
#define CAPFIT_CLIENT_PICTURE_PAGE_PAINTER_H_

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "client/picture/page.h"
#include "client/picture/panel.h"

namespace capfit::client {

enum class PictureFormat { kPng, kSvg };

// `panels`: the pixels of page.panels. In an SVG file they are images; lines and words are curves.
// The text is drawn with cairo's own built-in font, so that the bytes are the same on every machine
// with the same cairo and libpng. INTERNAL where cairo fails.
[[nodiscard]] absl::StatusOr<std::string> PaintPage(const Page& page, std::vector<Pixels> panels,
                                                    PictureFormat format);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_PICTURE_PAGE_PAINTER_H_
