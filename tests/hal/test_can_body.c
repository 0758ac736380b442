#include <string.h>

#include <unity.h>

#include "hal/can/crc8.h"
#include "hal/can/port.h"
#include "hal/can/wire.h"
#include "octet.h"

enum { NODE = 1, SCRIPT_MAX = 64, SENT_MAX = 256, NEVER = 0, FRAMES = WIRE_FRAMES_MAX - 1 /* no crash */ };

/* What the fake link does, in order: at a time, a result of link_receive, with a frame if that is 1. */
struct event {
    uint32_t at_ms;
    int result;
    struct frame frame;
};

/* The fake link and the fake port. Time begins at 0 and passes only while the link waits. */
static struct {
    uint32_t clock_ms;
    struct event script[SCRIPT_MAX];
    unsigned events, next;
    unsigned receives, failing_receive;   /* link_receive fails at this call, counted from 1 */
    unsigned sends, failing_send;
    int failure;
    bool closed;
    struct frame sent[SENT_MAX];
    int open_result, port_result, store_result;
    bool needs_rest;                      /* to store anything */
    unsigned stores;                      /* that were not put off */
    uint32_t alive_ms, longest_wait_ms;   /* without a sign of life */
    uint16_t ids[WIRE_LISTEN_COUNT];
} fake;

static struct hal *hal;
static struct input in;

/* ---- the fake port */

int port_open(struct port *port, int argc, char *const argv[])
{
    (void)argc;
    (void)argv;
    *port = (struct port){.link = "fake", .node = NODE};
    return fake.port_result;
}

void port_ready(const struct port *port)
{
    TEST_ASSERT_EQUAL_UINT8(NODE, port->node);
}

uint32_t port_clock_ms(void)
{
    return UINT32_MAX - 50 + fake.clock_ms;   /* wraps within each test */
}

int port_load(uint8_t memory[CELL_COUNT])
{
    memory[1] = 2;
    return fake.store_result;
}

void port_alive(bool outage)
{
    const uint32_t waited_ms = fake.clock_ms - fake.alive_ms;

    (void)outage;
    if (waited_ms > fake.longest_wait_ms)
        fake.longest_wait_ms = waited_ms;
    fake.alive_ms = fake.clock_ms;
}

int port_store(const uint8_t memory[CELL_COUNT], enum port_effort effort)
{
    TEST_ASSERT_EQUAL_UINT8(2, memory[1]);
    if (fake.needs_rest && effort == PORT_QUICKLY)
        return PORT_LATER;
    fake.stores++;
    return fake.store_result;
}

uint32_t port_entropy(void)
{
    return 0xC0FFEE;
}

/* ---- the fake link */

int link_open(struct link **link, const char *name, const uint16_t ids[], size_t id_count)
{
    TEST_ASSERT_EQUAL_STRING("fake", name);
    TEST_ASSERT_EQUAL_size_t(WIRE_LISTEN_COUNT, id_count);
    memcpy(fake.ids, ids, sizeof fake.ids);
    *link = NULL;
    return fake.open_result;
}

static int failed(uint32_t wait_ms)
{
    fake.closed = fake.failure == LINK_E_CLOSED;
    if (fake.failure == LINK_E_DOWN)
        fake.clock_ms += wait_ms;
    return fake.failure;
}

int link_receive(struct link *link, struct frame *out, uint32_t wait_ms)
{
    const struct event *event = &fake.script[fake.next];

    (void)link;
    fake.receives++;
    if (fake.closed)
        return LINK_E_CLOSED;
    if (fake.receives == fake.failing_receive)
        return failed(wait_ms);
    if (fake.next == fake.events || (int32_t)(event->at_ms - fake.clock_ms) > (int32_t)wait_ms) {
        fake.clock_ms += wait_ms;
        return 0;
    }
    fake.next++;
    if ((int32_t)(event->at_ms - fake.clock_ms) > 0)
        fake.clock_ms = event->at_ms;
    *out = event->frame;
    return event->result;
}

