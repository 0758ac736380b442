#include "open_listening.h"

#include <errno.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#include <unity.h>

static const uint16_t IDS[LINK_IDS_MAX + 1];

char printed[PRINTED_MAX];

/* Stderr goes to a private file. */
int open_listening(struct link **link, const char *name, size_t id_count)
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

int open_descriptors(void)
{
    struct stat status;
    int count = 0;
    for (int fd = 0; fd < 64; fd++) count += fstat(fd, &status) == 0;
    return count;
}
