/* body_faults.h: what is wrong with a body, between what it senses and what its robot is told, and back to its motors.
 * body_fault_words.c reads what people call that. */
#ifndef OCTET_BODY_FAULTS_H
#define OCTET_BODY_FAULTS_H

#include <stdbool.h>
#include <stdint.h>

struct senses;

struct body_faults {
    bool mirrored;           /* the ring of sensors is mounted the other way round */
    bool swapped;            /* each motor, with its odometer, has the other one's plug */
    uint8_t stuck_on;        /* sensors, as bits of feel */
    uint8_t stuck_off;
    uint8_t left_lost_percent;    /* speed that a motor lacks, of what it is told: 0..100 */
    uint8_t right_lost_percent;
    bool odometers_swapped;       /* each wheel is counted by the other one's odometer */
    int16_t left_miscounted_percent;    /* what an odometer counts beyond its wheel's way, of that way: -100: it is stuck */
    int16_t right_miscounted_percent;
    uint16_t false_beacon_mm;     /* to food that is seen where there is none; 0: to none */
    uint16_t lag_ms;         /* added to the lag of the wheels, */
    uint8_t slack_deg;       /* to the slack of the gears, degrees of a wheel, */
    uint8_t slip_percent;    /* to the slip, */
    uint8_t latency_ticks;   /* and to the delay of the senses: 0: nothing. kit/kit.h makes them felt */
    bool dark_wall;          /* walls are seen from nearer, */
    bool weak_battery;       /* and the battery is nearly empty */
    uint32_t noise;          /* each sensor is wrong in this many */
    uint32_t noise_of;       /* out of this many ticks; not 0 where noise is not */
    uint64_t noise_key;      /* from which it follows in which */
};   /* all 0: nothing is wrong */

void body_faults_sense(const struct body_faults *faults, uint32_t tick, struct senses *senses);
        /* Makes what the body senses into what the robot is told. tick is the number of the tick in the run. */

void body_faults_measure(const struct body_faults *faults, uint8_t *range_mm);
        /* The same for its FEEL_COUNT distances; noise does not change them. */

void body_faults_drive(const struct body_faults *faults, double *left_mm_s, double *right_mm_s);
        /* Makes the speeds that the robot asks for into those of the wheels. */

void body_faults_count(const struct body_faults *faults, double *left_mm, double *right_mm);
        /* Makes the ways that the wheels roll into those that the odometers count. */

const char *body_faults_add(struct body_faults *faults, const char *what, uint32_t seed, uint32_t robot);
        /* One fault more, such as "stuck-on:front"; docs/worlds.md has all. The ticks of noise follow from the seed and from
           which robot it is. Null, or why it cannot be, such as "write mirror". */

uint64_t body_faults_mix(uint64_t number);
        /* The SplitMix64 generator's number after this one. */

#endif
