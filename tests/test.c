#define _POSIX_C_SOURCE 200809L

#include "tests/test.h"

#include <unistd.h>

static struct test *first;
static pid_t running;   /* the process, during a test, else 0; a child of it may end at any time */

void test_register(struct test *test)
{
    struct test **at = &first;

    while (*at != NULL && (*at)->line < test->line)
        at = &(*at)->next;
    test->next = *at;
    *at = test;
}

__attribute__((destructor)) static void end(void)
{
    if (running != 0 && running == getpid())
        _exit(1);   /* a test has ended the program, perhaps by exit(0) */
}

static void (*prepare)(void), (*run)(void);

static void run_prepared(void)
{
    if (prepare != NULL)
        prepare();
    run();
}

int tests_run(void)
{
    running = getpid();
    UnityBegin(first == NULL ? "" : first->file);
    for (const struct test *test = first; test != NULL; test = test->next) {
        run = test->run;
        if (test->is_preparation)
            prepare = run;
        else if (test->applies == NULL || test->applies())
            UnityDefaultTestRun(run_prepared, test->name, test->line);
    }
    running = 0;
    return UNITY_END() != 0 || Unity.NumberOfTests == 0;
}

/* What a test file may have of its own. */
__attribute__((weak)) void setUp(void) {}
__attribute__((weak)) void tearDown(void) {}

__attribute__((weak)) int main(void)
{
    return tests_run();
}
