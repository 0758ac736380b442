/* slcan.h: CAN frames as lines of text, in the format of Lawicel's adapters, over any byte stream.
 *
 *   tIIILDD...        data, 11-bit identifier        III, IIIIIIII: the identifier. L: 0..8, how many bytes.
 *   TIIIIIIIILDD...   data, 29-bit identifier        DD: a byte. All are hex digits.
 *   rIIIL             remote request, 11-bit         Four digits of time may follow.
 *   RIIIIIIIIL        remote request, 29-bit         CR ends each line. */
#ifndef OCTET_SLCAN_H
#define OCTET_SLCAN_H

#include "hal/link/link.h"

enum {
    SLCAN_LINE_MAX = 30,   /* T, identifier, length, eight bytes, time */
    SLCAN_TEXT_MAX = 32    /* room for any line that slcan_encode writes */
};

enum slcan_found { SLCAN_NOTHING, SLCAN_FRAME, SLCAN_GARBLED };

struct slcan_decoder {     /* all zero: at the start of a line */
    char line[SLCAN_LINE_MAX];
    uint8_t len;           /* of the line so far; above SLCAN_LINE_MAX: too long, skip to its end */
};

enum slcan_found slcan_decode(struct slcan_decoder *decoder, char byte, struct frame *out);
        /* Takes the next byte. SLCAN_FRAME: it completed the line of a frame, now in *out. SLCAN_GARBLED: it ended an
           invalid line; reported only at the end, so once per line. SLCAN_NOTHING: it is inside a line, or ended a
           reply or a set-up command, which are ignored. */

size_t slcan_encode(char text[SLCAN_TEXT_MAX], const struct frame *frame);
        /* Writes the line of a frame with a length of 0..8: upper case, with CR, without NUL. Returns its length. */

#endif
