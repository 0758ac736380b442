/* socket_faults.h: what sockets seldom say, said to the link by fakes of the system calls. Time is a fake as well: it passes
   only while the link waits, so that a busy machine changes nothing. */
#ifndef OCTET_SOCKET_FAULTS_H
#define OCTET_SOCKET_FAULTS_H

#include <limits.h>

#include "tests/test.h"
#include "hal/link/link.h"

enum { FOR_EVER = INT_MAX, NS_PER_MS = 1000000 };

/* The first calls fail, with error, each after some time; the others go through. */
struct fault {
    int error, first, calls, each_ms;
};

extern struct fault recv_fault, send_fault, poll_fault, setsockopt_fault, calloc_fault;
extern struct link *near;            /* listens for 0x123 */
extern int far;                      /* the other end, which never blocks */
extern int64_t now_ns;
extern int64_t receive_timeout_ns;   /* that the kernel was last told, */
extern int times_told;               /* and how often */

void put(size_t size, uint8_t len);
        /* The far end sends a datagram of this size: a frame with that length, if it is one. */

#endif
