#include "firmware/motion/owed.h"

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

void owed_tell(struct owed *owed, int32_t counts)
{
    if (counts != owed->told[0])
        owed->same = 0;
    else
        owed->same = (uint8_t)(owed->same < UINT8_MAX ? owed->same + 1 : UINT8_MAX);
    owed->told[1] = owed->told[0];
    owed->told[0] = (int16_t)counts;
}

/* The increase of the distance owed. Once the same command must have arrived, wheels owe only for their acceleration:
 * what is missing at a steady speed will never be rolled. */
static int32_t more(const struct owed *owed, int32_t rolled, int32_t told)
{
    int32_t gathered = LAG_TICKS * (rolled - owed->rolled);
    int32_t missing = told - rolled;

    if (told == 0 || owed->same < OWED_DELAY_TICKS || magnitude(owed->rolled) <= ROUNDING)
        return missing;
    if ((gathered < 0) != (missing < 0) && magnitude(missing) <= ROUNDING)
        return 0;
    return wheels_limited(gathered, magnitude(missing));
}

/* Limits the distance owed to what lag and pending commands can make wheels at that speed roll. */
static int32_t possible(const struct owed *owed, int32_t counts, int32_t rolled)
{
    int32_t coast = LAG_TICKS * rolled + LAG_TICKS / 2 * (rolled - owed->rolled);   /* by the tick's final speed */
    int32_t most = owed->told[0] > 0 ? owed->told[0] : 0;
    int32_t least = owed->told[0] - most;

    if (owed->told[1] > 0)
        most += owed->told[1];
    else
        least += owed->told[1];
    if (coast > 0 && rolled > 0)
        most += coast;
    if (coast < 0 && rolled < 0)
        least += coast;
    if (counts > most)
        return most;
    return counts < least ? least : counts;
}

void owed_settle(struct owed *owed, int32_t rolled, unsigned ticks)
{
    bool rests = (rolled | owed->counts | owed->told[0] | owed->told[1]) == 0;   /* no more than a shortcut */
    int32_t counts = rests ? 0 : owed->counts + more(owed, rolled, owed->told[0] * (int32_t)ticks);

    if (!rests)
        owed->counts = (int16_t)wheels_limited(possible(owed, counts, rolled), COUNTS_MAX);
    owed->rolled = (int16_t)rolled;
}

int32_t owed_counts(const struct owed *owed)
{
    return magnitude(owed->counts) > ROUNDING_SUM ? owed->counts : 0;
}
