#include "hal/pins_body/proximity.h"

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
