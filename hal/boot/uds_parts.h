/* uds_parts.h: shared by the two halves of the implementation of uds.h, and by the UDS services of an image. */
#ifndef OCTET_UDS_PARTS_H
#define OCTET_UDS_PARTS_H

#include "hal/boot/uds.h"

/* Negative response codes, by ISO 14229-1 annex A. */
enum nrc {
    NRC_NONE = 0,
    NRC_SERVICE = 0x11, NRC_FUNCTION = 0x12, NRC_LENGTH = 0x13, NRC_BUSY = 0x21, NRC_CONDITIONS = 0x22,
    NRC_SEQUENCE = 0x24, NRC_RANGE = 0x31, NRC_LOCKED = 0x33, NRC_KEY = 0x35, NRC_TRIES = 0x36,
    NRC_DELAY = 0x37, NRC_FAILURE = 0x72, NRC_BLOCK = 0x73, NRC_PENDING = 0x78, NRC_SESSION = 0x7F
};

enum service {
    SESSION_CONTROL = 0x10, RESET = 0x11, READ = 0x22, SECURITY = 0x27, WRITE = 0x2E, ROUTINE = 0x31, DOWNLOAD = 0x34,
    TRANSFER = 0x36, TRANSFER_EXIT = 0x37, TESTER_PRESENT = 0x3E,
    POSITIVE = 0x40, NEGATIVE = 0x7F
};

enum {
    DEFAULT_SESSION = 1, PROGRAMMING_SESSION = 2,
    ID_LEN = 2,
    DID_SESSION = 0xF186
};

/* A request, and the answer to it; a positive one begins with the service plus POSITIVE. */
struct exchange {
    const uint8_t *request;
    uint16_t len;
    uint8_t *answer;
    uint16_t size;       /* of the answer so far */
    uint8_t function;
    bool quiet;          /* send only negative answers */
};

/* Functions of a service. */
enum { FUNCTION_0 = 1, FUNCTION_1 = 2, FUNCTION_2 = 4 };

/* What a service takes. */
enum { EXACT = 1 /* exactly as long as the shortest request */, PROGRAMMING = 2 /* session */, UNLOCKED = 4 };

struct entry {
    uint8_t service;
    uint8_t shortest;    /* request, bytes */
    uint8_t functions;   /* with which the answer begins; 0: it has none */
    uint8_t takes;
};

uint32_t uds_number(const uint8_t *bytes);
        /* A number from four bytes, big-endian as in all of UDS. */

void uds_put(struct exchange *exchange, uint32_t number, unsigned bytes);
        /* Appends to the answer. */

enum nrc uds_admit(const struct entry *entry, const struct entry *end, unsigned given, struct exchange *exchange);
        /* Begins the answer to a request if it meets the conditions of its entry. They are checked in the order of
           the standard. */

uint16_t uds_answer(struct exchange *exchange, enum nrc why);
uint16_t uds_refuse(uint8_t service, enum nrc why, uint8_t answer[]);
        /* The length of the answer, or 0 for none. */

void uds_put_times(struct exchange *exchange);
        /* Appends the end of the answer to DiagnosticSessionControl. */

enum nrc uds_routine(struct uds *uds, struct exchange *exchange);
enum nrc uds_download(struct uds *uds, struct exchange *exchange);
enum nrc uds_transfer(struct uds *uds, struct exchange *exchange);
enum nrc uds_transfer_exit(struct uds *uds);
        /* RoutineControl and so on, in an unlocked programming session. NRC_PENDING: uds_step will do it. */

enum nrc uds_step(struct uds *uds);
        /* A step of uds->work. NRC_PENDING: there is more to do. */

#endif
