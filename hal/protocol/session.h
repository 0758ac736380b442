/* session.h: which sender the robot obeys, and which tick comes next. */
#ifndef OCTET_SESSION_H
#define OCTET_SESSION_H

#include "firmware/io.h"

enum { SESSION_WINDOW = 14 };   /* ticks ahead of the last that are taken where the robot's own clock counts */

/* A COMMAND as it was sent. */
struct request {
    struct command command;   /* what the robot is to do */
    uint8_t counter;
    uint8_t owner;            /* who asks for it */
    bool lockstep;            /* start: the owner's clock counts */
};

struct session {
    struct request request; /* the last one taken, */
    bool knows_request;     /* if there was one */
    uint8_t owner;          /* who started the robot; 0 if it was not started */
    bool hears;             /* the owner's senses come */
    bool lockstep;          /* the owner's clock counts */
    bool knows_tick;        /* false: whatever tick comes next is taken */
    uint8_t tick;           /* of the last senses taken, */
    uint8_t counter;        /* and their alive counter */
    uint32_t told;          /* CRC-32 over the commands carried out since a stop without an owner, and over senses for a tick
                               that had others, */
    uint32_t telling;       /* and what it becomes once the request is carried out */
    uint8_t told_opcodes;   /* the sum of those commands' opcodes */
};

enum arrival { ARRIVAL_FRESH, ARRIVAL_AGAIN, ARRIVAL_STALE };

enum arrival session_senses(struct session *session, uint8_t tick, uint8_t counter, unsigned *missed);
        /* Senses have come. Fresh: they are the next ones, and *missed is the number of ticks that were left out. Again:
           in lockstep, those of the last tick. */

enum arrival session_request(struct session *session, const struct request *request, enum result *why);
        /* A whole COMMAND has come. Fresh: it is to be carried out, and is session->request now. Again: it is that one, once
           more. Stale: it is refused, and *why says why. */

void session_executed(struct session *session, enum result result);
        /* session->request has been carried out, or refused by the robot. */

void session_end(struct session *session);
        /* The robot has been stopped: it has no owner, and any tick may come next. */

#endif
