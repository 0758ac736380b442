/* Which registers are accessed in C and which by Python, and how an image that polls is detected. */
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
    join_alone(TXFP);
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

static uint32_t read_word(uint32_t offset)
{
    return (uint32_t)window_read(NULL, offset, 4, &window);
}

static uint32_t read_timer(void)
{
    const struct register_window core = {.clock = &board, .space = &space, .base = CORE_BASE, .read = python_reads};

    return (uint32_t)window_read(NULL, SYSTICK_VAL - CORE_BASE, 4, (void *)&core);
}

/* ---- where registers are */

TEST(can_register_is_read_without_python)
{
    TEST_ASSERT_EQUAL_HEX32(BIT_TIMING, read_word(BTR));
    TEST_ASSERT_EQUAL_UINT(0, python.reads);
}

TEST(can_register_is_written_without_python)
{
    window_write(NULL, 0x184, 4, 5, &window);
    TEST_ASSERT_EQUAL_HEX32(5, read_register(0x184));
    TEST_ASSERT_EQUAL_UINT(0, python.writes);
}

TEST(transmit_request_starts_the_frame_at_once)
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

TEST(register_space_passes_all_other_accesses_to_python)
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

TEST(register_space_passes_other_writes_to_python)
{
    window_write(NULL, MCR, 4, INRQ, &window);
    TEST_ASSERT_EQUAL_UINT(1, python.writes);
    TEST_ASSERT_EQUAL_HEX32(CAN_BASE + MCR, python.address);
    TEST_ASSERT_EQUAL_HEX32(INRQ, python.value);
    TEST_ASSERT_EQUAL_UINT32(4, python.width);
}

TEST(register_refused_by_the_controller_is_passed_to_python)
{
    assert_read_by_python(0x20, 4);
    window_write(NULL, 0x20, 4, 7, &window);
    TEST_ASSERT_EQUAL_UINT(1, python.writes);
    TEST_ASSERT_EQUAL_HEX32(7, python.value);
}

TEST(timer_value_is_read_without_python)
{
    timer.since_cycles = board.cycles;
    clock_execute(&board, 1);
    TEST_ASSERT_EQUAL_UINT32(999, read_timer());
    TEST_ASSERT_EQUAL_UINT(0, python.reads);
    space.direct = false;
    TEST_ASSERT_EQUAL_UINT32(FROM_PYTHON, read_timer());
}

TEST(registers_ignore_accesses_after_a_failure)
{
    board.failed = true;
    TEST_ASSERT_EQUAL_HEX32(0, read_word(BTR));
    window_write(NULL, 0x184, 4, 5, &window);
    window_write(NULL, MCR, 4, INRQ, &window);
    TEST_ASSERT_EQUAL_HEX32(0xA5A5A5A5, read_register(0x184));
    TEST_ASSERT_EQUAL_UINT(0, python.reads + python.writes);
}

/* ---- an image that waits */

/* Returns the time in ns that is skipped in so many reads. */
static uint64_t skipped_ns(unsigned reads, bool with_timer)
{
    uint64_t start = board.now.ns;

    for (unsigned n = 0; n < reads; n++) {
        (void)read_word(RF0R);
        if (with_timer)
            (void)read_timer();
    }
    return board.now.ns - start;
}

/* The very first read returns a new value, and is not counted. */
TEST(register_space_skips_a_millisecond_per_burst_of_reads)
{
    TEST_ASSERT_EQUAL_UINT64(0, skipped_ns(1 + SPACE_WAITING_READS, true));
    TEST_ASSERT_EQUAL_UINT64(SPACE_SKIP_NS, skipped_ns(1, true));
    TEST_ASSERT_EQUAL_UINT64(0, skipped_ns(SPACE_WAITING_READS, true));
    TEST_ASSERT_EQUAL_UINT64(SPACE_SKIP_NS, skipped_ns(1, true));
}

TEST(register_space_skips_no_time_for_counted_reads)
{
    TEST_ASSERT_EQUAL_UINT64(0, skipped_ns(100, false));
}

TEST(register_space_skips_no_time_for_an_image_that_writes)
{
    for (unsigned n = 0; n < 100; n++) {
        TEST_ASSERT_EQUAL_UINT64(0, skipped_ns(1, true));
        window_write(NULL, 0x184, 4, n, &window);
    }
}

