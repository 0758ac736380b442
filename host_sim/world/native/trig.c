#include "host_sim/world/native/trig.h"

#include <math.h>

double trig_sin(double angle_rad)
{
    return sin(angle_rad);
}

double trig_cos(double angle_rad)
{
    return cos(angle_rad);
}
