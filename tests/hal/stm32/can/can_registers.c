#include "can_registers.h"

#include <string.h>

#include <unity.h>

enum { WORDS_MAX = 256 };

struct can_wire wire;
struct clocks machine;

static uint32_t shown[2][WORDS_MAX];   /* what the driver has read or could have */

static uint32_t offset_of(unsigned part, uint32_t word)
{
    return 4 * word + (part ? CAN_MEMORY.offset : 0);
}

void registers_show(void)
{
    for (unsigned part = 0; part < 2; part++)
        for (uint32_t word = 0; word < CAN_MEMORY.count[part]; word++)
            if (CAN_MEMORY.shows(offset_of(part, word), &shown[part][word]))
                CAN_MEMORY.words[part][word] = shown[part][word];
}

/* From the last register to the first: what starts something comes behind what it needs. */
static void take_writes(void)
{
    for (unsigned part = 2; part-- > 0;)
        for (uint32_t word = CAN_MEMORY.count[part]; word-- > 0;) {
            uint32_t value = CAN_MEMORY.words[part][word], offset = offset_of(part, word);

            if (value == shown[part][word])
                continue;
            CAN_MEMORY.prepare(offset);
            TEST_ASSERT_TRUE_MESSAGE(node_write(CAN_MEMORY.node, offset, value), CAN_MEMORY.node->refusal);
            shown[part][word] = value;
        }
}

void registers_reset(void)
{
    memset(shown, 0, sizeof shown);
    wire_open(&wire);
    CAN_MEMORY.open();
    CAN_MEMORY.node->clock_hz = machine.can_hz;
    for (unsigned part = 0; part < 2; part++)
        for (uint32_t word = 0; word < CAN_MEMORY.count[part]; word++)
            shown[part][word] = CAN_MEMORY.words[part][word];
    registers_show();
}

void registers_pass_us(uint32_t us)
{
    uint64_t end = wire.now_ns + 1000u * (uint64_t)us, next;

    CAN_MEMORY.node->clock_hz = machine.can_hz;
    take_writes();
    while ((next = wire_advance(&wire, wire.now_ns)) < end)
        (void)wire_advance(&wire, next);
    (void)wire_advance(&wire, end);
    TEST_ASSERT_EQUAL_STRING("", CAN_MEMORY.node->refusal);
    registers_show();
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
