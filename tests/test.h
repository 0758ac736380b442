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
        static struct test test = {__FILE__, "test_" #name, __LINE__, test_##name, condition, NULL}; \
        test_register(&test); \
    } \
    static void test_##name(void)

#endif
