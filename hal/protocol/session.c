#include "hal/protocol/session.h"

#include "hal/protocol/e2e.h"

enum { COMMANDS_AHEAD = 7 };   /* half of the counters: behind these lie the old ones */

static bool is_fresh(const struct session *session, unsigned ahead, uint8_t counter)
{
    return ahead >= 1 && ahead <= (session->lockstep ? 1u : (unsigned)SESSION_WINDOW)
        && e2e_ahead(session->counter, counter) == ahead % E2E_COUNTERS;
}

enum arrival session_senses(struct session *session, uint8_t tick, uint8_t counter, unsigned *missed)
{
    unsigned ahead = (unsigned)(tick - session->tick) % TICK_SPAN;

    if (session->knows_tick && ahead == 0 && counter == session->counter && session->lockstep)
        return ARRIVAL_AGAIN;
    if (session->knows_tick && !is_fresh(session, ahead, counter))
        return ARRIVAL_STALE;
    *missed = session->knows_tick ? ahead - 1 : 0;
    session->tick = tick;
    session->counter = counter;
    session->knows_tick = session->hears = true;
    return ARRIVAL_FRESH;
}

static enum opcode opcode_of(const struct frame *command)
{
    return (enum opcode)(command->data[1] >> 4);
}

static uint8_t owner_of(const struct frame *command)
{
    return command->data[2];
}

static bool are_same(const struct frame *one, const struct frame *other)
{
    for (unsigned i = 0; i < sizeof one->data; i++)
        if (one->data[i] != other->data[i])
            return false;
    return one->len == other->len;
}

/* Whoever it comes from, stop is obeyed: but not one of the owner's that has been under way for long. */
static enum result judge(const struct session *session, const struct frame *command)
{
    unsigned ahead = e2e_ahead(e2e_counter(&session->command), e2e_counter(command));

    if (session->owner == 0 || !session->hears)
        return RESULT_DONE;
    if (owner_of(command) != session->owner)
        return opcode_of(command) == OPCODE_STOP ? RESULT_DONE : RESULT_OWNED;
    return ahead >= 1 && ahead <= COMMANDS_AHEAD ? RESULT_DONE : RESULT_OUT_OF_SEQUENCE;
}

enum arrival session_command(struct session *session, const struct frame *command, enum result *why)
{
    if (are_same(&session->command, command))
        return ARRIVAL_AGAIN;
    *why = judge(session, command);
    if (*why != RESULT_DONE)
        return ARRIVAL_STALE;
    session->command = *command;
    return ARRIVAL_FRESH;
}

static void begin(struct session *session)
{
    session->owner = owner_of(&session->command);
    session->hears = true;
    session->knows_tick = false;
}

void session_executed(struct session *session, enum result result)
{
    enum opcode opcode = opcode_of(&session->command);

    if (result != RESULT_DONE)
        return;
    if (opcode == OPCODE_START)
        session->lockstep = session->command.data[3] >> 7;
    if (opcode == OPCODE_START || opcode == OPCODE_RESUME)
        begin(session);
    else if (opcode == OPCODE_STOP)
        session_end(session);
}

void session_end(struct session *session)
{
    session->owner = 0;
    session->knows_tick = false;
}
