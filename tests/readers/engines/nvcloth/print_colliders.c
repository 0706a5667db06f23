/* Says what the header holds: "s x y z radius" for each sphere, "c first second" for each capsule, "n NAME"
 * in hexadecimal for each joint, "o joint x y z" for each sphere's place in its joint. */
#include <stdio.h>

#include "nvcloth_colliders.h"

int main(void) {
  int i;
  for (i = 0; i < CAPFIT_SPHERE_COUNT; ++i) {
    const float* sphere = capfit_spheres + 4 * i;
    printf("s %.9g %.9g %.9g %.9g\n", sphere[0], sphere[1], sphere[2], sphere[3]);
  }
  for (i = 0; i < CAPFIT_CAPSULE_COUNT; ++i) {
    printf("c %u %u\n", (unsigned)capfit_capsules[2 * i], (unsigned)capfit_capsules[2 * i + 1]);
  }
  for (i = 0; i < CAPFIT_JOINT_COUNT; ++i) {
    const char* name = capfit_joint_names[i];
    printf("n ");
    for (; *name != 0; ++name) printf("%02x", (unsigned)(unsigned char)*name);
    printf("\n");
  }
  for (i = 0; i < CAPFIT_SPHERE_COUNT; ++i) {
    const float* offset = capfit_sphere_offsets + 3 * i;
    printf("o %d %.9g %.9g %.9g\n", (int)capfit_sphere_joints[i], offset[0], offset[1], offset[2]);
  }
  return 0;
}