TEST(register_space_skips_no_time_when_values_change)
{
    uint64_t start = board.now.ns;

    for (uint32_t n = 0; n < 100; n++) {
        write_register(ESR, n % 7 << 4);
        (void)read_word(ESR);
        (void)read_timer();
    }
    TEST_ASSERT_EQUAL_UINT64(start, board.now.ns);
}

TEST(register_space_skips_to_the_next_event_at_most)
{
    request(0, 0x81);
    clock_settle(&board);
    TEST_ASSERT_EQUAL_UINT64(FRAME_NS, skipped_ns(2 + SPACE_WAITING_READS, true));
}

TEST(register_space_counts_accesses_of_python)
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

static void add_plain_block(void)
{
    block = (struct plain_block){.base = BLOCK_BASE, .clocked = true, .readable = 1u << IDR | 1u << ODR | 1u << STATUS | 1u << OFTEN,
        .writable = 1u << BSRR | 1u << STATUS | 1u << OFTEN, .outputs = 0x00F0,
        .write = {[BSRR] = SPACE_SETS_PINS, [STATUS] = SPACE_ZEROS_CLEAR}};
    space.blocks[space.block_count++] = &block;
    window.base = BLOCK_BASE;
}

TEST(plain_register_holds_the_written_value)
{
    add_plain_block();
    window_write(NULL, 4 * OFTEN, 4, 0x12345678, &window);
    TEST_ASSERT_EQUAL_HEX32(0x12345678, read_word(4 * OFTEN));
    TEST_ASSERT_EQUAL_UINT(0, python.reads + python.writes);
}

TEST(status_register_is_cleared_by_writing_zeros)
{
    add_plain_block();
    block.value[STATUS] = 0x81;
    window_write(NULL, 4 * STATUS, 4, 0xFFFFFFFE, &window);
    TEST_ASSERT_EQUAL_HEX32(0x80, read_word(4 * STATUS));
}

TEST(bsrr_drives_outputs_that_idr_reads_back)
{
    add_plain_block();
    block.value[IDR] = 0x0F0F;
    window_write(NULL, 4 * BSRR, 4, 0x00FF, &window);
    TEST_ASSERT_EQUAL_HEX32(0x00FF, read_word(4 * ODR));
    TEST_ASSERT_EQUAL_HEX32(0x0FFF, read_word(4 * IDR));
    window_write(NULL, 4 * BSRR, 4, 0x00100010 | 0x0F << 16, &window);   /* setting wins over clearing */
    TEST_ASSERT_EQUAL_HEX32(0x00F0, read_word(4 * ODR));
}

TEST(register_space_passes_unclocked_and_odd_accesses_to_python)
{
    add_plain_block();
    TEST_ASSERT_EQUAL_HEX32(FROM_PYTHON, read_word(4 * BSRR));
    TEST_ASSERT_EQUAL_HEX32(FROM_PYTHON, (uint32_t)window_read(NULL, 4 * OFTEN, 2, &window));
    window_write(NULL, 4 * IDR, 4, 1, &window);
    TEST_ASSERT_EQUAL_UINT(1, python.writes);
    block.clocked = false;
    TEST_ASSERT_EQUAL_HEX32(FROM_PYTHON, read_word(4 * OFTEN));
    block.clocked = true;
    space.direct = false;
    TEST_ASSERT_EQUAL_HEX32(FROM_PYTHON, read_word(4 * OFTEN));
    window_write(NULL, 4 * OFTEN, 4, 1, &window);
    TEST_ASSERT_EQUAL_UINT(2, python.writes);
    TEST_ASSERT_EQUAL_HEX32(FROM_PYTHON, read_word(4 * SPACE_BLOCK_WORDS));
}

TEST(message_ram_words_follow_the_registers)
{
    static const uint32_t offsets[] = {0, 4, 0x3FC, 0x400, SPACE_CAN_RAM, SPACE_CAN_RAM + 0x34C, SPACE_CAN_RAM + 0x400, 2};
    static const uint32_t words[] = {0, 1, 0xFF, SPACE_CAN_WORDS, 0x100, 0x1D3, SPACE_CAN_WORDS, SPACE_CAN_WORDS};

    for (unsigned i = 0; i < 8; i++)
        TEST_ASSERT_EQUAL_HEX32(words[i], space_can_word(offsets[i]));
}
