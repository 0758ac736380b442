/* posix_port_rig.h: the host's port, with a clock and with system calls that do as a test says, and what it says itself. */
#ifndef OCTET_POSIX_PORT_RIG_H
#define OCTET_POSIX_PORT_RIG_H

#include <stdio.h>
#include <sys/types.h>
#include <time.h>

#include "tests/test.h"
#include "hal/can_body/port.h"

extern struct port port;
extern char said[512];            /* on the stream that was redirected */
extern struct timespec now;
extern bool prctl_fails;
extern ssize_t getrandom_gives;   /* bytes, or -1; 0: as many as are asked for */

int __real_prctl(int option, unsigned long value);

int open_scratch(void);
        /* An empty file that nobody else sees. */

int redirect(FILE *stream, int to);
        /* Redirects a stream into a file, which is closed, or back. Returns what it was before. */

void read_said(int fd);
        /* Reads a file into said, and closes it. */

int open_with(const char *first, ...);
        /* port_open with these words, the last of them null; what it says on stderr is in said. */

void assert_says(const char *text);

#endif
