/* file_store_rig.h: a file store in a folder of its own, on a disk whose n-th call can fail. After each test, every file is
   closed, and nothing is left but the memory. */
#ifndef OCTET_FILE_STORE_RIG_H
#define OCTET_FILE_STORE_RIG_H

#include <limits.h>

#include "tests/test.h"
#include "hal/port/posix/file_store.h"

extern const uint8_t OLD[CELL_COUNT], NEW[CELL_COUNT];
extern char folder[32];
extern char path[64];                /* of the memory */
extern char fresh[64];               /* of the file beside it */
extern char last_opened[PATH_MAX];
extern int calls;                    /* of the system so far */
extern int fail_at;                  /* the call that fails; 0: none */
extern int error;                    /* and why */

int __real_close(int fd);
        /* A call that does not count. */

void write_file(const void *bytes, size_t size);
        /* Puts them where the memory is. */

void assert_stored(const uint8_t expected[CELL_COUNT]);

void assert_load_leaves_memory_alone(int expected);
        /* Loading gives this result, and writes nothing. */

#endif
