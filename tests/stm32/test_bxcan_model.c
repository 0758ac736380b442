/* The model of bxCAN against the reference manuals: what drivers are tested on must be right itself. */
#include <string.h>

#include <unity.h>

#include "host_sim/emulator/models/bxcan_model.h"

enum {
    MCR = 0x00, MSR = 0x04, TSR = 0x08, RF0R = 0x0C, RF1R = 0x10, IER = 0x14, ESR = 0x18, BTR = 0x1C,
    OUTPUT_0 = 0x1B0, FMR = 0x200, FM1R = 0x204, FS1R = 0x20C, FFA1R = 0x214, FA1R = 0x21C, BANK_0 = 0x240,
    INRQ = 1, TXFP = 4, RFLM = 8, NART = 0x10, ABOM = 0x40, INAK = 1, SLAK = 2,
    RQCP = 1, TXOK = 2, ALST = 4, TERR = 8, ABRQ = 0x80, TME_ALL = 7 << 26,
    FULL = 8, FOVR = 0x10, RFOM = 0x20, EWGF = 1, EPVF = 2, BOFF = 4,
    CLOCK_HZ = 42000000, BIT_TIMING = 9 << 16 | 2 << 20 | 5,   /* 42 MHz / 6 / (1 + 10 + 3) quanta */
    ERROR_US = 80, RECOVERY_US = 128 * 22
};

static struct can_wire wire;
static struct bxcan can, other;

static uint32_t read(uint32_t offset)
{
    int64_t value = bxcan_read(&can, offset);

    TEST_ASSERT_TRUE_MESSAGE(value >= 0, can.refusal);
    return (uint32_t)value;
}

static void write(uint32_t offset, uint32_t value)
{
    TEST_ASSERT_TRUE_MESSAGE(bxcan_write(&can, offset, value), can.refusal);
}

static void pass_us(uint32_t us)
{
    uint64_t end = wire.now_ns + 1000u * (uint64_t)us, next;

    while ((next = wire_advance(&wire, wire.now_ns)) < end)
        (void)wire_advance(&wire, next);
    (void)wire_advance(&wire, end);
}

static void enter_init(struct bxcan *node)
{
    TEST_ASSERT_TRUE(bxcan_write(node, MCR, INRQ));
    pass_us(30);
}

/* From init with open filters to the bus. */
static void join(struct bxcan *node, uint32_t mcr)
{
    enter_init(node);
    node->clock_hz = CLOCK_HZ;
    TEST_ASSERT_TRUE(bxcan_write(node, BTR, BIT_TIMING));
    TEST_ASSERT_TRUE(bxcan_write(node, FS1R, 1));
    TEST_ASSERT_TRUE(bxcan_write(node, BANK_0, 0) && bxcan_write(node, BANK_0 + 4, 0));
    TEST_ASSERT_TRUE(bxcan_write(node, FA1R, 1) && bxcan_write(node, FMR, 0));
    TEST_ASSERT_TRUE(bxcan_write(node, MCR, mcr));
    pass_us(30);
}

static void rejoin(uint32_t mcr)
{
    wire_open(&wire);
    bxcan_open(&can, &wire, 14);
    join(&can, mcr);
}

void setUp(void)
{
    rejoin(TXFP);
}

void tearDown(void) {}

static void request_from(struct bxcan *node, uint32_t mailbox, uint32_t id)
{
    uint32_t base = 0x180 + 0x10 * mailbox;

    TEST_ASSERT_TRUE(bxcan_write(node, base + 0x4, 8) && bxcan_write(node, base + 0x8, 0x04030201));
    TEST_ASSERT_TRUE(bxcan_write(node, base + 0xC, mailbox) && bxcan_write(node, base, id << 21 | 1));
}

static void request(uint32_t mailbox, uint32_t id)
{
    request_from(&can, mailbox, id);
}

static void bring(uint32_t id)
{
    TEST_ASSERT_TRUE(wire_put(&wire, &(struct frame){.id = id}));
    pass_us(300);
}

