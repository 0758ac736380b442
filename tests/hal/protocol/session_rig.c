#include "session_rig.h"

struct session session;
enum result why;
unsigned missed;

void setUp(void)
{
    session = (struct session){.owner = 0};
    missed = 999;
}

enum arrival command(enum opcode opcode, uint8_t counter, uint8_t owner)
{
    const struct request request = {.command = {.opcode = opcode}, .counter = counter, .owner = owner};

    return session_request(&session, &request, &why);
}

enum arrival start(bool lockstep)
{
    const struct request request = {
        .command = {.opcode = OPCODE_START}, .counter = 1, .owner = OURS, .lockstep = lockstep};
    enum arrival arrival = session_request(&session, &request, &why);

    session_executed(&session, RESULT_DONE);
    return arrival;
}

enum arrival tick(unsigned ticks)
{
    return session_senses(&session, (uint8_t)ticks, (uint8_t)(ticks % E2E_COUNTERS), &missed);
}

void refuses(enum result expected, enum opcode opcode, uint8_t counter, uint8_t owner)
{
    TEST_ASSERT_EQUAL(ARRIVAL_STALE, command(opcode, counter, owner));
    TEST_ASSERT_EQUAL(expected, why);
}
