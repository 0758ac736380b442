#include "hal/protocol/session.h"

#include "hal/protocol/e2e.h"

enum { COMMANDS_AHEAD = 7 };   /* half of the counter range: beyond it are old commands */

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

static bool are_same(const struct request *one, const struct request *other)
{
    return one->counter == other->counter && one->owner == other->owner && one->lockstep == other->lockstep
        && one->command.opcode == other->command.opcode && one->command.which == other->command.which
        && one->command.value == other->command.value;
}

/* Obeys a stop from any sender, except an old one of the owner's. */
static enum result judge(const struct session *session, const struct request *request)
{
    unsigned ahead = e2e_ahead(session->request.counter, request->counter);

    if (session->owner == 0 || !session->hears)
        return RESULT_DONE;
    if (request->owner != session->owner)
        return request->command.opcode == OPCODE_STOP ? RESULT_DONE : RESULT_OWNED;
    return ahead >= 1 && ahead <= COMMANDS_AHEAD ? RESULT_DONE : RESULT_OUT_OF_SEQUENCE;
}

enum arrival session_request(struct session *session, const struct request *request, enum result *why)
{
    if (session->knows_request && are_same(&session->request, request))
        return ARRIVAL_AGAIN;
    *why = judge(session, request);
    if (*why != RESULT_DONE)
        return ARRIVAL_STALE;
    session->request = *request;
    session->knows_request = true;
    return ARRIVAL_FRESH;
}

static void begin(struct session *session)
{
    session->owner = session->request.owner;
    session->hears = true;
    session->knows_tick = false;
    session->heard = 0;
}

void session_executed(struct session *session, enum result result)
{
    enum opcode opcode = session->request.command.opcode;

    if (result != RESULT_DONE)
        return;
    if (opcode == OPCODE_START)
        session->lockstep = session->request.lockstep;
    if (opcode == OPCODE_STOP && session->owner == 0) {
        session->told = session->heard = session->told_opcodes = 0;
    } else if (opcode != OPCODE_GET && opcode != OPCODE_REPORT) {
        session->told = session->telling;
        session->told_opcodes = (uint8_t)(session->told_opcodes + opcode);
    }
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
