/* munk.h: the part of Munk2D, pymunk's physics library, that is called from here. It is not built a second time: pymunk hands
 * out pointers to its own functions. The types are laid out as in Munk2D's headers. */
#ifndef OCTET_MUNK_H
#define OCTET_MUNK_H

#include <stdint.h>

struct munk_space;
struct munk_body;
struct munk_shape;
struct munk_arbiter;   /* two shapes that touch */

struct munk_vector {
    double x;
    double y;
};

struct munk_filter {
    uintptr_t group;   /* shapes of the same group do not collide; 0: no group */
    unsigned int categories;
    unsigned int mask;
};

struct munk_contact {
    struct munk_vector a;
    struct munk_vector b;
    double distance;   /* negative where the shapes overlap */
};

struct munk_contacts {
    int count;
    struct munk_vector normal;   /* from the first shape into the second */
    struct munk_contact points[2];
};

struct munk_hit {
    const struct munk_shape *shape;
    struct munk_vector point;
    struct munk_vector normal;
    double alpha;
};

struct munk_nearest {
    const struct munk_shape *shape;
    struct munk_vector point;
    double distance;
    struct munk_vector gradient;
};

/* What is called when two shapes begin to touch, in each step in which they do, and when they part. */
struct munk_handler {
    uintptr_t type_a;
    uintptr_t type_b;
    void (*begin)(struct munk_arbiter *arbiter, struct munk_space *space, void *data);
    void (*pre_solve)(struct munk_arbiter *arbiter, struct munk_space *space, void *data);
    void (*post_solve)(struct munk_arbiter *arbiter, struct munk_space *space, void *data);
    void (*separate)(struct munk_arbiter *arbiter, struct munk_space *space, void *data);
    void *data;
};

/* Munk2D's functions, by their own names. */
struct munk {
    void (*cpSpaceStep)(struct munk_space *space, double seconds);
    struct munk_handler *(*cpSpaceAddCollisionHandler)(struct munk_space *space, uintptr_t type_a, uintptr_t type_b);
    struct munk_shape *(*cpSpaceSegmentQueryFirst)(struct munk_space *space, struct munk_vector start,
        struct munk_vector end, double radius, struct munk_filter filter, struct munk_hit *out);
    struct munk_shape *(*cpSpacePointQueryNearest)(struct munk_space *space, struct munk_vector point,
        double distance_max, struct munk_filter filter, struct munk_nearest *out);
    void (*cpBodySetPosition)(struct munk_body *body, struct munk_vector position);
    void (*cpBodySetAngle)(struct munk_body *body, double angle);
    void (*cpArbiterGetShapes)(struct munk_arbiter *arbiter, struct munk_shape **a, struct munk_shape **b);
    struct munk_contacts (*cpArbiterGetContactPointSet)(struct munk_arbiter *arbiter);
};

#endif
