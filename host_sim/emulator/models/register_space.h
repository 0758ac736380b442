/* register_space.h: the registers of all peripherals by address. Those that are accessed most are models in C; all others,
 * and all refused accesses, are left to Python, which reads this header too.
 *
 * Time in which the image only waits is skipped. It waits if it reads the same values again and again and reads the time
 * in between; a loop that counts its reads instead is executed. */
#ifndef OCTET_REGISTER_SPACE_H
#define OCTET_REGISTER_SPACE_H

#include <stdbool.h>
#include <stdint.h>

#include "host_sim/emulator/models/board_clock.h"
#include "host_sim/emulator/models/bxcan_model.h"
#include "host_sim/emulator/models/systick_model.h"

enum {
    SPACE_WAITING_READS = 8,    /* reads in a row that bring nothing new, after which the image counts as waiting */
    SPACE_SKIP_NS = 1000000,    /* longest skip before its next read: it may be waiting for the time itself */
    SPACE_CAN_WORDS = 0x100     /* registers of CAN that there can be */
};

struct seen_value {
    bool known;
    uint32_t value;
};

struct register_space {
    struct board_clock *clock;
    struct bxcan *can;
    struct systick *systick;
    uint32_t can_base, systick_val;   /* addresses */
    bool direct;                      /* whether any register is accessed here */
    bool can_readable[SPACE_CAN_WORDS], can_writable[SPACE_CAN_WORDS];   /* here, while CAN has a clock */
    struct seen_value seen[SPACE_CAN_WORDS];
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

void space_begin_anew(struct register_space *space);
        /* The image does something other than wait. */

void space_note(struct register_space *space, bool is_news);
        /* It has read a register that tells what has happened. */

void space_note_time(struct register_space *space);
        /* It has read a register that tells the time. */

uint64_t window_read(void *emulator, uint64_t offset, unsigned width, void *window);
void window_write(void *emulator, uint64_t offset, unsigned width, uint64_t value, void *window);
        /* Unicorn's hooks: the core reads or writes registers. */

#endif
