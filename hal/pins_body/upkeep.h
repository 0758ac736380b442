/* upkeep.h: commands for the parameters of a body on pins, BODY_MEASURE and those after it, and its calibration. The
 * robot core knows none of them. */
#ifndef OCTET_UPKEEP_H
#define OCTET_UPKEEP_H

#include "hal/pins_body/calibrate.h"
#include "hal/pins_body/proximity.h"
#include "firmware/motion/speed_control.h"

struct upkeep {
    struct traits traits;
    struct calibration calibration;
    bool unkept;           /* measured traits are not stored yet */
    bool serves;           /* the current command is for the body, which answers: */
    enum result served;
    uint32_t value;
};

uint8_t upkeep_trait(const struct upkeep *upkeep, unsigned number);
        /* The value of a parameter TRAIT_FIRST..BODY_PARAMETER_END - 1. */

void upkeep_use(const struct upkeep *upkeep, struct proximity *proximity, struct wheel *wheels);
        /* Applies the traits to the sensors and both wheels. */

void upkeep_store(struct upkeep *upkeep);
        /* Stores new measurements, if any. Call only with the wheels at rest. */

void upkeep_serve(struct upkeep *upkeep, const struct command *command, bool running);
        /* Handles a command from outside, if it is for the body. While the robot runs, nothing can be set; while it
           measures, only another measurement. */

void upkeep_answer(const struct upkeep *upkeep, struct output *out);
        /* If the output answers such a command, replaces the robot's answer with the body's. */

#endif
