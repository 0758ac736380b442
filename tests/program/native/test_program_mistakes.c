#include "tests/test.h"
#include "tests/program/native/program_rig.h"

#include <string.h>

void setUp(void)
{
    rig_reset();
}

static const struct {
    const char *text;
    unsigned line;
    const char *word;
    enum program_expected expected;
} mistakes[] = {
    {"rTrun 10", 1, "rTrun", EXPECTED_STATEMENT},
    {"x=1\n 5 = x", 2, "5", EXPECTED_STATEMENT},
    {"then", 1, "then", EXPECTED_STATEMENT},
    {"x = ", 1, "", EXPECTED_VALUE},
    {"x = while", 1, "while", EXPECTED_VALUE},
    {"x = rFell()", 1, "rFell", EXPECTED_VALUE},
    {"x = \"a\"", 1, "a", EXPECTED_NO_TEXT},
    {"x = 1 2", 1, "2", EXPECTED_LINE_END},
    {"if 1 x = 2", 1, "x", EXPECTED_LINE_END},
    {"x = (1 + 2", 1, "", EXPECTED_CLOSE},
    {"x = random(1", 1, "", EXPECTED_CLOSE},
    {"dim a[3]\nx = a[1", 2, "", EXPECTED_BRACKET},
    {"dim a", 1, "", EXPECTED_OPEN},
    {"dim a(3)", 1, "(", EXPECTED_OPEN},
    {"xyString 1,1,\"never ends\nx=1", 1, "never ends", EXPECTED_QUOTE},
    {"for i 1 to 2\nnext", 1, "1", EXPECTED_EQUALS},
    {"dim a[2]\na[1]", 2, "", EXPECTED_EQUALS},
    {"repeat\nx=2", 1, "repeat", EXPECTED_UNTIL},
    {"until 1", 1, "until", EXPECTED_REPEAT},
    {"while 1\nuntil 1", 2, "until", EXPECTED_REPEAT},
    {"if 1 then break", 1, "break", EXPECTED_LOOP},
    {"continue", 1, "continue", EXPECTED_LOOP},
    {"goto 10", 1, "10", EXPECTED_NAME},
    {"goto Nowhere", 1, "Nowhere", EXPECTED_LABEL},
    {"A:\ncall B()\nend\nsub B()\ngoto A", 5, "A", EXPECTED_NO_GOTO},
    {"if rFeel then rTurn 5", 1, "then", EXPECTED_BRACKETS},
    {"x = rRange(91)", 1, "x", EXPECTED_ANGLE},
    {"if 0 then n = 1\nx = n", 2, "n", EXPECTED_WRITTEN},
    {"n++", 1, "n", EXPECTED_WRITTEN},
    {"x = 0x", 1, "x", EXPECTED_LINE_END},
    {"x = a[0]\ndim a[2]", 1, "x", EXPECTED_WRITTEN},
    {"Circle 1,2,3,4", 1, "Circle", EXPECTED_NO_DRAWING},
    {"GetKey k", 1, "GetKey", EXPECTED_NO_KEYS},
    {"if rSense() then rTurn 5", 1, "rSense", EXPECTED_NO_SENSOR},
    {"rInvisible Green", 1, "rInvisible", EXPECTED_NO_SETTING},
    {"for i = 1\nnext", 1, "", EXPECTED_TO},
    {"for 1 = 1 to 2\nnext", 1, "1", EXPECTED_NAME},
    {"dim a[2]\nfor a[1] = 1 to 2\nnext", 2, "a", EXPECTED_NAME},
    {"rForward = 3", 1, "=", EXPECTED_VALUE},
    {"Green = 3", 1, "Green", EXPECTED_NAME},
    {"gosub 5", 1, "5", EXPECTED_NAME},
    {"call", 1, "", EXPECTED_NAME},
    {"sub", 1, "", EXPECTED_NAME},
    {"dim if[3]", 1, "if", EXPECTED_NAME},
    {"sub A(1)", 1, "1", EXPECTED_NAME},
    {"sub A(a,b,c,d,e,f,g,h,i)", 1, "i", EXPECTED_NAME},
    {"xyString 1", 1, "", EXPECTED_COMMA},
    {"x=1\nif x\nx=2", 2, "if", EXPECTED_ENDIF},
    {"while 1\nx=2", 1, "while", EXPECTED_WEND},
    {"for i = 1 to 2", 1, "for", EXPECTED_NEXT},
    {"while 1\nA:\nwend", 1, "while", EXPECTED_WEND},
    {"endif", 1, "endif", EXPECTED_IF},
    {"if 1\nelse\nelse\nendif", 3, "else", EXPECTED_IF},
    {"if 1\nwend", 2, "wend", EXPECTED_WHILE},
    {"next", 1, "next", EXPECTED_FOR},
    {"gosub Nowhere", 1, "Nowhere", EXPECTED_LABEL},
    {"call Nobody(1)", 1, "Nobody", EXPECTED_SUB},
    {"x = 1\ny = z", 2, "z", EXPECTED_GIVEN},
    {"a[1] = 2", 1, "a", EXPECTED_DIM},
    {"A:\nA:", 2, "A", EXPECTED_NEW_NAME},
    {"delay:", 1, "delay", EXPECTED_NEW_NAME},
    {"dim a[0]", 1, "0", EXPECTED_SIZE},
    {"dim a[x]", 1, "x", EXPECTED_SIZE},
    {"dim Mem[9]", 1, "9", EXPECTED_SIZE},
    {"dim a[1000]\ndim b[1000]", 2, "", EXPECTED_SHORTER},
    {"x = ((((((((((((((((((((((((((1))))))))))))))))))))))))))", 1, "(", EXPECTED_PLAIN},
    {"x = random()", 1, "random", EXPECTED_ONE_VALUE},
    {"x = rFeel(1)", 1, "rFeel", EXPECTED_NO_VALUE},
    {"rEat 1", 1, "rEat", EXPECTED_NO_VALUE},
    {"x = rLook(0, 0)", 1, "rLook", EXPECTED_AHEAD},
    {"rLocate 1", 1, "rLocate", EXPECTED_PLACE},
    {"rTurn", 1, "rTurn", EXPECTED_ONE_VALUE},
    {"rTurn 1,2", 1, "rTurn", EXPECTED_ONE_VALUE},
    {"rForw\xc3\xa4rts 5", 1, "rForw\xc3\xa4rts", EXPECTED_STATEMENT},
    {"x=1\ncall A(1)\nend\nsub A(a,b)\nreturn", 2, "A", EXPECTED_ARGUMENTS},
    {"x = 1\nsub A()", 2, "sub", EXPECTED_END},
    {"dim a[3]\nx = a[3]", 2, "x", EXPECTED_INDEX},
    {"dim a[3]\na[-1] = 1", 2, "a[-1]", EXPECTED_INDEX},
    {"Mem[2]=3", 1, "Mem[2]", EXPECTED_SIDE},
    {"Mem[0] = 1", 1, "Mem[0]", EXPECTED_SIDE},
    {"while 1\nwend", 1, "while", EXPECTED_ACTION},
    {"A:\ngosub A", 2, "gosub", EXPECTED_RETURN},
    {"call A(1)\nend\nsub A(x)\n  call A(x)", 4, "call", EXPECTED_RETURN},
    {"return", 1, "return", EXPECTED_GOSUB},
    {"x = 1 / 0", 1, "x", EXPECTED_DIVISOR},
    {"x = 1 mod 0.5", 1, "x", EXPECTED_DIVISOR},
    {"rTurn 721", 1, "rTurn", EXPECTED_DEGREES},
    {"rForward 801", 1, "rForward", EXPECTED_WAY},
    {"delay -1", 1, "delay", EXPECTED_DELAY},
    {"delay 60001", 1, "delay", EXPECTED_DELAY},
    {"x = random(0)", 1, "x", EXPECTED_CHOICES},
    {"x = rLook(45)", 1, "x", EXPECTED_AHEAD},
};

