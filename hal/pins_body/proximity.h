/* proximity.h: what the infrared sensors see: light that comes back while their LEDs shine, less what is there without them. */
#ifndef OCTET_PROXIMITY_H
#define OCTET_PROXIMITY_H

#include "firmware/io.h"

enum {
    PROXIMITY_NEAR = 1200,          /* of 4095: a wall at 60 mm, unless calibrated */
    PROXIMITY_HYSTERESIS_PART = 10  /* a sensor lets go when it receives a tenth less than what triggers it */
};

struct proximity {
    uint16_t near[FEEL_COUNT];      /* light that triggers a sensor */
    uint16_t lit[FEEL_COUNT];       /* measured with the LEDs on, */
    uint16_t back[FEEL_COUNT];      /* and what of it was theirs, as of the last look */
    uint8_t feel;                   /* as last returned */
};

uint8_t proximity_feel(struct proximity *proximity, const uint16_t dark[FEEL_COUNT]);
        /* The sensors that are triggered, the sum of the FEEL_ bits, given lit and what is received without the LEDs. */

uint8_t proximity_range_mm(const struct proximity *proximity, unsigned sensor);
        /* How far a wall is from the rim by its light, as of the last look: 60 mm where it just triggers the sensor. RANGE_NONE: it is
           not triggered. */

#endif
