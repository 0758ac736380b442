/* kit.h: a real body: wheels that follow late and unevenly, sensors that differ. A robot's own is drawn from its seed. Where
 * the wheels have motors, the very controller of a board holds their speed: hal/pins_body/wheel.h. */
#ifndef OCTET_WORLD_KIT_H
#define OCTET_WORLD_KIT_H

#include "hal/pins_body/wheel.h"
#include "host_sim/world/native/ranges.h"

enum { KIT_DELAY_MAX = 5, KIT_WHEELS = 2 };

enum trait {
    TRAIT_LAG_MS, TRAIT_DEAD_MM_S, TRAIT_ACCELERATION_MM_S2, TRAIT_SLACK_MM, TRAIT_COUNT_MM, TRAIT_LEFT_WHEEL, TRAIT_RIGHT_WHEEL,
    TRAIT_TRACK, TRAIT_SLIP, TRAIT_SENSES_TICKS, TRAIT_DRIVES_TICKS, TRAIT_MOTOR_MS, TRAIT_LEFT_MOTOR, TRAIT_RIGHT_MOTOR,
    TRAIT_BATTERY_V, TRAIT_SAG_V, TRAIT_RIGHT_MM, TRAIT_FRONT_RIGHT_MM, TRAIT_FRONT_MM, TRAIT_FRONT_LEFT_MM, TRAIT_LEFT_MM,
    TRAIT_HYSTERESIS_MM, TRAIT_NOISE_MM, TRAIT_WALL, TRAIT_BEAM_DEG, TRAIT_BEACON_NOISE, TRAIT_COUNT
};

/* What each trait may be, and what it is; docs/bodies.md says what they mean. */
struct trait_row {
    const char *name;
    double least, most;
    double ideal;
    double kit, tolerance;   /* of a robot of the kit: within so much of it, either way */
};

extern const struct trait_row KIT_TRAITS[TRAIT_COUNT];

struct kit_wheel {
    struct wheel control;
    double told_mm_s;    /* as it follows with the lag */
    double speed_mm_s;   /* of the motor, at the wheel's rim */
    double motor_mm;     /* way of the motor, at the wheel's rim, */
    double wheel_mm;     /* and of the wheel behind the slack; */
    double motor_was_mm, wheel_was_mm;   /* both when it last rolled */
    double duty;         /* -1..1 */
};

struct kit {
    bool wheels_differ, senses_differ;   /* false: they are ideal */
    bool pushed;         /* a board drives the motors itself, by kit_push */
    double trait[TRAIT_COUNT];
    uint64_t key;        /* from which its random numbers follow */
    uint32_t moved;      /* ticks in which it has rolled */
    bool has_sensed;
    uint32_t tick;       /* of the last senses, */
    struct senses told_senses;   /* and what they were */
    double lag_gain, motor_gain;   /* in a period of the controller, of what is missing */
    struct kit_wheel wheels[KIT_WHEELS];
    double told[KIT_DELAY_MAX + 1][KIT_WHEELS];   /* the last orders, the newest first */
    struct senses sensed[KIT_DELAY_MAX + 1];
    uint8_t feel;        /* the last, for the hysteresis */
    const struct ranges *ranges;   /* what its sensors measure */
};

void kit_draw(struct kit *kit, const double *trait, const double *tolerance, uint64_t key);
        /* A robot's body: each trait within its tolerance, and within its range. key: another one for each robot. */

double kit_roll(struct kit *kit, double tick_s, double *counted_mm, double *rolled_mm);
        /* Lets both wheels, left and right, follow their orders for a tick. rolled_mm: as far as they are told, then as far as they
           roll. counted_mm: what the odometers count. Its track, as a part of the ideal one. */

void kit_push(struct kit *kit, const int32_t duty[KIT_WHEELS]);
        /* A board drives both motors itself for a period of the controller: duty in 1/65536 of the battery. From now on the body rolls
           as far as it is pushed, whatever it is told, and its senses are not delayed: the board does that by itself. */

uint16_t kit_count(const struct kit *kit, unsigned side);
        /* Counts of a wheel's encoder; wraps. */

void kit_light(const struct kit *kit, const struct world *world, const struct body *body, uint32_t tick, uint16_t light[FEEL_COUNT]);
        /* Light of its own LEDs that each infrared sensor receives back, 0..4095: PROXIMITY_NEAR where a wall is as far away as the
           sensor reaches. */

void kit_sense(struct kit *kit, const struct world *world, const struct body *body, uint32_t tick, struct senses *senses);
        /* Makes what an ideal body senses into what this one does; asked again in the same tick, the same. */

double kit_beam_mm(const struct kit *kit, double far_mm, double ideal_mm);
        /* Width of the corridor in which food is seen so far away. */

#endif
