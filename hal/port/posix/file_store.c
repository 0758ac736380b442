#include "hal/port/posix/file_store.h"

#include <errno.h>
#include <fcntl.h>
#include <libgen.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

int file_store_load(const char *path, uint8_t memory[CELL_COUNT])
{
    uint8_t bytes[CELL_COUNT + 1];   /* one more, to notice a longer file */
    int fd = open(path, O_RDONLY | O_CLOEXEC);
    if (fd < 0)
        return errno == ENOENT ? 0 : HAL_E_STORE;
    ssize_t got = read(fd, bytes, sizeof bytes);
    close(fd);
    if (got != CELL_COUNT)
        return HAL_E_STORE;
    memcpy(memory, bytes, CELL_COUNT);
    return 1;
}

/* Writes and syncs, so that the data is on the disk. */
static int write_whole(const char *path, const uint8_t memory[CELL_COUNT])
{
    int fd = open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (fd < 0)
        return -1;
    bool done = write(fd, memory, CELL_COUNT) == CELL_COUNT && fsync(fd) == 0;
    return close(fd) == 0 && done ? 0 : -1;
}

/* Replaces the file atomically: a reader finds the old or the new one. */
static int replace(const char *path, const uint8_t memory[CELL_COUNT])
{
    char fresh[PATH_MAX];
    if (snprintf(fresh, sizeof fresh, "%s.new", path) >= (int)sizeof fresh)
        return -1;
    if (write_whole(fresh, memory) == 0 && rename(fresh, path) == 0)
        return 0;
    unlink(fresh);
    return -1;
}

/* Syncs the directory; only then is the rename durable. */
static int sync_folder(const char *path)
{
    char copy[PATH_MAX] = {0};   /* modified by dirname */
    snprintf(copy, sizeof copy, "%s", path);
    int fd = open(dirname(copy), O_RDONLY | O_CLOEXEC);
    if (fd < 0)
        return -1;
    int result = fsync(fd);
    close(fd);
    return result;
}

int file_store_save(const char *path, const uint8_t memory[CELL_COUNT])
{
    uint8_t old[CELL_COUNT];
    int had = file_store_load(path, old);
    if (replace(path, memory) != 0)
        return HAL_E_STORE;
    if (sync_folder(path) == 0)
        return 0;
    if (had == 1)
        replace(path, old);   /* a refused save must leave the old memory */
    if (had == 0)
        unlink(path);
    return HAL_E_STORE;
}
