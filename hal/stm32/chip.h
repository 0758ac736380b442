/* chip.h: what each chip implements for itself, and what the drivers know of it. Its folder has pins_start, the
 * tables below with the functions beside them, gpio.h unless gpio_f4.c does, registers, linker script, and
 * chip.cmake, which names its links and their shared drivers. Notation as in registers.h. */
#ifndef OCTET_CHIP_H
#define OCTET_CHIP_H

#include "hal/flash_store/flash.h"
#include "hal/port/cortex_m/systick.h"

struct clocks {
    uint32_t core_hz;
    uint32_t can_hz;     /* of the CAN controller */
    uint32_t usart_hz;   /* of the serial port */
    bool exact;          /* false: internal oscillator, 1 % accurate */
};

enum { CLOCK_SYSTICK_DIVISOR = 8 };   /* RM0008 and its like: longer between two looks than by the core clock */

struct clocks clock_start(void);
        /* Starts the best clock that works: crystal and PLL, else internal oscillator and PLL, else the internal
           oscillator alone. Each wait is bounded: a few milliseconds in all with a good crystal, 0.12 s at most.
           Leaves systick set for the clock after reset. */

struct clocks machine_clocks(void);
        /* The clocks as they run now. */

enum { CHIP_POWER_ON = 1 << 27 };   /* in RCC_CSR: RM0008 7.3.10, RM0090 7.3.21, RM0440 7.4.28 */

uint32_t chip_reset_flags(void);
        /* RCC_CSR: what has reset the chip since the last call; a brown-out counts as CHIP_POWER_ON. */

void pins_start(void);
        /* Enables the clocks of all peripherals in use, monitors the supply for flash.h, and sets up the pins of the
           board's LED, CAN and serial port. */

/* What clock.c needs to know of a chip. */

struct clock_source {
    uint32_t pll;            /* the PLL's setting with this source */
    struct clocks clocks;    /* the resulting clocks */
};

struct clock_table {
    volatile uint32_t *cr, *cfgr, *pll, *csr, *acr;   /* of RCC, the one that sets up the PLL, and of the flash */
    uint32_t on_after_reset; /* a bit of CR that is never 0 on the chip itself, or 0 */
    uint32_t forget;         /* in CSR: clears the flags */
    uint32_t brown_out;      /* in CSR: the flag of a brown-out, if power-on does not cover it */
    uint32_t internal;       /* CFGR: the internal oscillator alone */
    uint32_t buses;          /* CFGR: the same, with buses slow enough for the PLL, if its setting does not say so */
    uint32_t switch_to_pll;  /* CFGR: SW */
    uint32_t from_pll;       /* CFGR: SWS */
    uint32_t caches;         /* ACR, and the wait states in it */
    uint32_t waits_mask;
    uint32_t waits;
};

/* In the chip's clock.c. */
extern const struct clock_table CLOCK_TABLE;
extern const struct clock_source CLOCK_SOURCES[2];   /* the internal oscillator, the crystal */
extern const struct clocks CLOCK_SLOW;   /* the internal oscillator alone */

enum {
    CRYSTAL_MS = 100,        /* most start in 2 ms; the vendor's code allows as much */
    SWITCH_MS = 5            /* a PLL locks in 0.3 ms; a switch takes a few cycles */
};

/* What flash.c needs to know of a chip. */

struct flash_table {
    volatile uint32_t *keyr, *sr, *cr;
    volatile uint32_t *ar;              /* takes the address of the page to erase; NULL: CR has its number */
    const volatile uint32_t *supply;    /* the supply, compared with what pins.c says */
    uint32_t supply_low;                /* in *supply */
    uint32_t page_size;
    uint32_t unit;
    uint32_t at_once;                   /* bytes that are written at once: a unit, or half of one */
    uint32_t erase_ms;                  /* at least twice what a page takes */
    uint32_t busy, errors, done;        /* SR */
    uint32_t lock, write, erase, start; /* CR */
    uint32_t number_at;                 /* and the lowest bit there of the page's number */
    bool slow;                          /* a unit takes longer than a byte on a serial line */
};

/* In the chip's flash.c, with flash_read. */
extern const struct flash_table FLASH_TABLE;

void flash_begin(unsigned page, uint32_t offset, const uint32_t words[]);
        /* Starts one write of at_once bytes; a half-word is in the low half of words[0]. */

volatile void *flash_place(unsigned page, uint32_t offset);
        /* Where that is. */

uint32_t flash_number(unsigned page);
        /* The chip's own number of a page, for CR. */

bool flash_has(unsigned page, uint32_t offset, const uint32_t words[]);
        /* Whether they read back as written. */

/* What robot_pins.c leaves to each chip family: clocks, the ADC for the sensors, and additional registers of its
 * TIM1. */

enum { CONVERTER_SAMPLES = 6 };

extern const uint32_t BREAK_FILTER;   /* in TIM1's bdtr: of the pulses at its break input; 0: it has none */

const volatile uint32_t *converter_power(void);
        /* Enables the clocks of TIM1 to TIM4, DMA1 and the ADC. Returns the register from which DMA reads samples. */

void converter_start(const uint8_t channels[CONVERTER_SAMPLES]);
        /* Starts converting all channels in rounds of under 0.5 ms, repeatedly. Channel 1 of DMA1 must be ready. */

#endif