static uint32_t take(void)
{
    uint32_t id = read(OUTPUT_0) >> 21;

    write(RF0R, RFOM);
    return id;
}

static void assert_heard(unsigned count, const uint32_t ids[])
{
    TEST_ASSERT_EQUAL_UINT(count, wire.heard.count);
    for (unsigned i = 0; i < count; i++)
        TEST_ASSERT_EQUAL_HEX32(ids[i], wire.heard.frames[i].id);
}

#define ASSERT_HEARD(...) \
    assert_heard(sizeof((uint32_t[]){__VA_ARGS__}) / sizeof(uint32_t), (const uint32_t[]){__VA_ARGS__})
#define ASSERT_REFUSED(REASON, ACCESS)                                                                                 \
    do {                                                                                                               \
        can.refusal[0] = '\0';                                                                                         \
        (void)(ACCESS);                                                                                                \
        TEST_ASSERT_NOT_NULL_MESSAGE(strstr(can.refusal, REASON), can.refusal);                                        \
    } while (0)

/* ---- modes */

static void test_it_sleeps_after_a_reset_with_garbage_in_its_mailboxes(void)
{
    bxcan_reset(&can);
    TEST_ASSERT_EQUAL_HEX32(SLAK, read(MSR) & (INAK | SLAK));
    TEST_ASSERT_EQUAL_HEX32(0xA5A5A5A4, read(0x180));
    TEST_ASSERT_EQUAL_HEX32(0xA5A5A5A5, read(0x184));
}

static void test_init_is_acknowledged_but_not_at_once(void)
{
    write(MCR, INRQ);
    TEST_ASSERT_EQUAL_HEX32(0, read(MSR) & INAK);
    pass_us(30);
    TEST_ASSERT_EQUAL_HEX32(INAK, read(MSR) & (INAK | SLAK));
}

static void test_init_can_be_asked_for_in_vain(void)
{
    can.init_stuck = true;
    write(MCR, INRQ);
    pass_us(1000000);
    TEST_ASSERT_EQUAL_HEX32(0, read(MSR) & INAK);
}

static void test_it_joins_the_bus_eleven_bits_after_init(void)
{
    enter_init(&can);
    write(MCR, TXFP);
    pass_us(21);
    TEST_ASSERT_EQUAL_HEX32(INAK, read(MSR) & INAK);
    pass_us(2);
    TEST_ASSERT_EQUAL_HEX32(0, read(MSR) & INAK);
}

static void test_it_neither_sends_on_a_bus_that_is_never_idle_nor_joins_it(void)
{
    wire.busy = true;
    request(0, 0x81);
    pass_us(1000);
    TEST_ASSERT_EQUAL_UINT(0, wire.heard.count);
    enter_init(&can);
    write(MCR, TXFP);
    pass_us(100000);
    TEST_ASSERT_EQUAL_HEX32(INAK, read(MSR) & INAK);
}

static void test_another_speed_than_the_bus_is_refused(void)
{
    enter_init(&can);
    write(BTR, BIT_TIMING + 1);
    write(MCR, 0);
    ASSERT_REFUSED("428571 bit/s", wire_advance(&wire, wire.now_ns + 30000));
}

static void test_bit_timing_can_be_written_in_init_only(void)
{
    ASSERT_REFUSED("BTR", bxcan_write(&can, BTR, BIT_TIMING));
}

static void test_asking_for_the_mode_that_is_changes_nothing(void)
{
    can.bus_off = true;
    write(MCR, TXFP | RFLM);
    pass_us(30 + RECOVERY_US);
    TEST_ASSERT_EQUAL_HEX32(0, read(MSR) & (INAK | SLAK));
    TEST_ASSERT_EQUAL_HEX32(BOFF, read(ESR) & BOFF);
}

