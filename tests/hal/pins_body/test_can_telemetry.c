/* What a robot of its own says and hears on a bus, over a link that the tests hold. */
#include <string.h>

#include "hal/can_body/port.h"
#include "hal/pins_body/telemetry.h"
#include "hal/protocol/e2e.h"
#include "octet.h"
#include "tests/test.h"

enum { ROOM = 64 };

static struct frame said[ROOM], heard[ROOM];
static size_t said_count, heard_count, taken;
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
    if (taken == heard_count)
        return 0;
    *out = heard[taken++];
    return out->len > 8 ? LINK_E_GARBLED : 1;
}

int link_send(struct link *link, const struct frame *frame)
{
    (void)link;
    if (result == 0)
        said[said_count++] = *frame;
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
    said_count = heard_count = taken = 0;
    TEST_ASSERT_EQUAL_INT(0, telemetry_open(&port));
}

static const struct frame *last(uint32_t id_of_node_1)
{
    for (size_t i = said_count; i > 0; i--)
        if (said[i - 1].id == id_of_node_1 + 1)
            return &said[i - 1];
    TEST_FAIL_MESSAGE("it did not say that");
    return NULL;
}

static void hear(uint32_t id, const uint8_t *data, uint8_t len)
{
    struct frame *frame = &heard[heard_count++];

    *frame = (struct frame){.id = id, .len = len};
    memcpy(frame->data, data, sizeof frame->data);
    if (len <= 8)
        e2e_protect(frame);
}

static void order(uint8_t opcode, uint8_t counter)
{
    struct octet_command_t command = {.opcode = opcode, .counter = counter, .owner = 9, .lockstep = 1, .seed = 5};
    uint8_t data[8] = {0};

    (void)octet_command_pack(data, &command, sizeof data);
    hear(OCTET_COMMAND_FRAME_ID + 1, data, OCTET_COMMAND_LENGTH);
}

TEST(each_drive_answers_the_senses_before_it)
{
    const struct output out = {.has_drive = true, .drive = {.tick = 77, .left_mm_s = -5}};
    struct senses senses = {.tick = 77, .feel = 9, .look = true, .beacon_mm = 1000, .odometer_left = 4095, .bump = true};
    struct octet_senses_t told;
    struct octet_drive_t drive;
    uint8_t counter;

    telemetry_senses(&senses);
    telemetry_output(&out, false);
    (void)octet_senses_unpack(&told, last(OCTET_SENSES_FRAME_ID)->data, 8);
    (void)octet_drive_unpack(&drive, last(OCTET_DRIVE_FRAME_ID)->data, 8);
    TEST_ASSERT_TRUE(e2e_is_whole(last(OCTET_SENSES_FRAME_ID), OCTET_SENSES_LENGTH));
    TEST_ASSERT_EQUAL_UINT8(77, told.tick);
    TEST_ASSERT_EQUAL_UINT8(9, told.feel);
    TEST_ASSERT_EQUAL_UINT16(1000, told.beacon);
    TEST_ASSERT_EQUAL_UINT16(4095, told.odometer_left);
    TEST_ASSERT_TRUE(told.look && told.bump);
    TEST_ASSERT_EQUAL_UINT8(told.counter, drive.counter);
    counter = told.counter;
    telemetry_senses(&senses);
    (void)octet_senses_unpack(&told, last(OCTET_SENSES_FRAME_ID)->data, 8);
    TEST_ASSERT_EQUAL_UINT8((counter + 1) % E2E_COUNTERS, told.counter);
}

TEST(it_says_once_that_it_has_come_up)
{
    struct senses senses = {.tick = 1};
    size_t boots = 0;

    for (unsigned i = 0; i < 3; i++)
        telemetry_senses(&senses);
    for (size_t i = 0; i < said_count; i++)
        boots += said[i].id == OCTET_BOOT_FRAME_ID + 1;
    TEST_ASSERT_EQUAL_size_t(1, boots);
}

TEST(a_command_is_heard_and_answered_and_again_when_it_comes_again)
{
    const struct output out = {.has_answer = true, .answer = RESULT_DONE};

    order(OPCODE_START, 1);
    TEST_ASSERT_EQUAL_INT(INPUT_COMMAND, telemetry_receive(&in));
    TEST_ASSERT_EQUAL_INT(OPCODE_START, in.command.opcode);
    telemetry_output(&out, true);
    (void)last(OCTET_ANSWER_FRAME_ID);
    said_count = 0;
    order(OPCODE_START, 1);
    TEST_ASSERT_EQUAL_INT(INPUT_SILENCE, telemetry_receive(&in));
    (void)last(OCTET_ANSWER_FRAME_ID);
}

