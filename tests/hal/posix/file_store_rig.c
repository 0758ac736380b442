#include "file_store_rig.h"

#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const uint8_t OLD[] = {0, 1, 2, 3, 4, 5, 6, 7};
const uint8_t NEW[] = {7, 6, 5, 4, 3, 2, 1, 0};

char folder[32], path[64], fresh[64], last_opened[PATH_MAX];
int calls, fail_at, error;
static int free_descriptor;

int __real_open(const char *name, int flags, ...);
int __wrap_open(const char *name, int flags, ...);
ssize_t __real_read(int fd, void *to, size_t size);
ssize_t __wrap_read(int fd, void *to, size_t size);
ssize_t __real_write(int fd, const void *from, size_t size);
ssize_t __wrap_write(int fd, const void *from, size_t size);
int __real_fsync(int fd);
int __wrap_fsync(int fd);
int __wrap_close(int fd);
int __real_rename(const char *from, const char *to);
int __wrap_rename(const char *from, const char *to);

static bool strikes(void)
{
    errno = error;
    return ++calls == fail_at;
}

/* No process that is started meanwhile is to inherit what is open. */
int __wrap_open(const char *name, int flags, ...)
{
    TEST_ASSERT_EQUAL_HEX(O_CLOEXEC, flags & O_CLOEXEC);
    va_list arguments;
    va_start(arguments, flags);
    snprintf(last_opened, sizeof last_opened, "%s", name);
    mode_t mode = flags & O_CREAT ? va_arg(arguments, mode_t) : 0;
    va_end(arguments);
    return strikes() ? -1 : __real_open(name, flags, mode);
}

ssize_t __wrap_read(int fd, void *to, size_t size)
{
    return strikes() ? -1 : __real_read(fd, to, size);
}

/* The disk is full half way through. */
ssize_t __wrap_write(int fd, const void *from, size_t size)
{
    return __real_write(fd, from, strikes() ? size / 2 : size);
}

int __wrap_fsync(int fd)
{
    return strikes() ? -1 : __real_fsync(fd);
}

int __wrap_close(int fd)
{
    int result = __real_close(fd);
    return strikes() ? -1 : result;
}

int __wrap_rename(const char *from, const char *to)
{
    return strikes() ? -1 : __real_rename(from, to);
}

static int next_descriptor(void)
{
    int fd = dup(STDERR_FILENO);
    __real_close(fd);
    return fd;
}

void setUp(void)
{
    fail_at = 0;
    error = EIO;
    free_descriptor = next_descriptor();
    strcpy(folder, "/tmp/octet-store-XXXXXX");
    TEST_ASSERT_NOT_NULL(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/memory", folder);
    snprintf(fresh, sizeof fresh, "%s/memory.new", folder);
}

void tearDown(void)
{
    fail_at = 0;
    TEST_ASSERT_EQUAL_INT(free_descriptor, next_descriptor());   /* each was closed */
    unlink(path);
    TEST_ASSERT_EQUAL_INT(0, rmdir(folder));   /* nothing else was left */
}

void write_file(const void *bytes, size_t size)
{
    FILE *file = fopen(path, "wb");
    TEST_ASSERT_NOT_NULL(file);
    TEST_ASSERT_EQUAL_size_t(size, fwrite(bytes, 1, size, file));
    TEST_ASSERT_EQUAL_INT(0, fclose(file));
}

void assert_stored(const uint8_t expected[CELL_COUNT])
{
    uint8_t memory[CELL_COUNT] = {0};
    TEST_ASSERT_EQUAL_INT(1, file_store_load(path, memory));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, memory, CELL_COUNT);
}

void assert_load_leaves_memory_alone(int expected)
{
    uint8_t memory[CELL_COUNT];
    memset(memory, 0xEE, sizeof memory);
    TEST_ASSERT_EQUAL_INT(expected, file_store_load(path, memory));
    TEST_ASSERT_EACH_EQUAL_HEX8(0xEE, memory, CELL_COUNT);
}
