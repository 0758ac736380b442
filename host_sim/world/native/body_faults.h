/* body_faults.h: faults of a body, on the way from its sensors to the robot and back to its motors.
 * body_fault_words.c parses their names. */
#ifndef OCTET_BODY_FAULTS_H
#define OCTET_BODY_FAULTS_H

#include <stdbool.h>
#include <stdint.h>

struct senses;

struct body_faults {
    bool mirrored;           /* the sensor ring is mounted mirror-inverted */
    bool swapped;            /* the plugs of the two motors, odometers included, are exchanged */
    uint8_t stuck_on;        /* sensors, as bits of feel */
    uint8_t stuck_off;
    uint8_t left_lost_percent;    /* part of the commanded speed that a motor lacks: 0..100 */
    uint8_t right_lost_percent;
    bool odometers_swapped;       /* each odometer counts the other wheel */
    int16_t left_miscounted_percent;    /* error of an odometer, of the wheel's distance; -100: it is stuck */
    int16_t right_miscounted_percent;
    uint16_t false_beacon_mm;     /* distance to food that is not there; 0: none */
    uint16_t lag_ms;         /* added to the lag of the wheels, */
    uint8_t slack_deg;       /* to the slack of the gears, degrees of a wheel, */
    uint8_t slip_percent;    /* to the slip, */
    uint8_t latency_ticks;   /* and to the delay of the senses: 0: nothing. kit/kit.h makes them felt */
    bool dark_wall;          /* walls are seen from nearer, */
    bool weak_battery;       /* and the battery is nearly empty */
    uint32_t noise;          /* each sensor is wrong in this many */
    uint32_t noise_of;       /* out of this many ticks; not 0 where noise is not */
    uint64_t noise_key;      /* selects these ticks */
};   /* all 0: nothing is wrong */

void body_faults_sense(const struct body_faults *faults, uint32_t tick, struct senses *senses);
        /* Applies the faults to what the body senses. tick is the number of the tick in the run. */

void body_faults_measure(const struct body_faults *faults, uint8_t *range_mm);
        /* The same for its FEEL_COUNT distances; noise does not change them. */

void body_faults_drive(const struct body_faults *faults, double *left_mm_s, double *right_mm_s);
        /* Applies the faults to the speeds that the robot commands. */

void body_faults_count(const struct body_faults *faults, double *left_mm, double *right_mm);
        /* Converts the distances that the wheels roll to those that the odometers count. */

const char *body_faults_add(struct body_faults *faults, const char *what, uint32_t seed, uint32_t robot);
        /* Adds a fault, such as "stuck-on:front"; docs/worlds.md lists them. Seed and robot determine the ticks of
           noise. Returns null, or why the text is refused, such as "write mirror". */

uint64_t body_faults_mix(uint64_t number);
        /* The output of the SplitMix64 generator whose state is number. */

#endif
