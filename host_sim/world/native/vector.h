/* vector.h: a position on the arena's floor, or a displacement. */
#ifndef OCTET_VECTOR_H
#define OCTET_VECTOR_H

struct vector {
    double x;   /* mm, to the right */
    double y;   /* mm, down */
};

#endif
