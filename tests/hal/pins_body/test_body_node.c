/* A body on pins whose brain is another node, over a link that the tests hold. */
#include "hal/pins_body/body_node.h"

#include "hal/can_body/port.h"
#include "hal/pins_body/telemetry.h"
#include "hal/protocol/e2e.h"
#include "octet.h"
#include "tests/test.h"

enum { ROOM = 64, NODE = 3 };

static struct frame said[ROOM], heard[ROOM];
static size_t said_count, heard_count, taken, looks;
static uint64_t garbled;   /* bit n: what is heard as number n */
static int result;
static uint8_t tick;
static struct input in;

int link_open(struct link **link, const char *name, const uint16_t ids[], size_t id_count)
{
    (void)name;
    *link = NULL;
    TEST_ASSERT_EQUAL_UINT(2, id_count);
    TEST_ASSERT_EQUAL_HEX16(OCTET_DRIVE_FRAME_ID + NODE - 1, ids[0]);
    TEST_ASSERT_EQUAL_HEX16(OCTET_ANSWER_FRAME_ID + NODE - 1, ids[1]);
    return result;
}

int link_receive(struct link *link, struct frame *out, uint32_t wait_ms)
{
    (void)link;
    TEST_ASSERT_EQUAL_UINT32(0, wait_ms);
    looks++;
    if (taken == heard_count)
        return 0;
    *out = heard[taken];
    return garbled >> taken++ & 1u ? LINK_E_GARBLED : 1;
}

int link_send(struct link *link, const struct frame *frame)
{
    (void)link;
    said[said_count++] = *frame;
    return 0;
}

void setUp(void)
{
    const struct port port = {.node = NODE, .link = ""};

    result = 0;
    tick = 250;
    said_count = heard_count = taken = garbled = 0;
    TEST_ASSERT_EQUAL_INT(0, telemetry_open(&port));
}

static void sense(void)
{
    const struct senses senses = {.tick = ++tick, .range_mm = {1, 2, 3, 4, 255}};

    said_count = 0;
    telemetry_senses(&senses);
}

static uint8_t counter(void)
{
    return e2e_counter(&said[said_count - 1]);
}

static void hear(const struct frame *frame)
{
    heard[heard_count++] = *frame;
}

/* What was heard last has another identifier, and is whole. */
static void rename_last(uint32_t id)
{
    heard[heard_count - 1].id = id + NODE - 1;
    e2e_protect(&heard[heard_count - 1]);
}

static void hear_drive(uint8_t of_tick, uint8_t with, enum reason reason)
{
    const struct octet_drive_t drive = {.counter = with, .tick = of_tick, .reason = (uint8_t)reason, .left = 200, .right = -100};
    struct frame frame = {.id = OCTET_DRIVE_FRAME_ID + NODE - 1, .len = OCTET_DRIVE_LENGTH};

    (void)octet_drive_pack(frame.data, &drive, sizeof frame.data);
    e2e_protect(&frame);
    hear(&frame);
}

static struct frame make_answer(enum opcode opcode, uint8_t with, enum result why, uint32_t value)
{
    const struct octet_answer_t answer = {.counter = with, .opcode = (uint8_t)opcode, .result = (uint8_t)why, .value = value};
    struct frame frame = {.id = OCTET_ANSWER_FRAME_ID + NODE - 1, .len = OCTET_ANSWER_LENGTH};

    (void)octet_answer_pack(frame.data, &answer, sizeof frame.data);
    e2e_protect(&frame);
    return frame;
}

static void hear_answer(enum opcode opcode, uint8_t with, enum result why, uint32_t value)
{
    const struct frame frame = make_answer(opcode, with, why, value);

    hear(&frame);
    TEST_ASSERT_EQUAL_INT(INPUT_SILENCE, telemetry_receive(&in));
}

static struct output driven(void)
{
    struct output out;

    body_node_drive(&out);
    TEST_ASSERT_TRUE(out.has_drive);
    return out;
}

static void start(enum result why, uint32_t value)
{
    body_node_order(&(struct command){OPCODE_START, 4, 0x12345678});
    sense();
    hear_answer(OPCODE_START, e2e_counter(&said[0]), why, value);
}

