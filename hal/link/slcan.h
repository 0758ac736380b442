/* slcan.h: CAN frames as lines of text, as Lawicel's adapters write them. Bytes in, bytes out, whatever carries them.
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
    uint8_t len;           /* of the line so far; past SLCAN_LINE_MAX: too long, waiting for its end */
};

enum slcan_found slcan_decode(struct slcan_decoder *decoder, char byte, struct frame *out);
        /* Takes the next byte. SLCAN_FRAME: it completed the line of a frame, now in *out. SLCAN_GARBLED: it ended a
           line that makes no sense. SLCAN_NOTHING: inside a line, or it ended a reply or a set-up command, which mean
           nothing here. Only the end of a line counts, so that each bad line counts once. */

size_t slcan_encode(char text[SLCAN_TEXT_MAX], const struct frame *frame);
        /* The line of a frame with a length of 0..8, upper-case, with its CR and no NUL. How many characters. */

#endif