TEST(mistakes_are_reported_with_line_word_and_expectation)
{
    for (unsigned i = 0; i < sizeof mistakes / sizeof *mistakes; i++)
        rig_fails(mistakes[i].text, mistakes[i].line, mistakes[i].word, mistakes[i].expected);
}

TEST(every_expectation_has_a_mistake_in_the_table)
{
    bool seen[EXPECTED_COUNT] = {true};

    for (unsigned i = 0; i < sizeof mistakes / sizeof *mistakes; i++)
        seen[mistakes[i].expected] = true;
    for (unsigned i = 0; i < EXPECTED_COUNT; i++)
        TEST_ASSERT_TRUE_MESSAGE(seen[i], program_expected((uint8_t)i));
    TEST_ASSERT_EQUAL_STRING(program_expected(EXPECTED_NOTHING), program_expected(EXPECTED_COUNT));
}

/* Refuses a program of count copies of this text; ? and ! stand for letters that make names differ. */
static void assert_too_large(const char *before, const char *text, unsigned count, enum program_expected expected)
{
    static char all[2 * PROGRAM_TEXT_MAX];
    size_t used = strlen(strcpy(all, before));

    for (unsigned i = 0; i < count; i++) {
        size_t len = strlen(text);

        memcpy(all + used, text, len);
        for (char *at = all + used; (at = memchr(at, '?', len)) && at < all + used + len; at++)
            *at = (char)('a' + i % 26);
        for (char *at = all + used; (at = memchr(at, '!', len)) && at < all + used + len; at++)
            *at = (char)('a' + i / 26);
        used += len;
    }
    TEST_ASSERT_FALSE(program_compile(&program, all, used));
    TEST_ASSERT_EQUAL_STRING(program_expected((uint8_t)expected), program_expected(program.mistake.expected));
    TEST_ASSERT_EQUAL(REASON_PROGRAM, rig_next().reason);
}

