/* Selects the active mutant and records the sites reached; linked into each test program that contains mutants.

   OCTET_MUTANT         number of the active mutant; without it, none is active
   OCTET_MUTANT_TRACE   file with a byte for each mutant number; each site reached sets the byte of its first mutant
   OCTET_MUTANT_CPU_MS  limit of processor time, which ends an endless loop */
#define _GNU_SOURCE
#include <fcntl.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <unistd.h>

static unsigned acting;
static unsigned char *reached;

unsigned mutant_at(unsigned first, unsigned count);

unsigned mutant_at(unsigned first, unsigned count)
{
    if (reached)
        reached[first] = 1;
    return acting - first < count ? acting - first + 1 : 0;
}

static unsigned number(const char *name)
{
    const char *text = getenv(name);

    return text ? (unsigned)strtoul(text, NULL, 10) : 0;
}

/* Direct system calls, because tests replace open and similar functions. */
static void trace(const char *path)
{
    long file = syscall(SYS_openat, AT_FDCWD, path, O_RDWR | O_CLOEXEC, 0);
    long size = file < 0 ? 0 : syscall(SYS_lseek, file, 0, SEEK_END);

    if (size <= 0)
        abort();
    reached = (unsigned char *)syscall(SYS_mmap, 0, size, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    syscall(SYS_close, file);
}

static void limit(unsigned cpu_ms)
{
    struct itimerval timer = {.it_value = {cpu_ms / 1000, cpu_ms % 1000 * 1000}};
    struct rlimit whole = {cpu_ms / 1000 + 2, cpu_ms / 1000 + 2};   /* for children, which have no timer */

    setitimer(ITIMER_PROF, &timer, NULL);
    setrlimit(RLIMIT_CPU, &whole);
}

__attribute__((constructor)) static void begin(void)
{
    const char *path = getenv("OCTET_MUTANT_TRACE");

    acting = number("OCTET_MUTANT");
    if (path)
        trace(path);
    if (number("OCTET_MUTANT_CPU_MS"))
        limit(number("OCTET_MUTANT_CPU_MS"));
}
