/* trig.h: sine, cosine and distance, equal to the last bit on every machine: computed only by additions,
 * multiplications and square roots, which IEEE 754 defines exactly. Those of C libraries differ in the last place. */
#ifndef OCTET_TRIG_H
#define OCTET_TRIG_H

#include "host_sim/world/native/vector.h"

double trig_sin(double angle_rad);
double trig_cos(double angle_rad);
struct vector trig_along(double angle_rad);   /* both: the unit vector in that direction */
        /* Off by at most 1.1 units in the last place, for angles of -10^6..10^6 rad. */

double trig_hypot(double dx, double dy);
        /* The length of a vector, in its own unit; for lengths up to 10^150. */

#endif
