#include "hal/pins_body/guard.h"

static uint8_t counted(uint8_t before, bool again)
{
    if (!again)
        return 0;
    return (uint8_t)(before < GUARD_BEATS ? before + 1 : before);
}

static bool turns_against(const struct guard *guard, const struct guard_look *look, unsigned side)
{
    int16_t moved = (int16_t)(uint16_t)(look->counts[side] - guard->counts[side]);
    int32_t duty = guard->duty[side];

    return guard->known && ((duty > GUARD_WRONG_DUTY && moved < 0) || (duty < -GUARD_WRONG_DUTY && moved > 0));
}

bool guard_stops(struct guard *guard, const struct guard_look *look)
{
    bool begins = look->bumped && !guard->bumped;

    guard->weak = counted(guard->weak, look->battery_mv < GUARD_BATTERY_MV);
    guard->forbids = guard->forbids || look->failed || guard->weak == GUARD_BEATS;
    for (unsigned side = 0; side < GUARD_SIDES; side++) {
        guard->against[side] = counted(guard->against[side], turns_against(guard, look, side));
        guard->counts[side] = look->counts[side];
        guard->forbids = guard->forbids || guard->against[side] == GUARD_BEATS;
    }
    guard->known = true;
    guard->bumped = look->bumped;
    return begins || guard->forbids;
}

bool guard_forbids(const struct guard *guard)
{
    return guard->forbids;
}
