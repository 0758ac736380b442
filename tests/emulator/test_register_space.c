/* Which registers are accessed here and which are left to Python; and how an image that waits is found out. */
#include "host_sim/emulator/models/register_space.h"

#include "bxcan_model_rig.h"

enum { CAN_BASE = 0x40006400, SYSTICK_VAL = 0x18, CORE_BASE = 0x10, FROM_PYTHON = 0xC0DE, FRAME_NS = (47 + 64) * WIRE_BIT_NS };

static struct board_clock board;
static struct systick timer;
static struct register_space space;
static struct register_window window;
static struct {
    unsigned reads, writes;
    uint32_t address, width, value;   /* of the last */
} python;

static uint64_t python_reads(uint32_t address, uint32_t width)
{
    python.reads++;
    python.address = address;
    python.width = width;
    return FROM_PYTHON;
}

static void python_writes(uint32_t address, uint32_t width, uint32_t value)
{
    python.writes++;
    python.address = address;
    python.width = width;
    python.value = value;
}

static void ignore(struct board_clock *clock)
{
    clock->wire->heard.count = 0;
}

void setUp(void)
{
    rejoin(TXFP);
    can.node.clocked = true;
    board = (struct board_clock){.now = {wire.now_ns, 0}, .period_fs = 1000000, .wire = &wire,
        .take = ignore};
    clock_settle(&board);
    timer = (struct systick){.clock = &board, .ctrl = SYSTICK_ENABLE | SYSTICK_CLKSOURCE, .load = 999};
    space = (struct register_space){.clock = &board, .can = &can.node, .systick = &timer, .can_base = CAN_BASE,
        .systick_val = SYSTICK_VAL, .direct = true};
    for (unsigned word = 0; word < SPACE_CAN_WORDS; word++)
        space.can_readable[word] = space.can_writable[word] = true;
    space.can_writable[MCR / 4] = false;
    window = (struct register_window){.clock = &board, .space = &space, .base = CAN_BASE, .read = python_reads,
        .write = python_writes};
    memset(&python, 0, sizeof python);
}

static uint32_t look(uint32_t offset)
{
    return (uint32_t)window_read(NULL, offset, 4, &window);
}

static uint32_t look_at_time(void)
{
    const struct register_window core = {.clock = &board, .space = &space, .base = CORE_BASE, .read = python_reads};

    return (uint32_t)window_read(NULL, SYSTICK_VAL - CORE_BASE, 4, (void *)&core);
}

/* ---- where registers are */

TEST(a_register_of_can_is_read_here)
{
    TEST_ASSERT_EQUAL_HEX32(BIT_TIMING, look(BTR));
    TEST_ASSERT_EQUAL_UINT(0, python.reads);
}

TEST(a_register_of_can_is_written_here)
{
    window_write(NULL, 0x184, 4, 5, &window);
    TEST_ASSERT_EQUAL_HEX32(5, read_register(0x184));
    TEST_ASSERT_EQUAL_UINT(0, python.writes);
}

TEST(what_is_written_is_on_the_wire_at_once)
{
    uint64_t start;

    for (uint32_t offset = 0x184; offset <= 0x18C; offset += 4)
        window_write(NULL, offset, 4, 8, &window);
    clock_execute(&board, 12345);
    start = board.now.ns;
    window_write(NULL, 0x180, 4, 0x81 << 21 | 1, &window);
    clock_execute(&board, 0);
    TEST_ASSERT_EQUAL_INT(0, wire.sender);
    TEST_ASSERT_EQUAL_UINT64(start + FRAME_NS, wire.ends_ns);
}

static void assert_read_by_python(uint32_t offset, uint32_t width)
{
    unsigned before = python.reads;

    TEST_ASSERT_EQUAL_HEX32(FROM_PYTHON, window_read(NULL, offset, width, &window));
    TEST_ASSERT_EQUAL_UINT(before + 1, python.reads);
    TEST_ASSERT_EQUAL_HEX32(CAN_BASE + offset, python.address);
    TEST_ASSERT_EQUAL_UINT32(width, python.width);
}

