/* A body on pins whose brain is another node, over a fake link. */
#include "hal/pins_body/body_node.h"

#include "hal/can_body/port.h"
#include "hal/pins_body/telemetry.h"
#include "hal/protocol/e2e.h"
#include "octet.h"
#include "tests/test.h"

enum { ROOM = 64, NODE = 3 };

static struct frame sent[ROOM], received[ROOM];
static size_t sent_count, received_count, taken, looks;
static uint64_t garbled;   /* bit n: received frame n */
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
    if (taken == received_count)
        return 0;
    *out = received[taken];
    return garbled >> taken++ & 1u ? LINK_E_GARBLED : 1;
}

int link_send(struct link *link, const struct frame *frame)
{
    (void)link;
    sent[sent_count++] = *frame;
    return 0;
}

void setUp(void)
{
    const struct port port = {.node = NODE, .link = ""};

    result = 0;
    tick = 250;
    sent_count = received_count = taken = garbled = 0;
    TEST_ASSERT_EQUAL_INT(0, telemetry_open(&port));
}

static void sense(void)
{
    const struct senses senses = {.tick = ++tick, .range_mm = {1, 2, 3, 4, 255}};

    sent_count = 0;
    telemetry_senses(&senses);
}

static uint8_t counter(void)
{
    return e2e_counter(&sent[sent_count - 1]);
}

static void feed(const struct frame *frame)
{
    received[received_count++] = *frame;
}

/* Gives the last frame another identifier and a valid CRC. */
static void rename_last(uint32_t id)
{
    received[received_count - 1].id = id + NODE - 1;
    e2e_protect(&received[received_count - 1]);
}

static void feed_drive(uint8_t of_tick, uint8_t with, enum reason reason)
{
    const struct octet_drive_t drive = {.counter = with, .tick = of_tick, .reason = (uint8_t)reason, .left = 200, .right = -100};
    struct frame frame = {.id = OCTET_DRIVE_FRAME_ID + NODE - 1, .len = OCTET_DRIVE_LENGTH};

    (void)octet_drive_pack(frame.data, &drive, sizeof frame.data);
    e2e_protect(&frame);
    feed(&frame);
}

static struct frame make_answer(enum opcode opcode, uint8_t with, enum result why, uint32_t value)
{
    const struct octet_answer_t answer = {.counter = with, .opcode = (uint8_t)opcode, .result = (uint8_t)why, .value = value};
    struct frame frame = {.id = OCTET_ANSWER_FRAME_ID + NODE - 1, .len = OCTET_ANSWER_LENGTH};

    (void)octet_answer_pack(frame.data, &answer, sizeof frame.data);
    e2e_protect(&frame);
    return frame;
}

static void feed_answer(enum opcode opcode, uint8_t with, enum result why, uint32_t value)
{
    const struct frame frame = make_answer(opcode, with, why, value);

    feed(&frame);
    TEST_ASSERT_EQUAL_INT(INPUT_SILENCE, telemetry_receive(&in));
}

static struct output drive_output(void)
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
    feed_answer(OPCODE_START, e2e_counter(&sent[0]), why, value);
}

TEST(senses_counter_advances_by_one)
{
    sense();
    TEST_ASSERT_EQUAL_UINT(1, sent_count);
    TEST_ASSERT_EQUAL_HEX32(OCTET_SENSES_FRAME_ID + NODE - 1, sent[0].id);
    for (unsigned i = 0; i < 40; i++) {
        uint8_t before = counter();

        sense();
        TEST_ASSERT_EQUAL_UINT8(e2e_next(before), counter());
    }
}

