/* STM32 functions for a boot loader and its images. */
#include "hal/boot/handover.h"
#include "hal/boot/image.h"
#include "hal/port/cortex_m/leave.h"
#include "hal/stm32/clock.h"
#include "hal/stm32/flash_table.h"

enum { MARK = 0x53544159 };   /* stored with its complement; unlikely to be in RAM at power-up */

extern volatile uint32_t HANDOVER[2];

void handover_ask(void)
{
    HANDOVER[0] = MARK;
    HANDOVER[1] = ~(uint32_t)MARK;
}

bool handover_take(void)
{
    bool asked = HANDOVER[0] == MARK && HANDOVER[1] == ~(uint32_t)MARK;

    HANDOVER[0] = 0;
    return asked;
}

void boot_start(unsigned slot)
{
    clock_stop();
    leave_to((const uint32_t *)(uintptr_t)flash_place(LAYOUT.slot_page[slot], IMAGE_VECTORS));
}