TEST(programs_beyond_the_capacity_are_refused)
{
    assert_too_large("", "xxxxx = 12345678\n", 1200, EXPECTED_SHORTER);
    assert_too_large("", "x=1+1\n", 1000, EXPECTED_SHORTER);
    assert_too_large("", "!?x=1\n", 300, EXPECTED_SHORTER);
    assert_too_large("", "while 1\n", 40, EXPECTED_PLAIN);
}

TEST(too_many_numbers_are_refused)
{
    static char all[PROGRAM_TEXT_MAX];
    size_t used = 0;

    for (unsigned i = 0; i < 300; i++) {
        const char digits[] = {'x', '=', (char)('1' + i / 100), (char)('0' + i / 10 % 10), (char)('0' + i % 10), '\n'};

        memcpy(all + used, digits, sizeof digits);
        used += sizeof digits;
    }
    TEST_ASSERT_FALSE(program_compile(&program, all, used));
    TEST_ASSERT_EQUAL(EXPECTED_SHORTER, program.mistake.expected);
    TEST_ASSERT_EQUAL(257, program.mistake.line);
}

TEST(long_word_is_truncated_between_letters)
{
    rig_fails("abcdefghijklmnopqrstuvwxyzabcdefghijklmnop 1", 1, "abcdefghijklmnopqrstuvwxyzabcde", EXPECTED_STATEMENT);
    rig_fails("x = \"abcdefghijklmnopqrstuvwxyzabcd\xc3\xa4\xc3\xa4\"", 1, "abcdefghijklmnopqrstuvwxyzabcd", EXPECTED_NO_TEXT);
}

TEST(nul_in_a_program_is_refused)
{
    TEST_ASSERT_FALSE(program_compile(&program, "x=1\0y=2", 7));
    TEST_ASSERT_EQUAL(EXPECTED_SHORTER, program.mistake.expected);
}

TEST(program_restarts_after_a_mistake)
{
    rig_fails("x = 1 / Mem[1]", 1, "x", EXPECTED_DIVISOR);
    brain.memory.cell[1] = SIDE_LEFT;
    program_begin(&program);
    (void)rig_next();
    TEST_ASSERT_EQUAL(PROGRAM_ENDED, program.state);
    TEST_ASSERT_EQUAL(EXPECTED_NOTHING, program.mistake.expected);
}

static void assert_action(struct action action, enum reason reason, int forward_mm, int turn_deg)
{
    TEST_ASSERT_EQUAL(reason, action.reason);
    TEST_ASSERT_EQUAL(forward_mm, action.forward_mm);
    TEST_ASSERT_EQUAL(turn_deg, action.turn_deg);
}

