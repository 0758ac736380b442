#include "tests/test.h"

static struct test *first;

void test_register(struct test *test)
{
    struct test **at = &first;

    while (*at != NULL && (*at)->line < test->line)
        at = &(*at)->next;
    test->next = *at;
    *at = test;
}

int tests_run(void)
{
    UnityBegin(first == NULL ? "" : first->file);
    for (const struct test *test = first; test != NULL; test = test->next)
        if (test->applies == NULL || test->applies())
            UnityDefaultTestRun(test->run, test->name, test->line);
    return UNITY_END() != 0 || Unity.NumberOfTests == 0;
}

/* What a test file may have of its own. */
__attribute__((weak)) void setUp(void) {}
__attribute__((weak)) void tearDown(void) {}

__attribute__((weak)) int main(void)
{
    return tests_run();
}
