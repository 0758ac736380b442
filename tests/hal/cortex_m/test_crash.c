#include "hal/port/cortex_m/crash.h"
#include "tests/test.h"
#include "hal/port/cortex_m/core.h"
#include "octet.h"

volatile struct system_registers SCB;

/* r0..r3, r12, lr, pc, psr, somewhere in a stack */
static const uint32_t stack[16] = {[4] = 0x10, 0x11, 0x12, 0x13, 0x1C, 0x0800AAA1, 0x0800BBB2, 0x61000000};

void setUp(void)
{
    (void)crash_reset_cause(RESET_POWER_ON);
    SCB.cpuid = 0x412FC231;   /* Cortex-M3 r2p1 */
    SCB.cfsr = 0x8200;
    SCB.hfsr = 0x40000000;
    SCB.mmfar = 0xE000ED34;
    SCB.bfar = 0xDEADBEEF;
}

static void crash_at(const uint32_t *frame)
{
    crash_keep(CRASH_BUS_FAULT, frame, stack, stack + 16);
}

TEST(fault_registers_are_not_read_on_cortex_m0)
{
    SCB.cpuid = 0x410CC601;   /* Cortex-M0+ r0p1 */
    crash_at(&stack[4]);
    (void)crash_reset_cause(RESET_SOFTWARE);
    TEST_ASSERT_EQUAL_HEX32(0x0800BBB2, crash_last()->values[CRASH_PC]);
    for (unsigned i = CRASH_CFSR; i <= CRASH_BFAR; i++)
        TEST_ASSERT_EQUAL_HEX32(0, crash_last()->values[i]);
}

TEST(no_crash_is_known_after_power_on)
{
    TEST_ASSERT_NULL(crash_last());
}

TEST(crash_is_reported_after_software_reset)
{
    crash_at(&stack[4]);
    TEST_ASSERT_EQUAL(RESET_CRASH, crash_reset_cause(RESET_SOFTWARE));
    TEST_ASSERT_NOT_NULL(crash_last());
    TEST_ASSERT_EQUAL_UINT32(CRASH_BUS_FAULT, crash_last()->cause);
}

TEST(crash_saves_all_registers)
{
    const uint32_t *registers;

    crash_at(&stack[4]);
    (void)crash_reset_cause(RESET_SOFTWARE);
    registers = crash_last()->values;
    TEST_ASSERT_EQUAL_HEX32(0x10, registers[CRASH_R0]);
    TEST_ASSERT_EQUAL_HEX32(0x11, registers[CRASH_R1]);
    TEST_ASSERT_EQUAL_HEX32(0x12, registers[CRASH_R2]);
    TEST_ASSERT_EQUAL_HEX32(0x13, registers[CRASH_R3]);
    TEST_ASSERT_EQUAL_HEX32(0x1C, registers[CRASH_R12]);
    TEST_ASSERT_EQUAL_HEX32(0x0800AAA1, registers[CRASH_LR]);
    TEST_ASSERT_EQUAL_HEX32(0x0800BBB2, registers[CRASH_PC]);
    TEST_ASSERT_EQUAL_HEX32(0x61000000, registers[CRASH_PSR]);
    TEST_ASSERT_EQUAL_HEX32((uint32_t)(uintptr_t)&stack[4], registers[CRASH_SP]);
    TEST_ASSERT_EQUAL_HEX32(0x8200, registers[CRASH_CFSR]);
    TEST_ASSERT_EQUAL_HEX32(0x40000000, registers[CRASH_HFSR]);
    TEST_ASSERT_EQUAL_HEX32(0xE000ED34, registers[CRASH_MMFAR]);
    TEST_ASSERT_EQUAL_HEX32(0xDEADBEEF, registers[CRASH_BFAR]);
}

TEST(stack_pointer_outside_the_stack_is_not_dereferenced)
{
    static const uint32_t elsewhere[8] = {1, 2, 3, 4, 5, 6, 7, 8};

    crash_at(elsewhere);
    (void)crash_reset_cause(RESET_SOFTWARE);
    TEST_ASSERT_EQUAL_HEX32((uint32_t)(uintptr_t)elsewhere, crash_last()->values[CRASH_SP]);
    TEST_ASSERT_EQUAL_HEX32(0, crash_last()->values[CRASH_PC]);
}

TEST(exception_frame_below_the_stack_is_not_read)
{
    crash_keep(CRASH_BUS_FAULT, &stack[4], stack + 5, stack + 16);
    (void)crash_reset_cause(RESET_SOFTWARE);
    TEST_ASSERT_EQUAL_HEX32(0, crash_last()->values[CRASH_R0]);
}

TEST(exception_frame_beyond_the_stack_end_is_not_read)
{
    crash_at(&stack[9]);
    (void)crash_reset_cause(RESET_SOFTWARE);
    TEST_ASSERT_EQUAL_HEX32(0, crash_last()->values[CRASH_R0]);
}

/* A runaway stack pointer: less room than a frame takes before addresses wrap to 0. */
TEST(exception_frame_at_the_last_address_is_not_read)
{
    crash_at((const uint32_t *)(UINTPTR_MAX - 7u));
    (void)crash_reset_cause(RESET_SOFTWARE);
    TEST_ASSERT_EQUAL_HEX32(UINT32_MAX - 7u, crash_last()->values[CRASH_SP]);
    TEST_ASSERT_EQUAL_HEX32(0, crash_last()->values[CRASH_R0]);
}