TEST(pixel_is_5_mm_and_right_turn_is_positive)
{
    assert_action(rig_begin("rForward 2.4\nrTurn -10\nrForward -4\nrTurn 0.6"), REASON_WANDER, 12, 0);
    assert_action(rig_next(), REASON_PROGRAM, 0, -10);
    assert_action(rig_next(), REASON_WANDER, -20, 0);
    assert_action(rig_next(), REASON_PROGRAM, 0, 1);
}

TEST(command_for_no_motion_takes_no_time)
{
    assert_action(rig_begin("rForward 0\nrTurn 0.4\ndelay 0\nrTurn 5"), REASON_PROGRAM, 0, 5);
}

TEST(long_rforward_is_split_and_ends_at_an_obstacle)
{
    assert_action(rig_begin("rForward 100\nrTurn 7"), REASON_WANDER, 150, 0);
    assert_action(rig_next(), REASON_WANDER, 150, 0);
    senses.feel = FEEL_FRONT;
    assert_action(rig_next(), REASON_PROGRAM, 0, 7);
}

TEST(long_backward_rforward_ignores_obstacles)
{
    senses.feel = FEEL_FRONT;
    assert_action(rig_begin("rForward -40"), REASON_WANDER, -150, 0);
    assert_action(rig_next(), REASON_WANDER, -50, 0);
}

TEST(delay_rests_for_its_ticks)
{
    TEST_ASSERT_EQUAL(0, rig_begin("delay 15\ndelay 2000\ndelay 6000\nrTurn 5").rest_ticks);
    TEST_ASSERT_EQUAL(99, rig_next().rest_ticks);
    TEST_ASSERT_EQUAL(249, rig_next().rest_ticks);
    TEST_ASSERT_EQUAL(49, rig_next().rest_ticks);
    assert_action(rig_next(), REASON_PROGRAM, 0, 5);
}

TEST(rrange_reads_the_sensor_in_that_direction)
{
    senses = (struct senses){.range_mm = {10, 20, 30, 40, RANGE_NONE}};
    (void)rig_begin("a=rRange()\nb=rRange(45)\nc=rRange(90)\nd=rRange(-30)\ne=rRange(-90)\nf=rRange(22)");
    TEST_ASSERT_EQUAL_DOUBLE(6, rig_value("a"));
    TEST_ASSERT_EQUAL_DOUBLE(4, rig_value("b"));
    TEST_ASSERT_EQUAL_DOUBLE(2, rig_value("c"));
    TEST_ASSERT_EQUAL_DOUBLE(8, rig_value("d"));
    TEST_ASSERT_EQUAL_DOUBLE(800, rig_value("e"));
    TEST_ASSERT_EQUAL_DOUBLE(6, rig_value("f"));
    TEST_ASSERT_TRUE(program.measures);
}

TEST(program_reads_the_senses_of_the_robot)
{
    senses = (struct senses){.feel = FEEL_FRONT_RIGHT | FEEL_RIGHT, .look = true, .beacon_mm = 149, .bump = true};
    (void)rig_begin("a=rFeel()\nb=rLook(0)=Green\nc=rBeacon(Green)\nd=rBumper()\ne=rBeacon(Red)\nf=rLook()");
    TEST_ASSERT_EQUAL_DOUBLE(FEEL_FRONT_RIGHT | FEEL_RIGHT, rig_value("a"));
    TEST_ASSERT_EQUAL_DOUBLE(1, rig_value("b"));
    TEST_ASSERT_EQUAL_DOUBLE(29, rig_value("c"));
    TEST_ASSERT_EQUAL_DOUBLE(1, rig_value("d"));
    TEST_ASSERT_EQUAL_DOUBLE(0, rig_value("e"));
    TEST_ASSERT_EQUAL_DOUBLE(2, rig_value("f"));
}

TEST(beacon_distance_of_visible_food_is_never_zero)
{
    senses = (struct senses){.look = true, .beacon_mm = 3};
    (void)rig_begin("c=rBeacon(Green)");
    TEST_ASSERT_EQUAL_DOUBLE(1, rig_value("c"));
}

