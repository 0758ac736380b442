/* Lockstep over a line that loses, doubles, reorders and delays frames: every schedule there is, with the real robot and a
 * simulator that repeats its senses until they are answered. The limits of the line leave few enough states
 * to visit each of them once. */
#include "tests/test.h"
#include "hal/library/exchange.h"
#include "hal/link/link.h"
#include "tests/hal/protocol/wire_frames.h"

#include <stdlib.h>
#include <string.h>

/* One direction of a line that loses and delays frames: those on the way, which may arrive in any order. */

enum {
    LINE_ROOM = 2,         /* frames on the way at once */
    LINE_LATE_TICKS = 2    /* that a frame can be late */
};

struct lossy_line {
    unsigned count;
    struct {
        struct frame frame;
        unsigned sent;    /* in which tick */
    } on_the_way[LINE_ROOM];
};

/* Sends a frame in that tick. It is lost if there is no room. */
static void lossy_line_put(struct lossy_line *line, const struct frame *frame, unsigned tick)
{
    if (line->count == LINE_ROOM)
        return;   /* lost */
    line->on_the_way[line->count].frame = *frame;
    line->on_the_way[line->count].sent = tick;
    line->count++;
}

/* Takes the i-th frame off the line; those after it move up. */
static struct frame lossy_line_take(struct lossy_line *line, unsigned i)
{
    struct frame frame = line->on_the_way[i].frame;

    line->count--;
    memmove(&line->on_the_way[i], &line->on_the_way[i + 1], (LINE_ROOM - i - 1) * sizeof line->on_the_way[0]);
    memset(&line->on_the_way[line->count], 0, sizeof line->on_the_way[0]);
    return frame;
}

/* Loses frames that are too late in that tick. */
static void lossy_line_lose_late(struct lossy_line *line, unsigned tick)
{
    for (unsigned i = line->count; i-- > 0;)
        if (tick - line->on_the_way[i].sent > LINE_LATE_TICKS)
            (void)lossy_line_take(line, i);
}

enum {
    FIRST = 250,          /* soon after it ticks and counters wrap */
    TICKS = 8,
    STATES_MAX = 1 << 17
};

/* Everything that can differ between two moments of a run. */
struct state {
    struct octet octet;
    struct lossy_line up, down;   /* to the robot, and from it */
    unsigned tick;          /* of the senses that the simulator waits to have answered */
    bool silent;            /* the robot has reported silence since */
};

typedef bool (*answers_rule)(const struct frame *drive, unsigned tick);

static const uint8_t STORED[CELL_COUNT] = {0, 1, 2, 1, 2, 1, 2, 1};

static struct state *states;
static size_t state_count;
static uint64_t visited[2 * STATES_MAX];
static struct frame expected[FIRST + TICKS];   /* drives of a run over a line without faults */
static answers_rule answers;
static bool has_diverged;

static void start(struct octet *octet)
{
    struct octet *fresh = octet_open(1, STORED);
    struct frame command =
        command_frame((struct octet_command_t){.opcode = OPCODE_START, .counter = 1, .owner = 1, .lockstep = 1});

    TEST_ASSERT_NOT_NULL(fresh);
    TEST_ASSERT_EQUAL_size_t(1, octet_exchange(fresh, &command));
    memcpy(octet, fresh, sizeof *octet);
    octet_close(fresh);
}

static void run_without_faults(void)
{
    struct octet octet;

    start(&octet);
    for (unsigned tick = FIRST; tick < FIRST + TICKS; tick++) {
        struct frame senses = senses_frame(1, tick);
        size_t count = octet_exchange(&octet, &senses);

        TEST_ASSERT_GREATER_THAN_size_t(0, count);
        expected[tick] = octet.answers[count - 1];
    }
}

/* The rule of the simulator's client: tick and counter are those of the senses, and the drive does not report silence. */
static bool is_the_answer(const struct frame *drive, unsigned tick)
{
    struct octet_drive_t got;

    (void)octet_drive_unpack(&got, drive->data, drive->len);
    return got.tick == (uint8_t)tick && got.counter == tick % E2E_COUNTERS && got.reason != REASON_SILENCE;
}

static bool accept_any_drive(const struct frame *drive, unsigned tick)
{
    (void)drive;
    (void)tick;
    return true;
}

static uint64_t hash_of(const struct state *state)
{
    const uint8_t *bytes = (const uint8_t *)state;
    uint64_t hash = 14695981039346656037u;

    for (size_t i = 0; i < sizeof *state; i++)
        hash = (hash ^ bytes[i]) * 1099511628211u;
    return hash | 1u;
}

/* Counters, reports and the last answers are no part of the state: no drive depends on them. */
static void leave_out_reports(struct octet *octet)
{
    struct wire *wire = &octet->wire;

    memset(wire->faults, 0, sizeof wire->faults);
    memset(wire->counters, 0, sizeof wire->counters);
    wire->news = 0;
    wire->first_news = 0;
    wire->part = 0;
    wire->again = NULL;
    memset(octet->answers, 0, sizeof octet->answers);
}

