#include "hal/rp2040/machine.h"

enum {
    MAGIC = 0x01754D, MAGIC_MASK = 0xFFFFFF,   /* "Mu", and a 1 */
    BLOCK = 65536, BLOCK_ERASE = 0xD8,         /* what it may erase at once; a sector is less */
    CALLS = 5
};

/* Its functions, by two letters. */
enum {
    CONNECT = 0x4649, LEAVE = 0x5845,   /* IF: the flash's pins; EX: leave the mode in which it is read as memory */
    ERASE = 0x4552, WRITE = 0x5052,     /* RE, RP */
    FORGET = 0x4346, READ = 0x5843      /* FC: what is cached; CX: read as memory again */
};

extern const volatile uint32_t ROM[];

struct call {
    uint32_t first, second, third, fourth;   /* arguments */
    uint32_t function;                       /* its name, or its address; 0 ends a list */
};

uint32_t rom_call(const struct call *calls);

/* Calls each function of a list, and returns what the last one does. It lies in RAM. In assembly, since no compiler
 * can tell what stack the ROM's functions use: at most 200 bytes. */
__attribute__((naked, used, section(".in_ram")))
uint32_t rom_call(const struct call *calls __attribute__((unused)))
{
    __asm__ volatile(".syntax unified\n\t"
                     "push {r4, r5, lr}\n\t"
                     "movs r4, r0\n"
                     "1:\n\t"
                     "ldr r5, [r4, #16]\n\t"
                     "cmp r5, #0\n\t"
                     "beq 2f\n\t"
                     "ldmia r4!, {r0, r1, r2, r3, r5}\n\t"
                     "blx r5\n\t"
                     "b 1b\n"
                     "2:\n\t"
                     "pop {r4, r5, pc}");
}

static uint32_t find(uint32_t name)
{
    /* The half-words at 0x14 and 0x18 are the table and the function that looks up. */
    const struct call calls[] = {
        {.first = ROM[5] & 0xFFFFu, .second = name, .function = ROM[6] & 0xFFFFu},
        {.function = 0},
    };

    return rom_call(calls);
}

bool rom_exists(void)
{
    return (ROM[4] & MAGIC_MASK) == MAGIC && find(ERASE) != 0 && find(WRITE) != 0;
}

static void run(const struct call *work)
{
    struct call calls[CALLS + 1] = {
        {.function = CONNECT}, {.function = LEAVE}, *work, {.function = FORGET}, {.function = READ}, {.function = 0},
    };

    for (unsigned i = 0; i < CALLS; i++)
        calls[i].function = find(calls[i].function);
    (void)rom_call(calls);
}

void rom_erase(uint32_t offset)
{
    run(&(const struct call){offset, ROM_SECTOR, BLOCK, BLOCK_ERASE, ERASE});
}

void rom_write(uint32_t offset, const uint32_t page[ROM_PAGE / 4])
{
    run(&(const struct call){offset, (uint32_t)(uintptr_t)page, ROM_PAGE, 0, WRITE});
}