int link_send(struct link *link, const struct frame *frame)
{
    (void)link;
    if (fake.closed)
        return LINK_E_CLOSED;
    if (fake.sends + 1 == fake.failing_send) {
        fake.sends++;
        return failed(0);
    }
    TEST_ASSERT_LESS_THAN_UINT(SENT_MAX, fake.sends);
    fake.sent[fake.sends++] = *frame;
    return 0;
}

void link_health(const struct link *link, struct link_health *out)
{
    (void)link;
    *out = (struct link_health){.state = BUS_ACTIVE};
}

/* ---- what the tests say */

static int open_body(void)
{
    return hal_open(&hal, 0, NULL);
}

void setUp(void)
{
    memset(&fake, 0, sizeof fake);
    TEST_ASSERT_EQUAL(0, open_body());
}

void tearDown(void) {}

static void happens(uint32_t at_ms, int result, struct frame frame)
{
    TEST_ASSERT_LESS_THAN_UINT(SCRIPT_MAX, fake.events);
    fake.script[fake.events++] = (struct event){.at_ms = at_ms, .result = result, .frame = frame};
}

static struct frame sealed(struct frame frame)
{
    frame.data[0] = crc8_of_frame(&frame);
    return frame;
}

static void senses_come(uint32_t at_ms, uint16_t tick)
{
    const struct octet_senses_t senses = {.tick = tick};
    struct frame frame = {.id = OCTET_SENSES_FRAME_ID, .len = OCTET_SENSES_LENGTH};

    octet_senses_pack(frame.data, &senses, sizeof frame.data);
    happens(at_ms, 1, sealed(frame));
}

static void command_comes(uint32_t at_ms, struct octet_command_t command)
{
    struct frame frame = {.id = OCTET_COMMAND_FRAME_ID, .len = OCTET_COMMAND_LENGTH};

    octet_command_pack(frame.data, &command, sizeof frame.data);
    happens(at_ms, 1, sealed(frame));
}

static void noise_comes(uint32_t at_ms)
{
    happens(at_ms, 1, (struct frame){.id = 0x7FF});
}

static int receive(void)
{
    return hal_receive(hal, &in);
}

/* What the robot itself reports of its faults, with nothing failing any more. */
static struct octet_faults_t faults(void)
{
    const struct output out = {.has_report = true};
    struct octet_faults_t reported;

    fake.failing_send = NEVER;
    TEST_ASSERT_EQUAL(0, hal_send(hal, &out));
    TEST_ASSERT_EQUAL(0, octet_faults_unpack(&reported, fake.sent[fake.sends - 1].data, OCTET_FAULTS_LENGTH));
    return reported;
}

static void assert_faults(struct octet_faults_t expected)
{
    const struct octet_faults_t actual = faults();

    TEST_ASSERT_EQUAL_MEMORY(&expected, &actual, sizeof actual);
}

static void test_it_listens_for_senses_and_commands_only(void)
{
    TEST_ASSERT_EQUAL_UINT16(OCTET_SENSES_FRAME_ID, fake.ids[0]);
    TEST_ASSERT_EQUAL_UINT16(OCTET_COMMAND_FRAME_ID, fake.ids[1]);
}

static void test_arguments_that_make_no_sense_are_a_usage_error(void)
{
    fake.port_result = HAL_E_USAGE;
    TEST_ASSERT_EQUAL(HAL_E_USAGE, open_body());
}

static void test_a_link_name_that_makes_no_sense_is_a_usage_error(void)
{
    fake.open_result = LINK_E_NAME;
    TEST_ASSERT_EQUAL(HAL_E_USAGE, open_body());
}

static void test_a_link_that_cannot_be_opened_is_no_body(void)
{
    fake.open_result = LINK_E_OPEN;
    TEST_ASSERT_EQUAL(HAL_E_BODY, open_body());
}

static void test_a_body_that_did_not_open_is_not_given_out(void)
{
    struct hal *untouched = NULL;

    fake.open_result = LINK_E_OPEN;
    (void)hal_open(&untouched, 0, NULL);
    TEST_ASSERT_NULL(untouched);
}