static void visit(struct state *state)
{
    size_t at;

    leave_out_reports(&state->octet);
    at = hash_of(state) % (2 * STATES_MAX);
    while (visited[at] != 0) {
        if (visited[at] == hash_of(state))
            return;
        at = (at + 1) % (2 * STATES_MAX);
    }
    TEST_ASSERT_LESS_THAN_size_t(STATES_MAX, state_count);
    visited[at] = hash_of(state);
    memcpy(&states[state_count++], state, sizeof *state);
}

static void send_drive(struct state *state, const struct frame frames[], size_t count)
{
    if (count > 0 && frames[count - 1].id == OCTET_DRIVE_FRAME_ID)
        lossy_line_put(&state->down, &frames[count - 1], state->tick);
}

static void receive_senses(struct state *state, const struct frame *senses)
{
    send_drive(state, state->octet.answers, octet_exchange(&state->octet, senses));
}

static void receive_silence(struct state *state)
{
    struct frame frames[WIRE_FRAMES_MAX];
    struct output out;

    robot_respond(&state->octet.robot, INPUT_SILENCE, &(struct input){.senses = {0}}, &out);
    send_drive(state, frames, wire_write(&state->octet.wire, &out, frames));
    state->silent = true;
}

static void receive_drive(struct state *state, const struct frame *drive)
{
    if (!answers(drive, state->tick))
        return;
    has_diverged = has_diverged || memcmp(drive, &expected[state->tick], sizeof *drive) != 0;
    state->tick++;
    state->silent = false;
    lossy_line_lose_late(&state->up, state->tick);
    lossy_line_lose_late(&state->down, state->tick);
}

/* A frame arrives, arrives and is duplicated, or is lost. */
static void deliver_frame(const struct state *from, bool up, unsigned i)
{
    for (unsigned fate = 0; fate < 3; fate++) {
        struct state next;
        struct frame frame;
        bool arrives = fate < 2;

        memcpy(&next, from, sizeof next);
        frame = (up ? from->up : from->down).on_the_way[i].frame;
        if (fate != 1)
            (void)lossy_line_take(up ? &next.up : &next.down, i);
        if (arrives && up)
            receive_senses(&next, &frame);
        else if (arrives)
            receive_drive(&next, &frame);
        visit(&next);
    }
}

static void send_senses(const struct state *from)
{
    struct state next;
    struct frame senses = senses_frame(1, from->tick);

    memcpy(&next, from, sizeof next);
    lossy_line_put(&next.up, &senses, next.tick);
    visit(&next);
}

static void wait_for_silence(const struct state *from)
{
    struct state next;

    memcpy(&next, from, sizeof next);
    receive_silence(&next);
    visit(&next);
}

static void visit_successors(const struct state *from)
{
    if (from->up.count < LINE_ROOM)
        send_senses(from);
    if (!from->silent)
        wait_for_silence(from);
    for (unsigned i = 0; i < from->up.count; i++)
        deliver_frame(from, true, i);
    for (unsigned i = 0; i < from->down.count; i++)
        deliver_frame(from, false, i);
}

static void explore(answers_rule rule)
{
    struct state first;

    memset(&first, 0, sizeof first);
    start(&first.octet);
    first.tick = FIRST;
    answers = rule;
    visit(&first);
    for (size_t i = 0; i < state_count && !has_diverged; i++)
        if (states[i].tick < FIRST + TICKS)
            visit_successors(&states[i]);
}

void setUp(void)
{
    states = malloc(STATES_MAX * sizeof *states);
    TEST_ASSERT_NOT_NULL(states);
    state_count = 0;
    memset(visited, 0, sizeof visited);
    has_diverged = false;
    run_without_faults();
}

void tearDown(void)
{
    free(states);
}

TEST(no_schedule_changes_a_drive)
{
    unsigned farthest = 0;

    explore(is_the_answer);
    for (size_t i = 0; i < state_count; i++)
        farthest = states[i].tick > farthest ? states[i].tick : farthest;
    TEST_ASSERT_FALSE(has_diverged);
    TEST_ASSERT_EQUAL_UINT(FIRST + TICKS, farthest);
    TEST_ASSERT_GREATER_THAN_size_t(TICKS * 100, state_count);
}

/* Liveness: when a frame finally arrives, its answer does. */
TEST(next_senses_are_answered_in_every_state)
{
    explore(is_the_answer);
    for (size_t i = 0; i < state_count; i++) {
        struct state state;
        struct frame senses = senses_frame(1, states[i].tick);

        if (states[i].tick == FIRST + TICKS)
            continue;
        memcpy(&state, &states[i], sizeof state);
        memset(&state.down, 0, sizeof state.down);
        receive_senses(&state, &senses);
        TEST_ASSERT_EQUAL_UINT(1, state.down.count);
        receive_drive(&state, &state.down.on_the_way[0].frame);
        TEST_ASSERT_EQUAL_UINT(states[i].tick + 1, state.tick);
    }
}

TEST(simulator_that_accepts_any_drive_is_detected)
{
    explore(accept_any_drive);
    TEST_ASSERT_TRUE(has_diverged);
}
