/* session.h: the session: which sender the robot obeys, and which tick comes next. */
#ifndef OCTET_SESSION_H
#define OCTET_SESSION_H

#include "firmware/io.h"

enum { SESSION_WINDOW = 14 };   /* how many ticks ahead of the last are accepted in real time */

/* A COMMAND as it was sent. */
struct request {
    struct command command;   /* what the robot is to do */
    uint8_t counter;
    uint8_t owner;            /* who asks for it */
    bool lockstep;            /* start: lockstep instead of real time */
};

struct session {
    struct request request; /* the last one accepted, */
    bool knows_request;     /* if there was one */
    uint8_t owner;          /* who started the robot; 0 if it was not started */
    bool hears;             /* the owner's senses are arriving */
    bool lockstep;          /* the owner's clock counts, not the robot's */
    bool knows_tick;        /* false: any tick is accepted next */
    uint8_t tick;           /* of the last senses accepted, */
    uint8_t counter;        /* and their alive counter */
    uint32_t told;          /* CRC-32 over the commands carried out since a stop without an owner, and over senses
                               for a tick that had others, */
    uint32_t telling;       /* and what it becomes once the request is carried out */
    uint8_t told_opcodes;   /* the sum of those commands' opcodes */
    uint32_t heard;         /* CRC-32 over the senses taken since the owner has started the robot, each combined with
                               the drive before them */
};

enum arrival { ARRIVAL_FRESH, ARRIVAL_AGAIN, ARRIVAL_STALE };

enum arrival session_senses(struct session *session, uint8_t tick, uint8_t counter, unsigned *missed);
        /* Judges received senses. Fresh: they are the next ones, and *missed is the number of ticks skipped. Again:
           in lockstep, those of the last tick, repeated. */

enum arrival session_request(struct session *session, const struct request *request, enum result *why);
        /* Judges a received valid COMMAND. Fresh: it is now session->request, to be carried out. Again: the same
           request, repeated. Stale: it is refused, and *why says why. */

void session_executed(struct session *session, enum result result);
        /* Notes that session->request was carried out, or refused by the robot. */

void session_end(struct session *session);
        /* Notes that the robot was stopped: it has no owner, and any tick may come next. */

#endif
