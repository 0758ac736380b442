#include "hal/pins_body/proximity.h"

enum { WALL_MM = 60, BEHIND_MM = 20 };

uint8_t proximity_feel(struct proximity *proximity, const uint16_t dark[FEEL_COUNT])
{
    unsigned triggered = 0;

    for (unsigned i = 0; i < FEEL_COUNT; i++) {
        unsigned back = proximity->lit[i] > dark[i] ? (unsigned)proximity->lit[i] - dark[i] : 0;
        unsigned near = proximity->near[i];

        proximity->back[i] = (uint16_t)back;
        if ((proximity->feel >> i & 1) != 0)
            near -= near / PROXIMITY_HYSTERESIS_PART;
        triggered |= (back >= near ? 1u : 0u) << i;
    }
    proximity->feel = (uint8_t)triggered;
    return proximity->feel;
}

/* Light decreases with the square of the distance from a point behind the sensor's window. */
uint8_t proximity_range_mm(const struct proximity *proximity, unsigned sensor)
{
    uint32_t square, range_mm = 0;

    if ((proximity->feel >> sensor & 1) == 0)
        return RANGE_NONE;
    square = (uint32_t)proximity->near[sensor] * (WALL_MM + BEHIND_MM) * (WALL_MM + BEHIND_MM)
           / proximity->back[sensor];
    while ((range_mm + 1 + BEHIND_MM) * (range_mm + 1 + BEHIND_MM) <= square)
        range_mm++;
    return (uint8_t)range_mm;
}
