/* What the body tells of the machine that it runs on, and of the bus. */
#include "fake_body.h"

#include <stddef.h>

static const struct output REPORT = {.has_report = true, .whole_report = true};

static void report_anew(void)
{
    TEST_ASSERT_EQUAL(0, open_body());
    TEST_ASSERT_EQUAL(0, hal_send(hal, &REPORT));
}

/* The last frame with this identifier. */
static const uint8_t *told_in(uint32_t id)
{
    for (unsigned i = fake.sends; i-- > 0;)
        if (fake.sent[i].id == id)
            return fake.sent[i].data;
    TEST_FAIL_MESSAGE("it was not sent");
    return NULL;
}

TEST(the_machine_hears_that_the_link_is_open)
{
    TEST_ASSERT_EQUAL_UINT(1, fake.readies);
    fake.open_result = LINK_E_OPEN;
    (void)open_body();
    TEST_ASSERT_EQUAL_UINT(1, fake.readies);
}

TEST(it_tells_why_the_machine_has_started)
{
    struct octet_boot_t boot;

    fake.reset_cause = RESET_WATCHDOG;
    report_anew();
    TEST_ASSERT_EQUAL(0, octet_boot_unpack(&boot, told_in(OCTET_BOOT_FRAME_ID), OCTET_BOOT_LENGTH));
    TEST_ASSERT_EQUAL_UINT8(RESET_WATCHDOG, boot.reset_cause);
}

TEST(it_tells_of_the_machines_last_crash)
{
    static const struct crash crash = {.cause = 3, .count = 1, .values = {0x12345678}};
    struct octet_crash_t told;

    fake.crash = &crash;
    report_anew();
    TEST_ASSERT_EQUAL(0, octet_crash_unpack(&told, told_in(OCTET_CRASH_FRAME_ID), OCTET_CRASH_LENGTH));
    TEST_ASSERT_EQUAL_HEX32(0x12345678, told.value);
}

static struct octet_health_t health(void)
{
    struct octet_health_t told;

    report_anew();
    TEST_ASSERT_EQUAL(0, octet_health_unpack(&told, told_in(OCTET_HEALTH_FRAME_ID), OCTET_HEALTH_LENGTH));
    return told;
}

TEST(it_tells_whether_the_clock_is_exact)
{
    TEST_ASSERT_EQUAL_UINT8(0, health().clock);
    fake.clock_exact = true;
    TEST_ASSERT_EQUAL_UINT8(1, health().clock);
}

TEST(it_tells_how_the_bus_is)
{
    fake.bus = (struct link_health){.state = BUS_PASSIVE, .tx_errors = 130, .rx_errors = 7};
    TEST_ASSERT_EQUAL_UINT8(BUS_PASSIVE, health().bus_state);
    TEST_ASSERT_EQUAL_UINT8(130, health().tx_errors);
    TEST_ASSERT_EQUAL_UINT8(7, health().rx_errors);
}

TEST(the_bus_is_looked_at_for_a_report_only)
{
    static const struct output drive = {.has_drive = true};

    TEST_ASSERT_EQUAL(0, hal_send(hal, &drive));
    TEST_ASSERT_EQUAL_UINT(0, fake.looks_at_health);
    TEST_ASSERT_EQUAL(0, hal_send(hal, &REPORT));
    TEST_ASSERT_EQUAL_UINT(1, fake.looks_at_health);
}

TEST(every_byte_that_was_put_off_is_stored)
{
    static const uint8_t memory[CELL_COUNT] = {0x0F, 2, 3, 4, 5, 6, 7, 8};

    fake.needs_rest = true;
    TEST_ASSERT_EQUAL(0, hal_store(hal, memory, false));
    TEST_ASSERT_EQUAL(INPUT_SILENCE, hal_receive(hal, &in));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(memory, fake.stored, CELL_COUNT);
}