static void test_a_master_reset_empties_everything_and_sleeps(void)
{
    wire.shorted = true;
    request(0, 0x81);
    pass_us(100);
    write(MCR, 1 << 15);
    TEST_ASSERT_EQUAL_HEX32(0x00010002, read(MCR));
    TEST_ASSERT_EQUAL_HEX32(SLAK, read(MSR) & SLAK);
    TEST_ASSERT_EQUAL_HEX32(0, read(ESR));
    TEST_ASSERT_EQUAL_HEX32(TME_ALL, read(TSR) & TME_ALL);
}

static void test_what_is_not_modelled_is_refused(void)
{
    enter_init(&can);
    ASSERT_REFUSED("interrupts", bxcan_write(&can, IER, 1));
    ASSERT_REFUSED("loop back", bxcan_write(&can, BTR, 1u << 30));
    ASSERT_REFUSED("no register at 0x020", bxcan_read(&can, 0x20));
    ASSERT_REFUSED("no register at 0x208", bxcan_write(&can, 0x208, 0));
}

/* ---- sending */

static void test_a_frame_takes_its_bits_to_leave(void)
{
    const uint8_t data[] = {1, 2, 3, 4, 0, 0, 0, 0};

    request(0, 0x81);
    pass_us(221);
    TEST_ASSERT_EQUAL_UINT(0, wire.heard.count);
    pass_us(1);
    ASSERT_HEARD(0x81);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(data, wire.heard.frames[0].data, 8);
}

static void test_what_became_of_a_frame_is_cleared_by_writing_ones(void)
{
    request(1, 0x81);
    pass_us(300);
    write(TSR, 0);
    TEST_ASSERT_EQUAL_HEX32(RQCP | TXOK, read(TSR) >> 8 & 0xFF);
    write(TSR, RQCP << 8);
    TEST_ASSERT_EQUAL_HEX32(0, read(TSR) >> 8 & 0xFF);
    request(1, 0x81);
    pass_us(300);
    request(1, 0x81);
    TEST_ASSERT_EQUAL_HEX32(0, read(TSR) >> 8 & 0xFF);   /* a new request clears them too */
}

static void request_three(uint32_t mcr)
{
    rejoin(mcr);
    request(2, 0x300);
    request(0, 0x200);
    request(1, 0x100);
}

static void test_mailboxes_leave_in_the_order_of_request_with_txfp(void)
{
    request_three(TXFP);
    pass_us(1000);
    ASSERT_HEARD(0x300, 0x200, 0x100);
}

static void test_the_lowest_identifier_leaves_first_without_txfp(void)
{
    request_three(0);
    pass_us(1000);
    ASSERT_HEARD(0x100, 0x200, 0x300);
}

static void test_equal_identifiers_leave_by_mailbox_number_without_txfp(void)
{
    rejoin(0);
    for (uint32_t n = 3; n-- > 0;)
        request(n, 0x100);
    pass_us(1000);
    for (uint8_t n = 0; n < 3; n++)
        TEST_ASSERT_EQUAL_UINT8(n, wire.heard.frames[n].data[4]);
}

static void test_the_status_names_a_free_mailbox_or_the_one_to_leave_last(void)
{
    request(0, 0x81);
    TEST_ASSERT_EQUAL_HEX32(6u << 26 | 1u << 24, read(TSR));
    request(1, 0x82);
    request(2, 0x80);
    TEST_ASSERT_EQUAL_HEX32(4u << 29 | 2u << 24, read(TSR));
    pass_us(1000);
    TEST_ASSERT_EQUAL_HEX32(TME_ALL, read(TSR) & 0xFF000000u);
}

static void test_a_pending_mailbox_must_not_be_written(void)
{
    request(0, 0x81);
    ASSERT_REFUSED("mailbox 0", bxcan_write(&can, 0x184, 1));
}

static void test_a_request_is_given_up_unless_it_is_on_the_wire(void)
{
    request(0, 0x81);
    request(1, 0x82);
    pass_us(10);
    write(TSR, ABRQ | ABRQ << 8);
    TEST_ASSERT_EQUAL_HEX32(RQCP << 8, read(TSR) & 0xFFFF);
    pass_us(1000);
    ASSERT_HEARD(0x81);
    TEST_ASSERT_EQUAL_HEX32((RQCP | TXOK) | RQCP << 8, read(TSR) & 0xFFFF);
}

