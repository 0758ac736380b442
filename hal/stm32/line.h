/* line.h: for those who keep the machine busy for longer than a byte takes on a serial line. */
#ifndef OCTET_LINE_H
#define OCTET_LINE_H

void line_pump(void);
        /* Takes in what the link has received so far, where it would be lost otherwise. A byte takes 87 us. */

#endif
