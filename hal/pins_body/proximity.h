/* proximity.h: reads the infrared sensors: the light received with the LEDs on, less the ambient light. */
#ifndef OCTET_PROXIMITY_H
#define OCTET_PROXIMITY_H

#include "firmware/io.h"

enum { PROXIMITY_HYSTERESIS_PART = 10 };   /* a sensor releases at a tenth less than it triggers at */

struct proximity {
    uint16_t near[FEEL_COUNT];      /* light that triggers a sensor */
    uint16_t lit[FEEL_COUNT];       /* measured with the LEDs on, */
    uint16_t back[FEEL_COUNT];      /* and the LEDs' part of it, as of the last reading */
    uint8_t feel;                   /* as last returned */
};

uint8_t proximity_feel(struct proximity *proximity, const uint16_t dark[FEEL_COUNT]);
        /* The triggered sensors, the sum of the FEEL_ bits, from lit and the light received with the LEDs off. */

uint8_t proximity_range_mm(const struct proximity *proximity, unsigned sensor);
        /* Distance of a wall from the rim by its light, as of the last reading: 60 mm where it just triggers the
           sensor. RANGE_NONE: not triggered. */

#endif
