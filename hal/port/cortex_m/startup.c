/* From reset to main, and from a crash to reset. */
#include <stddef.h>
#include <string.h>

#include "hal/port/cortex_m/core.h"
#include "hal/port/cortex_m/crash.h"
#include "hal/port/cortex_m/leave.h"
#include "hal/port/cortex_m/mcu.h"
#include "hal/port/cortex_m/systick.h"

enum {
    ICSR_VECTOR = 0x1FF       /* number of the active exception */
};

/* From the linker script: addresses only. */
extern uint32_t stack_bottom[], stack_top[], data_start[], data_end[], data_image[], bss_start[], bss_end[];

int main(int argc, char *argv[]);
void startup_reset(void);
void startup_crash(void);
void startup_nmi(void) __attribute__((weak, alias("startup_crash")));   /* a chip may have its own */
void startup_crashed(const uint32_t *frame);

struct vectors {              /* PM0214 2.3.4, PM0056 2.3.4 */
    uint32_t *stack;
    void (*handlers[15])(void);
};

/* No interrupt is ever taken: the table has only the core's 15 exceptions. */
__attribute__((section(".vectors"), used))
static const struct vectors vectors = {
    stack_top,
    {
        startup_reset, startup_nmi, startup_crash, startup_crash, startup_crash, startup_crash, NULL, NULL, NULL,
        NULL, startup_crash, startup_crash, NULL, startup_crash, startup_crash,
    },
};

/* With PRIMASK set, a pending interrupt ends the wait and is not taken. */
void core_sleep(void)
{
    __asm__ volatile("cpsid i\n\tdsb\n\twfi" ::: "memory");
}

void startup_reset(void)
{
    SCB.vtor = (uint32_t)(uintptr_t)&vectors;   /* a boot loader's may be in force */
    memcpy(data_start, data_image, (size_t)((char *)data_end - (char *)data_start));
    memset(bss_start, 0, (size_t)((char *)bss_end - (char *)bss_start));
    systick_start(mcu_start());
    (void)main(0, NULL);
    leave_by_reset();   /* main returns if its body cannot be opened: restart */
}

/* The stack may be corrupt: starts a new one in the half without the core's exception frame. */
__attribute__((naked)) void startup_crash(void)
{
    __asm__ volatile("mrs r0, msp\n\t"
                     "ldr r1, =stack_middle\n\t"
                     "cmp r0, r1\n\t"
                     "it lo\n\t"
                     "ldrlo r1, =stack_top\n\t"
                     "msr msp, r1\n\t"
                     "b startup_crashed");
}

/* Called by the assembly above, which the linker cannot see. */
__attribute__((used, weak)) void startup_crashed(const uint32_t *frame)   /* a boot loader has its own */
{
    crash_keep(SCB.icsr & ICSR_VECTOR, frame, stack_bottom, stack_top);
    leave_by_reset();
}
