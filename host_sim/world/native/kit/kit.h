/* kit.h: a real body: wheels that follow late and unevenly, sensors that differ. Each robot's is drawn from its seed.
 * If the wheels have motors, their speed is controlled as on a board: firmware/motion/speed_control.h. */
#ifndef OCTET_WORLD_KIT_H
#define OCTET_WORLD_KIT_H

#include "firmware/motion/speed_control.h"
#include "host_sim/world/native/ranges.h"

enum { KIT_DELAY_MAX = 5, KIT_SENSED = 8, KIT_WHEELS = 2 };   /* KIT_SENSED: a power of 2, above KIT_DELAY_MAX */
enum { KIT_LIGHT_NEAR = 1200 };   /* what triggers a sensor of a robot that was not calibrated: body_near_right */

enum trait {
    TRAIT_LAG_MS, TRAIT_DEAD_MM_S, TRAIT_ACCELERATION_MM_S2, TRAIT_SLACK_MM, TRAIT_COUNT_MM, TRAIT_LEFT_WHEEL,
    TRAIT_RIGHT_WHEEL, TRAIT_TRACK, TRAIT_SLIP, TRAIT_DRIVES_TICKS, TRAIT_MOTOR_MS, TRAIT_LEFT_MOTOR,
    TRAIT_RIGHT_MOTOR, TRAIT_BATTERY_V, TRAIT_SAG_V, TRAIT_SENSES_TICKS, TRAIT_RIGHT_MM, TRAIT_FRONT_RIGHT_MM,
    TRAIT_FRONT_MM, TRAIT_FRONT_LEFT_MM, TRAIT_LEFT_MM, TRAIT_CONE_DEG, TRAIT_FOLD_MM, TRAIT_HYSTERESIS_MM,
    TRAIT_NOISE_MM, TRAIT_WALL, TRAIT_BEAM_DEG, TRAIT_BEACON_MM, TRAIT_BEACON_NOISE, TRAIT_COUNT
};

/* The range and the values of each trait; docs/bodies.md explains them. */
struct trait_row {
    const char *name;
    double least, most;
    double ideal;
    double kit, tolerance;   /* of a robot of the kit: nominal value, and plus or minus this */
};

extern const struct trait_row KIT_TRAITS[TRAIT_COUNT];

/* The kind of the bodies of a run. */
struct kit_kind {
    double trait[TRAIT_COUNT];
    double tolerance[TRAIT_COUNT];   /* either way */
};

struct kit_wheel {
    struct wheel control;
    int32_t duty;         /* 1/65536 */
    int64_t speed;        /* of the motor, 1/65536 count in a period of the controller */
    int64_t strength;     /* of the motor: the speed that a duty of 1 beyond the dead band adds in a period */
    uint64_t place;       /* of the motor, 1/65536 count, */
    uint64_t place_was;   /* and when it last rolled */
    double told_mm_s;     /* commanded speed after the lag, */
    int16_t told;         /* and rounded, for the controller */
    double motor_mm;      /* distance rolled by the motor, at the wheel's rim, */
    double wheel_mm;      /* by the wheel after the slack, */
    double counted_mm;    /* and as counted by its odometer */
};

struct kit {
    bool wheels_differ, senses_differ;   /* false: they are ideal */
    bool pushed;                         /* a board drives the motors itself, by kit_push */
    bool has_sensed;
    double apart[TRAIT_COUNT];           /* from the ideal, as it was drawn */
    double trait[TRAIT_COUNT];           /* with its faults */
    uint64_t key;                        /* seed of its random numbers */
    uint32_t moved;                      /* number of ticks in which it rolled */
    uint32_t battery_mv;
    int64_t supply;                      /* battery_v, */
    uint64_t sag;                        /* and sag_v, by the nominal voltage, 1/65536 */
    int64_t speed_kept;                  /* of a motor in a period of the controller, 1/65536 */
    double counts_per_mm;                /* of the odometers; 0: exact */
    double lag_gain;                     /* part of the difference made up in a period */
    struct kit_wheel wheels[KIT_WHEELS];
    double told[KIT_DELAY_MAX + 1][KIT_WHEELS];   /* the last commands, newest first */
    struct senses sensed[KIT_SENSED];             /* of the last ticks */
    const struct ranges *ranges;                  /* what its sensors measure */
};   /* all 0: ideal */

void kit_draw(struct kit *kit, const struct kit_kind *kind, uint32_t seed, uint32_t robot);
        /* Draws a robot's body, each trait within its tolerance and its range, from the seed of the run and the
           number of the robot, from 0. A null kind is ideal. */

void kit_set_kind(struct kit_kind *kind, bool is_kit);
        /* The kind of the kit, or an ideal one. */

double kit_reach_mm(const struct kit_kind *kind);
        /* Maximum range of any sensor of such a body, beyond its rim. */

void kit_suffer(struct kit *kit, const struct body_faults *faults);
        /* Replaces its faults by these; all else stays as drawn. */

double kit_chance(const struct kit *kit, uint64_t number);
        /* A uniform random number from -1 to 1. */

/* kit_wheels.c: */

double kit_roll(struct kit *kit, double tick_s, double *counted_mm, double *rolled_mm);
        /* Rolls both wheels, left and right, for a tick. rolled_mm: in, the distances commanded; out, those rolled.
           counted_mm: what the odometers count. Returns the track as a fraction of the ideal one. */

void kit_push(struct kit *kit, const int32_t duty[KIT_WHEELS]);
        /* Lets a board drive both motors for a controller's period: duty in 1/65536 of the battery. From now on the
           body rolls as the motors push it, ignores commands and senses without delay: the board has its own. */

uint32_t kit_supply_mv(const struct kit *kit);
        /* Voltage of the battery under the load of both motors. */

uint16_t kit_count(const struct kit *kit, unsigned side);
        /* Counts of a wheel's encoder; wraps. */

/* kit_senses.c: */

void kit_light(const struct kit *kit, const struct world *world, const struct body *body, uint32_t tick,
               uint16_t light[FEEL_COUNT]);
        /* Light of its own LEDs that each infrared sensor receives, 0..4095: KIT_LIGHT_NEAR from a wall at the
           sensor's maximum range. */

void kit_light_from(const struct kit *kit, const uint8_t range_mm[FEEL_COUNT], uint32_t tick,
                    uint16_t light[FEEL_COUNT]);
        /* The same, from walls at these distances beyond its rim; RANGE_NONE: no wall. */

void kit_sense(struct kit *kit, const struct world *world, const struct body *body, uint32_t tick,
               struct senses *senses);
        /* Converts what an ideal body senses to what this one senses: the same, if called again in a tick. */

bool kit_sees(const struct kit *kit, double ahead_mm, double aside_mm, double beam_mm);
        /* Whether its receiver sees food this far ahead and to the side; beam_mm: the width of the ideal beam. */

#endif
