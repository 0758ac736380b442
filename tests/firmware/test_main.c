/* The robot's main, between a fake body and the real robot. */
#include "firmware/robot.h"
#include "hal/hal.h"

#include <string.h>

#include "tests/test.h"

enum { SCRIPT_MAX = 8 };

int robot_main(int argc, char *argv[]);   /* main, as it is called here */

struct hal {
    int open_result, load_result, send_result;
    uint8_t stored[CELL_COUNT];
    struct {
        int result;
        struct input in;
    } script[SCRIPT_MAX];   /* what is received; behind its end the body is gone */
    unsigned received, events;
    struct output sent[SCRIPT_MAX];
    unsigned sends, stores;
    bool stored_at_rest, stored_before_sent;
    int argc;
};

static struct hal body;

int hal_open(struct hal **hal, int argc, char *const argv[])
{
    (void)argv;
    body.argc = argc;
    if (body.open_result == 0)
        *hal = &body;
    return body.open_result;
}

int hal_receive(struct hal *hal, struct input *in)
{
    if (hal->received == hal->events)
        return HAL_E_CLOSED;
    *in = hal->script[hal->received].in;
    return hal->script[hal->received++].result;
}

int hal_send(struct hal *hal, const struct output *out)
{
    hal->sent[hal->sends++] = *out;
    return hal->send_result;
}

int hal_load(struct hal *hal, uint8_t memory[CELL_COUNT])
{
    memcpy(memory, hal->stored, CELL_COUNT);   /* even where it failed */
    return hal->load_result;
}

int hal_store(struct hal *hal, const uint8_t memory[CELL_COUNT], bool at_rest)
{
    hal->stores++;
    hal->stored_at_rest = at_rest;
    hal->stored_before_sent = hal->sends < hal->received;
    memcpy(hal->stored, memory, CELL_COUNT);
    return 0;
}

uint32_t hal_entropy(struct hal *hal)
{
    (void)hal;
    return 7;
}

void setUp(void)
{
    memset(&body, 0, sizeof body);
}

static int run(void)
{
    char name[] = "robot";
    char *argv[] = {name, NULL};

    return robot_main(1, argv);
}

static void comes(int result, struct input in)
{
    body.script[body.events].result = result;
    body.script[body.events++].in = in;
}

static void command_comes(enum opcode opcode, uint8_t which, uint32_t value)
{
    comes(INPUT_COMMAND, (struct input){.command = {opcode, which, value}});
}

static const struct output *last_sent(void)
{
    TEST_ASSERT_GREATER_THAN_UINT(0, body.sends);
    return &body.sent[body.sends - 1];
}

/* What the robot says of its memory when it is asked for all. */
static void assert_wakes_with(const uint8_t cells[CELL_COUNT])
{
    command_comes(OPCODE_REPORT, 0, 0);
    TEST_ASSERT_EQUAL(0, run());
    TEST_ASSERT_TRUE(last_sent()->has_report);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(cells, last_sent()->memory, CELL_COUNT);
}

static const uint8_t LEARNED[CELL_COUNT] = {0, 1, 2, 1, 2, 1, 2, 2}, NOTHING[CELL_COUNT] = {0};

TEST(a_body_that_cannot_be_had_is_the_exit_code)
{
    body.open_result = HAL_E_USAGE;
    TEST_ASSERT_EQUAL(-HAL_E_USAGE, run());
    TEST_ASSERT_EQUAL(1, body.argc);
}

TEST(a_body_that_is_gone_ends_the_robot_in_order)
{
    TEST_ASSERT_EQUAL(0, run());
}

TEST(a_body_that_fails_is_the_exit_code)
{
    comes(HAL_E_BODY, (struct input){0});
    TEST_ASSERT_EQUAL(-HAL_E_BODY, run());
    TEST_ASSERT_EQUAL_UINT(0, body.sends);
}

TEST(a_failure_to_send_ends_the_robot_too)
{
    comes(INPUT_SILENCE, (struct input){0});
    comes(INPUT_SILENCE, (struct input){0});
    body.send_result = HAL_E_BODY;
    TEST_ASSERT_EQUAL(-HAL_E_BODY, run());
    TEST_ASSERT_EQUAL_UINT(1, body.sends);
}

TEST(each_input_is_responded_to)
{
    comes(INPUT_SENSES, (struct input){.senses = {.tick = 3}});
    comes(INPUT_SILENCE, (struct input){0});
    TEST_ASSERT_EQUAL(0, run());
    TEST_ASSERT_EQUAL_UINT(2, body.sends);
    TEST_ASSERT_EQUAL_UINT8(3, body.sent[0].drive.tick);
    TEST_ASSERT_EQUAL(REASON_SILENCE, body.sent[1].drive.reason);
}

TEST(it_wakes_with_what_was_stored)
{
    memcpy(body.stored, LEARNED, CELL_COUNT);
    body.load_result = 1;
    assert_wakes_with(LEARNED);
}

TEST(it_wakes_with_nothing_where_nothing_was_stored)
{
    assert_wakes_with(NOTHING);
}

TEST(what_cannot_be_loaded_is_learned_anew)
{
    memcpy(body.stored, LEARNED, CELL_COUNT);
    body.load_result = HAL_E_STORE;
    assert_wakes_with(NOTHING);
}

TEST(bytes_that_are_no_memory_are_learned_anew)
{
    memset(body.stored, 0xEE, CELL_COUNT);
    body.load_result = 1;
    assert_wakes_with(NOTHING);
}

TEST(a_changed_memory_is_stored_after_the_answer_has_gone)
{
    command_comes(OPCODE_WRITE, 0x02, 0x0100);
    TEST_ASSERT_EQUAL(0, run());
    TEST_ASSERT_EQUAL_UINT(1, body.stores);
    TEST_ASSERT_EQUAL_UINT8(1, body.stored[1]);
    TEST_ASSERT_TRUE(body.stored_at_rest);
    TEST_ASSERT_FALSE(body.stored_before_sent);
}

TEST(a_robot_that_runs_stores_on_the_move)
{
    command_comes(OPCODE_START, 0, 1);
    command_comes(OPCODE_WRITE, 0x02, 0x0100);
    TEST_ASSERT_EQUAL(0, run());
    TEST_ASSERT_FALSE(body.stored_at_rest);
}

TEST(nothing_new_is_not_stored)
{
    comes(INPUT_SENSES, (struct input){.senses = {.tick = 0}});
    TEST_ASSERT_EQUAL(0, run());
    TEST_ASSERT_EQUAL_UINT(0, body.stores);
}
