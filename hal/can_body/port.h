/* port.h: what the CAN body needs from its machine besides a link. One thread calls all of it. */
#ifndef OCTET_PORT_H
#define OCTET_PORT_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/hal.h"
#include "hal/protocol/health.h"

struct port {
    const char *link;   /* name of the link, as link_open takes it */
    uint8_t node;       /* 1..63 */
    enum reset_cause reset_cause;
    const struct crash *crash;   /* the last since power-up; null for none */
    bool clock_exact;   /* port_clock_ms and the bus run at their right speed */
};

int port_open(struct port *port, int argc, char *const argv[]);
        /* Fills *port from the command line or built-in values. Returns 0 or HAL_E_USAGE, reported on the console. */

void port_ready(const struct port *port);
        /* Reports that the link is open, in the machine's own way. */

uint32_t port_clock_ms(void);
        /* Milliseconds from any start; wraps. */

void port_alive(bool outage);
        /* Feeds the watchdog and drives the status light. Called whenever the body begins to wait: at least every
           HAL_SILENCE_MS plus the time of a store. outage: no senses arrive. */

int port_load(uint8_t memory[CELL_COUNT]);
uint32_t port_entropy(void);
        /* As hal_load and hal_entropy in hal.h. */

enum port_effort { PORT_QUICKLY, PORT_AT_REST };

enum { PORT_LATER = 1 };

int port_store(const uint8_t memory[CELL_COUNT], enum port_effort effort);
        /* As hal_store. With PORT_QUICKLY, returns PORT_LATER and changes nothing if it would take longer than a
           tick. PORT_AT_REST: the wheels are at rest and no answer is awaited, so the call may take a second. */

enum { PORT_MORE = 2 };

int port_load_more(unsigned which, uint8_t bytes[CELL_COUNT]);
int port_store_more(unsigned which, const uint8_t bytes[CELL_COUNT]);
        /* Load and store eight further bytes for the body; which is below PORT_MORE. As port_load, and port_store
           with PORT_AT_REST. Only on machines with a body on pins. */

#endif
