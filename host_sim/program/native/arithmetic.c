#include "host_sim/program/native/machine.h"

enum { SHIFT_MAX = 31 };

int32_t machine_whole(double number)
{
    if (number >= INT32_MAX)
        return INT32_MAX;
    return number > INT32_MIN ? (int32_t)number : number <= INT32_MIN ? INT32_MIN : 0;   /* NaN becomes 0 */
}

static uint32_t bits(double number)
{
    return (uint32_t)machine_whole(number);
}

static unsigned places(double number)
{
    int32_t whole = machine_whole(number);

    return whole < 0 ? 0u : whole > SHIFT_MAX ? (unsigned)SHIFT_MAX : (unsigned)whole;
}

static double compared(enum operation operation, double a, double b)
{
    switch (operation) {
    case DO_OR:
        return a != 0 || b != 0;
    case DO_AND:
        return a != 0 && b != 0;
    case DO_EQUAL:
        return a == b;
    case DO_UNEQUAL:
        return a != b;
    case DO_LESS:
        return a < b;
    case DO_LESS_EQUAL:
        return a <= b;
    case DO_GREATER:
        return a > b;
    default:
        return a >= b;
    }
}

static double of_bits(enum operation operation, double a, double b)
{
    switch (operation) {
    case DO_BIT_OR:
        return (int32_t)(bits(a) | bits(b));
    case DO_BIT_AND:
        return (int32_t)(bits(a) & bits(b));
    case DO_SHIFT_LEFT:
        return (int32_t)(bits(a) << places(b));
    default:
        return (int32_t)(bits(a) >> places(b));
    }
}

static double divided(struct machine *machine, enum operation operation, double a, double b)
{
    int64_t divisor = machine_whole(b);

    if (operation == DO_DIVIDE ? b == 0 : divisor == 0) {
        machine_fail(machine, EXPECTED_DIVISOR);
        return 0;
    }
    return operation == DO_DIVIDE ? a / b : (double)(machine_whole(a) % divisor);
}

double machine_operate(struct machine *machine, enum operation operation, double a, double b)
{
    if (operation <= DO_GREATER_EQUAL)
        return compared(operation, a, b);
    if (operation <= DO_SHIFT_RIGHT)
        return of_bits(operation, a, b);
    switch (operation) {
    case DO_ADD:
        return a + b;
    case DO_SUBTRACT:
        return a - b;
    case DO_MULTIPLY:
        return a * b;
    case DO_NEGATE:
        return -b;
    case DO_NOT:
        return b == 0;
    default:
        return divided(machine, operation, a, b);
    }
}
