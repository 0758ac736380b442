/* The store against a disk that fails at the n-th call, for every n. */
#include <errno.h>
#include <stdio.h>
#include <unistd.h>

#include "file_store_rig.h"

TEST(a_file_that_cannot_be_read_is_no_memory)
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

TEST(a_refused_save_leaves_the_old_memory)
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

TEST(a_refused_first_save_leaves_nothing)
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

TEST(a_refused_save_over_what_is_no_memory_makes_none_up)
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
