/* upkeep.h: what a body on pins knows of itself, and how others come to know and change it: commands for its parameters, BODY_MEASURE
 * and those behind it. The robot knows none of them. */
#ifndef OCTET_UPKEEP_H
#define OCTET_UPKEEP_H

#include "hal/pins_body/calibrate.h"
#include "hal/pins_body/proximity.h"
#include "hal/pins_body/wheel.h"

struct upkeep {
    struct traits traits;
    struct calibration calibration;
    bool unkept;           /* traits that were measured are not stored yet */
    bool serves;           /* the command under way is for the body, which answers: */
    enum result served;
    uint32_t value;
};

uint8_t upkeep_trait(const struct upkeep *upkeep, unsigned number);
        /* The value of a parameter TRAIT_FIRST..BODY_PARAMETER_END - 1. */

void upkeep_use(const struct upkeep *upkeep, struct proximity *proximity, struct wheel *wheels);
        /* Sensors and both wheels go by the traits. */

void upkeep_store(struct upkeep *upkeep);
        /* Stores what was measured, if there is anything. Wheels at rest. */

void upkeep_serve(struct upkeep *upkeep, const struct command *command, bool running);
        /* A command has come from outside. If it is for the body, it is carried out; a robot that runs keeps what it has. */

void upkeep_answer(const struct upkeep *upkeep, struct output *out);
        /* Where the robot's answer was to such a command, puts the body's in its place. */

#endif
