/* Division by the chip's own divider (data sheet 2.3.1.5), since its core has none: what the compiler calls for / and
 * %. No interrupt is ever taken, so nobody else divides in between. */
void divide(void);

/* Quotient in r0, remainder in r1: each also serves who wants only the first. The divider takes eight cycles. */
__attribute__((naked, used)) void divide(void)
{
    __asm__ volatile(".syntax unified\n\t"
                     ".global __aeabi_uidiv, __aeabi_uidivmod, __aeabi_idiv, __aeabi_idivmod\n\t"
                     ".thumb_func\n__aeabi_idiv:\n\t"
                     ".thumb_func\n__aeabi_idivmod:\n\t"
                     "ldr r3, =0xD0000060\n\t"
                     "str r0, [r3, #0x08]\n\t"   /* DIV_SDIVIDEND */
                     "str r1, [r3, #0x0C]\n\t"
                     "b 1f\n\t"
                     ".thumb_func\n__aeabi_uidiv:\n\t"
                     ".thumb_func\n__aeabi_uidivmod:\n\t"
                     "ldr r3, =0xD0000060\n\t"
                     "str r0, [r3, #0x00]\n\t"   /* DIV_UDIVIDEND */
                     "str r1, [r3, #0x04]\n"
                     "1:\n\t"
                     "b 2f\n"
                     "2:\n\t"
                     "b 3f\n"
                     "3:\n\t"
                     "b 4f\n"
                     "4:\n\t"
                     "b 5f\n"
                     "5:\n\t"
                     "ldr r1, [r3, #0x14]\n\t"   /* DIV_REMAINDER */
                     "ldr r0, [r3, #0x10]\n\t"   /* DIV_QUOTIENT, last */
                     "bx lr\n\t"
                     ".ltorg");
}
