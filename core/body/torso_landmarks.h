// Landmarks of the trunk: crotch, neck, top of the head, and the waist, bust and hip sections.
#ifndef CAPFIT_CORE_BODY_TORSO_LANDMARKS_H_
#define CAPFIT_CORE_BODY_TORSO_LANDMARKS_H_

#include "core/body/shape.h"

namespace capfit::body {

// Where the legs part.
void FindCrotch(const Shape& shape, Landmarks& landmarks);

// Base of the neck and, where there is a head, its top; without a head the neck is at the cut. Sets
// the shape's neck_base_m and neck_middle_m.
void FindNeck(Shape& shape, Landmarks& landmarks);

// Centres of the waist (least girth), bust (greatest depth) and hip (greatest girth) sections, once
// crotch, armpits and neck are known.
void FindTrunkSections(const Shape& shape, Landmarks& landmarks);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_TORSO_LANDMARKS_H_
