/* inputs.h: what a body on pins makes of its contacts and of its sensors' light.
 *
 * One button serves a robot without a PC. Pressed while the robot runs, it stops. Pressed n times at rest, it starts
 * with the n-th profile, a second after the last press. Held for five seconds, it erases its memory. */
#ifndef OCTET_INPUTS_H
#define OCTET_INPUTS_H

#include "firmware/io.h"

struct button {
    uint8_t same;       /* debouncing: readings in a row that differ from down */
    bool down;          /* debounced state */
    uint8_t presses;    /* since the robot came to rest */
    uint16_t ticks;     /* since it was pressed or released; saturates */
    bool held;          /* long enough to erase the memory */
};   /* all 0: not pressed */

bool button_look(struct button *button, bool pressed, bool running, struct command *command);
        /* Call once per tick of 20 ms. True: *command holds a command; the caller sets the seed of a start. */

/* The infrared sensors: the light received with the LEDs on, less the ambient light. */

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
