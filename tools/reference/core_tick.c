/* How long one tick of the core takes here: prints nanoseconds a tick, averaged over many ticks of an ideal body that
 * meets something now and then. */
#include <stdio.h>
#include <time.h>

#include "firmware/robot.h"

enum { TICKS = 20000000, WHEEL_SHARE = 5 };   /* 1 mm/s for 20 ms is a fifth of a count */

static double now_ns(void)
{
    struct timespec now;

    clock_gettime(CLOCK_MONOTONIC, &now);
    return 1e9 * (double)now.tv_sec + (double)now.tv_nsec;
}

static uint16_t rolled(uint16_t odometer, int16_t speed_mm_s)
{
    return (uint16_t)((odometer + speed_mm_s / WHEEL_SHARE) & (ODOMETER_SPAN - 1));
}

int main(void)
{
    const struct command start = {.opcode = OPCODE_START, .which = PROFILE_ARTICLE, .value = 1};
    struct robot robot;
    struct senses senses = {0};
    struct drive drive = {0};
    uint32_t none;
    double began;

    robot_init(&robot, 1);
    if (robot_execute(&robot, &start, &none) != RESULT_DONE)
        return 1;
    began = now_ns();
    for (uint32_t tick = 0; tick < TICKS; tick++) {
        senses.tick = (uint8_t)(tick % TICK_SPAN);
        senses.feel = (uint8_t)((tick >> 6) % 7u == 0 ? (tick >> 9) % 32u : 0u);
        senses.odometer_left = rolled(senses.odometer_left, drive.left_mm_s);
        senses.odometer_right = rolled(senses.odometer_right, drive.right_mm_s);
        robot_step(&robot, &senses, &drive);
    }
    printf("%.2f\n", (now_ns() - began) / TICKS);
    return drive.tick == (TICKS - 1) % TICK_SPAN ? 0 : 1;
}
