/* calibrate.h: a body measures itself, one thing at a time, as BODY_MEASURE names it.
 *
 * Light: the light of its own LEDs that each sensor receives from a white wall 60 mm away, the mean of 16 ticks.
 * Motors, wheels in the air: two levels of duty, and a step between them, forward and then backward; both directions
 * count alike. A line through the two speeds gives the dead band (its offset) and the feed-forward (its slope). The
 * distance missing after the step gives the lag.
 * Track, turning on the spot beside one wall: both wheels' distances from a sight of it to the fourth after that. */
#ifndef OCTET_CALIBRATE_H
#define OCTET_CALIBRATE_H

#include "hal/pins_body/pins.h"

/* Calibration of one robot: body_near_right and the parameters after it in octet.dbc. They are stored in flash, in
 * two records beside that of the memory; an interrupted store leaves each record old or new. */

enum {
    CALIBRATION_FIRST = BODY_NEAR_RIGHT,
    CALIBRATION_VALUES = BODY_PARAMETER_END - CALIBRATION_FIRST,
    CALIBRATION_LIGHT = 16,    /* sensor counts per unit of body_near_.. */
    CALIBRATION_DEAD_OF = 8192, CALIBRATION_DEAD_BY = 125   /* this duty is 125 units of body_dead_.. */
};

struct calibration_values {
    uint8_t value[CALIBRATION_VALUES];   /* by number, less CALIBRATION_FIRST */
};

bool calibration_fit(uint8_t number, uint32_t value);
        /* Whether value is in the range of parameter number, BODY_MEASURE..BODY_PARAMETER_END - 1. */

void calibration_load(struct calibration_values *values);
        /* Loads the stored values; those missing or out of range get the defaults of octet.dbc. */

int calibration_store(const struct calibration_values *values);
        /* Returns 0, or HAL_E_STORE. May take a second: call only with the wheels at rest. */

/* The measurements. */

enum { MEASURE_NOTHING, MEASURE_LIGHT, MEASURE_MOTORS, MEASURE_TRACK, MEASURE_ENDS };

enum { CALIBRATE_STAIRS = 5 };        /* of the motors' duty, in each direction */

struct calibration {
    uint8_t measures;                 /* one of these */
    uint8_t refused;                  /* as BODY_REFUSED has it */
    bool saw_wall;
    uint8_t sights;                   /* of the wall */
    uint16_t beats;                   /* since it began */
    uint16_t counts[PINS_SIDES];      /* in the last beat */
    uint16_t marks[PINS_SIDES][CALIBRATE_STAIRS];   /* counts at the end of each: forward, and then those since */
    uint16_t both_mv[CALIBRATE_STAIRS];             /* of the battery there, the sum of both directions */
    int32_t turned, first;            /* left wheel less right, counts: since it began, and up to the first sight */
    int32_t found;                    /* what was refused */
    uint32_t light[FEEL_COUNT];
};   /* all 0: at rest */

struct calibrate_look {
    uint16_t counts[PINS_SIDES];
    uint32_t battery_mv;
    bool senses;                      /* there is new light: */
    const uint16_t *back;             /* as in struct proximity */
    uint8_t has;                      /* the sensors, as PINS_SENSORS: the others are not measured */
    bool wall;                        /* the front sensor is triggered */
};

void calibrate_begin(struct calibration *calibration, uint8_t measures);
        /* Begins to measure one of these; MEASURE_NOTHING: comes to rest. Drops a measurement in progress. */

void calibrate_interrupt(struct calibration *calibration);
        /* Aborts the measurement. */

bool calibrate_beat(struct calibration *calibration, const struct calibrate_look *look,
                    struct calibration_values *values);
        /* Call every 5 ms while it measures. True: it has ended. An impossible result is refused and changes no
           value; otherwise store the values. */

int32_t calibrate_duty(const struct calibration *calibration);
        /* Duty of both motors in the next beat; 0: the wheels' controllers drive them. */

int16_t calibrate_mm_s(const struct calibration *calibration);
        /* Speed of the left wheel; the right one turns backward at the same speed. */

#endif
