/* From reset to main, and from a crash to reset. */
#include <stddef.h>
#include <string.h>

#include "hal/port/cortex_m/core.h"
#include "hal/port/cortex_m/crash.h"
#include "hal/port/cortex_m/mcu.h"
#include "hal/port/cortex_m/systick.h"

#ifndef OCTET_INTERRUPTS
#define OCTET_INTERRUPTS "32"   /* as many as a Cortex-M0+ can have; a chip says how many it has */
#endif

enum {
    ICSR_VECTOR = 0x1FF,      /* number of the active exception */
    AIRCR_KEY = 0x05FA << 16,
    AIRCR_RESET = 1 << 2
};

/* From the linker script: addresses only. */
extern uint32_t stack_bottom[], stack_top[], data_start[], data_end[], data_image[], bss_start[], bss_end[];

int main(int argc, char *argv[]);
void startup_reset(void);
void startup_begin(void);
void startup_crash(void);
void startup_interrupts(void);
void startup_nmi(void) __attribute__((weak, alias("startup_crash")));   /* a chip may have its own */
void startup_crashed(const uint32_t *frame);

struct vectors {              /* PM0214 2.3.4, PM0056 2.3.4 */
    uint32_t *stack;
    void (*handlers[15])(void);
};

/* The core's 15 exceptions. */
__attribute__((section(".vectors"), used))
static const struct vectors vectors = {
    stack_top,
    {
        startup_reset, startup_nmi, startup_crash, startup_crash, startup_crash, startup_crash, NULL, NULL, NULL,
        NULL, startup_crash, startup_crash, NULL, startup_crash, startup_crash,
    },
};

/* Behind them, the chip's interrupts: none is ever taken, and one that were would be a crash. */
__attribute__((naked, section(".vectors.interrupts"), used)) void startup_interrupts(void)
{
    __asm__ volatile(".rept " OCTET_INTERRUPTS "\n\t.word startup_crash\n\t.endr");
}

/* With PRIMASK set, as it is from the start, a pending interrupt ends the wait and is not taken. */
void core_sleep(void)
{
    __asm__ volatile("dsb\n\twfi" ::: "memory");
}

/* A chip may have its own. The reset takes a few cycles. The barrier completes all earlier stores of compiler and
 * core. */
__attribute__((weak)) void reset_chip(void)
{
    __asm__ volatile("dsb" ::: "memory");
    SCB.aircr = AIRCR_KEY | AIRCR_RESET;
    for (;;)
        continue;
}

/* No interrupt may come before PRIMASK is set. */
__attribute__((naked)) void startup_reset(void)
{
    __asm__ volatile("cpsid i\n\tbl startup_begin");
}

__attribute__((used)) void startup_begin(void)   /* called by the assembly above, which the linker cannot see */
{
    SCB.vtor = (uint32_t)(uintptr_t)&vectors;   /* that of the chip's ROM may be in force */
    memcpy(data_start, data_image, (size_t)((char *)data_end - (char *)data_start));
    memset(bss_start, 0, (size_t)((char *)bss_end - (char *)bss_start));
    systick_start(mcu_start(), mcu_systick_divisor());
    (void)main(0, NULL);
    reset_chip();   /* main returns if its body cannot be opened: restart */
}

/* The stack may be corrupt: starts a new one in the half without the core's exception frame. */
__attribute__((naked)) void startup_crash(void)
{
    __asm__ volatile("mrs r0, msp\n\t"
                     "ldr r1, =stack_middle\n\t"
                     "cmp r0, r1\n\t"
                     "bhs 1f\n\t"
                     "ldr r1, =stack_top\n"
                     "1:\n\t"
                     "msr msp, r1\n\t"
                     "ldr r1, =startup_crashed\n\t"
                     "bx r1");   /* what every Cortex-M can do */
}

/* Called by the assembly above, which the linker cannot see. */
__attribute__((used)) void startup_crashed(const uint32_t *frame)
{
    crash_keep(SCB.icsr & ICSR_VECTOR, frame, stack_bottom, stack_top);
    reset_chip();
}