TEST(each_senses_has_the_next_counter_and_nothing_before_it)
{
    sense();
    TEST_ASSERT_EQUAL_UINT(1, said_count);
    TEST_ASSERT_EQUAL_HEX32(OCTET_SENSES_FRAME_ID + NODE - 1, said[0].id);
    for (unsigned i = 0; i < 40; i++) {
        uint8_t before = counter();

        sense();
        TEST_ASSERT_EQUAL_UINT8(e2e_next(before), counter());
    }
}

TEST(the_drive_that_answers_the_last_senses_is_done_for_a_tenth_of_a_second)
{
    sense();
    hear_drive(tick, counter(), REASON_WANDER);
    TEST_ASSERT_EQUAL_INT(INPUT_PEER, telemetry_receive(&in));
    for (unsigned i = 0; i < 4; i++) {
        sense();
        TEST_ASSERT_EQUAL_INT16(200, driven().drive.left_mm_s);
        TEST_ASSERT_EQUAL_INT16(-100, driven().drive.right_mm_s);
    }
    sense();
    TEST_ASSERT_EQUAL_INT16(0, driven().drive.left_mm_s);
    TEST_ASSERT_EQUAL_INT(REASON_STOP, driven().drive.reason);
}

TEST(other_drives_are_not_done)
{
    sense();
    hear_drive((uint8_t)(tick - 1), counter(), REASON_WANDER);
    hear_drive(tick, e2e_next(counter()), REASON_WANDER);
    hear_drive(tick, counter(), REASON_SILENCE);
    hear_drive(tick, counter(), REASON_WANDER);
    heard[heard_count - 1].data[0] ^= 1;
    TEST_ASSERT_EQUAL_INT(INPUT_SILENCE, telemetry_receive(&in));
    TEST_ASSERT_EQUAL_UINT(4, taken);
    TEST_ASSERT_EQUAL_INT16(0, driven().drive.left_mm_s);
    hear_drive((uint8_t)(tick + 1), counter(), REASON_WANDER);
    hear_drive(tick, (uint8_t)(counter() - 1), REASON_WANDER);
    garbled = 1u << heard_count;
    hear_drive(tick, counter(), REASON_WANDER);
    TEST_ASSERT_EQUAL_INT(INPUT_SILENCE, telemetry_receive(&in));
    hear_drive(tick, counter(), REASON_WANDER);
    TEST_ASSERT_EQUAL_INT(INPUT_PEER, telemetry_receive(&in));
}

TEST(four_frames_are_taken_in_one_go_and_where_there_is_none_it_does_not_ask_again)
{
    garbled = 31;
    heard_count = 5;
    TEST_ASSERT_EQUAL_INT(INPUT_SILENCE, telemetry_receive(&in));
    TEST_ASSERT_EQUAL_size_t(4, taken);
    looks = 0;
    TEST_ASSERT_EQUAL_INT(INPUT_SILENCE, telemetry_receive(&in));
    TEST_ASSERT_EQUAL_size_t(2, looks);
}

