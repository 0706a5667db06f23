/* Says what the header holds: "s x y z radius" for each sphere, "c first second" for each capsule. */
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
  return 0;
}
