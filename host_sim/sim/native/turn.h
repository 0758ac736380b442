/* turn.h: one robot's senses and answer in one tick. */
#ifndef OCTET_TURN_H
#define OCTET_TURN_H

#include "firmware/io.h"

struct turn {
    struct senses senses;
    struct drive drive;
};

#endif
