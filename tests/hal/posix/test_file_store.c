/* The file store loads only what it saved. */
#include "tests/test.h"
#include "hal/port/posix/file_store.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* A file store in a folder of its own, on a disk whose n-th call can fail. After each test, every file is
   closed, and nothing is left but the memory. */

int __real_close(int fd);
        /* A call that does not count. */

static const uint8_t OLD[] = {0, 1, 2, 3, 4, 5, 6, 7};
static const uint8_t NEW[] = {7, 6, 5, 4, 3, 2, 1, 0};

static char folder[32], path[64], fresh[64], last_opened[PATH_MAX];
static int calls, fail_at, error;   /* of the system so far; the one that fails, or 0; and why */
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

static bool should_fail(void)
{
    errno = error;
    return ++calls == fail_at;
}

/* A process that is started meanwhile must not inherit the file. */
int __wrap_open(const char *name, int flags, ...)
{
    TEST_ASSERT_EQUAL_HEX(O_CLOEXEC, flags & O_CLOEXEC);
    va_list arguments;
    va_start(arguments, flags);
    snprintf(last_opened, sizeof last_opened, "%s", name);
    mode_t mode = flags & O_CREAT ? va_arg(arguments, mode_t) : 0;
    va_end(arguments);
    return should_fail() ? -1 : __real_open(name, flags, mode);
}

ssize_t __wrap_read(int fd, void *to, size_t size)
{
    return should_fail() ? -1 : __real_read(fd, to, size);
}

/* The disk is full half way through. */
ssize_t __wrap_write(int fd, const void *from, size_t size)
{
    return __real_write(fd, from, should_fail() ? size / 2 : size);
}

int __wrap_fsync(int fd)
{
    return should_fail() ? -1 : __real_fsync(fd);
}

int __wrap_close(int fd)
{
    int result = __real_close(fd);
    return should_fail() ? -1 : result;
}

int __wrap_rename(const char *from, const char *to)
{
    return should_fail() ? -1 : __real_rename(from, to);
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

/* Puts them where the memory is. */
static void write_file(const void *bytes, size_t size)
{
    FILE *file = fopen(path, "wb");
    TEST_ASSERT_NOT_NULL(file);
    TEST_ASSERT_EQUAL_size_t(size, fwrite(bytes, 1, size, file));
    TEST_ASSERT_EQUAL_INT(0, fclose(file));
}

static void assert_stored(const uint8_t expected[CELL_COUNT])
{
    uint8_t memory[CELL_COUNT] = {0};
    TEST_ASSERT_EQUAL_INT(1, file_store_load(path, memory));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, memory, CELL_COUNT);
}

/* Loading gives this result, and writes nothing. */
static void assert_load_leaves_memory_alone(int expected)
{
    uint8_t memory[CELL_COUNT];
    memset(memory, 0xEE, sizeof memory);
    TEST_ASSERT_EQUAL_INT(expected, file_store_load(path, memory));
    TEST_ASSERT_EACH_EQUAL_HEX8(0xEE, memory, CELL_COUNT);
}

TEST(load_without_a_file_leaves_the_memory_unchanged)
{
    assert_load_leaves_memory_alone(0);
}

TEST(saved_memory_is_loaded_from_the_file)
{
    TEST_ASSERT_EQUAL_INT(0, file_store_save(path, OLD));
    assert_stored(OLD);
    TEST_ASSERT_EQUAL_INT(0, file_store_save(path, NEW));
    assert_stored(NEW);
}

TEST(memory_file_holds_only_the_eight_bytes)
{
    struct stat file;
    TEST_ASSERT_EQUAL_INT(0, file_store_save(path, NEW));

    TEST_ASSERT_EQUAL_INT(0, stat(path, &file));
    TEST_ASSERT_EQUAL_INT(CELL_COUNT, file.st_size);
}

TEST(memory_file_has_mode_0644)
{
    struct stat file;
    mode_t before = umask(0);
    TEST_ASSERT_EQUAL_INT(0, file_store_save(path, NEW));
    umask(before);

    TEST_ASSERT_EQUAL_INT(0, stat(path, &file));
    TEST_ASSERT_EQUAL_HEX(0644, file.st_mode & 0777);
}

TEST(save_opens_the_folder_last)
{
    TEST_ASSERT_EQUAL_INT(0, file_store_save(path, NEW));
    TEST_ASSERT_EQUAL_STRING(folder, last_opened);
}

TEST(leftover_of_an_interrupted_save_is_replaced)
{
    const uint8_t left[2 * CELL_COUNT] = {9, 9, 9, 9, 9, 9, 9, 9, 9};
    write_file(left, sizeof left);
    TEST_ASSERT_EQUAL_INT(0, rename(path, fresh));
    TEST_ASSERT_EQUAL_INT(0, file_store_save(path, NEW));
    assert_stored(NEW);
}

