// Colours of parts and gaps, and how light falls on them.
#ifndef CAPFIT_CLIENT_PICTURE_COLOR_H_
#define CAPFIT_CLIENT_PICTURE_COLOR_H_

#include <Eigen/Core>
#include <string>

namespace capfit::client {

using Color = Eigen::Vector3f;  // red, green, blue in [0, 1]

inline const Color kPaper{1.0f, 1.0f, 1.0f};
inline const Color kSkin{0.80f, 0.76f, 0.72f};
inline const Color kNotFitted{0.66f, 0.66f, 0.66f};  // body parts that nothing stands for
inline const Color kInk{0.13f, 0.15f, 0.18f};

// A colour for each body part ("torso", "left_arm", ...), at shade 1/2 the one of the legend; a
// little lighter or darker by `shade` in [0, 1], which tells the primitives of a part apart. People
// who see no red, no green or no blue can tell the parts' colours apart, and all of them from
// kNotFitted. Other words: any colour, by `shade` alone.
[[nodiscard]] Color PartColor(const std::string& part, double shade);

// From blue (-1) over near white (0) and orange to dark red (1).
[[nodiscard]] Color SignedColor(double value);

// The colour of a surface under the picture's lamps. `normal` is (right, up, towards the eye).
[[nodiscard]] Color Lit(const Color& color, const Eigen::Vector3d& normal);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_PICTURE_COLOR_H_