static void test_a_stuck_mailbox_neither_sends_nor_gives_up(void)
{
    can.stuck_mailboxes = 1;
    request(0, 0x81);
    request(1, 0x82);
    write(TSR, ABRQ);
    pass_us(1000);
    ASSERT_HEARD(0x82);
    TEST_ASSERT_EQUAL_HEX32(6u << 26, read(TSR) & TME_ALL);
}

/* ---- arbitration */

static void test_the_lower_identifier_wins_the_bus(void)
{
    (void)wire_put(&wire, &(struct frame){.id = 0x100});
    request(0, 0x81);
    request(1, 0x200);
    pass_us(230);   /* 0x81 has left, and 0x100 is on the wire */
    ASSERT_HEARD(0x81);
    TEST_ASSERT_EQUAL_HEX32(0, read(RF0R) & 3);
    pass_us(100);
    TEST_ASSERT_EQUAL_HEX32(0x100, take());
    pass_us(300);
    ASSERT_HEARD(0x81, 0x200);
}

static void test_a_data_frame_goes_before_a_remote_one_and_that_before_an_extended_one(void)
{
    static const uint32_t ids[] = {FRAME_EXTENDED | 0x100 << 18, FRAME_REMOTE | 0x100, 0x101};

    for (unsigned i = 0; i < 3; i++) {
        rejoin(TXFP);
        (void)wire_put(&wire, &(struct frame){.id = ids[i]});
        request(0, 0x100);
        pass_us(222);
        ASSERT_HEARD(0x100);
    }
    rejoin(TXFP);
    (void)wire_put(&wire, &(struct frame){.id = FRAME_REMOTE | 0x100});
    write(0x184, 0);
    write(0x180, 0x100u << 21 | 4 | 1);   /* extended */
    pass_us(94);
    TEST_ASSERT_EQUAL_HEX32(1, read(RF0R));
}

static void test_a_frame_that_lost_arbitration_can_be_given_up(void)
{
    (void)wire_put(&wire, &(struct frame){.id = 0x100, .len = 8});
    request(0, 0x200);
    pass_us(50);
    write(TSR, ABRQ);
    pass_us(1000);
    TEST_ASSERT_EQUAL_UINT(0, wire.heard.count);
}

static void test_without_a_second_try_lost_arbitration_is_the_end(void)
{
    rejoin(TXFP | NART);
    (void)wire_put(&wire, &(struct frame){.id = 0x100});
    request(0, 0x200);
    pass_us(1000);
    TEST_ASSERT_EQUAL_HEX32(RQCP | ALST, read(TSR) & 0xFF);
}

static void test_the_same_frame_goes_to_the_world_first(void)
{
    (void)wire_put(&wire, &(struct frame){.id = 0x100});
    request(0, 0x100);
    pass_us(100);
    TEST_ASSERT_EQUAL_HEX32(0x100, take());
}

static void join_other(void)
{
    bxcan_open(&other, &wire, 14);
    join(&other, TXFP);
}

static void test_a_frame_that_lost_to_another_controller_can_be_given_up_at_once(void)
{
    join_other();
    request(0, 0x200);
    request_from(&other, 0, 0x100);
    pass_us(10);
    write(TSR, ABRQ);
    TEST_ASSERT_EQUAL_HEX32(RQCP, read(TSR) & 0xFF);
}

static void test_controllers_acknowledge_each_other_and_the_lower_identifier_goes_first(void)
{
    join_other();
    wire.alone = true;
    request(0, 0x200);
    request_from(&other, 0, 0x100);
    pass_us(1000);
    TEST_ASSERT_EQUAL_HEX32(0x100, take());
    TEST_ASSERT_EQUAL_HEX32(0x200u << 21, (uint32_t)bxcan_read(&other, OUTPUT_0));
    TEST_ASSERT_EQUAL_HEX32(0, read(ESR));
    TEST_ASSERT_EQUAL_UINT(0, wire.heard.count);
}

