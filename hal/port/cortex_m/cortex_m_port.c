/* The port for Cortex-M microcontrollers. */
#include "hal/can_body/port.h"

#include "hal/flash_store/flash.h"
#include "hal/flash_store/flash_store.h"
#include "hal/port/cortex_m/core.h"
#include "hal/port/cortex_m/crash.h"
#include "hal/port/cortex_m/mcu.h"
#include "hal/port/cortex_m/systick.h"

/* Compile-time check. */
enum { NODE_IS_IN_RANGE = 1 / (OCTET_NODE >= 1 && OCTET_NODE <= NODE_MAX) };

enum { MORE_PAGE = FLASH_PAGES + 58 };

enum { BLINK_SLOWLY = 9, BLINK_FAST = 7 };   /* bit of the milliseconds: about 1 Hz, 4 Hz */

static struct flash_store store;                                /* of the memory */
static struct flash_store more[PORT_MORE];                      /* of the body, in the four pages before that */
static uint32_t entropy __attribute__((section(".noinit")));    /* random after power-up; kept by a reset */

int port_open(struct port *port, int argc, char *const argv[])
{
    (void)argc;
    (void)argv;
    *port = (struct port){
        .link = "",
        .node = OCTET_NODE,
        .reset_cause = crash_reset_cause(mcu_reset_cause()),
        .crash = crash_last(),
        .clock_exact = mcu_clock_is_exact(),
    };
    mcu_light(true);
    return 0;
}

void port_ready(const struct port *port)
{
    (void)port;
    mcu_light(false);
}

uint32_t port_clock_ms(void)
{
    return machine_ms();
}

void port_alive(bool outage)
{
    mcu_feed();
    mcu_light(machine_ms() >> (outage ? BLINK_FAST : BLINK_SLOWLY) & 1u);
}

int port_load(uint8_t memory[CELL_COUNT])
{
    return flash_exists() ? flash_store_open(&store, memory) : 0;
}

int port_store(const uint8_t memory[CELL_COUNT], enum port_effort effort)
{
    int result = flash_exists() ? flash_store_save(&store, memory, effort == PORT_AT_REST) : 0;

    return result == FLASH_STORE_LATER ? PORT_LATER : result;
}

int port_load_more(unsigned which, uint8_t bytes[CELL_COUNT])
{
    return flash_exists() ? flash_store_open_at(&more[which], MORE_PAGE + FLASH_PAGES * which, bytes) : 0;
}

int port_store_more(unsigned which, const uint8_t bytes[CELL_COUNT])
{
    return flash_exists() ? flash_store_save(&more[which], bytes, true) : 0;
}

uint32_t port_entropy(void)
{
    entropy = (entropy + SYSTICK.val) * 1664525u + 1013904223u;
    return entropy;
}
