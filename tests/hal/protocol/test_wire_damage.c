/* What is damaged on its way is refused, and counted. */
#include <string.h>

#include "tests/test.h"
#include "reading_rig.h"

static void flip(struct frame *frame, unsigned bit)
{
    if (bit < ID_BITS)
        frame->id ^= 1u << bit;
    else
        frame->data[(bit - ID_BITS) / 8] ^= (uint8_t)(1u << (bit - ID_BITS) % 8);
}

/* Each is counted: as damaged, or as foreign where the identifier became another's. */
static void refuse_and_count(struct frame frame)
{
    memset(wire.faults, 0, sizeof wire.faults);
    refuse(frame);
    TEST_ASSERT_EQUAL_UINT(1, wire.faults[FAULT_DAMAGED] + wire.faults[FAULT_FOREIGN]);
    wire.faults[FAULT_DAMAGED] = wire.faults[FAULT_FOREIGN] = 0;
}

static void refuse_every_flip(const struct frame good)
{
    for (unsigned i = 0; i < BITS; i++) {
        struct frame one = good;

        flip(&one, i);
        refuse_and_count(one);
        for (unsigned j = 0; j < i; j++) {
            struct frame two = one;

            flip(&two, j);
            refuse_and_count(two);
        }
    }
    TEST_ASSERT_NOT_EQUAL(INPUT_SILENCE, hear(good));   /* the clean control */
}

TEST(senses_with_one_or_two_flipped_bits_are_refused)
{
    refuse_every_flip(senses_frame(NODE, 123));
}

TEST(a_command_with_one_or_two_flipped_bits_is_refused)
{
    refuse_every_flip(command_frame((struct octet_command_t){.opcode = OPCODE_START, .seed = 0x12345678}));
}

TEST(a_frame_of_another_length_is_damaged)
{
    for (uint8_t len = 0; len < 8; len++) {
        struct frame senses = senses_frame(NODE, 0), command = command_of(OPCODE_STOP, 0, OWNER), ranges = ranges_frame(0);

        senses.len = command.len = ranges.len = len;
        refuse(protected_frame(senses));
        refuse(protected_frame(command));
        refuse(protected_frame(ranges));
    }
    expect(FAULT_DAMAGED, 24);
}

TEST(damaged_senses_do_not_move_the_tick)
{
    struct frame damaged = senses_frame(NODE, 10);

    read_tick(1);
    damaged.data[0] ^= 1;
    refuse(damaged);
    expect(FAULT_DAMAGED, 1);
    TEST_ASSERT_EQUAL(INPUT_SENSES, read_tick(2));
}

TEST(a_damaged_command_does_not_use_up_its_counter)
{
    struct frame damaged = command_of(OPCODE_ERASE, 7, OWNER);

    damaged.data[7] ^= 1;
    refuse(damaged);
    expect(FAULT_DAMAGED, 1);
    TEST_ASSERT_EQUAL(INPUT_COMMAND, hear(command_of(OPCODE_ERASE, 7, OWNER)));
}

TEST(every_counter_stays_at_255)
{
    for (unsigned fault = 0; fault < FAULT_COUNT; fault++) {
        for (unsigned i = 0; i < 300; i++)
            wire_count(&wire, (enum fault)fault);
        expect((enum fault)fault, 255);
    }
}