TEST(exception_frame_that_just_fits_is_read)
{
    crash_keep(CRASH_BUS_FAULT, &stack[4], &stack[4], &stack[12]);
    (void)crash_reset_cause(RESET_SOFTWARE);
    TEST_ASSERT_EQUAL_HEX32(0x10, crash_last()->values[CRASH_R0]);
    TEST_ASSERT_EQUAL_HEX32(0x61000000, crash_last()->values[CRASH_PSR]);
}

/* RAM may keep its contents through a short loss of power. */
TEST(power_on_erases_the_crash_for_later_resets)
{
    crash_at(&stack[4]);
    (void)crash_reset_cause(RESET_POWER_ON);
    TEST_ASSERT_EQUAL(RESET_SOFTWARE, crash_reset_cause(RESET_SOFTWARE));
    TEST_ASSERT_NULL(crash_last());
    crash_at(&stack[4]);
    (void)crash_reset_cause(RESET_SOFTWARE);
    (void)crash_reset_cause(RESET_POWER_ON);
    TEST_ASSERT_NULL(crash_last());
}

TEST(old_crash_stays_known_but_is_not_the_reset_cause)
{
    crash_at(&stack[4]);
    (void)crash_reset_cause(RESET_SOFTWARE);
    TEST_ASSERT_EQUAL(RESET_SOFTWARE, crash_reset_cause(RESET_SOFTWARE));
    TEST_ASSERT_NOT_NULL(crash_last());
}

TEST(power_on_erases_the_crash)
{
    crash_at(&stack[4]);
    TEST_ASSERT_EQUAL(RESET_POWER_ON, crash_reset_cause(RESET_POWER_ON));
    TEST_ASSERT_NULL(crash_last());
}

TEST(other_reset_causes_are_unchanged)
{
    static const enum reset_cause causes[] = {RESET_PIN, RESET_WATCHDOG, RESET_SOFTWARE, RESET_POWER_ON};

    for (unsigned i = 0; i < sizeof causes / sizeof causes[0]; i++)
        TEST_ASSERT_EQUAL(causes[i], crash_reset_cause(causes[i]));
}

TEST(pin_reset_keeps_the_crash)
{
    crash_at(&stack[4]);
    TEST_ASSERT_EQUAL(RESET_PIN, crash_reset_cause(RESET_PIN));
    TEST_ASSERT_NOT_NULL(crash_last());
}

TEST(crash_has_as_many_values_as_the_dbc)
{
    crash_at(&stack[4]);
    (void)crash_reset_cause(RESET_SOFTWARE);
    TEST_ASSERT_EQUAL_UINT8(CRASH_REGISTER_COUNT, crash_last()->count);
    TEST_ASSERT_EQUAL(CRASH_VALUES_MAX, CRASH_REGISTER_COUNT);
}

TEST(crash_causes_and_registers_match_the_dbc)
{
    TEST_ASSERT_EQUAL(OCTET_CRASH_CAUSE_NMI_CHOICE, CRASH_NMI);
    TEST_ASSERT_EQUAL(OCTET_CRASH_CAUSE_HARD_FAULT_CHOICE, CRASH_HARD_FAULT);
    TEST_ASSERT_EQUAL(OCTET_CRASH_CAUSE_MEMORY_FAULT_CHOICE, CRASH_MEMORY_FAULT);
    TEST_ASSERT_EQUAL(OCTET_CRASH_CAUSE_BUS_FAULT_CHOICE, CRASH_BUS_FAULT);
    TEST_ASSERT_EQUAL(OCTET_CRASH_CAUSE_USAGE_FAULT_CHOICE, CRASH_USAGE_FAULT);
    TEST_ASSERT_EQUAL(OCTET_CRASH_NAME_PC_CHOICE, CRASH_PC);
    TEST_ASSERT_EQUAL(OCTET_CRASH_NAME_LR_CHOICE, CRASH_LR);
    TEST_ASSERT_EQUAL(OCTET_CRASH_NAME_PSR_CHOICE, CRASH_PSR);
    TEST_ASSERT_EQUAL(OCTET_CRASH_NAME_SP_CHOICE, CRASH_SP);
    TEST_ASSERT_EQUAL(OCTET_CRASH_NAME_R0_CHOICE, CRASH_R0);
    TEST_ASSERT_EQUAL(OCTET_CRASH_NAME_R1_CHOICE, CRASH_R1);
    TEST_ASSERT_EQUAL(OCTET_CRASH_NAME_R2_CHOICE, CRASH_R2);
    TEST_ASSERT_EQUAL(OCTET_CRASH_NAME_R3_CHOICE, CRASH_R3);
    TEST_ASSERT_EQUAL(OCTET_CRASH_NAME_R12_CHOICE, CRASH_R12);
    TEST_ASSERT_EQUAL(OCTET_CRASH_NAME_CFSR_CHOICE, CRASH_CFSR);
    TEST_ASSERT_EQUAL(OCTET_CRASH_NAME_HFSR_CHOICE, CRASH_HFSR);
    TEST_ASSERT_EQUAL(OCTET_CRASH_NAME_MMFAR_CHOICE, CRASH_MMFAR);
    TEST_ASSERT_EQUAL(OCTET_CRASH_NAME_BFAR_CHOICE, CRASH_BFAR);
}
