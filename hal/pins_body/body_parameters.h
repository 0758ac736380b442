/* body_parameters.h: commands for the parameters of a body on pins, BODY_MEASURE and those after it, and its
 * calibration. The robot core knows none of them. */
#ifndef OCTET_BODY_PARAMETERS_H
#define OCTET_BODY_PARAMETERS_H

#include "hal/pins_body/calibrate.h"
#include "hal/pins_body/inputs.h"
#include "firmware/motion/speed_control.h"

struct body_parameters {
    struct calibration_values values;
    struct calibration calibration;
    bool unstored;         /* measured values are not stored yet */
    bool serves;           /* the current command is for the body, which answers: */
    enum result served;
    uint32_t value;
};

uint8_t parameters_value(const struct body_parameters *parameters, unsigned number);
        /* The value of a parameter CALIBRATION_FIRST..BODY_PARAMETER_END - 1. */

void parameters_apply(const struct body_parameters *parameters, struct proximity *proximity, struct wheel *wheels);
        /* Applies the values to the sensors and both wheels. */

void parameters_store(struct body_parameters *parameters);
        /* Stores new measurements, if any. Call only with the wheels at rest. */

void parameters_serve(struct body_parameters *parameters, const struct command *command, bool running);
        /* Handles a command from outside, if it is for the body. While the robot runs, nothing can be set; while it
           measures, only another measurement. */

void parameters_answer(const struct body_parameters *parameters, struct output *out);
        /* If the output answers such a command, replaces the robot's answer with the body's. */

#endif
