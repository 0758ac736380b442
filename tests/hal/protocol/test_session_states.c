/* Every state that a session can come to, and in each every frame that can arrive. Ticks and counters count only as far as
 * they differ from the last ones taken, so that a state stands for all that differ in these. */
#include "hal/protocol/session.h"
#include "tests/test.h"
#include "hal/protocol/e2e.h"

enum { NOBODY, OURS, THEIRS, OWNERS, STATES_MAX = 1024, COMMANDS_AHEAD = 7 };

static const enum opcode OPCODES[] = {OPCODE_STOP, OPCODE_START, OPCODE_RESUME, OPCODE_REPORT};

enum { OPCODE_KINDS = sizeof OPCODES / sizeof *OPCODES, REQUESTS = E2E_COUNTERS * OPCODE_KINDS * 2 * 2 };

static struct session states[STATES_MAX];
static size_t state_count;

static struct request request_number(unsigned n)
{
    return (struct request){
        .counter = (uint8_t)(n % E2E_COUNTERS),
        .owner = (uint8_t)(n / E2E_COUNTERS % 2 + OURS),
        .lockstep = n / E2E_COUNTERS / 2 % 2,
        .command = {.opcode = OPCODES[n / E2E_COUNTERS / 4]},
    };
}

static bool are_equal(const struct session *one, const struct session *other)
{
    return one->owner == other->owner && one->hears == other->hears && one->lockstep == other->lockstep
        && one->knows_tick == other->knows_tick && one->tick == other->tick && one->counter == other->counter
        && one->knows_request == other->knows_request && one->request.counter == other->request.counter
        && one->request.owner == other->request.owner && one->request.lockstep == other->request.lockstep
        && one->request.command.opcode == other->request.command.opcode;
}

static void visit(struct session session)
{
    session.tick = session.counter = session.request.counter = 0;
    for (size_t i = 0; i < state_count; i++)
        if (are_equal(&states[i], &session))
            return;
    TEST_ASSERT_LESS_THAN_size_t(STATES_MAX, state_count);
    states[state_count++] = session;
}

static struct session after_outage(struct session session)
{
    session.hears = false;
    session.knows_tick = session.knows_tick && session.lockstep;
    return session;
}

static void visit_after_senses(struct session session)
{
    unsigned missed;

    (void)session_senses(&session, 1, 1, &missed);
    visit(session);
}

static void visit_after_request(struct session session, unsigned n)
{
    const struct request request = request_number(n);
    enum result why;

    if (session_request(&session, &request, &why) != ARRIVAL_FRESH)
        return;
    visit(session);   /* the robot refuses it */
    session_executed(&session, RESULT_DONE);
    visit(session);
}

/* Once for all tests, which only read the states: it takes long. */
void setUp(void)
{
    if (state_count > 0)
        return;
    visit((struct session){.owner = NOBODY});
    for (size_t i = 0; i < state_count; i++) {
        visit(after_outage(states[i]));
        visit_after_senses(states[i]);
        for (unsigned n = 0; n < REQUESTS; n++)
            visit_after_request(states[i], n);
    }
}

TEST(session_has_314_reachable_states)
{
    TEST_ASSERT_EQUAL_size_t(314, state_count);
}

typedef void check_senses(const struct session *before, unsigned ahead, uint8_t counter);

static void with_all_senses(check_senses *check)
{
    for (size_t i = 0; i < state_count; i++)
        for (unsigned ahead = 0; ahead < TICK_SPAN; ahead++)
            for (uint8_t counter = 0; counter < E2E_COUNTERS; counter++)
                check(&states[i], ahead, counter);
}

/* No tick is accepted again, nor one of the past. */
static void check_ticks_advance(const struct session *before, unsigned ahead, uint8_t counter)
{
    struct session session = *before;
    unsigned missed;

    if (session_senses(&session, (uint8_t)ahead, counter, &missed) != ARRIVAL_FRESH || !before->knows_tick)
        return;
    TEST_ASSERT_TRUE(ahead >= 1 && ahead <= SESSION_WINDOW);
    TEST_ASSERT_EQUAL_UINT(ahead - 1, missed);
    TEST_ASSERT_TRUE(!before->lockstep || missed == 0);
}

TEST(ticks_are_accepted_once_and_never_skipped_in_lockstep)
{
    with_all_senses(check_ticks_advance);
}

static void check_refused_senses_keep_state(const struct session *before, unsigned ahead, uint8_t counter)
{
    struct session session = *before;
    unsigned missed;

    if (session_senses(&session, (uint8_t)ahead, counter, &missed) != ARRIVAL_FRESH)
        TEST_ASSERT_TRUE(are_equal(before, &session));
}

