#include "open_listening.h"

#include <errno.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#include <unity.h>

static const uint16_t IDS[LINK_IDS_MAX + 1];

char said[SAID_MAX];

/* Stderr goes to a file that nobody else sees. */
int open_listening(struct link **link, const char *name, size_t id_count)
{
    int console = dup(STDERR_FILENO);
    FILE *heard = tmpfile();
    TEST_ASSERT_NOT_NULL(heard);
    dup2(fileno(heard), STDERR_FILENO);
    errno = ERANGE;   /* of something that failed before */
    int result = link_open(link, name, IDS, id_count);
    dup2(console, STDERR_FILENO);
    close(console);
    rewind(heard);
    said[fread(said, 1, sizeof said - 1, heard)] = '\0';
    fclose(heard);
    return result;
}

int open_descriptors(void)
{
    struct stat status;
    int count = 0;
    for (int fd = 0; fd < 64; fd++) count += fstat(fd, &status) == 0;
    return count;
}
