/* What the Python for musl wants, and a musl before 1.2.5 has not; and what Debian's zlib wants of glibc. */
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>

long preadv2(void)
{
    errno = ENOSYS;
    return -1;
}

long pwritev2(void)
{
    return preadv2();
}

int __vsnprintf_chk(char *out, size_t size, int flag, size_t room, const char *format, va_list arguments)
{
    (void)flag, (void)room;
    return vsnprintf(out, size, format, arguments);
}

int __snprintf_chk(char *out, size_t size, int flag, size_t room, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    int length = __vsnprintf_chk(out, size, flag, room, format, arguments);
    va_end(arguments);
    return length;
}
