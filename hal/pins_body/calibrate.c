#include "hal/pins_body/calibrate.h"

#include "firmware/motion/speed_control.h"
#include "hal/can_body/port.h"

#define RANGE(parameter, minimum, maximum, initial) {minimum, maximum, initial},

static const struct {
    uint8_t min, max, initial;
} ranges[] = {BODY_PARAMETERS(RANGE)};

/* Values measured together are stored together: light and track, then motors. */
enum { EACH = 6, RECORDS = (CALIBRATION_VALUES + EACH - 1) / EACH };

bool calibration_fit(uint8_t number, uint32_t value)
{
    return value >= ranges[number - BODY_MEASURE].min && value <= ranges[number - BODY_MEASURE].max;
}

void calibration_load(struct calibration_values *values)
{
    uint8_t bytes[CELL_COUNT];

    for (unsigned i = 0; i < CALIBRATION_VALUES; i++) {
        uint8_t number = (uint8_t)(CALIBRATION_FIRST + i);
        unsigned at = i % EACH;

        if (at == 0 && port_load_more(i / EACH, bytes) != 1)
            for (unsigned byte = 0; byte < CELL_COUNT; byte++)
                bytes[byte] = 0;
        values->value[i] = calibration_fit(number, bytes[at]) ? bytes[at] : ranges[number - BODY_MEASURE].initial;
    }
}

int calibration_store(const struct calibration_values *values)
{
    int result = 0;

    for (unsigned record = 0; record < RECORDS && result == 0; record++) {
        uint8_t bytes[CELL_COUNT] = {0};

        for (unsigned i = 0; i < EACH && record * EACH + i < CALIBRATION_VALUES; i++)
            bytes[i] = values->value[record * EACH + i];
        result = port_store_more(record, bytes);
    }
    return result;
}

enum {
    SETTLING_TICKS = 10, LIGHT_TICKS = 16,
    LOW_DUTY = 16384, HIGH_DUTY = 49152,
    PUSH = 64,                       /* divisor of duty times millivolts, against overflow */
    STAIR_BEATS = 100,               /* 0.5 s: the motors settle much sooner */
    TURN_MM_S = 150,
    TURNS = 4,
    TURN_BEATS = 8000,               /* 40 s: the maximum duration of all turns */
    TURNED_MAX = INT32_MAX / 1000,   /* counts: 30 times the widest track's */
    /* Counts, left wheel less right one, of TURNS turns on a track of 1000 mm: 2 pi times 1000 mm each. */
    COUNTS_1000 = (int)(1608495439LL * TURNS / WHEEL_COUNT_256),
    /* Units of the feed-forward (push per count of a stair) and of the dead band (push). */
    FORWARD_1000 = (int)(1000LL * WHEEL_NOMINAL_MV * WHEEL_COUNT_256 / (PUSH * STAIR_BEATS * WHEEL_PERIOD_MS * 256)),
    DEAD_10 = (int)(10LL * WHEEL_NOMINAL_MV * CALIBRATION_DEAD_OF / CALIBRATION_DEAD_BY / PUSH)
};

/* A staircase: the motors rest, and settle on each level before they are measured there. */
enum { STAIR_REST, STAIR_LOW_SETTLES, STAIR_LOW, STAIR_HIGH_SETTLES, STAIR_HIGH };

void calibrate_begin(struct calibration *calibration, uint8_t measures)
{
    *calibration = (struct calibration){.measures = measures, .saw_wall = true};
}

void calibrate_interrupt(struct calibration *calibration)
{
    if (calibration->measures != MEASURE_NOTHING)
        *calibration = (struct calibration){.refused = BODY_MEASURE};
}

static int32_t rounded(int32_t dividend, int32_t divisor)
{
    return divisor > 0 ? (dividend + divisor / 2) / divisor : 0;
}

/* Stores a value; one out of range refuses the whole measurement. */
static void take(struct calibration *calibration, struct calibration_values *values, unsigned number, int32_t value)
{
    if (calibration->refused != 0)
        return;
    if (!calibration_fit((uint8_t)number, (uint32_t)value)) {   /* negative values become too large */
        calibration->refused = (uint8_t)number;
        calibration->found = value;
    }
    values->value[number - CALIBRATION_FIRST] = (uint8_t)value;
}

static bool measure_light(struct calibration *calibration, const struct calibrate_look *look,
                          struct calibration_values *values)
{
    if (!look->senses)
        return false;
    calibration->sights++;
    for (unsigned i = 0; i < FEEL_COUNT && calibration->sights > SETTLING_TICKS; i++)
        calibration->light[i] += look->back[i];
    if (calibration->sights < SETTLING_TICKS + LIGHT_TICKS)
        return false;
    for (unsigned i = 0; i < FEEL_COUNT; i++)
        if ((look->has >> i & 1) != 0)
            take(calibration, values, BODY_NEAR_RIGHT + i,
                 rounded((int32_t)calibration->light[i], CALIBRATION_LIGHT * LIGHT_TICKS));
    return true;
}

/* A wheel's counts in a stair, the mean of both directions. */
static int32_t counted(const uint16_t *marks, unsigned stair)
{
    return (int16_t)(uint16_t)(marks[stair - 1] - marks[stair]) / 2;
}