TEST(drive_for_the_last_senses_holds_for_100_ms)
{
    sense();
    feed_drive(tick, counter(), REASON_WANDER);
    TEST_ASSERT_EQUAL_INT(INPUT_PEER, telemetry_receive(&in));
    for (unsigned i = 0; i < 4; i++) {
        sense();
        TEST_ASSERT_EQUAL_INT16(200, drive_output().drive.left_mm_s);
        TEST_ASSERT_EQUAL_INT16(-100, drive_output().drive.right_mm_s);
    }
    sense();
    TEST_ASSERT_EQUAL_INT16(0, drive_output().drive.left_mm_s);
    TEST_ASSERT_EQUAL_INT(REASON_STOP, drive_output().drive.reason);
}

TEST(body_node_ignores_drives_for_other_senses)
{
    sense();
    feed_drive((uint8_t)(tick - 1), counter(), REASON_WANDER);
    feed_drive(tick, e2e_next(counter()), REASON_WANDER);
    feed_drive(tick, counter(), REASON_SILENCE);
    feed_drive(tick, counter(), REASON_WANDER);
    received[received_count - 1].data[0] ^= 1;
    TEST_ASSERT_EQUAL_INT(INPUT_SILENCE, telemetry_receive(&in));
    TEST_ASSERT_EQUAL_UINT(4, taken);
    TEST_ASSERT_EQUAL_INT16(0, drive_output().drive.left_mm_s);
    feed_drive((uint8_t)(tick + 1), counter(), REASON_WANDER);
    feed_drive(tick, (uint8_t)(counter() - 1), REASON_WANDER);
    garbled = 1u << received_count;
    feed_drive(tick, counter(), REASON_WANDER);
    TEST_ASSERT_EQUAL_INT(INPUT_SILENCE, telemetry_receive(&in));
    feed_drive(tick, counter(), REASON_WANDER);
    TEST_ASSERT_EQUAL_INT(INPUT_PEER, telemetry_receive(&in));
}

TEST(body_node_reads_at_most_four_frames_per_call)
{
    garbled = 31;
    received_count = 5;
    TEST_ASSERT_EQUAL_INT(INPUT_SILENCE, telemetry_receive(&in));
    TEST_ASSERT_EQUAL_size_t(4, taken);
    looks = 0;
    TEST_ASSERT_EQUAL_INT(INPUT_SILENCE, telemetry_receive(&in));
    TEST_ASSERT_EQUAL_size_t(2, looks);
}

TEST(body_node_repeats_an_order_until_it_is_answered)
{
    struct octet_command_t got;
    struct frame damaged;
    uint8_t with;

    body_node_order(&(struct command){OPCODE_START, 4, 0x12345678});
    body_node_order(&(struct command){OPCODE_SET, WHEEL_TRACK_MM, 163});
    sense();
    sense();
    TEST_ASSERT_EQUAL_UINT(2, sent_count);
    TEST_ASSERT_EQUAL_INT(0, octet_command_unpack(&got, sent[0].data, sent[0].len));
    TEST_ASSERT_TRUE(e2e_is_whole(&sent[0], OCTET_COMMAND_LENGTH));
    TEST_ASSERT_EQUAL_UINT8(BODY_NODE_OWNER, got.owner);
    TEST_ASSERT_EQUAL_UINT8(4, got.profile);
    TEST_ASSERT_EQUAL_HEX32(0x12345678, got.seed);
    TEST_ASSERT_EQUAL_UINT8(0, got.lockstep);
    with = got.counter;
    feed_answer(OPCODE_STOP, with, RESULT_DONE, 0);
    feed_answer(OPCODE_START, e2e_next(with), RESULT_DONE, 0);
    damaged = make_answer(OPCODE_START, with, RESULT_DONE, 0);
    damaged.data[OCTET_ANSWER_LENGTH - 1] ^= 1;
    feed(&damaged);
    TEST_ASSERT_EQUAL_INT(INPUT_SILENCE, telemetry_receive(&in));
    TEST_ASSERT_FALSE(drive_output().report.running);
    feed_answer(OPCODE_START, with, RESULT_DONE, 0);
    TEST_ASSERT_TRUE(drive_output().report.running);
    sense();
    TEST_ASSERT_EQUAL_INT(0, octet_command_unpack(&got, sent[0].data, sent[0].len));
    TEST_ASSERT_EQUAL_UINT8(OPCODE_SET, got.opcode);
    TEST_ASSERT_EQUAL_UINT8(WHEEL_TRACK_MM, got.parameter);
    TEST_ASSERT_EQUAL_UINT16(163, got.value);
    TEST_ASSERT_EQUAL_UINT8(e2e_next(with), got.counter);
    feed_answer(OPCODE_SET, got.counter, RESULT_DONE, 0);
    sense();
    TEST_ASSERT_EQUAL_UINT(1, sent_count);
}