/* ---- receiving */

static void test_three_frames_wait_in_their_order(void)
{
    for (uint32_t id = 1; id <= 3; id++)
        bring(id);
    TEST_ASSERT_EQUAL_HEX32(3 | FULL, read(RF0R));
    for (uint32_t id = 1; id <= 3; id++)
        TEST_ASSERT_EQUAL_HEX32(id, take());
    TEST_ASSERT_EQUAL_HEX32(FULL, read(RF0R));   /* stays until it is cleared */
}

static void test_the_flags_of_a_fifo_are_cleared_by_writing_ones(void)
{
    for (uint32_t id = 1; id <= 4; id++)
        bring(id);
    write(RF0R, 0);
    TEST_ASSERT_EQUAL_HEX32(3 | FULL | FOVR, read(RF0R));
    write(RF0R, FOVR);
    TEST_ASSERT_EQUAL_HEX32(3 | FULL, read(RF0R));
    write(RF0R, FULL);
    TEST_ASSERT_EQUAL_HEX32(3, read(RF0R));
}

static void assert_left_of_five(uint32_t mcr, uint32_t last)
{
    rejoin(mcr);
    for (uint32_t id = 1; id <= 5; id++)
        bring(id);
    TEST_ASSERT_EQUAL_UINT(2, can.fifos[0].overruns);
    TEST_ASSERT_EQUAL_HEX32(1, take());
    TEST_ASSERT_EQUAL_HEX32(2, take());
    TEST_ASSERT_EQUAL_HEX32(last, take());
}

static void test_an_overrun_replaces_the_last_frame_unless_locked(void)
{
    assert_left_of_five(TXFP, 5);
    assert_left_of_five(TXFP | RFLM, 3);
}

static void test_a_slow_release_shows_the_frame_on(void)
{
    can.release_slow = true;
    bring(1);
    bring(2);
    TEST_ASSERT_EQUAL_HEX32(1, take());
    pass_us(99);
    TEST_ASSERT_EQUAL_HEX32(2 | RFOM, read(RF0R));
    pass_us(1);
    TEST_ASSERT_EQUAL_HEX32(1, read(RF0R));
}

static void test_an_output_mailbox_is_read_only_and_only_when_there_is_a_frame(void)
{
    ASSERT_REFUSED("FIFO 0", bxcan_read(&can, OUTPUT_0));
    ASSERT_REFUSED("read-only", bxcan_write(&can, OUTPUT_0, 0));
}

static void test_a_received_frame_reads_as_it_was_sent(void)
{
    (void)wire_put(&wire, &(struct frame){.id = FRAME_EXTENDED | 0x1ABCDEF0, .len = 5, .data = {1, 2, 3, 4, 5}});
    pass_us(213);
    TEST_ASSERT_EQUAL_HEX32(0, read(RF0R));
    pass_us(1);
    TEST_ASSERT_EQUAL_HEX32(0x1ABCDEF0u << 3 | 4, read(OUTPUT_0));
    TEST_ASSERT_EQUAL_HEX32(5, read(OUTPUT_0 + 4) & 0xF);
    TEST_ASSERT_EQUAL_HEX32(0x04030201, read(OUTPUT_0 + 8));
    TEST_ASSERT_EQUAL_HEX32(5, read(OUTPUT_0 + 12));
}

/* ---- filters */

