#include "hal/port/cortex_m/crash.h"

#include <stdbool.h>

#include "hal/port/cortex_m/core.h"

enum {
    ARMV6_M = 12,        /* architecture in CPUID: a core without fault registers */
    KEPT = 0x4B455054,   /* unlikely to be in RAM at power-up */
    FRESH = 0x46524553
};

/* Not initialised, so that it survives a reset. */
static struct {
    uint32_t mark;       /* KEPT: record from before a reset; FRESH: no reset since; else there is no record */
    struct crash crash;
} note __attribute__((section(".noinit")));

void crash_keep(uint32_t cause, const uint32_t *frame, const uint32_t *lowest, const uint32_t *end)
{
    static const uint8_t pushed[CRASH_FRAME_WORDS] = {
        CRASH_R0, CRASH_R1, CRASH_R2, CRASH_R3, CRASH_R12, CRASH_LR, CRASH_PC, CRASH_PSR,
    };
    uint32_t *registers = note.crash.values;

    note.crash = (struct crash){.cause = (uint8_t)cause, .count = CRASH_REGISTER_COUNT};
    registers[CRASH_SP] = (uint32_t)(uintptr_t)frame;
    if ((SCB.cpuid >> 16 & 15u) != ARMV6_M) {
        registers[CRASH_CFSR] = SCB.cfsr;
        registers[CRASH_HFSR] = SCB.hfsr;
        registers[CRASH_MMFAR] = SCB.mmfar;
        registers[CRASH_BFAR] = SCB.bfar;
    }
    if (frame >= lowest && frame <= end - CRASH_FRAME_WORDS)   /* no addition to a wild pointer: it could wrap */
        for (unsigned i = 0; i < CRASH_FRAME_WORDS; i++)
            registers[pushed[i]] = frame[i];
    note.mark = FRESH;
}

enum reset_cause crash_reset_cause(enum reset_cause cause)
{
    bool crashed = note.mark == FRESH;

    if (cause == RESET_POWER_ON)
        note.mark = 0;
    else if (crashed)
        note.mark = KEPT;
    return cause == RESET_SOFTWARE && crashed ? RESET_CRASH : cause;
}

const struct crash *crash_last(void)
{
    return note.mark == KEPT ? &note.crash : NULL;
}
