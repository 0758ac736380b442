#include "tests/program/native/program_rig.h"

#include <string.h>

#include "host_sim/program/native/code.h"
#include "host_sim/program/native/tokens.h"
#include "tests/test.h"

void setUp(void)
{
    rig_reset();
}

static void comes_to(double expected, const char *expression)
{
    char text[200] = "x = ";

    strcat(text, expression);
    (void)rig_begin(text);
    TEST_ASSERT_EQUAL_DOUBLE_MESSAGE(expected, rig_value("x"), expression);
}

TEST(operators_bind_as_in_the_listing)
{
    comes_to(7, "1 + 2 * 3");
    comes_to(9, "(1+2)*3");
    comes_to(-5, "-2-3");
    comes_to(2, "-(-2)");
    comes_to(5, "(10>>1)&7");
    comes_to(2.5, "5/2");
    comes_to(2.4, "2.4");
    comes_to(1, "7 mod 3");
    comes_to(1, "7 % 3");
    comes_to(1, "1 < 2 and 3 >= 3");
    comes_to(0, "1 > 2 or 3 <> 3");
    comes_to(1, "not 1 = 2");
    comes_to(1, "1 != 2");
    comes_to(12, "3 << 2");
    comes_to(7, "4 | 3");
    comes_to(1, "2 <= 2 == 1");
    comes_to(3, "abs(-3)");
    comes_to(2, "int(2.9)");
    comes_to(COLOUR_GREEN, "Green");
    comes_to(1, "+TRUE");
}

TEST(shifts_and_remainders_of_anything_are_numbers)
{
    comes_to(0, "1 >> 99");
    comes_to(2147483647, "9999999999 | 0");
    comes_to(-2147483648.0, "-9999999999 | 0");
    comes_to(1, "1 << -3");
    comes_to(0, "(-2147483648) mod -1");
}

TEST(names_have_letters_of_any_alphabet)
{
    (void)rig_begin("Gr\xc3\xb6\xc3\x9f" "e = 3\nx = gr\xc3\xb6\xc3\x9f" "e\xe2\x80\x93" "1");   /* ends with a dash */
    TEST_ASSERT_EQUAL_DOUBLE(2, rig_value("x"));
}

TEST(capital_and_small_letters_are_the_same)
{
    (void)rig_begin("Dist = 3\nDIST = dist + 1\nrFORWARD dist");
    TEST_ASSERT_EQUAL_DOUBLE(4, rig_value("Dist"));
}

TEST(an_if_on_one_line_holds_for_the_rest_of_the_line)
{
    (void)rig_begin("if 0 then a=1\\b=1\nif 1 then c=1\\d=1 else e=1\nif 0 then f=1 else g=1\na=a\\b=b\\e=e\\f=f");
    TEST_ASSERT_EQUAL_DOUBLE(0, rig_value("a") + rig_value("b") + rig_value("e") + rig_value("f"));
    TEST_ASSERT_EQUAL_DOUBLE(3, rig_value("c") + rig_value("d") + rig_value("g"));
}

TEST(the_first_branch_that_holds_is_taken)
{
    const char *text = "for x = 1 to 4\nif x=1\na=a*10+1\nelseif x=2\na=a*10+2\nelseif x=3 then\na=a*10+3\nelse\na=a*10+4\nendif\nnext";

    (void)rig_begin(text);
    TEST_ASSERT_EQUAL_DOUBLE(1234, rig_value("a"));
}

TEST(loops_go_on_as_long_as_they_should)
{
    (void)rig_begin("n = 5\nwhile n\nn--\nsum++\nwend\nfor i = 10 to 1 step -3\nlast = i\nnext i\nfor j = 2 to 1\nno = 1\nnext\n");
    TEST_ASSERT_EQUAL_DOUBLE(5, rig_value("sum"));
    TEST_ASSERT_EQUAL_DOUBLE(1, rig_value("last"));
    TEST_ASSERT_EQUAL_DOUBLE(0, rig_value("no"));
}

TEST(gosub_comes_back)
{
    (void)rig_begin("gosub Twice\ngosub Twice\nend\nTwice:\ngosub Once\ngosub Once\nreturn\nOnce:\nn++\nreturn\n");
    TEST_ASSERT_EQUAL_DOUBLE(4, rig_value("n"));
    TEST_ASSERT_EQUAL(PROGRAM_ENDED, program.state);
}