static void test_filters_let_through_what_they_say(void)
{
    static const struct frame frames[] = {{.id = 0xC1}, {.id = FRAME_EXTENDED | 0xC1 << 18 | 5 << 15},
                                          {.id = FRAME_REMOTE | 0xC1}, {.id = 0xC2}};
    static const struct {
        uint32_t wide, list, bank[2], passes;   /* bit n: frames[n] */
    } cases[] = {
        {1, 0, {0xC1u << 21, 0x7FFu << 21}, 7},            /* any kind */
        {1, 0, {0xC1u << 21, 0x7FFu << 21 | 6}, 1},        /* data, standard */
        {1, 1, {0xC1u << 21 | 2, 0xC2u << 21}, 12},
        {0, 1, {0xC1u << 5 | 0x700u << 21, 0x700u << 5 | 0xC2u << 21}, 9},
        {0, 0, {0xC0u << 5 | 0x7FCu << 21, 0x7FFu << 5 | 0x7FFu << 21}, 15},
        {0, 1, {0xC1u << 5 | 8 | 5, 0}, 2},
        {0, 0, {8 | 8u << 16, 8 | 8u << 16}, 2},           /* extended */
        {0, 0, {0xC1u << 5 | 0xFFF8u << 16, 0x700u << 5 | 0xFFE0u << 16}, 1},
    };

    for (unsigned i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        write(FMR, 1);
        write(FS1R, cases[i].wide);
        write(FM1R, cases[i].list);
        write(BANK_0, cases[i].bank[0]);
        write(BANK_0 + 4, cases[i].bank[1]);
        write(FMR, 0);
        for (unsigned n = 0; n < 4; n++)
            TEST_ASSERT_EQUAL_INT(cases[i].passes >> n & 1 ? 0 : -1, bxcan_fifo_for(&can, &frames[n]));
    }
}

static void test_a_filter_names_its_fifo(void)
{
    write(FMR, 1);
    write(FFA1R, 1);
    write(FMR, 0);
    bring(5);
    TEST_ASSERT_EQUAL_HEX32(0, read(RF0R) & 3);
    TEST_ASSERT_EQUAL_HEX32(1, read(RF1R) & 3);
}

static void test_nothing_passes_without_an_active_filter_or_while_they_are_set_up(void)
{
    write(FA1R, 0);
    bring(5);
    write(FMR, 1);
    write(FA1R, 1);
    bring(5);
    TEST_ASSERT_EQUAL_HEX32(0, read(RF0R) & 3);
}

static void test_filters_in_use_must_not_be_changed(void)
{
    ASSERT_REFUSED("F0R1", bxcan_write(&can, BANK_0, 1));
    ASSERT_REFUSED("FM1R", bxcan_write(&can, FM1R, 1));
    write(BANK_0 + 8, 1);
}

/* ---- errors */

static void test_a_lone_node_becomes_passive_and_never_goes_bus_off(void)
{
    wire.alone = true;
    request(0, 0x81);
    pass_us(100000);
    TEST_ASSERT_EQUAL_HEX32(128u << 16 | 3u << 4 | EWGF | EPVF, read(ESR));
    TEST_ASSERT_EQUAL_HEX32(6u << 26, read(TSR) & TME_ALL);
}

static void request_shorted(uint32_t errors)
{
    wire.shorted = true;
    request(0, 0x81);
    pass_us(errors * ERROR_US);
}

static void test_twelve_destroyed_frames_are_a_warning_sixteen_passive_and_thirty_two_bus_off(void)
{
    static const uint32_t expected[] = {0, EWGF, EWGF, EWGF | EPVF, EWGF | EPVF, EWGF | EPVF | BOFF};
    static const uint32_t errors[] = {11, 1, 3, 1, 15, 1};

    request_shorted(0);
    for (unsigned i = 0; i < 6; i++) {
        pass_us(errors[i] * ERROR_US);
        TEST_ASSERT_EQUAL_HEX32(expected[i], read(ESR) & (EWGF | EPVF | BOFF));
    }
}

static void test_bus_off_lasts_until_init_and_128_times_11_bits(void)
{
    request_shorted(32);
    wire.shorted = false;
    pass_us(1000000);
    TEST_ASSERT_EQUAL_HEX32(BOFF, read(ESR) & BOFF);
    enter_init(&can);
    write(MCR, TXFP);
    pass_us(22 + RECOVERY_US - 1);
    TEST_ASSERT_EQUAL_HEX32(BOFF, read(ESR) & BOFF);
    pass_us(1);
    TEST_ASSERT_EQUAL_HEX32(0, read(ESR));
    pass_us(300);
    ASSERT_HEARD(0x81);
}

