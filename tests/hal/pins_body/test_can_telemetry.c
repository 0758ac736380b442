/* What a robot with a body of its own sends and receives on a bus, over a fake link. */
#include <string.h>

#include "hal/can_body/port.h"
#include "hal/pins_body/telemetry.h"
#include "hal/protocol/e2e.h"
#include "octet.h"
#include "tests/test.h"

enum { ROOM = 64 };

static struct frame sent[ROOM], received[ROOM];
static size_t sent_count, received_count, taken;
static int result;
static struct input in;

int link_open(struct link **link, const char *name, const uint16_t ids[], size_t id_count)
{
    (void)name;
    (void)ids;
    *link = NULL;
    return id_count > 0 ? result : 1;
}

int link_receive(struct link *link, struct frame *out, uint32_t wait_ms)
{
    (void)link;
    TEST_ASSERT_EQUAL_UINT32(0, wait_ms);
    if (taken == received_count)
        return 0;
    *out = received[taken++];
    return out->len > 8 ? LINK_E_GARBLED : 1;
}

int link_send(struct link *link, const struct frame *frame)
{
    (void)link;
    if (result == 0)
        sent[sent_count++] = *frame;
    return result;
}

void link_health(const struct link *link, struct link_health *out)
{
    (void)link;
    out->bus_offs = 3;
}

void setUp(void)
{
    const struct port port = {.node = 2, .link = ""};

    result = 0;
    sent_count = received_count = taken = 0;
    TEST_ASSERT_EQUAL_INT(0, telemetry_open(&port));
}

static const struct frame *last(uint32_t id_of_node_1)
{
    for (size_t i = sent_count; i > 0; i--)
        if (sent[i - 1].id == id_of_node_1 + 1)
            return &sent[i - 1];
    TEST_FAIL_MESSAGE("it was not sent");
    return NULL;
}

static void feed(uint32_t id, const uint8_t *data, uint8_t len)
{
    struct frame *frame = &received[received_count++];

    *frame = (struct frame){.id = id, .len = len};
    memcpy(frame->data, data, sizeof frame->data);
    if (len <= 8)
        e2e_protect(frame);
}

static void feed_command(uint8_t opcode, uint8_t counter)
{
    struct octet_command_t command = {.opcode = opcode, .counter = counter, .owner = 9, .lockstep = 1, .seed = 5};
    uint8_t data[8] = {0};

    (void)octet_command_pack(data, &command, sizeof data);
    feed(OCTET_COMMAND_FRAME_ID + 1, data, OCTET_COMMAND_LENGTH);
}

TEST(drive_has_the_counter_of_its_senses)
{
    const struct output out = {.has_drive = true, .drive = {.tick = 77, .left_mm_s = -5}};
    struct senses senses = {.tick = 77, .feel = 9, .look = true, .beacon_mm = 1000, .odometer_left = 4095, .bump = true};
    struct octet_senses_t senses_sent;
    struct octet_drive_t drive;
    uint8_t counter;

    telemetry_senses(&senses);
    telemetry_output(&out, false);
    (void)octet_senses_unpack(&senses_sent, last(OCTET_SENSES_FRAME_ID)->data, 8);
    (void)octet_drive_unpack(&drive, last(OCTET_DRIVE_FRAME_ID)->data, 8);
    TEST_ASSERT_TRUE(e2e_is_whole(last(OCTET_SENSES_FRAME_ID), OCTET_SENSES_LENGTH));
    TEST_ASSERT_EQUAL_UINT8(77, senses_sent.tick);
    TEST_ASSERT_EQUAL_UINT8(9, senses_sent.feel);
    TEST_ASSERT_EQUAL_UINT16(1000, senses_sent.beacon);
    TEST_ASSERT_EQUAL_UINT16(4095, senses_sent.odometer_left);
    TEST_ASSERT_TRUE(senses_sent.look && senses_sent.bump);
    TEST_ASSERT_EQUAL_UINT8(senses_sent.counter, drive.counter);
    counter = senses_sent.counter;
    telemetry_senses(&senses);
    (void)octet_senses_unpack(&senses_sent, last(OCTET_SENSES_FRAME_ID)->data, 8);
    TEST_ASSERT_EQUAL_UINT8((counter + 1) % E2E_COUNTERS, senses_sent.counter);
}

TEST(telemetry_sends_boot_once)
{
    struct senses senses = {.tick = 1};
    size_t boots = 0;

    for (unsigned i = 0; i < 3; i++)
        telemetry_senses(&senses);
    for (size_t i = 0; i < sent_count; i++)
        boots += sent[i].id == OCTET_BOOT_FRAME_ID + 1;
    TEST_ASSERT_EQUAL_size_t(1, boots);
}

TEST(repeated_command_is_answered_again)
{
    const struct output out = {.has_answer = true, .answer = RESULT_DONE};

    feed_command(OPCODE_START, 1);
    TEST_ASSERT_EQUAL_INT(INPUT_COMMAND, telemetry_receive(&in));
    TEST_ASSERT_EQUAL_INT(OPCODE_START, in.command.opcode);
    telemetry_output(&out, true);
    (void)last(OCTET_ANSWER_FRAME_ID);
    sent_count = 0;
    feed_command(OPCODE_START, 1);
    TEST_ASSERT_EQUAL_INT(INPUT_SILENCE, telemetry_receive(&in));
    (void)last(OCTET_ANSWER_FRAME_ID);
}

