#include "bxcan_registers.h"

#include <string.h>

#include <unity.h>

#include "hal/stm32/registers.h"

enum { WORDS = sizeof(struct can_registers) / 4, OUTPUT_0 = 0x1B0 / 4, OUTPUT_1 = 0x1C0 / 4, FMR = 0x200 / 4 };

volatile struct can_registers CAN1;
struct can_wire wire;
struct bxcan can;
struct clocks machine;

static uint32_t shown[WORDS];   /* what the driver has read or could have */

static bool is_reserved(uint32_t word)
{
    uint32_t offset = 4 * word;

    return (offset >= 0x20 && offset < 0x180) || (offset >= 0x1D0 && offset < 0x200) || offset == 0x208
           || offset == 0x210 || offset == 0x218 || (offset >= 0x220 && offset < 0x240);
}

static bool is_empty_output(uint32_t word)
{
    return (word >= OUTPUT_0 && word < OUTPUT_1 && can.fifos[0].count == 0)
           || (word >= OUTPUT_1 && word < FMR && can.fifos[1].count == 0);
}

static void show(uint32_t count)
{
    volatile uint32_t *memory = (volatile uint32_t *)&CAN1;

    for (uint32_t word = 0; word < count; word++)
        if (!is_reserved(word) && !is_empty_output(word))
            memory[word] = shown[word] = (uint32_t)bxcan_read(&can, 4 * word);
}

/* From the last register to the first: what starts something comes behind what it needs. */
static void take_writes(void)
{
    const volatile uint32_t *memory = (const volatile uint32_t *)&CAN1;

    for (uint32_t word = WORDS; word-- > 0;)
        if (memory[word] != shown[word])
            TEST_ASSERT_TRUE_MESSAGE(bxcan_write(&can, 4 * word, memory[word]), can.refusal);
}

void registers_reset(void)
{
    memset((void *)&CAN1, 0, sizeof CAN1);
    memset(shown, 0, sizeof shown);
    wire_open(&wire);
    bxcan_open(&can, &wire, 14);
    can.ier = can.filters.words[3] = can.filters.words[5] = 0xFF;   /* IER, FS1R, FFA1R */
    machine = (struct clocks){72000000, 36000000, 72000000, true};
    can.clock_hz = machine.can_hz;
    show(WORDS);
}

void registers_leave_filters(uint32_t modes, uint32_t scales, uint32_t bank)
{
    can.filters.words[1] = modes;
    can.filters.words[3] = scales;
    can.filters.words[7] = 0x3FFF;
    for (unsigned i = 0; i < 2 * 14; i++)
        can.filters.banks[i] = bank;
    show(WORDS);
}

void registers_pass_us(uint32_t us)
{
    uint64_t end = wire.now_ns + 1000u * (uint64_t)us, next;
    bool changed = memcmp((const void *)&CAN1, shown, sizeof shown) != 0;

    can.clock_hz = machine.can_hz;
    if (changed)
        take_writes();
    while ((next = wire_advance(&wire, wire.now_ns)) < end)
        (void)wire_advance(&wire, next);
    (void)wire_advance(&wire, end);
    TEST_ASSERT_EQUAL_STRING("", can.refusal);
    show(changed ? WORDS : FMR);   /* filters change only where they are written */
}

uint32_t machine_ms(void)
{
    registers_pass_us(LOOK_US);
    return (uint32_t)(wire.now_ns / 1000000);
}

struct clocks machine_clocks(void)
{
    return machine;
}
