/* The second stage, which the boot ROM copies to RAM and calls: it lets the flash be read as memory (data sheet
 * 2.8.1.3, 4.10). It uses the command that every flash has, 03h: an image of this size is soon in the cache. */
void boot2_start(void);

/* The last word is a CRC-32 of the others, without which the ROM does not call it; the tests compute it. */
__attribute__((naked, section(".boot2"), used)) void boot2_start(void)
{
    __asm__ volatile(".syntax unified\n\t"
                     "ldr r0, =0x18000000\n\t"   /* XIP_SSI */
                     "movs r1, #0\n\t"
                     "str r1, [r0, #0x08]\n\t"   /* SSIENR: off while it is set up */
                     "str r1, [r0, #0x04]\n\t"   /* CTRLR1: one word a read */
                     "movs r2, #4\n\t"
                     "str r2, [r0, #0x14]\n\t"   /* BAUDR: 31 MHz at 125 MHz */
                     "ldr r2, =0x001F0300\n\t"   /* frames of 32 bits; send command and address, then receive */
                     "str r2, [r0, #0x00]\n\t"   /* CTRLR0 */
                     "ldr r2, =0x03000218\n\t"   /* command 03h of 8 bits, address of 24, all by one line */
                     "ldr r3, =0x180000F4\n\t"   /* SPI_CTRLR0 */
                     "str r2, [r3]\n\t"
                     "movs r1, #1\n\t"
                     "str r1, [r0, #0x08]\n\t"
                     "ldr r0, =0x10000100\n\t"   /* the image's vectors */
                     "ldr r1, =0xE000ED08\n\t"   /* VTOR */
                     "str r0, [r1]\n\t"
                     "ldr r1, [r0]\n\t"
                     "msr msp, r1\n\t"
                     "ldr r0, [r0, #4]\n\t"
                     "bx r0\n\t"
                     ".ltorg\n\t"
                     ".org 252\n\t"
                     ".word 0xF54E526E");
}
