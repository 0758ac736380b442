/* vector_sums.h: vector arithmetic and rounding, without a C library. */
#ifndef OCTET_VECTOR_SUMS_H
#define OCTET_VECTOR_SUMS_H

#include "host_sim/world/native/vector.h"

static inline struct vector vector_to(struct vector from, struct vector to)
{
    return (struct vector){to.x - from.x, to.y - from.y};
}

static inline struct vector vector_add(struct vector one, struct vector other)
{
    return (struct vector){one.x + other.x, one.y + other.y};
}

static inline struct vector vector_scale(struct vector way, double factor)
{
    return (struct vector){way.x * factor, way.y * factor};
}

static inline double vector_dot(struct vector one, struct vector other)
{
    return one.x * other.x + one.y * other.y;
}

static inline double vector_cross(struct vector one, struct vector other)
{
    return one.x * other.y - one.y * other.x;
}

static inline double vector_root(double square)
{
    return __builtin_sqrt(square);   /* an instruction on every supported processor */
}

static inline double vector_length(struct vector way)
{
    return vector_root(vector_dot(way, way));
}

static inline double vector_whole(double number)
{
    /* Rounds to the nearest whole number, a half to the even one, with every compiler; for less than 2^51. */
    static const double SHIFT = 6755399441055744.0;

    return (number + SHIFT) - SHIFT;
}

#endif