TEST(an_argument_by_reference_is_changed_and_another_is_not)
{
    (void)rig_begin("a=1\nb=1\ndim c[2]\ncall Add(a,b,c[1])\nd=c[1]\nend\nsub Add(x,&y,&z)\nx=x+5\ny=y+5\nz=x+y\n");
    TEST_ASSERT_EQUAL_DOUBLE(1, rig_value("a"));
    TEST_ASSERT_EQUAL_DOUBLE(6, rig_value("b"));
    TEST_ASSERT_EQUAL_DOUBLE(12, rig_value("d"));
}

TEST(a_reference_is_handed_on_and_a_sub_may_call_itself)
{
    (void)rig_begin("n=0\ncall Count(5,n)\nend\nsub Count(more,&n)\nif more=0 then return\nn++\ncall Count(more-1,n)\nreturn");
    TEST_ASSERT_EQUAL_DOUBLE(5, rig_value("n"));
}

TEST(parameters_are_counted_and_looped_over)
{
    (void)rig_begin("a=0\ncall Sum(3,a)\nend\nsub Sum(n,&total)\nfor i = 1 to n\ntotal = total + i\nnext\nn--\ntotal++\nreturn");
    TEST_ASSERT_EQUAL_DOUBLE(7, rig_value("a"));
}

TEST(dim_empties_an_array_but_for_mem)
{
    brain.memory.cell[3] = SIDE_RIGHT;
    (void)rig_begin("dim a[3]\na[2]=7\nb=a[2]\ndim a[3]\nc=a[2]\ndim Mem[8]\nd=Mem[3]");
    TEST_ASSERT_EQUAL_DOUBLE(7, rig_value("b"));
    TEST_ASSERT_EQUAL_DOUBLE(0, rig_value("c"));
    TEST_ASSERT_EQUAL_DOUBLE(SIDE_RIGHT, rig_value("d"));
}

TEST(what_a_magazine_prints_is_understood)
{
    (void)rig_begin("\xef\xbb\xbfx = 5 \xe2\x80\x93 2\xc2\xa0// \xe2\x80\x9cthree\xe2\x80\x9d\r\nxyString 1,2,\xe2\x80\x9d" "ALL DONE\xe2\x80\x9d\r\ny = \xe2\x88\x92x\n");
    TEST_ASSERT_EQUAL_DOUBLE(-3, rig_value("y"));
    TEST_ASSERT_EQUAL_STRING("ALL DONE", program.shown[0].text);
}

TEST(texts_and_numbers_are_shown_at_their_places)
{
    (void)rig_begin("xyString 1,1,\"a\",-1.5,\" \",2\nxyString 2,1,0.0004\nxyString 1,1,\"b\",0.9999,2.25\n");
    TEST_ASSERT_EQUAL_STRING("b12.25", program.shown[0].text);
    TEST_ASSERT_EQUAL_STRING("0", program.shown[1].text);
    (void)rig_begin("xyString 1,1,\"a\",-1.5,\" \",2\n");
    TEST_ASSERT_EQUAL_STRING("a-1.5 2", program.shown[0].text);
}

TEST(a_text_that_is_too_long_is_cut)
{
    (void)rig_begin("for i = 1 to 99\nxyString i,0,\"12345678901234567890\",\"12345678901234567890\",\"1234567890\"\nnext");
    TEST_ASSERT_EQUAL(PROGRAM_SHOWN_TEXT - 1, strlen(program.shown[PROGRAM_SHOWN_MAX - 1].text));
}

TEST(the_last_decision_is_kept_step_by_step)
{
    (void)rig_begin("x=1\nrForward 1\nx=x+1\nif x=2\nrTurn 5\nendif");
    TEST_ASSERT_EQUAL_DOUBLE(0, program.before[0]);
    (void)rig_next();
    TEST_ASSERT_EQUAL_DOUBLE(1, program.before[0]);
    TEST_ASSERT_EQUAL(4, program.trace_count);
    TEST_ASSERT_EQUAL(3, program.trace[0].line);
    TEST_ASSERT_EQUAL_DOUBLE(2, program.trace[1].number);
    TEST_ASSERT_EQUAL(4, program.trace[2].line);
    TEST_ASSERT_EQUAL(5, program.trace[3].line);
}

TEST(tokens_have_their_kinds_lines_and_places)
{
    const char *text = "ab 1.5\\\n\"x\" ++";
    const enum token_kind kinds[] = {TOKEN_WORD, TOKEN_NUMBER, TOKEN_SEPARATOR, TOKEN_LINE_END, TOKEN_TEXT, TOKEN_SIGN, TOKEN_END, TOKEN_END};
    struct token token = {.line = 1};

    for (unsigned i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        token_next(text, &token);
        TEST_ASSERT_EQUAL(kinds[i], token.kind);
        TEST_ASSERT_EQUAL(i < 4 ? 1 : 2, token.line);
    }
}
