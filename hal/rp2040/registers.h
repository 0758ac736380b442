/* registers.h: the RP2040's own registers, as far as used. Behind each: what an access does (rw; r: read
 * only; w: write only; w1s, w1c: writing 1 sets or clears the bit); behind each block its data sheet section. */
#ifndef OCTET_RP2040_REGISTERS_H
#define OCTET_RP2040_REGISTERS_H

#include <stdint.h>

struct clock_generator {
    uint32_t ctrl;            /* rw */
    uint32_t div;             /* rw */
    uint32_t selected;        /* r    one bit for each source of a glitchless multiplexer */
};

struct clocks_registers {     /* 2.15.7 */
    struct clock_generator clk_gpout[4];
    struct clock_generator clk_ref, clk_sys, clk_peri, clk_usb, clk_adc;
};

struct resets_registers {     /* 2.14.3 */
    uint32_t reset;           /* rw   1 holds a block in reset */
    uint32_t wdsel;           /* rw */
    uint32_t reset_done;      /* r */
};

struct psm_registers {        /* 2.13.5 */
    uint32_t frce_on;         /* rw */
    uint32_t frce_off;        /* rw */
    uint32_t wdsel;           /* rw   what the watchdog resets */
    uint32_t done;            /* r */
};

struct chip_reset_registers { /* 2.10.6 */
    uint32_t vreg;            /* rw */
    uint32_t bod;             /* rw */
    uint32_t chip_reset;      /* r but for bit 24   what reset the whole chip last */
};

struct xosc_registers {       /* 2.16.7 */
    uint32_t ctrl;            /* rw */
    uint32_t status;          /* r, bit 24 w1c */
    uint32_t dormant;         /* rw */
    uint32_t startup;         /* rw   in 256 cycles of the crystal */
};

struct pll_registers {        /* 2.18.4 */
    uint32_t cs;              /* rw, LOCK r */
    uint32_t pwr;             /* rw   1 switches a part off */
    uint32_t fbdiv_int;       /* rw */
    uint32_t prim;            /* rw */
};

struct io_registers {         /* 2.19.6.1 */
    struct {
        uint32_t gpio_status; /* r */
        uint32_t gpio_ctrl;   /* rw */
    } gpio[30];
    uint32_t intr[4];         /* r, edges w1c   four bits for each pin */
};

struct pads_registers {       /* 2.19.6.3 */
    uint32_t voltage_select;  /* rw */
    uint32_t gpio[30];        /* rw */
};

struct sio_registers {        /* 2.3.1.7 */
    uint32_t cpuid;           /* r */
    uint32_t gpio_in;         /* r */
    uint32_t reserved[2];
    uint32_t gpio_out;        /* rw */
    uint32_t gpio_out_set;    /* w1s */
    uint32_t gpio_out_clr;    /* w1c */
    uint32_t gpio_out_xor;    /* w */
    uint32_t gpio_oe;         /* rw */
    uint32_t gpio_oe_set;     /* w1s */
    uint32_t gpio_oe_clr;     /* w1c */
};

struct uart_registers {       /* 4.2.8 */
    uint32_t uartdr;          /* rw   with the errors of the byte */
    uint32_t uartrsr;         /* rw */
    uint32_t reserved[4];
    uint32_t uartfr;          /* r */
    uint32_t reserved_1;
    uint32_t uartilpr;        /* rw */
    uint32_t uartibrd;        /* rw */
    uint32_t uartfbrd;        /* rw   taken over by a write to uartlcr_h */
    uint32_t uartlcr_h;       /* rw */
    uint32_t uartcr;          /* rw */
    uint32_t uartifls;        /* rw */
    uint32_t uartimsc;        /* rw   interrupts */
};

struct pwm_registers {        /* 4.5.3 */
    struct {
        uint32_t csr;         /* rw */
        uint32_t div;         /* rw   in sixteenths */
        uint32_t ctr;         /* rw */
        uint32_t cc;          /* rw   A, and B in the high half; taken over as it wraps */
        uint32_t top;         /* rw */
    } ch[8];
    uint32_t en;              /* rw */
    uint32_t intr;            /* w1c   one bit for each slice that wrapped */
    uint32_t inte;            /* rw */
};

struct adc_registers {        /* 4.9.6 */
    uint32_t cs;              /* rw */
    uint32_t result;          /* r */
};

struct pio_registers {        /* 3.7 */
    uint32_t ctrl;            /* rw */
    uint32_t fstat;           /* r */
    uint32_t fdebug;          /* w1c */
    uint32_t flevel;          /* r */
    uint32_t txf[4];          /* w */
    uint32_t rxf[4];          /* r */
    uint32_t irq;             /* w1c */
    uint32_t irq_force;       /* w */
    uint32_t input_sync_bypass;   /* rw */
    uint32_t dbg_padout;      /* r */
    uint32_t dbg_padoe;       /* r */
    uint32_t dbg_cfginfo;     /* r */
    uint32_t instr_mem[32];   /* w */
    struct {
        uint32_t clkdiv;      /* rw */
        uint32_t execctrl;    /* rw */
        uint32_t shiftctrl;   /* rw */
        uint32_t addr;        /* r */
        uint32_t instr;       /* rw   executes at once what is written */
        uint32_t pinctrl;     /* rw */
    } sm[4];
};

struct watchdog_registers {   /* 4.7.6 */
    uint32_t ctrl;            /* rw */
    uint32_t load;            /* w */
    uint32_t reason;          /* r    both bits are 0 after a reset of the whole chip */
    uint32_t scratch[8];      /* rw */
    uint32_t tick;            /* rw */
};

extern volatile struct clocks_registers CLOCKS;
extern volatile struct resets_registers RESETS;
extern volatile struct psm_registers PSM;
extern volatile struct chip_reset_registers CHIP_RESET;
extern volatile struct xosc_registers XOSC;
extern volatile struct pll_registers PLL_SYS, PLL_USB;
extern volatile struct io_registers IO_BANK0;
extern volatile struct pads_registers PADS_BANK0;
extern volatile struct sio_registers SIO;
extern volatile struct uart_registers UART0;
extern volatile struct pwm_registers PWM;
extern volatile struct adc_registers ADC;
extern volatile struct pio_registers PIO0;
extern volatile struct watchdog_registers WATCHDOG;

#endif
