#include "hal/rp2040/rom.h"

#include <stddef.h>
#include <string.h>

enum {
    MAGIC = 'M' | 'u' << 8 | 1 << 16, MAGIC_MASK = 0xFFFFFF,
    BLOCK = 65536, BLOCK_ERASE = 0xD8,   /* what it may erase at once; a sector is less */
    RUN_SIZE = 28,                       /* of the code of run_calls, in bytes */
    CALLS = 5, CALL_WORDS = 5
};

extern const volatile uint32_t ROM[];

/* A function of the ROM and its arguments, for run_calls. */
struct call {
    uint32_t function, arguments[CALL_WORDS - 1];
};

void run_calls(void);

/* Calls each function of the list in r0, which 0 ends. It is copied to RAM, and must run wherever it lies. */
__attribute__((naked, used)) void run_calls(void)
{
    __asm__ volatile(".syntax unified\n\t"
                     "push {r4, r5, lr}\n\t"
                     "movs r4, r0\n"
                     "1:\n\t"
                     "ldr r5, [r4]\n\t"
                     "cmp r5, #0\n\t"
                     "beq 2f\n\t"
                     "ldr r0, [r4, #4]\n\t"
                     "ldr r1, [r4, #8]\n\t"
                     "ldr r2, [r4, #12]\n\t"
                     "ldr r3, [r4, #16]\n\t"
                     "blx r5\n\t"
                     "adds r4, #20\n\t"
                     "b 1b\n"
                     "2:\n\t"
                     "pop {r4, r5, pc}");
}

/* Called in assembly, since no compiler can tell what stack the ROM's functions use: at most 200 bytes. */
static uint32_t call(uint32_t function, uint32_t first, uint32_t second)
{
    register uint32_t r0 __asm__("r0") = first;
    register uint32_t r1 __asm__("r1") = second;

    __asm__ volatile("blx %2" : "+r"(r0), "+r"(r1) : "r"(function) : "r2", "r3", "r12", "lr", "cc", "memory");
    return r0;
}

/* A function by its two letters; 0 if there is none. */
static uint32_t find(char first, char second)
{
    uint32_t tables = ROM[5], look_up = ROM[6] & 0xFFFF;   /* half-words at 0x14 and 0x18 */

    return call(look_up, tables & 0xFFFF, (uint32_t)(uint8_t)first | (uint32_t)(uint8_t)second << 8);
}

bool rom_exists(void)
{
    return (ROM[4] & MAGIC_MASK) == MAGIC && find('R', 'E') && find('R', 'P');
}

static void run(const struct call *work)
{
    uint32_t code[RUN_SIZE / 4];
    const struct call calls[CALLS + 1] = {
        {find('I', 'F'), {0}},   /* connect the flash's pins, */
        {find('E', 'X'), {0}},   /* and leave the mode in which it is read as memory */
        *work,
        {find('F', 'C'), {0}},   /* forget what is cached, and read as memory again */
        {find('C', 'X'), {0}},
    };

    memcpy(code, (const void *)((uintptr_t)run_calls & ~(uintptr_t)1), sizeof code);
    (void)call((uint32_t)(uintptr_t)code | 1, (uint32_t)(uintptr_t)calls, 0);
}

void rom_erase(uint32_t offset)
{
    const struct call work = {find('R', 'E'), {offset, ROM_SECTOR, BLOCK, BLOCK_ERASE}};

    run(&work);
}

void rom_write(uint32_t offset, const uint8_t page[ROM_PAGE])
{
    const struct call work = {find('R', 'P'), {offset, (uint32_t)(uintptr_t)page, ROM_PAGE, 0}};

    run(&work);
}
