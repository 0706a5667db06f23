// Which planes cut a chain: where along its medial curve, and what they are called (paper, III-A).
#ifndef CAPFIT_CORE_SECTION_STATIONS_H_
#define CAPFIT_CORE_SECTION_STATIONS_H_

#include <string>
#include <vector>

#include "core/body/body.h"
#include "core/geometry/plane_frame.h"
#include "core/section/part_section.h"

namespace capfit::section {

// A place on a chain where a plane shall cut.
struct Station {
  std::string name;  // "waist", "left_knee", ...
  double arc_length_m = 0.0;
};

// `count` >= 2 stations of a chain that the cutter's body has, from the trunk outward (torso:
// upward).
//
// Torso: hip_low (just above the crotch), hip (the rearmost point of the buttocks), waist, bust,
// chest (at the shoulder joints), neck (the chain's end). Arm: upper_arm (just outside the armpit),
// elbow, wrist. Leg: thigh (just below the crotch), knee, calf (largest section), ankle. The first
// and the last lie at the ends of the part, so that little of it sticks out beyond its polygons.
// Fewer keep the most telling ones; more are spread evenly over the longest gaps. Missing landmarks
// are replaced by shares of the chain's length. Stations are at least a few millimetres apart.
[[nodiscard]] std::vector<Station> PlanStations(const PartCutter& cutter, body::Part chain,
                                                int count);

// The plane through the medial curve there, across its direction (taken over a few centimetres, so
// that at a joint it is the bisector). The normal points along the chain. The x axis points to the
// body's left as far as the plane allows, else (arms held level) down for the left arm and up for
// the right one: mirrored chains get frames that mirror. On a symmetric body the torso's planes
// mirror in x = 0 and have their origin there.
[[nodiscard]] geometry::PlaneFrame PlaneAt(const body::Body& body, body::Part chain,
                                           double arc_length_m);

// The image in x = 0, with the x axis turned round to point left again: a point's image has the
// same coordinates but for the sign of x.
[[nodiscard]] geometry::PlaneFrame MirroredFrame(const geometry::PlaneFrame& frame);

}  // namespace capfit::section

#endif  // CAPFIT_CORE_SECTION_STATIONS_H_