TEST(an_order_is_said_before_each_senses_until_it_is_answered_and_then_the_next)
{
    struct octet_command_t got;
    struct frame damaged;
    uint8_t with;

    body_node_order(&(struct command){OPCODE_START, 4, 0x12345678});
    body_node_order(&(struct command){OPCODE_SET, WHEEL_TRACK_MM, 163});
    sense();
    sense();
    TEST_ASSERT_EQUAL_UINT(2, said_count);
    TEST_ASSERT_EQUAL_INT(0, octet_command_unpack(&got, said[0].data, said[0].len));
    TEST_ASSERT_TRUE(e2e_is_whole(&said[0], OCTET_COMMAND_LENGTH));
    TEST_ASSERT_EQUAL_UINT8(BODY_NODE_OWNER, got.owner);
    TEST_ASSERT_EQUAL_UINT8(4, got.profile);
    TEST_ASSERT_EQUAL_HEX32(0x12345678, got.seed);
    TEST_ASSERT_EQUAL_UINT8(0, got.lockstep);
    with = got.counter;
    hear_answer(OPCODE_STOP, with, RESULT_DONE, 0);
    hear_answer(OPCODE_START, e2e_next(with), RESULT_DONE, 0);
    damaged = make_answer(OPCODE_START, with, RESULT_DONE, 0);
    damaged.data[OCTET_ANSWER_LENGTH - 1] ^= 1;
    hear(&damaged);
    TEST_ASSERT_EQUAL_INT(INPUT_SILENCE, telemetry_receive(&in));
    TEST_ASSERT_FALSE(driven().report.running);
    hear_answer(OPCODE_START, with, RESULT_DONE, 0);
    TEST_ASSERT_TRUE(driven().report.running);
    sense();
    TEST_ASSERT_EQUAL_INT(0, octet_command_unpack(&got, said[0].data, said[0].len));
    TEST_ASSERT_EQUAL_UINT8(OPCODE_SET, got.opcode);
    TEST_ASSERT_EQUAL_UINT8(WHEEL_TRACK_MM, got.parameter);
    TEST_ASSERT_EQUAL_UINT16(163, got.value);
    TEST_ASSERT_EQUAL_UINT8(e2e_next(with), got.counter);
    hear_answer(OPCODE_SET, got.counter, RESULT_DONE, 0);
    sense();
    TEST_ASSERT_EQUAL_UINT(1, said_count);
}

TEST(a_counter_that_an_earlier_session_has_used_is_left_behind)
{
    unsigned with;

    start(RESULT_OUT_OF_SEQUENCE, 0);
    with = e2e_counter(&said[0]);
    for (unsigned i = 1; i <= 3; i++) {
        sense();
        TEST_ASSERT_EQUAL_UINT8((with + 7 * i) % E2E_COUNTERS, e2e_counter(&said[0]));
        hear_answer(OPCODE_START, e2e_counter(&said[0]), RESULT_OUT_OF_SEQUENCE, 0);
    }
    TEST_ASSERT_FALSE(driven().report.running);
}

TEST(what_is_garbled_or_answers_an_older_order_is_no_answer)
{
    uint8_t with;

    start(RESULT_DONE, 0);
    body_node_order(&(struct command){OPCODE_STOP, 0, 0});
    sense();
    with = e2e_counter(&said[0]);
    hear_answer(OPCODE_STOP, (uint8_t)(with - 1), RESULT_DONE, 0);
    garbled = 1u << heard_count;
    hear_answer(OPCODE_STOP, with, RESULT_DONE, 0);
    TEST_ASSERT_TRUE(driven().report.running);
    hear_answer(OPCODE_STOP, with, RESULT_DONE, 0);
    TEST_ASSERT_FALSE(driven().report.running);
}

TEST(an_answer_to_another_order_leaves_the_robot_as_it_was)
{
    start(RESULT_DONE, ANSWER_WANTS_RANGES);
    body_node_order(&(struct command){OPCODE_SET, WHEEL_TRACK_MM, 163});
    sense();
    hear_answer(OPCODE_SET, e2e_counter(&said[0]), RESULT_DONE, 0);
    TEST_ASSERT_TRUE(telemetry_wants_ranges() && driven().report.running);
}

TEST(a_robot_that_wants_distances_gets_them_before_its_senses)
{
    struct octet_ranges_t got;

    TEST_ASSERT_FALSE(telemetry_wants_ranges());
    start(RESULT_DONE, ANSWER_WANTS_RANGES);
    TEST_ASSERT_TRUE(telemetry_wants_ranges());
    sense();
    TEST_ASSERT_EQUAL_UINT(2, said_count);
    TEST_ASSERT_EQUAL_HEX32(OCTET_RANGES_FRAME_ID + NODE - 1, said[0].id);
    TEST_ASSERT_TRUE(e2e_is_whole(&said[0], OCTET_RANGES_LENGTH));
    TEST_ASSERT_EQUAL_INT(0, octet_ranges_unpack(&got, said[0].data, said[0].len));
    TEST_ASSERT_EQUAL_UINT8(tick, got.tick);
    TEST_ASSERT_EQUAL_UINT8(counter(), got.counter);
    TEST_ASSERT_EQUAL_UINT8(1, got.range_right);
    TEST_ASSERT_EQUAL_UINT8(2, got.range_front_right);
    TEST_ASSERT_EQUAL_UINT8(3, got.range_front);
    TEST_ASSERT_EQUAL_UINT8(4, got.range_front_left);
    TEST_ASSERT_EQUAL_UINT8(255, got.range_left);
}

