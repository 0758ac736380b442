/* The host as a port: arguments, clock, a file for the memory. */
#include <errno.h>
#include <getopt.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/random.h>
#include <time.h>
#include <unistd.h>

#include "hal/can_body/port.h"
#include "hal/port/posix/file_store.h"

static const char *memory_path;   /* static, since hal_store has no path argument: one store per machine */

static void print_usage(FILE *to)
{
    fprintf(to,
            "usage: octet-robot [--node N] [--memory FILE] [--with-parent] LINK\n"
            "  LINK           socketcan:IFACE, fd:N or slcan:PATH[@BAUD]\n"
            "  --node N       which robot on the bus this is, 1..%d (1)\n"
            "  --memory FILE  load the eight bytes from FILE at start, store them there when they change\n"
            "  --with-parent  end when the process that started this one ends\n"
            "example: octet-robot --node 2 socketcan:vcan0\n",
            NODE_MAX);
}

static int parse_node(const char *text, uint8_t *node)
{
    char *end;
    long number;

    errno = 0;
    number = strtol(text, &end, 10);
    if (errno != 0 || *end != '\0' || number < 1 || number > NODE_MAX) {
        fprintf(stderr, "octet-robot: --node is 1..%d, not %s\n", NODE_MAX, text);
        return HAL_E_USAGE;
    }
    *node = (uint8_t)number;
    return 0;
}

/* Misses a parent that ended earlier, but then the link is closed or silent, as with any dead body. */
static int die_with_parent(void)
{
    return prctl(PR_SET_PDEATHSIG, SIGKILL) == 0 ? 0 : HAL_E_BODY;
}

static int take_option(struct port *port, int option)
{
    switch (option) {
    case 'n':
        return parse_node(optarg, &port->node);
    case 'm':
        memory_path = optarg;
        return 0;
    case 'p':
        return die_with_parent();
    case 'h':
        print_usage(stdout);
        exit(0);
    default:
        print_usage(stderr);
        return HAL_E_USAGE;
    }
}

int port_open(struct port *port, int argc, char *const argv[])
{
    static const struct option options[] = {
        {"node", required_argument, NULL, 'n'},
        {"memory", required_argument, NULL, 'm'},
        {"with-parent", no_argument, NULL, 'p'},
        {"help", no_argument, NULL, 'h'},
        {NULL, 0, NULL, 0},
    };
    int option;

    *port = (struct port){.node = 1, .clock_exact = true};
    while ((option = getopt_long(argc, argv, "", options, NULL)) != -1) {
        int result = take_option(port, option);

        if (result < 0)
            return result;
    }
    if (optind != argc - 1) {
        print_usage(stderr);
        return HAL_E_USAGE;
    }
    port->link = argv[optind];
    return 0;
}

void port_ready(const struct port *port)
{
    printf("octet-robot: node %d listens on %s\n", port->node, port->link);
    fflush(stdout);
}

uint32_t port_clock_ms(void)
{
    struct timespec now;

    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint32_t)now.tv_sec * 1000u + (uint32_t)(now.tv_nsec / 1000000);   /* wraps; a small time_t overflows */
}

void port_alive(bool outage)
{
    (void)outage;
}

int port_load(uint8_t memory[CELL_COUNT])
{
    return memory_path ? file_store_load(memory_path, memory) : 0;
}

int port_store(const uint8_t memory[CELL_COUNT], enum port_effort effort)
{
    (void)effort;
    return memory_path ? file_store_save(memory_path, memory) : 0;
}

uint32_t port_entropy(void)
{
    uint32_t number;

    if (getrandom(&number, sizeof number, 0) != sizeof number)
        number = port_clock_ms() ^ (uint32_t)getpid();
    return number;
}
