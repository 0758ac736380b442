/* line.h: for code that busies the core for longer than a byte takes on a serial line. */
#ifndef OCTET_LINE_H
#define OCTET_LINE_H

void line_pump(void);
        /* Buffers what the link has received so far, if it would be lost otherwise. A byte takes 87 us. */

#endif
