/* trig.h: sine and cosine, the only functions of a mathematical library that the world calls. A world that is to be equal
 * to another one elsewhere is given the same two. */
#ifndef OCTET_TRIG_H
#define OCTET_TRIG_H

double trig_sin(double angle_rad);
double trig_cos(double angle_rad);
        /* Those of the C library, unless another pair is linked in. */

#endif
