#include "real_wheels.h"

#include <math.h>
#include <string.h>

#include "firmware/io.h"

static double clamped(double x, double limit)
{
    return fmin(fmax(x, -limit), limit);
}

/* What the speed loop aims at. */
static double aim(const struct wheel_traits *traits, double order_mm_s)
{
    double aim = fabs(order_mm_s) < traits->dead_mm_s ? 0.0 : order_mm_s * traits->gain;

    return traits->fastest_mm_s > 0.0 ? clamped(aim, traits->fastest_mm_s) : aim;
}

static void roll_1_ms(struct real_wheel *wheel, const struct wheel_traits *traits, double aim_mm_s)
{
    double change = aim_mm_s - wheel->speed_mm_s;

    if (traits->lag_ms > 0.0)
        change *= 1.0 - exp(-1.0 / traits->lag_ms);
    if (traits->accel_mm_s2 > 0.0)
        change = clamped(change, traits->accel_mm_s2 / 1000.0);
    wheel->speed_mm_s += change;
    wheel->motor_mm += wheel->speed_mm_s / 1000.0;
    wheel->rim_mm = wheel->motor_mm + clamped(wheel->rim_mm - wheel->motor_mm, traits->slack_mm / 2.0);
}

void real_wheel_turn(struct real_wheel *wheel, const struct wheel_traits *traits, int16_t order_mm_s, unsigned tick_ms)
{
    memmove(wheel->orders + 1, wheel->orders, sizeof wheel->orders - sizeof *wheel->orders);
    wheel->orders[0] = order_mm_s;
    for (unsigned ms = 0; ms < tick_ms; ms++)
        roll_1_ms(wheel, traits, aim(traits, wheel->orders[traits->delay_ticks]));
}

uint16_t real_wheel_counts(const struct real_wheel *wheel)
{
    /* The little more keeps sums of whole counts whole. */
    return (uint16_t)((int64_t)floor(wheel->motor_mm * ODOMETER_COUNTS_PER_MM + 1e-6) & (ODOMETER_SPAN - 1));
}