TEST(all_other_accesses_are_pythons)
{
    assert_read_by_python(4 * SPACE_CAN_WORDS, 4);
    assert_read_by_python(BTR, 2);
    assert_read_by_python(BTR + 2, 4);
    space.can_readable[BTR / 4] = false;
    assert_read_by_python(BTR, 4);
    space.can_readable[BTR / 4] = true;
    can.node.clocked = false;
    assert_read_by_python(BTR, 4);
    can.node.clocked = true;
    space.direct = false;
    assert_read_by_python(BTR, 4);
    window.space = NULL;
    assert_read_by_python(BTR, 4);
}

TEST(what_is_not_written_here_is_pythons)
{
    window_write(NULL, MCR, 4, INRQ, &window);
    TEST_ASSERT_EQUAL_UINT(1, python.writes);
    TEST_ASSERT_EQUAL_HEX32(CAN_BASE + MCR, python.address);
    TEST_ASSERT_EQUAL_HEX32(INRQ, python.value);
    TEST_ASSERT_EQUAL_UINT32(4, python.width);
}

TEST(what_the_controller_refuses_is_pythons_who_asks_it_again)
{
    assert_read_by_python(0x20, 4);
    window_write(NULL, 0x20, 4, 7, &window);
    TEST_ASSERT_EQUAL_UINT(1, python.writes);
    TEST_ASSERT_EQUAL_HEX32(7, python.value);
}

TEST(the_timers_value_is_read_here)
{
    timer.since_cycles = board.cycles;
    clock_execute(&board, 1);
    TEST_ASSERT_EQUAL_UINT32(999, look_at_time());
    TEST_ASSERT_EQUAL_UINT(0, python.reads);
    space.direct = false;
    TEST_ASSERT_EQUAL_UINT32(FROM_PYTHON, look_at_time());
}

TEST(once_something_has_failed_registers_are_dead)
{
    board.failed = true;
    TEST_ASSERT_EQUAL_HEX32(0, look(BTR));
    window_write(NULL, 0x184, 4, 5, &window);
    window_write(NULL, MCR, 4, INRQ, &window);
    TEST_ASSERT_EQUAL_HEX32(0xA5A5A5A5, read_register(0x184));
    TEST_ASSERT_EQUAL_UINT(0, python.reads + python.writes);
}

/* ---- an image that waits */

/* How long it was let wait, in so many looks. */
static uint64_t wait_by(unsigned looks, bool at_time)
{
    uint64_t start = board.now.ns;

    for (unsigned n = 0; n < looks; n++) {
        (void)look(RF0R);
        if (at_time)
            (void)look_at_time();
    }
    return board.now.ns - start;
}

/* The first look of all brings something new. */
TEST(an_image_that_waits_is_let_wait_a_millisecond_again_and_again)
{
    TEST_ASSERT_EQUAL_UINT64(0, wait_by(1 + SPACE_WAITING_READS, true));
    TEST_ASSERT_EQUAL_UINT64(SPACE_SKIP_NS, wait_by(1, true));
    TEST_ASSERT_EQUAL_UINT64(0, wait_by(SPACE_WAITING_READS, true));
    TEST_ASSERT_EQUAL_UINT64(SPACE_SKIP_NS, wait_by(1, true));
}

TEST(an_image_that_counts_its_looks_is_left_to_do_so)
{
    TEST_ASSERT_EQUAL_UINT64(0, wait_by(100, false));
}

TEST(an_image_that_writes_does_not_wait)
{
    for (unsigned n = 0; n < 100; n++) {
        TEST_ASSERT_EQUAL_UINT64(0, wait_by(1, true));
        window_write(NULL, 0x184, 4, n, &window);
    }
}

TEST(an_image_that_reads_something_new_does_not_wait)
{
    uint64_t start = board.now.ns;

    for (uint32_t n = 0; n < 100; n++) {
        write_register(ESR, n % 7 << 4);
        (void)look(ESR);
        (void)look_at_time();
    }
    TEST_ASSERT_EQUAL_UINT64(start, board.now.ns);
}

TEST(a_wait_ends_with_the_next_event)
{
    request(0, 0x81);
    clock_settle(&board);
    TEST_ASSERT_EQUAL_UINT64(FRAME_NS, wait_by(2 + SPACE_WAITING_READS, true));
}

