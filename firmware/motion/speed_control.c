#include "firmware/motion/speed_control.h"

#include "robot_words.h"

enum {
    MODEL_PART = 8,            /* the model closes 1/8 of its error per period: 37 ms */
    MODEL_MS = MODEL_PART * WHEEL_PERIOD_MS,   /* feed-forward inverts the motor: it leads by the lag / this */
    BEHIND_MAX_UM = 4000,
    BATTERY_MIN_MV = 3000,     /* a lower value is no valid measurement */
    PRECISION = 4096,          /* fixed-point unit of the voltage compensation */
    STILL_DUTY = 1000,         /* a smaller duty does not justify a jump over the dead band */
    UNIT_256 = 25600           /* a unit of the odometer, 0.1 mm */
};
static const int32_t SPAN_256 = (int32_t)ODOMETER_SPAN * UNIT_256;

static int32_t limited(int32_t x, int32_t limit)
{
    return x > limit ? limit : x < -limit ? -limit : x;
}

/* Factor of the duty at this voltage, in units of 1 / PRECISION. */
static int32_t stronger(uint32_t battery_mv)
{
    return battery_mv < BATTERY_MIN_MV ? PRECISION : (int32_t)WHEEL_NOMINAL_MV * PRECISION / (int32_t)battery_mv;
}

/* Distance rolled by the wheel since the last period, um. */
static int32_t moved_um(struct wheel *wheel, uint16_t count)
{
    int32_t counts = wheel->known ? (int16_t)(uint16_t)(count - wheel->count) : 0;
    int32_t way_256 = counts * WHEEL_COUNT_256 + wheel->rest_256;
    int32_t way_um = way_256 / 256;

    wheel->way_256 = (wheel->way_256 + counts * WHEEL_COUNT_256) % SPAN_256;
    wheel->rest_256 = way_256 - way_um * 256;
    wheel->count = count;
    wheel->known = true;
    return way_um;
}

int32_t wheel_run(struct wheel *wheel, uint16_t count, int16_t told_mm_s, uint32_t battery_mv)
{
    int32_t part = stronger(battery_mv), told_um = told_mm_s * WHEEL_PERIOD_MS;
    int32_t missing_256 = told_um * 256 - wheel->model_256;
    int32_t model_um = wheel->model_256 / 256, error_um = model_um - moved_um(wheel, count);
    int32_t behind_um = limited(wheel->behind_um + error_um, BEHIND_MAX_UM), duty, out;
    int32_t dead = WHEEL_DEAD + wheel->dead_more;
    int32_t ahead_um = missing_256 / 256 * (WHEEL_LAG_MS + wheel->lag_more_ms) / MODEL_MS;

    wheel->model_256 += missing_256 / MODEL_PART;
    duty = (model_um + ahead_um) * (WHEEL_FORWARD + wheel->forward_more) / WHEEL_PERIOD_MS + error_um * WHEEL_KP
         + behind_um * WHEEL_KI_16 / 16;
    if (duty > STILL_DUTY)
        duty += dead;
    else if (duty < -STILL_DUTY)
        duty -= dead;
    else
        duty = 0;
    duty = limited(duty, (int32_t)WHEEL_DUTY_MAX * 2) * part / PRECISION;
    out = limited(duty, WHEEL_DUTY_MAX);
    if (out == duty)   /* anti-windup: no integration while the output is saturated */
        wheel->behind_um = behind_um;
    return out;
}

uint16_t wheel_odometer(const struct wheel *wheel)
{
    return (uint16_t)((wheel->way_256 + SPAN_256) % SPAN_256 / UNIT_256);
}
