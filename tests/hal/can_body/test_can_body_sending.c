/* Sending and storing, and a link that fails on plan. */
#include "fake_body.h"

TEST(it_says_that_it_has_come_up_before_anything_else)
{
    senses_come(20, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT(1, fake.sends);
    TEST_ASSERT_EQUAL_UINT32(OCTET_BOOT_FRAME_ID, fake.sent[0].id);
}

TEST(it_says_so_again_until_the_bus_is_up_and_counts_no_fault)
{
    fake.failing_send = 1;
    fake.failure = LINK_E_DOWN;
    senses_come(20, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT(2, fake.sends);
    TEST_ASSERT_EQUAL_UINT32(OCTET_BOOT_FRAME_ID, fake.sent[1].id);
    assert_faults((struct octet_faults_t){.unsent = 0});
}

TEST(a_drive_goes_out)
{
    const struct output out = {.has_drive = true};

    TEST_ASSERT_EQUAL(0, hal_send(hal, &out));
    TEST_ASSERT_EQUAL_UINT(1, fake.sends);
    TEST_ASSERT_EQUAL_UINT32(OCTET_DRIVE_FRAME_ID, fake.sent[0].id);
}

TEST(a_closed_link_takes_no_drive)
{
    const struct output out = {.has_drive = true};

    fake.closed = true;
    TEST_ASSERT_EQUAL(HAL_E_CLOSED, hal_send(hal, &out));
}

static void assert_only_frame_n_is_lost(unsigned n, int failure)
{
    const struct output out = {.has_answer = true, .has_report = true, .whole_report = true, .has_drive = true};

    setUp();
    fake.failing_send = n;
    fake.failure = failure;
    TEST_ASSERT_EQUAL(0, hal_send(hal, &out));
    TEST_ASSERT_EQUAL_UINT(FRAMES, fake.sends);
    assert_faults((struct octet_faults_t){.unsent = 1});
}

TEST(a_frame_that_the_bus_does_not_take_is_counted_and_the_rest_goes_out)
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

TEST(whenever_a_bus_is_down_for_a_while_life_goes_on)
{
    for (unsigned n = 1; n <= 25; n++)
        TEST_ASSERT_EQUAL(INPUT_SENSES, live_through(n, LINK_E_DOWN));
}

TEST(whenever_something_is_no_frame_it_is_counted_and_life_goes_on)
{
    for (unsigned n = 1; n <= 20; n++) {
        TEST_ASSERT_EQUAL(INPUT_SENSES, live_through(n, LINK_E_GARBLED));
        TEST_ASSERT_EQUAL_UINT8(1, faults().damaged);
    }
}

TEST(whenever_the_link_closes_the_robot_ends)
{
    for (unsigned n = 1; n <= 20; n++)
        TEST_ASSERT_EQUAL(HAL_E_CLOSED, live_through(n, LINK_E_CLOSED));
}

TEST(a_memory_is_loaded_and_stored_through_the_port)
{
    uint8_t memory[CELL_COUNT] = {0};

    fake.store_result = 1;
    TEST_ASSERT_EQUAL(1, hal_load(hal, memory));
    fake.store_result = 0;
    TEST_ASSERT_EQUAL(0, hal_store(hal, memory, false));
    assert_faults((struct octet_faults_t){.unsaved = 0});
}

TEST(a_memory_that_could_not_be_stored_is_counted)
{
    static const uint8_t memory[CELL_COUNT] = {0, 2};

    fake.store_result = HAL_E_STORE;
    TEST_ASSERT_EQUAL(HAL_E_STORE, hal_store(hal, memory, false));
    assert_faults((struct octet_faults_t){.unsaved = 1});
}

TEST(a_stored_memory_that_is_none_is_counted)
{
    uint8_t memory[CELL_COUNT];

    fake.store_result = HAL_E_STORE;
    TEST_ASSERT_EQUAL(HAL_E_STORE, hal_load(hal, memory));
    assert_faults((struct octet_faults_t){.unsaved = 1});
}

TEST(a_memory_never_stored_is_no_fault)
{
    uint8_t memory[CELL_COUNT];

    TEST_ASSERT_EQUAL(0, hal_load(hal, memory));
    assert_faults((struct octet_faults_t){.unsaved = 0});
}

static void store_later(void)
{
    static const uint8_t memory[CELL_COUNT] = {0, 2};

    fake.needs_rest = true;
    TEST_ASSERT_EQUAL(0, hal_store(hal, memory, false));
}

TEST(storing_that_takes_long_waits_for_a_silence)
{
    store_later();
    TEST_ASSERT_EQUAL_UINT(0, fake.stores);
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT(1, fake.stores);
    assert_faults((struct octet_faults_t){.unsaved = 0});
}

TEST(at_rest_what_takes_long_is_stored_at_once)
{
    static const uint8_t memory[CELL_COUNT] = {0, 2};

    fake.needs_rest = true;
    TEST_ASSERT_EQUAL(0, hal_store(hal, memory, true));
    TEST_ASSERT_EQUAL_UINT(1, fake.stores);
}

TEST(health_tells_of_what_was_put_off)
{
    store_later();
    (void)faults();
    TEST_ASSERT_EQUAL_UINT32(OCTET_HEALTH_FRAME_ID, fake.sent[fake.sends - 1].id);
    TEST_ASSERT_EQUAL_HEX8(1u << 6, fake.sent[fake.sends - 1].data[1] & 1u << 6);
}

TEST(what_was_put_off_is_stored_once)
{
    store_later();
    for (unsigned i = 0; i < 3; i++)
        TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT(1, fake.stores);
}

TEST(what_was_put_off_and_could_not_be_stored_is_counted)
{
    store_later();
    fake.store_result = HAL_E_STORE;
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    assert_faults((struct octet_faults_t){.unsaved = 1});
}

TEST(entropy_is_the_ports)
{
    TEST_ASSERT_EQUAL_HEX32(0xC0FFEE, hal_entropy(hal));
}
