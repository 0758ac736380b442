/* What is saved is loaded, and nothing else is. */
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <errno.h>

#include "file_store_rig.h"

TEST(nothing_was_ever_stored)
{
    assert_load_leaves_memory_alone(0);
}

TEST(what_was_saved_is_loaded)
{
    TEST_ASSERT_EQUAL_INT(0, file_store_save(path, OLD));
    assert_stored(OLD);
    TEST_ASSERT_EQUAL_INT(0, file_store_save(path, NEW));
    assert_stored(NEW);
}

TEST(the_file_is_the_bytes_alone)
{
    struct stat file;
    TEST_ASSERT_EQUAL_INT(0, file_store_save(path, NEW));

    TEST_ASSERT_EQUAL_INT(0, stat(path, &file));
    TEST_ASSERT_EQUAL_INT(CELL_COUNT, file.st_size);
}

TEST(everybody_may_read_the_file_and_its_owner_write_it)
{
    struct stat file;
    mode_t before = umask(0);
    TEST_ASSERT_EQUAL_INT(0, file_store_save(path, NEW));
    umask(before);

    TEST_ASSERT_EQUAL_INT(0, stat(path, &file));
    TEST_ASSERT_EQUAL_HEX(0644, file.st_mode & 0777);
}

TEST(the_folder_of_the_file_is_brought_to_the_disk_last)
{
    TEST_ASSERT_EQUAL_INT(0, file_store_save(path, NEW));
    TEST_ASSERT_EQUAL_STRING(folder, last_opened);
}

TEST(what_a_save_that_was_cut_off_left_beside_it_does_no_harm)
{
    const uint8_t left[2 * CELL_COUNT] = {9, 9, 9, 9, 9, 9, 9, 9, 9};
    write_file(left, sizeof left);
    TEST_ASSERT_EQUAL_INT(0, rename(path, fresh));
    TEST_ASSERT_EQUAL_INT(0, file_store_save(path, NEW));
    assert_stored(NEW);
}

TEST(a_robot_without_standard_input_stores_as_well)
{
    int input = dup(STDIN_FILENO);
    __real_close(STDIN_FILENO);
    TEST_ASSERT_EQUAL_INT(0, file_store_save(path, NEW));
    assert_stored(NEW);
    TEST_ASSERT_EQUAL_INT(STDIN_FILENO, dup2(input, STDIN_FILENO));
    __real_close(input);
}

TEST(a_file_of_another_size_is_no_memory)
{
    const size_t sizes[] = {0, 7, 9, 64};
    const uint8_t bytes[64] = {0};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        write_file(bytes, sizes[i]);
        assert_load_leaves_memory_alone(HAL_E_STORE);
    }
}

TEST(a_file_of_another_size_is_replaced_by_a_save)
{
    write_file("short", 5);
    TEST_ASSERT_EQUAL_INT(0, file_store_save(path, NEW));
    assert_stored(NEW);
}

TEST(a_folder_that_is_not_there_refuses_a_save)
{
    TEST_ASSERT_EQUAL_INT(HAL_E_STORE, file_store_save("/no/such/folder/memory", NEW));
}

TEST(a_path_too_long_refuses_a_save)
{
    char name[5000];
    memset(name, 'x', sizeof name);
    name[sizeof name - 1] = '\0';
    TEST_ASSERT_EQUAL_INT(HAL_E_STORE, file_store_save(name, NEW));
}

/* With the name of the file beside it, and with slashes beside each other, which are as one. */
TEST(a_path_may_be_as_long_as_the_system_knows)
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