TEST(what_the_button_asked_for_is_not_answered_on_the_bus)
{
    const struct output out = {.has_answer = true, .answer = RESULT_DONE};

    telemetry_output(&out, false);
    TEST_ASSERT_EQUAL_size_t(0, said_count);
}

TEST(a_stop_for_a_twin_is_not_answered)
{
    const struct output out = {.has_answer = true, .answer = RESULT_DONE};
    enum input_kind kind = INPUT_SILENCE;
    uint8_t data[8] = {0};

    while (kind == INPUT_SILENCE && heard_count < ROOM) {
        hear(OCTET_DRIVE_FRAME_ID + 1, data, OCTET_DRIVE_LENGTH);
        kind = telemetry_receive(&in);
    }
    TEST_ASSERT_EQUAL_INT(INPUT_COMMAND, kind);
    TEST_ASSERT_EQUAL_INT(OPCODE_STOP, in.command.opcode);
    telemetry_output(&out, true);
    for (size_t i = 0; i < said_count; i++)
        TEST_ASSERT_NOT_EQUAL_HEX32(OCTET_ANSWER_FRAME_ID + 1, said[i].id);
}

/* Returns whether a twin stops it. */
static bool meets_a_twin(void)
{
    enum input_kind kind = INPUT_SILENCE;
    uint8_t data[8] = {0};

    for (unsigned i = 0; i < 5 && kind == INPUT_SILENCE; i++) {
        hear(OCTET_DRIVE_FRAME_ID + 1, data, OCTET_DRIVE_LENGTH);
        kind = telemetry_receive(&in);
    }
    return kind == INPUT_COMMAND;
}

TEST(a_twin_stops_it_again_once_the_button_has_started_it)
{
    const struct output stopped = {.has_answer = true, .answer = RESULT_DONE};
    const struct output started = {.has_answer = true, .answer = RESULT_DONE, .report.running = true};

    TEST_ASSERT_TRUE(meets_a_twin());
    telemetry_output(&stopped, true);
    TEST_ASSERT_FALSE(meets_a_twin());
    telemetry_output(&started, false);
    TEST_ASSERT_TRUE(meets_a_twin());
}

TEST(what_was_put_off_and_what_could_not_be_stored_is_reported)
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

TEST(senses_of_another_body_are_not_ours)
{
    uint8_t data[8] = {0};

    hear(OCTET_SENSES_FRAME_ID + 1, data, OCTET_SENSES_LENGTH);
    hear(OCTET_RANGES_FRAME_ID + 1, data, OCTET_RANGES_LENGTH);
    order(OPCODE_REPORT, 1);
    TEST_ASSERT_EQUAL_INT(INPUT_COMMAND, telemetry_receive(&in));
    TEST_ASSERT_EQUAL_INT(OPCODE_REPORT, in.command.opcode);
}

TEST(no_more_than_four_frames_are_taken_at_once)
{
    uint8_t data[8] = {0};

    for (unsigned i = 0; i < 6; i++)
        hear(OCTET_SENSES_FRAME_ID + 1, data, i == 1 ? 9 : OCTET_SENSES_LENGTH);
    TEST_ASSERT_EQUAL_INT(INPUT_SILENCE, telemetry_receive(&in));
    TEST_ASSERT_EQUAL_size_t(4, taken);
}

TEST(a_bus_that_takes_nothing_is_counted_and_holds_nobody_up)
{
    const struct output report = {.has_answer = true, .has_report = true, .whole_report = true};
    struct senses senses = {.tick = 1};
    struct octet_faults_t faults;

    result = LINK_E_FULL;
    telemetry_senses(&senses);
    result = 0;
    telemetry_output(&report, true);
    for (size_t i = 0; i < said_count; i++)
        if (said[i].id == OCTET_FAULTS_FRAME_ID + 1 && octet_faults_unpack(&faults, said[i].data, 8) == 0 && faults.page == 0)
            TEST_ASSERT_EQUAL_UINT8(1, faults.unsent);
    (void)last(OCTET_FAULTS_FRAME_ID);
}

TEST(without_a_bus_there_is_no_body)
{
    const struct port port = {.node = 2, .link = ""};

    result = LINK_E_OPEN;
    TEST_ASSERT_EQUAL_INT(HAL_E_BODY, telemetry_open(&port));
}