TEST(out_of_sequence_answer_advances_the_command_counter)
{
    unsigned with;

    start(RESULT_OUT_OF_SEQUENCE, 0);
    with = e2e_counter(&sent[0]);
    for (unsigned i = 1; i <= 3; i++) {
        sense();
        TEST_ASSERT_EQUAL_UINT8((with + 7 * i) % E2E_COUNTERS, e2e_counter(&sent[0]));
        feed_answer(OPCODE_START, e2e_counter(&sent[0]), RESULT_OUT_OF_SEQUENCE, 0);
    }
    TEST_ASSERT_FALSE(drive_output().report.running);
}

TEST(garbled_or_older_answer_is_ignored)
{
    uint8_t with;

    start(RESULT_DONE, 0);
    body_node_order(&(struct command){OPCODE_STOP, 0, 0});
    sense();
    with = e2e_counter(&sent[0]);
    feed_answer(OPCODE_STOP, (uint8_t)(with - 1), RESULT_DONE, 0);
    garbled = 1u << received_count;
    feed_answer(OPCODE_STOP, with, RESULT_DONE, 0);
    TEST_ASSERT_TRUE(drive_output().report.running);
    feed_answer(OPCODE_STOP, with, RESULT_DONE, 0);
    TEST_ASSERT_FALSE(drive_output().report.running);
}

TEST(answer_to_set_keeps_running_and_ranges)
{
    start(RESULT_DONE, ANSWER_WANTS_RANGES);
    body_node_order(&(struct command){OPCODE_SET, WHEEL_TRACK_MM, 163});
    sense();
    feed_answer(OPCODE_SET, e2e_counter(&sent[0]), RESULT_DONE, 0);
    TEST_ASSERT_TRUE(telemetry_wants_ranges() && drive_output().report.running);
}

TEST(wanted_ranges_are_sent_before_senses)
{
    struct octet_ranges_t got;

    TEST_ASSERT_FALSE(telemetry_wants_ranges());
    start(RESULT_DONE, ANSWER_WANTS_RANGES);
    TEST_ASSERT_TRUE(telemetry_wants_ranges());
    sense();
    TEST_ASSERT_EQUAL_UINT(2, sent_count);
    TEST_ASSERT_EQUAL_HEX32(OCTET_RANGES_FRAME_ID + NODE - 1, sent[0].id);
    TEST_ASSERT_TRUE(e2e_is_whole(&sent[0], OCTET_RANGES_LENGTH));
    TEST_ASSERT_EQUAL_INT(0, octet_ranges_unpack(&got, sent[0].data, sent[0].len));
    TEST_ASSERT_EQUAL_UINT8(tick, got.tick);
    TEST_ASSERT_EQUAL_UINT8(counter(), got.counter);
    TEST_ASSERT_EQUAL_UINT8(1, got.range_right);
    TEST_ASSERT_EQUAL_UINT8(2, got.range_front_right);
    TEST_ASSERT_EQUAL_UINT8(3, got.range_front);
    TEST_ASSERT_EQUAL_UINT8(4, got.range_front_left);
    TEST_ASSERT_EQUAL_UINT8(255, got.range_left);
}

