/* The guard in a process of the robot's own, with the address sanitizer: a failure is printed and ends it. */
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/time.h>
#include <ucontext.h>
#include <unistd.h>

#include "host_sim/program/own/guard.h"

enum { ENDED = 3, NOTES_MAX = 4000, WAIT_US = 200000 };

void __sanitizer_symbolize_pc(void *code, const char *format, char *out, size_t size);
const char *__asan_default_options(void);
void __asan_on_error(void);
void note(const char *text, long value);

const char *__asan_default_options(void)
{
    return "detect_leaks=0:detect_stack_use_after_return=1:color=never";
}

/* The sanitizer has found an error, which it prints next: that may take longer than a decision. It does not know the
 * tick and the senses. */
void __asan_on_error(void)
{
    char when[GUARD_TEXT_MAX / 3];

    guard_watch(false);
    long tick = guard_when(when, sizeof when);
    printf("own: %ld , %s\n", tick, when);
    fflush(stdout);
}

/* Inlined functions of headers come first: the last of the places is in the user's file. */
void guard_place(const void *code, char *text, size_t size)
{
    char places[GUARD_TEXT_MAX] = "";
    const char *last = places;

    if (!code)
        return;
    __sanitizer_symbolize_pc((void *)code, "%S", places, sizeof places - 1);
    for (const char *next = places; next < places + sizeof places - 1 && *next; next += strlen(next) + 1)
        last = next;
    snprintf(text, size, "%s", last);
}

void guard_end(const char *text)
{
    printf("own: %s\n", text);
    fflush(stdout);
    _exit(ENDED);
}

static void too_long(int number, siginfo_t *info, void *context)
{
    const ucontext_t *at = context;
    const void *code = NULL;

    (void)number;
    (void)info;
#if defined(__x86_64__)
    code = (const void *)(at->uc_mcontext.gregs[REG_RIP] + 1);
#elif defined(__aarch64__)
    code = (const void *)(at->uc_mcontext.pc + 4);
#else
    (void)at;
#endif
    guard_fail(code, NULL, "a loop without an end: 0.2 s in one decision");
}

/* Limits the processor time of a decision: that ends empty loops, too, which take no branches. */
void guard_watch(bool on)
{
    static bool ready;
    const struct itimerval wait = {.it_value.tv_usec = on ? WAIT_US : 0};
    struct sigaction action;

    if (!ready) {
        memset(&action, 0, sizeof action);
        action.sa_sigaction = too_long;
        action.sa_flags = SA_SIGINFO;
        sigaction(SIGVTALRM, &action, NULL);
        ready = true;
    }
    setitimer(ITIMER_VIRTUAL, &wait, NULL);
}

void note(const char *text, long value)
{
    static int printed;

    if (printed < NOTES_MAX)
        printed += printf("> %.200s %ld\n", text, value);
    fflush(stdout);
}
