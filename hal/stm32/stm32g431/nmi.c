/* The only exception that does not end the program. It occurs only in flash_read, and takes 56 bytes of stack. */
void startup_nmi(void);

/* An error that is not forgiven is a crash, with the stack as left by the exception. */
__attribute__((naked)) void startup_nmi(void)
{
    __asm__ volatile("push {r4, lr}\n\t"
                     "bl flash_forgives\n\t"
                     "pop {r4, lr}\n\t"
                     "cbz r0, 1f\n\t"
                     "bx lr\n\t"
                     "1: b startup_crash");
}