TEST(what_python_reads_and_does_counts_as_well)
{
    uint64_t start = board.now.ns;

    for (unsigned n = 0; n <= 12 * SPACE_WAITING_READS; n++) {
        space_note_time(&space);
        space_note(&space, n % SPACE_WAITING_READS == 0);
    }
    for (unsigned n = 0; n < SPACE_WAITING_READS; n++)
        space_note(&space, false);
    space_begin_anew(&space);
    space_note_time(&space);
    for (unsigned n = 0; n < SPACE_WAITING_READS; n++)
        space_note(&space, false);
    TEST_ASSERT_EQUAL_UINT64(start, board.now.ns);
    space_note(&space, false);
    TEST_ASSERT_EQUAL_UINT64(start + SPACE_SKIP_NS, board.now.ns);
}

/* ---- registers that only hold what is written */

enum { BLOCK_BASE = 0x40010800, IDR = 2, ODR, BSRR, STATUS, OFTEN };

static struct plain_block block;

static void keep(void)
{
    block = (struct plain_block){.base = BLOCK_BASE, .clocked = true, .readable = 1u << IDR | 1u << ODR | 1u << STATUS | 1u << OFTEN,
        .writable = 1u << BSRR | 1u << STATUS | 1u << OFTEN, .outputs = 0x00F0,
        .write = {[BSRR] = SPACE_SETS_PINS, [STATUS] = SPACE_ZEROS_CLEAR}};
    space.blocks[space.block_count++] = &block;
    window.base = BLOCK_BASE;
}

TEST(what_is_written_is_kept_and_read)
{
    keep();
    window_write(NULL, 4 * OFTEN, 4, 0x12345678, &window);
    TEST_ASSERT_EQUAL_HEX32(0x12345678, look(4 * OFTEN));
    TEST_ASSERT_EQUAL_UINT(0, python.reads + python.writes);
}

TEST(zeros_clear_a_status_and_ones_leave_it)
{
    keep();
    block.value[STATUS] = 0x81;
    window_write(NULL, 4 * STATUS, 4, 0xFFFFFFFE, &window);
    TEST_ASSERT_EQUAL_HEX32(0x80, look(4 * STATUS));
}

TEST(pins_are_set_and_cleared_and_outputs_read_back)
{
    keep();
    block.value[IDR] = 0x0F0F;
    window_write(NULL, 4 * BSRR, 4, 0x00FF, &window);
    TEST_ASSERT_EQUAL_HEX32(0x00FF, look(4 * ODR));
    TEST_ASSERT_EQUAL_HEX32(0x0FFF, look(4 * IDR));
    window_write(NULL, 4 * BSRR, 4, 0x00100010 | 0x0F << 16, &window);   /* what is both set and cleared is set */
    TEST_ASSERT_EQUAL_HEX32(0x00F0, look(4 * ODR));
}

TEST(a_kept_register_without_a_clock_or_of_another_kind_is_left_to_python)
{
    keep();
    TEST_ASSERT_EQUAL_HEX32(FROM_PYTHON, look(4 * BSRR));
    TEST_ASSERT_EQUAL_HEX32(FROM_PYTHON, (uint32_t)window_read(NULL, 4 * OFTEN, 2, &window));
    window_write(NULL, 4 * IDR, 4, 1, &window);
    TEST_ASSERT_EQUAL_UINT(1, python.writes);
    block.clocked = false;
    TEST_ASSERT_EQUAL_HEX32(FROM_PYTHON, look(4 * OFTEN));
    block.clocked = true;
    space.direct = false;
    TEST_ASSERT_EQUAL_HEX32(FROM_PYTHON, look(4 * OFTEN));
    window_write(NULL, 4 * OFTEN, 4, 1, &window);
    TEST_ASSERT_EQUAL_UINT(2, python.writes);
    TEST_ASSERT_EQUAL_HEX32(FROM_PYTHON, look(4 * SPACE_BLOCK_WORDS));
}

TEST(words_of_a_message_ram_follow_the_registers)
{
    static const uint32_t offsets[] = {0, 4, 0x3FC, 0x400, SPACE_CAN_RAM, SPACE_CAN_RAM + 0x34C, SPACE_CAN_RAM + 0x400, 2};
    static const uint32_t words[] = {0, 1, 0xFF, SPACE_CAN_WORDS, 0x100, 0x1D3, SPACE_CAN_WORDS, SPACE_CAN_WORDS};

    for (unsigned i = 0; i < 8; i++)
        TEST_ASSERT_EQUAL_HEX32(words[i], space_can_word(offsets[i]));
}
