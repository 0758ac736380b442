#include "firmware/motion/odometry_backlog.h"

#include "firmware/motion/wheels.h"

enum {
    LAG_TICKS = 6,        /* wheels follow commands with a lag of up to 120 ms, at 20 ms a tick */
    ROUNDING = 3,         /* of odometers and commands in a tick */
    ROUNDING_SUM = 5,     /* and as it adds up */
    COUNTS_MAX = 16000    /* far beyond any wheel */
};

static int32_t magnitude(int32_t x)
{
    return (int32_t)wheels_magnitude(x);
}

void backlog_command(struct backlog *backlog, int32_t counts)
{
    if (counts != backlog->commanded[0])
        backlog->same = 0;
    else
        backlog->same = (uint8_t)(backlog->same < UINT8_MAX ? backlog->same + 1 : UINT8_MAX);
    backlog->commanded[1] = backlog->commanded[0];
    backlog->commanded[0] = (int16_t)counts;
}

/* The increase of the backlog. Once the same command must have arrived, only acceleration adds to it: what is missing
 * at a steady speed will never be rolled. */
static int32_t more(const struct backlog *backlog, int32_t rolled, int32_t commanded)
{
    int32_t gathered = LAG_TICKS * (rolled - backlog->rolled);
    int32_t missing = commanded - rolled;

    if (commanded == 0 || backlog->same < BACKLOG_DELAY_TICKS || magnitude(backlog->rolled) <= ROUNDING)
        return missing;
    if ((gathered < 0) != (missing < 0) && magnitude(missing) <= ROUNDING)
        return 0;
    return wheels_limited(gathered, magnitude(missing));
}

/* Limits the backlog to what lag and pending commands can make wheels at that speed roll. */
static int32_t possible(const struct backlog *backlog, int32_t counts, int32_t rolled)
{
    int32_t coast = LAG_TICKS * rolled + LAG_TICKS / 2 * (rolled - backlog->rolled);   /* by the tick's final speed */
    int32_t most = backlog->commanded[0] > 0 ? backlog->commanded[0] : 0;
    int32_t least = backlog->commanded[0] - most;

    if (backlog->commanded[1] > 0)
        most += backlog->commanded[1];
    else
        least += backlog->commanded[1];
    if (coast > 0 && rolled > 0)
        most += coast;
    if (coast < 0 && rolled < 0)
        least += coast;
    if (counts > most)
        return most;
    return counts < least ? least : counts;
}

void backlog_roll(struct backlog *backlog, int32_t rolled, unsigned ticks)
{
    bool rests = (rolled | backlog->counts | backlog->commanded[0] | backlog->commanded[1]) == 0;   /* a shortcut */
    int32_t counts = rests ? 0 : backlog->counts + more(backlog, rolled, backlog->commanded[0] * (int32_t)ticks);

    if (!rests)
        backlog->counts = (int16_t)wheels_limited(possible(backlog, counts, rolled), COUNTS_MAX);
    backlog->rolled = (int16_t)rolled;
}

int32_t backlog_counts(const struct backlog *backlog)
{
    return magnitude(backlog->counts) > ROUNDING_SUM ? backlog->counts : 0;
}
