#include "host_sim/emulator/models/board_clock.h"

#include "host_sim/emulator/models/can_node.h"

static const uint64_t FS_PER_NS = 1000000;
static const struct moment NEVER = { UINT64_MAX, 0 };

bool moment_before(struct moment one, struct moment other)
{
    return one.ns != other.ns ? one.ns < other.ns : one.fs < other.fs;
}

static struct moment earlier(struct moment one, struct moment other)
{
    return moment_before(other, one) ? other : one;
}

static uint64_t span_fs(struct moment from, struct moment to)
{
    return (to.ns - from.ns) * FS_PER_NS + to.fs - from.fs;
}

static bool refused(const struct can_wire *wire)
{
    for (unsigned n = 0; n < wire->node_count; n++)
        if (wire->nodes[n]->refusal[0] != '\0')
            return true;
    return false;
}

void clock_expect(struct board_clock *clock, struct moment moment)
{
    clock->horizon = earlier(clock->horizon, moment);
}

static void advance_wire(struct board_clock *clock)
{
    struct moment due = NEVER;

    due.ns = wire_advance(clock->wire, clock->now.ns);
    if (clock->wire->heard.count > 0 || refused(clock->wire))
        clock->take(clock);
    clock_expect(clock, due);
}

void clock_settle(struct board_clock *clock)
{
    clock->horizon = NEVER;
    if (clock->wire)
        advance_wire(clock);
    for (unsigned n = 0; n < clock->alarm_count && !clock->failed; n++) {
        if (!moment_before(clock->now, clock->alarms[n]))
            clock->ring(clock, n);
        clock_expect(clock, clock->alarms[n]);
    }
}

static void settle_if_due(struct board_clock *clock)
{
    if (!moment_before(clock->now, clock->horizon))
        clock_settle(clock);
}

void clock_execute(struct board_clock *clock, uint64_t cycles)
{
    uint64_t fs = clock->now.fs + cycles * clock->period_fs;

    clock->cycles += cycles;
    clock->now.ns += fs / FS_PER_NS;
    clock->now.fs = fs % FS_PER_NS;
    settle_if_due(clock);
}

void clock_skip_to(struct board_clock *clock, struct moment moment)
{
    while (moment_before(clock->now, moment) && !clock->failed) {
        struct moment target = earlier(moment, clock->horizon);

        if (moment_before(clock->now, target)) {
            clock->cycles += span_fs(clock->now, target) / clock->period_fs;
            clock->now = target;
        }
        settle_if_due(clock);
    }
}

void clock_skip_to_event(struct board_clock *clock, uint64_t most_ns)
{
    struct moment latest = { clock->now.ns + most_ns, clock->now.fs };

    clock_skip_to(clock, earlier(clock->horizon, latest));
}
