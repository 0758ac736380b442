#include "host_sim/world/native/trig.h"

#include <math.h>

#include "host_sim/world/native/vector_sums.h"

/* A quarter turn, in three parts: a million times the first or the second is still exact in a double. */
#define QUARTER_RAD 0x1.921fb544p0
#define QUARTER_2ND 0x1.0b4611a6p-34
#define QUARTER_3RD 0x1.3198a2e037073p-69
#define QUARTERS_PER_RAD 0x1.45f306dc9c883p-1

/* An angle reduced by whole quarter turns. */
struct reduced {
    double rad;    /* -pi/4..pi/4 */
    double rest;   /* rounding error of rad */
    unsigned quarters;
};

static struct reduced reduce(double angle_rad)
{
    double quarters = vector_whole(angle_rad * QUARTERS_PER_RAD);
    double coarse = angle_rad - quarters * QUARTER_RAD;
    double fine = coarse - quarters * QUARTER_2ND;
    double rest = coarse - fine - quarters * QUARTER_2ND - quarters * QUARTER_3RD;

    return (struct reduced){fine, rest, (unsigned)(long)quarters % 4u};
}

/* The Taylor series, until its terms no longer count: x - x^3/3! + x^5/5! ... and 1 - x^2/2! + x^4/4! ... */
static double sine(struct reduced x)
{
    double s = x.rad * x.rad;
    double sum = s * (-1.0 / 6 + s * (1.0 / 120 + s * (-1.0 / 5040 + s * (1.0 / 362880 + s * (-1.0 / 39916800
                 + s * (1.0 / 6227020800 + s * (-1.0 / 1307674368000)))))));

    return x.rad + (x.rad * sum + x.rest * (1 - s / 2));
}

static double cosine(struct reduced x)
{
    double s = x.rad * x.rad;
    double sum = s * s * (1.0 / 24 + s * (-1.0 / 720 + s * (1.0 / 40320 + s * (-1.0 / 3628800 + s * (1.0 / 479001600
                 + s * (-1.0 / 87178291200 + s * (1.0 / 20922789888000)))))));
    double most = 1 - s / 2;

    return most + (1 - most - s / 2 + sum - x.rad * x.rest);
}

static double of_quarter(struct reduced x, unsigned quarter)
{
    double size = quarter % 2 ? cosine(x) : sine(x);

    return quarter % 4 < 2 ? size : -size;
}

double trig_sin(double angle_rad)
{
    struct reduced x = reduce(angle_rad);

    return of_quarter(x, x.quarters);
}

double trig_cos(double angle_rad)
{
    struct reduced x = reduce(angle_rad);

    return of_quarter(x, x.quarters + 1);
}

struct vector trig_along(double angle_rad)
{
    struct reduced x = reduce(angle_rad);

    return (struct vector){of_quarter(x, x.quarters + 1), of_quarter(x, x.quarters)};
}

double trig_hypot(double dx, double dy)
{
    return sqrt(dx * dx + dy * dy);
}