TEST(refused_senses_change_no_state)
{
    with_all_senses(check_refused_senses_keep_state);
}

TEST(next_senses_are_always_accepted)
{
    for (size_t i = 0; i < state_count; i++) {
        struct session session = states[i];
        unsigned missed;

        TEST_ASSERT_EQUAL(ARRIVAL_FRESH, session_senses(&session, 1, 1, &missed));
    }
}

typedef void check_request(const struct session *before, const struct request *request, enum arrival arrival,
                           const struct session *after);

static void with_all_requests(check_request *check)
{
    for (size_t i = 0; i < state_count; i++)
        for (unsigned n = 0; n < REQUESTS; n++) {
            const struct request request = request_number(n);
            struct session after = states[i];
            enum result why;
            enum arrival arrival = session_request(&after, &request, &why);

            check(&states[i], &request, arrival, &after);
        }
}

static void check_owner_rights(const struct session *before, const struct request *request, enum arrival arrival,
                               const struct session *after)
{
    (void)after;
    if (before->owner != NOBODY && before->hears && request->owner != before->owner
        && request->command.opcode != OPCODE_STOP)
        TEST_ASSERT_NOT_EQUAL(ARRIVAL_FRESH, arrival);
}

TEST(other_senders_can_only_stop_an_owned_robot)
{
    with_all_requests(check_owner_rights);
}

static void check_refused_request_keeps_state(const struct session *before, const struct request *request,
                                              enum arrival arrival, const struct session *after)
{
    (void)request;
    if (arrival != ARRIVAL_FRESH)
        TEST_ASSERT_TRUE(are_equal(before, after));
}

TEST(refused_requests_change_no_state)
{
    with_all_requests(check_refused_request_keeps_state);
}

static void check_accepted_once(const struct session *before, const struct request *request, enum arrival arrival,
                                const struct session *after)
{
    struct session session = *after;
    enum result why;

    (void)before;
    if (arrival != ARRIVAL_FRESH)
        return;
    session_executed(&session, RESULT_DONE);
    TEST_ASSERT_EQUAL(ARRIVAL_AGAIN, session_request(&session, request, &why));
}

TEST(request_is_accepted_once)
{
    with_all_requests(check_accepted_once);
}

static void check_owner_changes(const struct session *before, const struct request *request,
                                enum arrival arrival, const struct session *after)
{
    struct session session = *after;
    enum opcode opcode = request->command.opcode;

    if (arrival != ARRIVAL_FRESH)
        return;
    session_executed(&session, RESULT_OUT_OF_RANGE);
    TEST_ASSERT_EQUAL_UINT8(before->owner, session.owner);
    session_executed(&session, RESULT_DONE);
    if (opcode == OPCODE_STOP)
        TEST_ASSERT_EQUAL_UINT8(NOBODY, session.owner);
    else if (opcode == OPCODE_REPORT)
        TEST_ASSERT_EQUAL_UINT8(before->owner, session.owner);
    else
        TEST_ASSERT_EQUAL_UINT8(request->owner, session.owner);
}

TEST(start_and_resume_set_the_owner_and_stop_clears_it)
{
    with_all_requests(check_owner_changes);
}

/* A sender with any counter: its stop is accepted at once if another owns the robot, and any command after an outage. */
static void check_no_lockout(const struct session *before, const struct request *request,
                             enum arrival arrival, const struct session *after)
{
    struct session silent = after_outage(*before);
    enum result why;

    (void)after;
    if (request->command.opcode == OPCODE_STOP && request->owner != before->owner)
        TEST_ASSERT_NOT_EQUAL(ARRIVAL_STALE, arrival);
    TEST_ASSERT_NOT_EQUAL(ARRIVAL_STALE, session_request(&silent, request, &why));
}

TEST(no_sender_is_locked_out)
{
    with_all_requests(check_no_lockout);
}

static void check_owner_counter(const struct session *before, const struct request *request,
                                enum arrival arrival, const struct session *after)
{
    (void)after;
    if (request->owner != before->owner)
        return;
    if (request->counter >= 1 && request->counter <= COMMANDS_AHEAD)
        TEST_ASSERT_EQUAL(ARRIVAL_FRESH, arrival);
    else if (before->hears)
        TEST_ASSERT_NOT_EQUAL(ARRIVAL_FRESH, arrival);
}

TEST(owner_requests_are_accepted_only_if_ahead)
{
    with_all_requests(check_owner_counter);
}
