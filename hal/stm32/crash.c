#include "hal/stm32/crash.h"

#include "hal/stm32/registers.h"

enum {
    KEPT = 0x4B455054,   /* whatever is in the RAM at power-up, it is not this */
    FRESH = 0x46524553
};

enum {                   /* in RCC_CSR: RM0090 7.3.21, RM0008 7.3.10 */
    FLAG_PIN = 1 << 26,
    FLAG_POWER_ON = 1 << 27,
    FLAG_SOFTWARE = 1 << 28,
    FLAG_WATCHDOGS = 3 << 29
};

/* A reset finds it as it was left. */
static struct {
    uint32_t mark;       /* KEPT: of an earlier life; FRESH: the machine has not been reset since; else nothing is kept */
    struct crash crash;
} note __attribute__((section(".noinit")));

void crash_keep(uint32_t cause, const uint32_t *frame, const uint32_t *lowest, const uint32_t *end)
{
    static const enum crash_register pushed[CRASH_FRAME_WORDS] = {
        CRASH_R0, CRASH_R1, CRASH_R2, CRASH_R3, CRASH_R12, CRASH_LR, CRASH_PC, CRASH_PSR,
    };
    uint32_t *registers = note.crash.registers;

    note.crash = (struct crash){.cause = cause};
    registers[CRASH_SP] = (uint32_t)(uintptr_t)frame;
    registers[CRASH_CFSR] = SCB.cfsr;
    registers[CRASH_HFSR] = SCB.hfsr;
    registers[CRASH_MMFAR] = SCB.mmfar;
    registers[CRASH_BFAR] = SCB.bfar;
    if (frame >= lowest && frame + CRASH_FRAME_WORDS <= end)
        for (unsigned i = 0; i < CRASH_FRAME_WORDS; i++)
            registers[pushed[i]] = frame[i];
    note.mark = FRESH;
}

static enum reset_cause cause_of_software_reset(void)
{
    return note.mark == FRESH ? RESET_CRASH : RESET_SOFTWARE;
}

static enum reset_cause cause_by(uint32_t flags)
{
    if (flags & FLAG_POWER_ON || !(flags & (FLAG_PIN | FLAG_SOFTWARE | FLAG_WATCHDOGS)))
        return RESET_POWER_ON;
    if (flags & FLAG_WATCHDOGS)
        return RESET_WATCHDOG;
    return flags & FLAG_SOFTWARE ? cause_of_software_reset() : RESET_PIN;   /* each reset sets the pin's flag too */
}

enum reset_cause crash_reset_cause(uint32_t reset_flags)
{
    enum reset_cause cause = cause_by(reset_flags);

    if (cause == RESET_POWER_ON)
        note.mark = 0;
    else if (note.mark == FRESH)
        note.mark = KEPT;
    return cause;
}

const struct crash *crash_last(void)
{
    return note.mark == KEPT ? &note.crash : NULL;
}