TEST(stopped_or_refused_robot_does_not_run)
{
    start(RESULT_DONE, 0);
    TEST_ASSERT_TRUE(drive_output().report.running);
    body_node_order(&(struct command){.opcode = OPCODE_STOP});
    sense();
    feed_answer(OPCODE_STOP, e2e_counter(&sent[0]), RESULT_DONE, 0);
    TEST_ASSERT_FALSE(drive_output().report.running);
    start(RESULT_OWNED, ANSWER_WANTS_RANGES);
    TEST_ASSERT_FALSE(drive_output().report.running);
    TEST_ASSERT_FALSE(telemetry_wants_ranges());
}

TEST(failed_link_open_returns_body_error)
{
    const struct port port = {.node = NODE, .link = ""};

    result = LINK_E_OPEN;
    TEST_ASSERT_EQUAL_INT(HAL_E_BODY, telemetry_open(&port));
    telemetry_output(&(struct output){.has_drive = false}, false);
}

TEST(reopened_body_node_forgets_its_session)
{
    const struct port port = {.node = NODE, .link = ""};

    start(RESULT_DONE, ANSWER_WANTS_RANGES);
    sense();
    feed_drive(tick, counter(), REASON_WANDER);
    TEST_ASSERT_EQUAL_INT(INPUT_PEER, telemetry_receive(&in));
    body_node_order(&(struct command){OPCODE_STOP, 0, 0});
    body_node_order(&(struct command){OPCODE_SET, WHEEL_TRACK_MM, 163});
    TEST_ASSERT_EQUAL_INT(0, telemetry_open(&port));
    sense();
    TEST_ASSERT_EQUAL_size_t(1, sent_count);
    TEST_ASSERT_FALSE(telemetry_wants_ranges() || drive_output().report.running);
    TEST_ASSERT_EQUAL_INT(REASON_STOP, drive_output().drive.reason);
    body_node_order(&(struct command){OPCODE_STOP, 0, 0});
    sense();
    TEST_ASSERT_EQUAL_HEX16(OCTET_COMMAND_FRAME_ID + NODE - 1, sent[0].id);
    TEST_ASSERT_EQUAL_UINT8(0, e2e_counter(&sent[0]));
    feed_answer(OPCODE_STOP, 0, RESULT_DONE, 0);
    sense();
    TEST_ASSERT_EQUAL_size_t(1, sent_count);
}

TEST(frame_with_another_identifier_is_ignored)
{
    const uint32_t ids[] = {OCTET_DRIVE_FRAME_ID - 1, OCTET_DRIVE_FRAME_ID + 1, OCTET_ANSWER_FRAME_ID - 1, OCTET_ANSWER_FRAME_ID + 1};

    body_node_order(&(struct command){OPCODE_START, 4, 1});
    sense();
    for (unsigned i = 0; i < sizeof ids / sizeof *ids; i++) {
        feed_drive(tick, counter(), REASON_WANDER);
        rename_last(ids[i]);
        TEST_ASSERT_EQUAL_INT(INPUT_SILENCE, telemetry_receive(&in));
        received[received_count++] = make_answer(OPCODE_START, e2e_counter(&sent[0]), RESULT_DONE, 0);
        rename_last(ids[i]);
        TEST_ASSERT_EQUAL_INT(INPUT_SILENCE, telemetry_receive(&in));
    }
    feed_drive(tick, counter(), REASON_WANDER);
    rename_last(OCTET_ANSWER_FRAME_ID);
    TEST_ASSERT_EQUAL_INT(INPUT_SILENCE, telemetry_receive(&in));
    TEST_ASSERT_FALSE(drive_output().report.running);
    feed_answer(OPCODE_START, e2e_counter(&sent[0]), RESULT_DONE, 0);
    TEST_ASSERT_TRUE(drive_output().report.running);
    TEST_ASSERT_EQUAL_INT(REASON_STOP, drive_output().drive.reason);
}