TEST(random_draws_from_the_generator_of_the_firmware)
{
    struct random random = brain.random;
    double expected[3] = {random_below(&random, 2), random_below(&random, 60), random_next(&random) % 1000};

    (void)rig_begin("a=random(2)\nb=random(60)\nc=random(1000)");
    TEST_ASSERT_EQUAL_DOUBLE(expected[0], rig_value("a"));
    TEST_ASSERT_EQUAL_DOUBLE(expected[1], rig_value("b"));
    TEST_ASSERT_EQUAL_DOUBLE(expected[2], rig_value("c"));
}

TEST(mem_reads_and_writes_the_memory_of_the_robot)
{
    brain.memory.cell[5] = SIDE_LEFT;
    (void)rig_begin("a=Mem[5]\nMem[5]=2\nMem[6]=1");
    TEST_ASSERT_EQUAL_DOUBLE(SIDE_LEFT, rig_value("a"));
    TEST_ASSERT_EQUAL(SIDE_RIGHT, brain.memory.cell[5]);
    TEST_ASSERT_EQUAL(SIDE_LEFT, brain.memory.cell[6]);
    TEST_ASSERT_TRUE(brain.changed);
}

TEST(mem_write_of_a_frozen_robot_is_ignored)
{
    brain.frozen = true;
    (void)rig_begin("Mem[5]=2\na=Mem[5]");
    TEST_ASSERT_EQUAL_DOUBLE(0, rig_value("a"));
    TEST_ASSERT_EQUAL(SIDE_NOTHING, brain.memory.cell[5]);
    TEST_ASSERT_FALSE(brain.changed);
}

TEST(mem_write_of_the_same_value_is_no_change)
{
    (void)rig_begin("Mem[5]=0");
    TEST_ASSERT_FALSE(brain.changed);
}

TEST(program_that_uses_mem_reports_the_reasons_of_the_firmware)
{
    senses.feel = FEEL_FRONT;
    assert_action(rig_begin("x=rFeel()\nrTurn 45\nMem[2]=1\nx=rFeel()\nrTurn -10\nrTurn 160\nrForward 1\nrTurn 4\nx=rFeel()\nrTurn 3"), REASON_TRIAL, 0, 45);
    assert_action(rig_next(), REASON_REMEMBERED, 0, -10);
    TEST_ASSERT_EQUAL(1, brain.repeat_count);
    assert_action(rig_next(), REASON_BOREDOM, 0, 160);
    assert_action(rig_next(), REASON_WANDER, 5, 0);
    TEST_ASSERT_EQUAL(0, brain.repeat_count);
    assert_action(rig_next(), REASON_LOOK_AROUND, 0, 4);
    senses.feel = 0;
    assert_action(rig_next(), REASON_LOOK_AROUND, 0, 3);
}

TEST(step_with_food_ahead_has_reason_toward_food_and_reat_eats)
{
    senses = (struct senses){.look = true, .beacon_mm = 100};
    assert_action(rig_begin("rForward 2\nrEat"), REASON_TOWARD_FOOD, 10, 0);
    assert_action(rig_next(), REASON_EAT, 0, 0);
}

TEST(ended_program_rests)
{
    assert_action(rig_begin("x=1"), REASON_PROGRAM, 0, 0);
    TEST_ASSERT_EQUAL(PROGRAM_ENDED, program.state);
    assert_action(rig_next(), REASON_PROGRAM, 0, 0);
}

TEST(program_position_follows_the_odometers)
{
    (void)rig_begin("rLocate 400,300,-90\nrForward 20\nx=rGPSx()\ny=rGPSy()\nrTurn 100\na=rCompass()\nrForward 1\nrLocate 5,6\nb=rCompass()");
    senses.odometer_left = senses.odometer_right = 1000;
    (void)rig_next();
    TEST_ASSERT_DOUBLE_WITHIN(0.001, 380, rig_value("x"));
    TEST_ASSERT_DOUBLE_WITHIN(0.001, 300, rig_value("y"));
    senses.odometer_left = 1100;
    (void)rig_next();
    TEST_ASSERT_EQUAL_DOUBLE(10, rig_value("a"));
    TEST_ASSERT_DOUBLE_WITHIN(0.001, 380, program.x_mm / 5);
    (void)rig_next();
    TEST_ASSERT_EQUAL_DOUBLE(0, rig_value("b"));
    TEST_ASSERT_EQUAL_DOUBLE(30, program.y_mm);
}
