/* The one exception that does not end the program. It comes within flash_read only, and takes 56 bytes of the stack. */
#include "hal/stm32/stm32g431/flash_errors.h"

void startup_nmi(void);

/* What is not forgiven is a crash, with the stack as the exception left it. */
__attribute__((naked)) void startup_nmi(void)
{
    __asm__ volatile("push {r4, lr}\n\t"
                     "bl flash_forgives\n\t"
                     "pop {r4, lr}\n\t"
                     "cbz r0, 1f\n\t"
                     "bx lr\n\t"
                     "1: b startup_crash");
}