static void test_bus_off_ends_by_itself_with_abom_unless_it_is_stuck(void)
{
    for (unsigned stuck = 0; stuck < 2; stuck++) {
        rejoin(TXFP | ABOM);
        can.recovery_stuck = stuck;
        request_shorted(32);
        wire.shorted = false;
        pass_us(RECOVERY_US);
        TEST_ASSERT_EQUAL_HEX32(stuck ? BOFF : 0, read(ESR) & BOFF);
    }
}

static void test_a_node_that_is_bus_off_neither_sends_nor_receives(void)
{
    request_shorted(32);
    wire.shorted = false;
    bring(5);
    TEST_ASSERT_EQUAL_UINT(0, wire.heard.count);
    TEST_ASSERT_EQUAL_HEX32(0, read(RF0R) & 3);
}

static void test_a_frame_waits_for_a_node_that_is_in_init(void)
{
    enter_init(&can);
    bring(5);
    TEST_ASSERT_EQUAL_HEX32(0, read(RF0R) & 3);
    write(MCR, TXFP);
    pass_us(300);
    TEST_ASSERT_EQUAL_HEX32(1, read(RF0R) & 3);
}

static void test_successes_make_up_for_errors(void)
{
    join_other();
    request_shorted(5);
    TEST_ASSERT_EQUAL_UINT(5, other.rec);
    wire.shorted = false;
    pass_us(400);
    TEST_ASSERT_EQUAL_UINT(5 * 8 - 1, read(ESR) >> 16 & 0xFF);
    TEST_ASSERT_EQUAL_UINT(4, other.rec);
}

static void test_a_destroyed_frame_that_was_given_up_is_over(void)
{
    request_shorted(0);
    pass_us(10);
    write(TSR, ABRQ);
    pass_us(ERROR_US);
    TEST_ASSERT_EQUAL_HEX32(RQCP | TERR, read(TSR) & 0xFF);
}

static void test_a_shorted_bus_makes_the_world_give_up_its_frames(void)
{
    wire.shorted = true;
    bring(5);
    wire.shorted = false;
    pass_us(300);
    TEST_ASSERT_EQUAL_HEX32(0, read(RF0R));
}

static void test_a_frame_received_ends_the_passive_state_and_clears_the_last_error(void)
{
    can.rec = 200;
    write(ESR, 7 << 4);
    bring(5);
    TEST_ASSERT_EQUAL_HEX32(120u << 24 | EWGF, read(ESR));
}

static void test_without_a_second_try_a_destroyed_frame_is_over(void)
{
    rejoin(TXFP | NART);
    request_shorted(4);
    TEST_ASSERT_EQUAL_HEX32(RQCP | TERR, read(TSR) & 0xFF);
    TEST_ASSERT_EQUAL_UINT(8, read(ESR) >> 16 & 0xFF);
}

static void test_the_last_error_is_told_until_it_is_written_over(void)
{
    wire.alone = true;
    request(0, 0x81);
    pass_us(300);
    TEST_ASSERT_EQUAL_UINT(BXCAN_NO_ACKNOWLEDGE, read(ESR) >> 4 & 7);
    write(ESR, 7 << 4);
    TEST_ASSERT_EQUAL_UINT(7, read(ESR) >> 4 & 7);
}

