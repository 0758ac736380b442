/* open_listening.h: opening a link, and what it says of that on stderr. */
#ifndef OCTET_OPEN_LISTENING_H
#define OCTET_OPEN_LISTENING_H

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/test.h"
#include "hal/link/link.h"

enum { PRINTED_MAX = 2 * PATH_MAX };

static char printed[PRINTED_MAX];   /* by the last open */

static const uint16_t IDS[LINK_IDS_MAX + 1];

/* As link_open, for so many identifiers. Stderr goes to a private file. */
static inline int open_listening(struct link **link, const char *name, size_t id_count)
{
    int console = dup(STDERR_FILENO);
    FILE *captured = tmpfile();
    TEST_ASSERT_NOT_NULL(captured);
    dup2(fileno(captured), STDERR_FILENO);
    errno = ERANGE;   /* of something that failed before */
    int result = link_open(link, name, IDS, id_count);
    dup2(console, STDERR_FILENO);
    close(console);
    rewind(captured);
    printed[fread(printed, 1, sizeof printed - 1, captured)] = '\0';
    fclose(captured);
    return result;
}

/* How many there are. */
static inline int open_descriptors(void)
{
    struct stat status;
    int count = 0;
    for (int fd = 0; fd < 64; fd++) count += fstat(fd, &status) == 0;
    return count;
}

#endif
