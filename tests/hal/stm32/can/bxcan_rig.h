/* bxcan_rig.h: the rig of can_rig.h with the model of bxCAN. */
#ifndef OCTET_BXCAN_RIG_H
#define OCTET_BXCAN_RIG_H

#include "can_rig.h"
#include "hal/stm32/registers.h"
#include "host_sim/emulator/models/bxcan_model.h"

enum { OUTPUT_0 = 0x1B0, OUTPUT_1 = 0x1C0, OUTPUT_END = 0x1D0 };

static const uint32_t RIG_CLOCKS_HZ[] = {42000000, 36000000, 32000000, 16000000, 8000000, 0};   /* of chips with it; ends with 0 */
volatile struct can_registers CAN1;
static struct bxcan can;

static bool is_reserved(uint32_t offset)
{
    return (offset >= 0x20 && offset < 0x180) || (offset >= OUTPUT_END && offset < 0x200) || offset == 0x208
           || offset == 0x210 || offset == 0x218 || (offset >= 0x220 && offset < 0x240);
}

static bool is_empty_output(uint32_t offset)
{
    return (offset >= OUTPUT_0 && offset < OUTPUT_1 && can.fifos[0].count == 0)
           || (offset >= OUTPUT_1 && offset < OUTPUT_END && can.fifos[1].count == 0);
}

static bool shows(uint32_t offset, uint32_t *out)
{
    if (is_reserved(offset) || is_empty_output(offset))
        return false;
    *out = (uint32_t)node_read(&can.node, offset);
    return true;
}

static void open_controller(void)
{
    memset((void *)&CAN1, 0, sizeof CAN1);
    bxcan_open(&can, &wire, 14);
    can.ier = can.filters.words[3] = can.filters.words[5] = 0xFF;   /* IER, FS1R, FFA1R */
    machine = (struct clocks){72000000, 36000000, 72000000, true};
}

static void prepare(uint32_t offset)
{
    (void)offset;
}

const struct can_memory CAN_MEMORY = {
    &can.node, {(volatile uint32_t *)&CAN1}, {sizeof CAN1 / 4}, 0, shows, open_controller, prepare,
};

/* All filters active, as a boot loader may leave them: FM1R, FS1R, and each word of each bank. */
static inline void rig_leave_filters(uint32_t modes, uint32_t scales, uint32_t bank)
{
    can.filters.words[1] = modes;
    can.filters.words[3] = scales;
    can.filters.words[7] = 0x3FFF;
    for (unsigned i = 0; i < 2 * 14; i++)
        can.filters.banks[i] = bank;
    rig_show();
}

static inline struct rig_bit rig_bit(void)
{
    uint32_t timing = CAN1.btr;

    return (struct rig_bit){(timing & 0x3FFu) + 1, (timing >> 16 & 15u) + 2, (timing >> 20 & 7u) + 1, (timing >> 24) + 1};
}

static inline int rig_fifo_for(uint32_t id)
{
    return bxcan_fifo_for(&can, &(struct frame){.id = id});
}

static inline void rig_open_filters(void)
{
    can.filters.words[1] = 0;                           /* FM1R: a mask ... */
    can.filters.banks[0] = can.filters.banks[1] = 0;    /* ... that asks for nothing */
}

static inline bool rig_is_off_bus(void)
{
    return CAN1.msr & 1u;
}

#endif
