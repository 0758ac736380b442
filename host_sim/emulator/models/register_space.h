/* register_space.h: the registers of all peripherals by address. The busiest ones are models in C; Python handles all
 * others and all refused accesses, and reads this header too.
 *
 * Time in which the image only waits is skipped. It counts as waiting if it reads the same values repeatedly and
 * reads the time in between; a loop that counts its reads is executed. */
#ifndef OCTET_REGISTER_SPACE_H
#define OCTET_REGISTER_SPACE_H

#include <stdbool.h>
#include <stdint.h>

#include "host_sim/emulator/models/board_clock.h"
#include "host_sim/emulator/models/can_node.h"
#include "host_sim/emulator/models/core_blocks.h"

enum {
    SPACE_WAITING_READS = 8,    /* reads in a row without news, after which the image counts as waiting */
    SPACE_SKIP_NS = 1000000,    /* longest skip before its next read: it may be waiting for the time itself */
    SPACE_CAN_WORDS = 0x200,    /* of a CAN controller: registers, then the message RAM in the upper half */
    SPACE_CAN_RAM = 0x4000,     /* offset of that RAM from the registers */
    SPACE_BLOCKS = 12, SPACE_BLOCK_WORDS = 32
};

struct seen_value {
    bool known;
    uint32_t value;
};

/* What a write does to a register that is kept here. */
enum space_write { SPACE_KEPT, SPACE_ZEROS_CLEAR, SPACE_SETS_PINS };

/* Registers that only hold what is written, or what their model puts there; and of a port of pins, whose registers
 * IDR, ODR and BSRR follow each other. */
struct plain_block {
    uint32_t base;
    bool clocked;
    uint32_t readable, writable;            /* bit n: word n is accessed here, while there is a clock */
    uint8_t write[SPACE_BLOCK_WORDS];       /* an enum space_write each */
    uint32_t outputs;                       /* of a port: the pins that are outputs */
    uint32_t value[SPACE_BLOCK_WORDS];
};

struct register_space {
    struct board_clock *clock;
    struct can_node *can;
    struct systick *systick;
    uint32_t can_base, systick_val;   /* addresses */
    bool direct;                      /* whether any register is accessed here */
    bool can_readable[SPACE_CAN_WORDS], can_writable[SPACE_CAN_WORDS];   /* here, while CAN has a clock */
    struct seen_value seen[SPACE_CAN_WORDS];
    struct plain_block *blocks[SPACE_BLOCKS];
    unsigned block_count;
    unsigned old_news;                /* reads in a row that brought nothing new */
    bool looks_at_time;
};

struct register_window {
    const struct board_clock *clock;
    struct register_space *space;     /* asked first; NULL: there is none */
    uint32_t base;
    uint64_t (*read)(uint32_t address, uint32_t width);                   /* Python's */
    void (*write)(uint32_t address, uint32_t width, uint32_t value);
};

uint32_t space_can_word(uint32_t offset);
        /* The number of the register or word of CAN at an offset; SPACE_CAN_WORDS: there is none. */

void space_begin_anew(struct register_space *space);
        /* Notes that the image does something other than wait. */

void space_note(struct register_space *space, bool is_news);
        /* Notes a read of a register that shows events. */

void space_note_time(struct register_space *space);
        /* Notes a read of a register that shows the time. */

uint64_t window_read(void *emulator, uint64_t offset, unsigned width, void *window);
void window_write(void *emulator, uint64_t offset, unsigned width, uint64_t value, void *window);
        /* Unicorn's hooks: the core reads or writes registers. */

#endif