TEST(save_works_without_standard_input)
{
    int input = dup(STDIN_FILENO);
    __real_close(STDIN_FILENO);
    TEST_ASSERT_EQUAL_INT(0, file_store_save(path, NEW));
    assert_stored(NEW);
    TEST_ASSERT_EQUAL_INT(STDIN_FILENO, dup2(input, STDIN_FILENO));
    __real_close(input);
}

TEST(file_of_wrong_size_is_no_memory)
{
    const size_t sizes[] = {0, 7, 9, 64};
    const uint8_t bytes[64] = {0};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        write_file(bytes, sizes[i]);
        assert_load_leaves_memory_alone(HAL_E_STORE);
    }
}

TEST(save_replaces_a_file_of_wrong_size)
{
    write_file("short", 5);
    TEST_ASSERT_EQUAL_INT(0, file_store_save(path, NEW));
    assert_stored(NEW);
}

TEST(save_into_a_missing_folder_fails)
{
    TEST_ASSERT_EQUAL_INT(HAL_E_STORE, file_store_save("/no/such/folder/memory", NEW));
}

TEST(save_to_an_overlong_path_fails)
{
    char name[5000];
    memset(name, 'x', sizeof name);
    name[sizeof name - 1] = '\0';
    TEST_ASSERT_EQUAL_INT(HAL_E_STORE, file_store_save(name, NEW));
}

/* Including the name of the temporary file; repeated slashes count as one. */
TEST(save_path_length_is_limited_by_path_max)
{
    const char end[] = "/memory";
    char name[PATH_MAX];
    for (size_t len = PATH_MAX - sizeof ".new"; len <= PATH_MAX - sizeof ".new" + 2; len++) {
        bool fits = len + sizeof ".new" <= PATH_MAX;
        memset(name, '/', sizeof name);
        memcpy(name, folder, strlen(folder));
        strcpy(name + len - strlen(end), end);
        TEST_ASSERT_EQUAL_INT(fits ? 0 : HAL_E_STORE, file_store_save(name, NEW));
        if (fits) assert_stored(NEW);
    }
}

/* The store against a disk that fails at the n-th call, for every n. */

TEST(unreadable_file_is_no_memory)
{
    const int errors[] = {EPERM, EIO, EACCES};
    write_file(OLD, CELL_COUNT);
    for (int n = 0; n < 6; n++) {
        calls = 0;
        fail_at = n % 2 + 1;   /* open, read */
        error = errors[n / 2];
        assert_load_leaves_memory_alone(HAL_E_STORE);
    }
}

/* Saves NEW with the n-th call failing, and nothing left beside the file; false: there are fewer than n. */
static bool save_fails_at(int n, int *result)
{
    calls = 0;
    fail_at = n;
    *result = file_store_save(path, NEW);
    fail_at = 0;
    TEST_ASSERT_EQUAL_INT(-1, access(fresh, F_OK));
    return calls >= n;
}

TEST(failed_save_leaves_the_old_memory)
{
    int result, refused = 0;
    write_file(OLD, CELL_COUNT);
    for (int n = 1; save_fails_at(n, &result); n++) {
        assert_stored(result == 0 ? NEW : OLD);
        refused += result == HAL_E_STORE;
        write_file(OLD, CELL_COUNT);
    }
    TEST_ASSERT_EQUAL_INT(7, refused);   /* open, write, fsync, close, rename; open and fsync of the folder */
}

TEST(failed_first_save_leaves_no_file)
{
    int result, refused = 0;
    for (int n = 2; save_fails_at(n, &result); n++) {
        if (result == 0) assert_stored(NEW);
        else assert_load_leaves_memory_alone(0);
        refused += result == HAL_E_STORE;
        unlink(path);
    }
    TEST_ASSERT_EQUAL_INT(7, refused);
}

TEST(failed_save_over_a_damaged_file_creates_no_memory)
{
    static const char rubbish[] = "short";
    int result;
    write_file(rubbish, sizeof rubbish);
    for (int n = 1; save_fails_at(n, &result); n++) {
        uint8_t memory[CELL_COUNT];
        FILE *file = fopen(path, "rb");
        TEST_ASSERT_NOT_NULL(file);
        size_t size = fread(memory, 1, sizeof memory, file);
        TEST_ASSERT_EQUAL_INT(0, fclose(file));
        TEST_ASSERT_EQUAL_MEMORY(size == CELL_COUNT ? (const void *)NEW : rubbish, memory, size);
        write_file(rubbish, sizeof rubbish);
    }
}
