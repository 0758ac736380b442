/* test.h: TEST(name) { ... } is a test: test_name, which runs because it is there. Tests run in the order of their lines;
 * setUp and tearDown may be left out. A program's tests are in one file; its main is in test.c. */
#ifndef OCTET_TEST_H
#define OCTET_TEST_H

#include <stdbool.h>
#include <stddef.h>

#include <unity.h>

struct test {
    const char *file, *name;
    int line;
    void (*run)(void);
    bool (*applies)(void);   /* null: always */
    bool is_preparation;
    struct test *next;
};

void test_register(struct test *test);

int tests_run(void);
        /* Runs those that apply; the exit code: 0, or 1 if one failed or if there was none. */

#define TEST(name) TEST_IF(name, NULL)

/* A test that is run only where bool condition(void) holds. */
#define TEST_IF(name, condition) \
    static void test_##name(void); \
    __attribute__((constructor)) static void register_##name(void) \
    { \
        static struct test test = {__FILE__, "test_" #name, __LINE__, test_##name, condition, false, NULL}; \
        test_register(&test); \
    } \
    static void test_##name(void)

/* BEFORE_EACH(name) { ... } runs before each test below it in the file, down to the next BEFORE_EACH; after setUp.
 * A test may call it again: prepare_name(). */
#define BEFORE_EACH(name) \
    static void prepare_##name(void); \
    __attribute__((constructor)) static void register_##name(void) \
    { \
        static struct test test = {__FILE__, #name, __LINE__, prepare_##name, NULL, true, NULL}; \
        test_register(&test); \
    } \
    static void prepare_##name(void)

#endif
