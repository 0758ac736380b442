/* The robot's main with the real robot and a fake body. */
#include "firmware/robot.h"
#include "hal/hal.h"

#include <string.h>

#include "tests/test.h"

enum { SCRIPT_MAX = 8 };

int robot_main(int argc, char *argv[]);   /* main of main.c, renamed */

struct hal {
    int open_result, load_result, send_result;
    uint8_t stored[CELL_COUNT];
    struct {
        int result;
        struct input in;
    } script[SCRIPT_MAX];   /* what is received; after the last one the body is closed */
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
    if (body.open_result >= 0)
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

static void queue_input(int result, struct input in)
{
    body.script[body.events].result = result;
    body.script[body.events++].in = in;
}

static void queue_command(enum opcode opcode, uint8_t which, uint32_t value)
{
    queue_input(INPUT_COMMAND, (struct input){.command = {opcode, which, value}});
}

static const struct output *last_sent(void)
{
    TEST_ASSERT_GREATER_THAN_UINT(0, body.sends);
    return &body.sent[body.sends - 1];
}

/* Checks the memory in the robot's report. */
static void assert_starts_with(const uint8_t cells[CELL_COUNT])
{
    queue_command(OPCODE_REPORT, 0, 0);
    TEST_ASSERT_EQUAL(0, run());
    TEST_ASSERT_TRUE(last_sent()->has_report);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(cells, last_sent()->memory, CELL_COUNT);
}

static const uint8_t LEARNED[CELL_COUNT] = {0, 1, 2, 1, 2, 1, 2, 2}, NOTHING[CELL_COUNT] = {0};

TEST(failed_open_is_the_exit_code)
{
    for (int error = HAL_E_BODY; error >= HAL_E_USAGE; error--) {
        body.open_result = error;
        TEST_ASSERT_EQUAL(-error, run());
        TEST_ASSERT_EQUAL(1, body.argc);
    }
}

TEST(closed_body_exits_with_0)
{
    TEST_ASSERT_EQUAL(0, run());
}

TEST(failed_receive_is_the_exit_code)
{
    queue_input(HAL_E_BODY, (struct input){0});
    TEST_ASSERT_EQUAL(-HAL_E_BODY, run());
    TEST_ASSERT_EQUAL_UINT(0, body.sends);
}

TEST(failed_send_is_the_exit_code)
{
    queue_input(INPUT_SILENCE, (struct input){0});
    queue_input(INPUT_SILENCE, (struct input){0});
    body.send_result = HAL_E_BODY;
    TEST_ASSERT_EQUAL(-HAL_E_BODY, run());
    TEST_ASSERT_EQUAL_UINT(1, body.sends);
}

TEST(error_of_the_body_is_the_exit_code)
{
    queue_input(HAL_E_STORE, (struct input){0});
    TEST_ASSERT_EQUAL(-HAL_E_STORE, run());
}

TEST(positive_results_of_the_body_are_success)
{
    body.open_result = body.send_result = 2;
    queue_input(INPUT_SILENCE, (struct input){0});
    queue_input(INPUT_SILENCE, (struct input){0});
    TEST_ASSERT_EQUAL(0, run());
    TEST_ASSERT_EQUAL_UINT(2, body.sends);
}

TEST(main_sends_a_response_to_every_input)
{
    queue_input(INPUT_SENSES, (struct input){.senses = {.tick = 3}});
    queue_input(INPUT_SILENCE, (struct input){0});
    TEST_ASSERT_EQUAL(0, run());
    TEST_ASSERT_EQUAL_UINT(2, body.sends);
    TEST_ASSERT_EQUAL_UINT8(3, body.sent[0].drive.tick);
    TEST_ASSERT_EQUAL(REASON_SILENCE, body.sent[1].drive.reason);
}

TEST(stored_memory_is_loaded_at_start)
{
    memcpy(body.stored, LEARNED, CELL_COUNT);
    body.load_result = 1;
    assert_starts_with(LEARNED);
}

TEST(memory_is_empty_at_start_when_none_was_stored)
{
    assert_starts_with(NOTHING);
}

TEST(failed_load_starts_with_an_empty_memory)
{
    memcpy(body.stored, LEARNED, CELL_COUNT);
    body.load_result = HAL_E_STORE;
    assert_starts_with(NOTHING);
}

TEST(invalid_stored_bytes_start_with_an_empty_memory)
{
    memset(body.stored, 0xEE, CELL_COUNT);
    body.load_result = 1;
    assert_starts_with(NOTHING);
}

TEST(changed_memory_is_stored_after_the_answer_is_sent)
{
    queue_command(OPCODE_WRITE, 0x02, 0x0100);
    TEST_ASSERT_EQUAL(0, run());
    TEST_ASSERT_EQUAL_UINT(1, body.stores);
    TEST_ASSERT_EQUAL_UINT8(1, body.stored[1]);
    TEST_ASSERT_TRUE(body.stored_at_rest);
    TEST_ASSERT_FALSE(body.stored_before_sent);
}

TEST(running_robot_stores_without_at_rest)
{
    queue_command(OPCODE_START, 0, 1);
    queue_command(OPCODE_WRITE, 0x02, 0x0100);
    TEST_ASSERT_EQUAL(0, run());
    TEST_ASSERT_FALSE(body.stored_at_rest);
}

TEST(unchanged_memory_is_not_stored)
{
    queue_input(INPUT_SENSES, (struct input){.senses = {.tick = 0}});
    TEST_ASSERT_EQUAL(0, run());
    TEST_ASSERT_EQUAL_UINT(0, body.stores);
}