static void test_senses_are_received_when_they_come(void)
{
    senses_come(20, 7);
    TEST_ASSERT_EQUAL(HAL_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(7, in.senses.tick);
    TEST_ASSERT_EQUAL_UINT32(20, fake.clock_ms);
}

static void test_senses_and_commands_are_received_in_their_order(void)
{
    senses_come(20, 0);
    command_comes(20, (struct octet_command_t){.opcode = OPCODE_ERASE});
    senses_come(20, 1);
    TEST_ASSERT_EQUAL(HAL_SENSES, receive());
    TEST_ASSERT_EQUAL(HAL_COMMAND, receive());
    TEST_ASSERT_EQUAL(HAL_SENSES, receive());
}

static void test_silence_is_100_ms_without_senses(void)
{
    senses_come(20, 0);
    receive();
    TEST_ASSERT_EQUAL(HAL_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(120, fake.clock_ms);
    assert_faults((struct octet_faults_t){.silences = 1});
}

static void test_senses_after_99_ms_are_no_silence(void)
{
    senses_come(99, 0);
    TEST_ASSERT_EQUAL(HAL_SENSES, receive());
}

static void test_silence_is_said_again_every_100_ms(void)
{
    for (uint32_t i = 1; i <= 10; i++) {
        TEST_ASSERT_EQUAL(HAL_SILENCE, receive());
        TEST_ASSERT_EQUAL_UINT32(100 * i, fake.clock_ms);
    }
}

static void test_noise_does_not_break_the_silence(void)
{
    for (uint32_t at_ms = 10; at_ms <= 190; at_ms += 10)
        noise_comes(at_ms);
    TEST_ASSERT_EQUAL(HAL_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(100, fake.clock_ms);
}

static void test_stale_senses_do_not_break_the_silence(void)
{
    senses_come(0, 5);
    senses_come(50, 5);
    receive();
    TEST_ASSERT_EQUAL(HAL_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(100, fake.clock_ms);
    assert_faults((struct octet_faults_t){.silences = 1, .stale = 1});
}

static void test_a_command_does_not_break_the_silence(void)
{
    command_comes(60, (struct octet_command_t){.opcode = OPCODE_ERASE});
    TEST_ASSERT_EQUAL(HAL_COMMAND, receive());
    TEST_ASSERT_EQUAL(HAL_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(100, fake.clock_ms);
}

static void test_in_lockstep_silence_is_10_s(void)
{
    command_comes(0, (struct octet_command_t){.opcode = OPCODE_START, .lockstep = 1});
    receive();
    TEST_ASSERT_EQUAL(HAL_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(10000, fake.clock_ms);
}

static void test_after_an_outage_only_the_newest_senses_count(void)
{
    TEST_ASSERT_EQUAL(HAL_SILENCE, receive());
    for (uint16_t tick = 0; tick < 30; tick++)
        senses_come(150, tick);
    TEST_ASSERT_EQUAL(HAL_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(29, in.senses.tick);
    assert_faults((struct octet_faults_t){.stale = 29});
}

static void test_noise_among_what_queued_up_is_passed_over(void)
{
    TEST_ASSERT_EQUAL(HAL_SILENCE, receive());
    senses_come(150, 0);
    noise_comes(150);
    happens(150, LINK_E_GARBLED, (struct frame){.len = 0});
    senses_come(150, 1);
    TEST_ASSERT_EQUAL(HAL_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(1, in.senses.tick);
    assert_faults((struct octet_faults_t){.stale = 1, .foreign = 1, .damaged = 1});
}

static void test_without_an_outage_nothing_is_passed_over(void)
{
    for (uint16_t tick = 0; tick < 30; tick++)
        senses_come(20, tick);
    for (uint16_t tick = 0; tick < 30; tick++) {
        TEST_ASSERT_EQUAL(HAL_SENSES, receive());
        TEST_ASSERT_EQUAL_UINT16(tick, in.senses.tick);
    }
}

static void test_after_an_outage_a_queued_command_comes_first(void)
{
    TEST_ASSERT_EQUAL(HAL_SILENCE, receive());
    senses_come(150, 0);
    command_comes(150, (struct octet_command_t){.opcode = OPCODE_ERASE});
    senses_come(150, 1);
    senses_come(150, 2);
    TEST_ASSERT_EQUAL(HAL_COMMAND, receive());
    TEST_ASSERT_EQUAL(HAL_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(2, in.senses.tick);
    assert_faults((struct octet_faults_t){.stale = 2});
}

static void test_senses_that_a_queued_command_outdates_do_not_end_the_outage(void)
{
    TEST_ASSERT_EQUAL(HAL_SILENCE, receive());
    senses_come(150, 0);
    command_comes(150, (struct octet_command_t){.opcode = OPCODE_ERASE});
    TEST_ASSERT_EQUAL(HAL_COMMAND, receive());
    TEST_ASSERT_EQUAL(HAL_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(200, fake.clock_ms);
}

static void test_a_body_opened_again_has_no_outage(void)
{
    TEST_ASSERT_EQUAL(HAL_SILENCE, receive());
    TEST_ASSERT_EQUAL(0, open_body());
    senses_come(150, 0);
    senses_come(150, 1);
    TEST_ASSERT_EQUAL(HAL_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(0, in.senses.tick);
}

static void test_an_outage_ends_with_its_first_senses(void)
{
    TEST_ASSERT_EQUAL(HAL_SILENCE, receive());
    senses_come(150, 0);
    senses_come(170, 1);
    senses_come(170, 2);
    TEST_ASSERT_EQUAL(HAL_SENSES, receive());
    TEST_ASSERT_EQUAL(HAL_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(1, in.senses.tick);
}

static void test_a_robot_that_was_held_up_itself_takes_the_newest_senses(void)
{
    senses_come(0, 0);
    TEST_ASSERT_EQUAL(HAL_SENSES, receive());
    for (uint16_t tick = 1; tick <= 7; tick++)
        senses_come(20u * tick, tick);
    fake.clock_ms += 150;
    TEST_ASSERT_EQUAL(HAL_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(7, in.senses.tick);
    assert_faults((struct octet_faults_t){.silences = 1, .stale = 6});
}

static void test_a_long_wait_gives_signs_of_life(void)
{
    command_comes(0, (struct octet_command_t){.opcode = OPCODE_START, .lockstep = 1});
    receive();
    TEST_ASSERT_EQUAL(HAL_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(10000 - HAL_SILENCE_MS, fake.alive_ms);
    TEST_ASSERT_EQUAL_UINT32(HAL_SILENCE_MS, fake.longest_wait_ms);
}

static void test_a_bus_that_is_down_is_silence(void)
{
    fake.failing_receive = 1;
    fake.failure = LINK_E_DOWN;
    TEST_ASSERT_EQUAL(HAL_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(100, fake.clock_ms);
}

static void test_what_is_no_frame_is_counted_as_damaged(void)
{
    happens(10, LINK_E_GARBLED, (struct frame){.len = 0});
    senses_come(20, 0);
    TEST_ASSERT_EQUAL(HAL_SENSES, receive());
    assert_faults((struct octet_faults_t){.damaged = 1});
}

static void test_a_closed_link_ends_the_robot(void)
{
    fake.closed = true;
    TEST_ASSERT_EQUAL(HAL_E_CLOSED, receive());
}

static void test_a_drive_goes_out(void)
{
    const struct output out = {.has_drive = true};

    TEST_ASSERT_EQUAL(0, hal_send(hal, &out));
    TEST_ASSERT_EQUAL_UINT(1, fake.sends);
    TEST_ASSERT_EQUAL_UINT32(OCTET_DRIVE_FRAME_ID, fake.sent[0].id);
}

static void test_a_closed_link_takes_no_drive(void)
{
    const struct output out = {.has_drive = true};

    fake.closed = true;
    TEST_ASSERT_EQUAL(HAL_E_CLOSED, hal_send(hal, &out));
}

static void assert_only_frame_n_is_lost(unsigned n, int failure)
{
    const struct output out = {.has_answer = true, .has_report = true, .has_memory = true, .has_drive = true};

    setUp();
    fake.failing_send = n;
    fake.failure = failure;
    TEST_ASSERT_EQUAL(0, hal_send(hal, &out));
    TEST_ASSERT_EQUAL_UINT(FRAMES, fake.sends);
    assert_faults((struct octet_faults_t){.unsent = 1});
}

static void test_a_frame_that_the_bus_does_not_take_is_counted_and_the_rest_goes_out(void)
{
    for (unsigned n = 1; n <= FRAMES; n++) {
        assert_only_frame_n_is_lost(n, LINK_E_FULL);
        assert_only_frame_n_is_lost(n, LINK_E_DOWN);
    }
}

/* Twenty ticks with an outage in the middle, and a failure at the n-th look at the link. */
static int live_through(unsigned n, int failure)
{
    int result = 0;

    setUp();
    fake.failing_receive = n;
    fake.failure = failure;
    for (uint16_t tick = 0; tick < 20; tick++)
        senses_come(20u * tick + (tick < 10 ? 0 : 300), tick);
    while (result >= 0 && fake.next < fake.events)
        result = receive();
    return result;
}

static void test_whenever_a_bus_is_down_for_a_while_life_goes_on(void)
{
    for (unsigned n = 1; n <= 25; n++)
        TEST_ASSERT_EQUAL(HAL_SENSES, live_through(n, LINK_E_DOWN));
}

static void test_whenever_something_is_no_frame_it_is_counted_and_life_goes_on(void)
{
    for (unsigned n = 1; n <= 20; n++) {
        TEST_ASSERT_EQUAL(HAL_SENSES, live_through(n, LINK_E_GARBLED));
        TEST_ASSERT_EQUAL_UINT8(1, faults().damaged);
    }
}

static void test_whenever_the_link_closes_the_robot_ends(void)
{
    for (unsigned n = 1; n <= 20; n++)
        TEST_ASSERT_EQUAL(HAL_E_CLOSED, live_through(n, LINK_E_CLOSED));
}

static void test_a_memory_is_loaded_and_stored_through_the_port(void)
{
    uint8_t memory[CELL_COUNT] = {0};

    fake.store_result = 1;
    TEST_ASSERT_EQUAL(1, hal_load(hal, memory));
    fake.store_result = 0;
    TEST_ASSERT_EQUAL(0, hal_store(hal, memory));
    assert_faults((struct octet_faults_t){.unsaved = 0});
}

static void test_a_memory_that_could_not_be_stored_is_counted(void)
{
    static const uint8_t memory[CELL_COUNT] = {0, 2};

    fake.store_result = HAL_E_STORE;
    TEST_ASSERT_EQUAL(HAL_E_STORE, hal_store(hal, memory));
    assert_faults((struct octet_faults_t){.unsaved = 1});
}

static void test_a_stored_memory_that_is_none_is_counted(void)
{
    uint8_t memory[CELL_COUNT];

    fake.store_result = HAL_E_STORE;
    TEST_ASSERT_EQUAL(HAL_E_STORE, hal_load(hal, memory));
    assert_faults((struct octet_faults_t){.unsaved = 1});
}

static void test_a_memory_never_stored_is_no_fault(void)
{
    uint8_t memory[CELL_COUNT];

    TEST_ASSERT_EQUAL(0, hal_load(hal, memory));
    assert_faults((struct octet_faults_t){.unsaved = 0});
}

static void store_later(void)
{
    static const uint8_t memory[CELL_COUNT] = {0, 2};

    fake.needs_rest = true;
    TEST_ASSERT_EQUAL(0, hal_store(hal, memory));
}

static void test_storing_that_takes_long_waits_for_a_silence(void)
{
    store_later();
    TEST_ASSERT_EQUAL_UINT(0, fake.stores);
    TEST_ASSERT_EQUAL(HAL_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT(1, fake.stores);
    assert_faults((struct octet_faults_t){.unsaved = 0});
}

static void test_what_was_put_off_is_stored_once(void)
{
    store_later();
    for (unsigned i = 0; i < 3; i++)
        TEST_ASSERT_EQUAL(HAL_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT(1, fake.stores);
}

static void test_what_was_put_off_and_could_not_be_stored_is_counted(void)
{
    store_later();
    fake.store_result = HAL_E_STORE;
    TEST_ASSERT_EQUAL(HAL_SILENCE, receive());
    assert_faults((struct octet_faults_t){.unsaved = 1});
}

static void test_entropy_is_the_ports(void)
{
    TEST_ASSERT_EQUAL_HEX32(0xC0FFEE, hal_entropy(hal));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_it_listens_for_senses_and_commands_only);
    RUN_TEST(test_arguments_that_make_no_sense_are_a_usage_error);
    RUN_TEST(test_a_link_name_that_makes_no_sense_is_a_usage_error);
    RUN_TEST(test_a_link_that_cannot_be_opened_is_no_body);
    RUN_TEST(test_a_body_that_did_not_open_is_not_given_out);
    RUN_TEST(test_senses_are_received_when_they_come);
    RUN_TEST(test_senses_and_commands_are_received_in_their_order);
    RUN_TEST(test_silence_is_100_ms_without_senses);
    RUN_TEST(test_senses_after_99_ms_are_no_silence);
    RUN_TEST(test_silence_is_said_again_every_100_ms);
    RUN_TEST(test_noise_does_not_break_the_silence);
    RUN_TEST(test_stale_senses_do_not_break_the_silence);
    RUN_TEST(test_a_command_does_not_break_the_silence);
    RUN_TEST(test_in_lockstep_silence_is_10_s);
    RUN_TEST(test_after_an_outage_only_the_newest_senses_count);
    RUN_TEST(test_noise_among_what_queued_up_is_passed_over);
    RUN_TEST(test_without_an_outage_nothing_is_passed_over);
    RUN_TEST(test_after_an_outage_a_queued_command_comes_first);
    RUN_TEST(test_senses_that_a_queued_command_outdates_do_not_end_the_outage);
    RUN_TEST(test_a_body_opened_again_has_no_outage);
    RUN_TEST(test_an_outage_ends_with_its_first_senses);
    RUN_TEST(test_a_robot_that_was_held_up_itself_takes_the_newest_senses);
    RUN_TEST(test_a_long_wait_gives_signs_of_life);
    RUN_TEST(test_a_bus_that_is_down_is_silence);
    RUN_TEST(test_what_is_no_frame_is_counted_as_damaged);
    RUN_TEST(test_a_closed_link_ends_the_robot);
    RUN_TEST(test_a_drive_goes_out);
    RUN_TEST(test_a_closed_link_takes_no_drive);
    RUN_TEST(test_a_frame_that_the_bus_does_not_take_is_counted_and_the_rest_goes_out);
    RUN_TEST(test_whenever_a_bus_is_down_for_a_while_life_goes_on);
    RUN_TEST(test_whenever_something_is_no_frame_it_is_counted_and_life_goes_on);
    RUN_TEST(test_whenever_the_link_closes_the_robot_ends);
    RUN_TEST(test_a_memory_is_loaded_and_stored_through_the_port);
    RUN_TEST(test_a_memory_that_could_not_be_stored_is_counted);
    RUN_TEST(test_a_stored_memory_that_is_none_is_counted);
    RUN_TEST(test_a_memory_never_stored_is_no_fault);
    RUN_TEST(test_storing_that_takes_long_waits_for_a_silence);
    RUN_TEST(test_what_was_put_off_is_stored_once);
    RUN_TEST(test_what_was_put_off_and_could_not_be_stored_is_counted);
    RUN_TEST(test_entropy_is_the_ports);
    return UNITY_END();
}