/* Returns the motor's lag after the step, ms; negative if it did not follow. Once the slope is in range, no sum can
 * overflow. */
static int32_t take_motor(struct calibration *calibration, unsigned side, struct calibration_values *values)
{
    const uint16_t *marks = calibration->marks[side];
    int32_t low = counted(marks, STAIR_LOW), high = counted(marks, STAIR_HIGH), more = high - low;
    int32_t ahead = (int16_t)marks[STAIR_REST], back = -(int16_t)marks[STAIR_HIGH];
    int32_t push = LOW_DUTY / PUSH / 2 * calibration->both_mv[STAIR_LOW];
    int32_t step = HIGH_DUTY / PUSH / 2 * calibration->both_mv[STAIR_HIGH] - push;

    if (ahead > 2 * back || back > 2 * ahead)
        more = 0;   /* it hardly turns in one direction: that is refused */
    take(calibration, values, BODY_FORWARD_LEFT + side, rounded(step, more * FORWARD_1000 / 1000));
    if (calibration->refused != 0)
        return 0;
    if (low > more || low < -more)
        low = more;   /* no motor counts like that: its dead band comes out of range, without an overflow */
    take(calibration, values, BODY_DEAD_LEFT + side,
         rounded((push - rounded(step / 64 * low, more) * 64) * 10, DEAD_10));
    return rounded((high - counted(marks, STAIR_HIGH_SETTLES)) * STAIR_BEATS * WHEEL_PERIOD_MS, more);
}

static bool measure_motors(struct calibration *calibration, const struct calibrate_look *look,
                           struct calibration_values *values)
{
    unsigned stairs = calibration->beats / STAIR_BEATS, stair = (stairs - 1) % CALIBRATE_STAIRS;

    if (stairs == 0 || calibration->beats % STAIR_BEATS != 0)
        return false;
    for (unsigned side = 0; side < PINS_SIDES; side++)
        calibration->marks[side][stair] = (uint16_t)(look->counts[side] - calibration->marks[side][stair]);
    calibration->both_mv[stair] = (uint16_t)(calibration->both_mv[stair] + look->battery_mv);
    if (stairs < 2 * CALIBRATE_STAIRS)
        return false;
    take(calibration, values, BODY_LAG_MS,
         rounded(take_motor(calibration, 0, values) + take_motor(calibration, 1, values), 2));
    return true;
}

/* The initial value of turned is irrelevant: only differences are used. */
static void turn(struct calibration *calibration, const struct calibrate_look *look)
{
    for (unsigned side = 0; side < PINS_SIDES; side++) {
        int32_t more = (int16_t)(uint16_t)(look->counts[side] - calibration->counts[side]);

        calibration->counts[side] = look->counts[side];
        calibration->turned += side == 0 ? more : -more;
    }
}

static bool measure_track(struct calibration *calibration, const struct calibrate_look *look,
                          struct calibration_values *values)
{
    int32_t turned;
    bool sees;

    turn(calibration, look);
    if (calibration->beats >= TURN_BEATS) {
        take(calibration, values, BODY_TRACK_MM, 0);
        return true;
    }
    if (!look->senses)
        return false;
    sees = look->wall && !calibration->saw_wall;
    calibration->saw_wall = look->wall;
    if (!sees)
        return false;
    if (calibration->sights++ == 0)
        calibration->first = calibration->turned;
    if (calibration->sights <= TURNS)
        return false;
    turned = calibration->turned - calibration->first;
    if ((uint32_t)turned > TURNED_MAX)
        turned = 0;   /* no wheels turn like that, and none backward */
    take(calibration, values, BODY_TRACK_MM, rounded(turned * 1000, COUNTS_1000));
    return true;
}

static bool measure(struct calibration *calibration, const struct calibrate_look *look,
                    struct calibration_values *values)
{
    if (calibration->measures == MEASURE_LIGHT)
        return measure_light(calibration, look, values);
    if (calibration->measures == MEASURE_MOTORS)
        return measure_motors(calibration, look, values);
    return measure_track(calibration, look, values);
}

bool calibrate_beat(struct calibration *calibration, const struct calibrate_look *look,
                    struct calibration_values *values)
{
    struct calibration_values found = *values;

    if (!measure(calibration, look, &found)) {
        calibration->beats++;
        return false;
    }
    calibration->measures = MEASURE_NOTHING;
    if (calibration->refused == 0)
        *values = found;
    return true;
}

int32_t calibrate_duty(const struct calibration *calibration)
{
    static const uint16_t DUTIES[CALIBRATE_STAIRS] = {0, LOW_DUTY, LOW_DUTY, HIGH_DUTY, HIGH_DUTY};
    int stair = (calibration->beats - 1) / STAIR_BEATS;

    if (calibration->measures != MEASURE_MOTORS)
        return 0;
    return stair < CALIBRATE_STAIRS ? DUTIES[stair] : -DUTIES[stair - CALIBRATE_STAIRS];
}

int16_t calibrate_mm_s(const struct calibration *calibration)
{
    return calibration->measures == MEASURE_TRACK ? TURN_MM_S : 0;
}