TEST(button_command_gets_no_answer_on_the_bus)
{
    const struct output out = {.has_answer = true, .answer = RESULT_DONE};

    telemetry_output(&out, false);
    TEST_ASSERT_EQUAL_size_t(0, sent_count);
}

TEST(stop_for_a_twin_is_not_answered)
{
    const struct output out = {.has_answer = true, .answer = RESULT_DONE};
    enum input_kind kind = INPUT_SILENCE;
    uint8_t data[8] = {0};

    while (kind == INPUT_SILENCE && received_count < ROOM) {
        feed(OCTET_DRIVE_FRAME_ID + 1, data, OCTET_DRIVE_LENGTH);
        kind = telemetry_receive(&in);
    }
    TEST_ASSERT_EQUAL_INT(INPUT_COMMAND, kind);
    TEST_ASSERT_EQUAL_INT(OPCODE_STOP, in.command.opcode);
    telemetry_output(&out, true);
    for (size_t i = 0; i < sent_count; i++)
        TEST_ASSERT_NOT_EQUAL_HEX32(OCTET_ANSWER_FRAME_ID + 1, sent[i].id);
}

/* Returns whether a twin stops it. */
static bool is_stopped_by_twin(void)
{
    enum input_kind kind = INPUT_SILENCE;
    uint8_t data[8] = {0};

    for (unsigned i = 0; i < 5 && kind == INPUT_SILENCE; i++) {
        feed(OCTET_DRIVE_FRAME_ID + 1, data, OCTET_DRIVE_LENGTH);
        kind = telemetry_receive(&in);
    }
    return kind == INPUT_COMMAND;
}

TEST(twin_stops_the_robot_again_after_a_button_start)
{
    const struct output stopped = {.has_answer = true, .answer = RESULT_DONE};
    const struct output started = {.has_answer = true, .answer = RESULT_DONE, .report.running = true};

    TEST_ASSERT_TRUE(is_stopped_by_twin());
    telemetry_output(&stopped, true);
    TEST_ASSERT_FALSE(is_stopped_by_twin());
    telemetry_output(&started, false);
    TEST_ASSERT_TRUE(is_stopped_by_twin());
}

TEST(postponed_and_failed_stores_are_reported)
{
    const struct output report = {.has_answer = true, .has_report = true, .whole_report = true};
    struct octet_health_t health;
    struct octet_faults_t faults;

    telemetry_stored(HAL_E_STORE);
    telemetry_stored(PORT_LATER);
    telemetry_output(&report, true);
    (void)octet_health_unpack(&health, last(OCTET_HEALTH_FRAME_ID)->data, 8);
    TEST_ASSERT_TRUE(health.unstored);
    (void)octet_faults_unpack(&faults, last(OCTET_FAULTS_FRAME_ID)->data, 8);
    TEST_ASSERT_EQUAL_UINT8(1, faults.unsaved);
    telemetry_stored(0);
    telemetry_output(&report, true);
    (void)octet_health_unpack(&health, last(OCTET_HEALTH_FRAME_ID)->data, 8);
    TEST_ASSERT_FALSE(health.unstored);
}

TEST(senses_and_ranges_from_the_bus_are_ignored)
{
    uint8_t data[8] = {0};

    feed(OCTET_SENSES_FRAME_ID + 1, data, OCTET_SENSES_LENGTH);
    feed(OCTET_RANGES_FRAME_ID + 1, data, OCTET_RANGES_LENGTH);
    feed_command(OPCODE_REPORT, 1);
    TEST_ASSERT_EQUAL_INT(INPUT_COMMAND, telemetry_receive(&in));
    TEST_ASSERT_EQUAL_INT(OPCODE_REPORT, in.command.opcode);
}

TEST(telemetry_reads_at_most_four_frames_per_call)
{
    uint8_t data[8] = {0};

    for (unsigned i = 0; i < 6; i++)
        feed(OCTET_SENSES_FRAME_ID + 1, data, i == 1 ? 9 : OCTET_SENSES_LENGTH);
    TEST_ASSERT_EQUAL_INT(INPUT_SILENCE, telemetry_receive(&in));
    TEST_ASSERT_EQUAL_size_t(4, taken);
}

TEST(unsent_senses_are_counted)
{
    const struct output report = {.has_answer = true, .has_report = true, .whole_report = true};
    struct senses senses = {.tick = 1};
    struct octet_faults_t faults;

    result = LINK_E_FULL;
    telemetry_senses(&senses);
    result = 0;
    telemetry_output(&report, true);
    for (size_t i = 0; i < sent_count; i++)
        if (sent[i].id == OCTET_FAULTS_FRAME_ID + 1 && octet_faults_unpack(&faults, sent[i].data, 8) == 0 && faults.page == 0)
            TEST_ASSERT_EQUAL_UINT8(1, faults.unsent);
    (void)last(OCTET_FAULTS_FRAME_ID);
}

TEST(failed_link_open_returns_body_error)
{
    const struct port port = {.node = 2, .link = ""};

    result = LINK_E_OPEN;
    TEST_ASSERT_EQUAL_INT(HAL_E_BODY, telemetry_open(&port));
}