static void test_the_world_can_have_only_so_many_frames_waiting(void)
{
    enter_init(&can);
    for (unsigned i = 0; i < WIRE_QUEUE_MAX; i++)
        TEST_ASSERT_TRUE(wire_put(&wire, &(struct frame){.id = 1}));
    TEST_ASSERT_FALSE(wire_put(&wire, &(struct frame){.id = 2}));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_it_sleeps_after_a_reset_with_garbage_in_its_mailboxes);
    RUN_TEST(test_init_is_acknowledged_but_not_at_once);
    RUN_TEST(test_init_can_be_asked_for_in_vain);
    RUN_TEST(test_it_joins_the_bus_eleven_bits_after_init);
    RUN_TEST(test_it_neither_sends_on_a_bus_that_is_never_idle_nor_joins_it);
    RUN_TEST(test_another_speed_than_the_bus_is_refused);
    RUN_TEST(test_bit_timing_can_be_written_in_init_only);
    RUN_TEST(test_asking_for_the_mode_that_is_changes_nothing);
    RUN_TEST(test_a_master_reset_empties_everything_and_sleeps);
    RUN_TEST(test_what_is_not_modelled_is_refused);
    RUN_TEST(test_a_frame_takes_its_bits_to_leave);
    RUN_TEST(test_what_became_of_a_frame_is_cleared_by_writing_ones);
    RUN_TEST(test_mailboxes_leave_in_the_order_of_request_with_txfp);
    RUN_TEST(test_the_lowest_identifier_leaves_first_without_txfp);
    RUN_TEST(test_equal_identifiers_leave_by_mailbox_number_without_txfp);
    RUN_TEST(test_the_status_names_a_free_mailbox_or_the_one_to_leave_last);
    RUN_TEST(test_a_pending_mailbox_must_not_be_written);
    RUN_TEST(test_a_request_is_given_up_unless_it_is_on_the_wire);
    RUN_TEST(test_a_stuck_mailbox_neither_sends_nor_gives_up);
    RUN_TEST(test_the_lower_identifier_wins_the_bus);
    RUN_TEST(test_a_data_frame_goes_before_a_remote_one_and_that_before_an_extended_one);
    RUN_TEST(test_a_frame_that_lost_arbitration_can_be_given_up);
    RUN_TEST(test_without_a_second_try_lost_arbitration_is_the_end);
    RUN_TEST(test_the_same_frame_goes_to_the_world_first);
    RUN_TEST(test_a_frame_that_lost_to_another_controller_can_be_given_up_at_once);
    RUN_TEST(test_controllers_acknowledge_each_other_and_the_lower_identifier_goes_first);
    RUN_TEST(test_three_frames_wait_in_their_order);
    RUN_TEST(test_the_flags_of_a_fifo_are_cleared_by_writing_ones);
    RUN_TEST(test_an_overrun_replaces_the_last_frame_unless_locked);
    RUN_TEST(test_a_slow_release_shows_the_frame_on);
    RUN_TEST(test_an_output_mailbox_is_read_only_and_only_when_there_is_a_frame);
    RUN_TEST(test_a_received_frame_reads_as_it_was_sent);
    RUN_TEST(test_filters_let_through_what_they_say);
    RUN_TEST(test_a_filter_names_its_fifo);
    RUN_TEST(test_nothing_passes_without_an_active_filter_or_while_they_are_set_up);
    RUN_TEST(test_filters_in_use_must_not_be_changed);
    RUN_TEST(test_a_lone_node_becomes_passive_and_never_goes_bus_off);
    RUN_TEST(test_twelve_destroyed_frames_are_a_warning_sixteen_passive_and_thirty_two_bus_off);
    RUN_TEST(test_bus_off_lasts_until_init_and_128_times_11_bits);
    RUN_TEST(test_bus_off_ends_by_itself_with_abom_unless_it_is_stuck);
    RUN_TEST(test_a_node_that_is_bus_off_neither_sends_nor_receives);
    RUN_TEST(test_a_frame_waits_for_a_node_that_is_in_init);
    RUN_TEST(test_successes_make_up_for_errors);
    RUN_TEST(test_a_destroyed_frame_that_was_given_up_is_over);
    RUN_TEST(test_a_shorted_bus_makes_the_world_give_up_its_frames);
    RUN_TEST(test_a_frame_received_ends_the_passive_state_and_clears_the_last_error);
    RUN_TEST(test_without_a_second_try_a_destroyed_frame_is_over);
    RUN_TEST(test_the_last_error_is_told_until_it_is_written_over);
    RUN_TEST(test_the_world_can_have_only_so_many_frames_waiting);
    return UNITY_END();
}