TEST(stopped_or_refused_the_robot_does_not_run)
{
    start(RESULT_DONE, 0);
    TEST_ASSERT_TRUE(driven().report.running);
    body_node_order(&(struct command){.opcode = OPCODE_STOP});
    sense();
    hear_answer(OPCODE_STOP, e2e_counter(&said[0]), RESULT_DONE, 0);
    TEST_ASSERT_FALSE(driven().report.running);
    start(RESULT_OWNED, ANSWER_WANTS_RANGES);
    TEST_ASSERT_FALSE(driven().report.running);
    TEST_ASSERT_FALSE(telemetry_wants_ranges());
}

TEST(a_link_that_cannot_be_opened_is_said)
{
    const struct port port = {.node = NODE, .link = ""};

    result = LINK_E_OPEN;
    TEST_ASSERT_EQUAL_INT(HAL_E_BODY, telemetry_open(&port));
    telemetry_output(&(struct output){.has_drive = false}, false);
}

TEST(a_body_that_is_opened_again_knows_nothing_of_before)
{
    const struct port port = {.node = NODE, .link = ""};

    start(RESULT_DONE, ANSWER_WANTS_RANGES);
    sense();
    hear_drive(tick, counter(), REASON_WANDER);
    TEST_ASSERT_EQUAL_INT(INPUT_PEER, telemetry_receive(&in));
    body_node_order(&(struct command){OPCODE_STOP, 0, 0});
    body_node_order(&(struct command){OPCODE_SET, WHEEL_TRACK_MM, 163});
    TEST_ASSERT_EQUAL_INT(0, telemetry_open(&port));
    sense();
    TEST_ASSERT_EQUAL_size_t(1, said_count);
    TEST_ASSERT_FALSE(telemetry_wants_ranges() || driven().report.running);
    TEST_ASSERT_EQUAL_INT(REASON_STOP, driven().drive.reason);
    body_node_order(&(struct command){OPCODE_STOP, 0, 0});
    sense();
    TEST_ASSERT_EQUAL_HEX16(OCTET_COMMAND_FRAME_ID + NODE - 1, said[0].id);
    TEST_ASSERT_EQUAL_UINT8(0, e2e_counter(&said[0]));
    hear_answer(OPCODE_STOP, 0, RESULT_DONE, 0);
    sense();
    TEST_ASSERT_EQUAL_size_t(1, said_count);
}

TEST(a_frame_of_another_identifier_is_neither_a_drive_nor_an_answer)
{
    const uint32_t ids[] = {OCTET_DRIVE_FRAME_ID - 1, OCTET_DRIVE_FRAME_ID + 1, OCTET_ANSWER_FRAME_ID - 1, OCTET_ANSWER_FRAME_ID + 1};

    body_node_order(&(struct command){OPCODE_START, 4, 1});
    sense();
    for (unsigned i = 0; i < sizeof ids / sizeof *ids; i++) {
        hear_drive(tick, counter(), REASON_WANDER);
        rename_last(ids[i]);
        TEST_ASSERT_EQUAL_INT(INPUT_SILENCE, telemetry_receive(&in));
        heard[heard_count++] = make_answer(OPCODE_START, e2e_counter(&said[0]), RESULT_DONE, 0);
        rename_last(ids[i]);
        TEST_ASSERT_EQUAL_INT(INPUT_SILENCE, telemetry_receive(&in));
    }
    hear_drive(tick, counter(), REASON_WANDER);
    rename_last(OCTET_ANSWER_FRAME_ID);
    TEST_ASSERT_EQUAL_INT(INPUT_SILENCE, telemetry_receive(&in));
    TEST_ASSERT_FALSE(driven().report.running);
    hear_answer(OPCODE_START, e2e_counter(&said[0]), RESULT_DONE, 0);
    TEST_ASSERT_TRUE(driven().report.running);
    TEST_ASSERT_EQUAL_INT(REASON_STOP, driven().drive.reason);
}
