#include "tests/program/native/program_rig.h"

#include <string.h>

#include "host_sim/program/native/compiler.h"
#include "host_sim/program/native/machine.h"
#include "tests/test.h"

void setUp(void)
{
    rig_reset();
}

static void assert_value(double expected, const char *expression)
{
    char text[200] = "x = ";

    strcat(text, expression);
    (void)rig_begin(text);
    TEST_ASSERT_EQUAL_DOUBLE_MESSAGE(expected, rig_value("x"), expression);
}

TEST(operators_have_the_precedence_of_the_language)
{
    assert_value(7, "1 + 2 * 3");
    assert_value(9, "(1+2)*3");
    assert_value(-5, "-2-3");
    assert_value(2, "-(-2)");
    assert_value(5, "(10>>1)&7");
    assert_value(2.5, "5/2");
    assert_value(2.4, "2.4");
    assert_value(1, "7 mod 3");
    assert_value(1, "7 % 3");
    assert_value(1, "1 < 2 and 3 >= 3");
    assert_value(0, "1 > 2 or 3 <> 3");
    assert_value(1, "not 1 = 2");
    assert_value(1, "1 != 2");
    assert_value(12, "3 << 2");
    assert_value(7, "4 | 3");
    assert_value(1, "2 <= 2 == 1");
    assert_value(3, "abs(-3)");
    assert_value(2, "int(2.9)");
    assert_value(COLOUR_GREEN, "Green");
    assert_value(1, "+TRUE");
    assert_value(31, "0x1F");
    assert_value(254, "0XfE");
    assert_value(14, "0%1110");
    assert_value(0, "0 % 1");
    assert_value(1, "1 < 2 && 3 >= 3");
    assert_value(1, "0 || 2");
    assert_value(0, "!3");
    assert_value(1, "!0 && !(2 > 3)");
}

TEST(shifts_and_remainders_are_defined_for_all_values)
{
    assert_value(0, "1 >> 99");
    assert_value(2147483647, "9999999999 | 0");
    assert_value(-2147483648.0, "-9999999999 | 0");
    assert_value(1, "1 << -3");
    assert_value(0, "(-2147483648) mod -1");
}

TEST(names_may_have_letters_of_any_alphabet)
{
    (void)rig_begin("Gr\xc3\xb6\xc3\x9f" "e = 3\nx = gr\xc3\xb6\xc3\x9f" "e\xe2\x80\x93" "1");   /* ends with a dash */
    TEST_ASSERT_EQUAL_DOUBLE(2, rig_value("x"));
}

TEST(names_are_case_insensitive)
{
    (void)rig_begin("Dist = 3\nDIST = dist + 1\nrFORWARD dist");
    TEST_ASSERT_EQUAL_DOUBLE(4, rig_value("Dist"));
}

TEST(single_line_if_applies_to_the_rest_of_the_line)
{
    (void)rig_begin("a=0\\b=0\\e=0\\f=0\nif 0 then a=1\\b=1\nif 1 then c=1\\d=1 else e=1\nif 0 then f=1 else g=1");
    TEST_ASSERT_EQUAL_DOUBLE(0, rig_value("a") + rig_value("b") + rig_value("e") + rig_value("f"));
    TEST_ASSERT_EQUAL_DOUBLE(3, rig_value("c") + rig_value("d") + rig_value("g"));
}

TEST(first_true_branch_is_taken)
{
    const char *text = "a=0\nfor x = 1 to 4\nif x=1\na=a*10+1\nelseif x=2\na=a*10+2\nelseif x=3 then\na=a*10+3\nelse\na=a*10+4\nendif\nnext";

    (void)rig_begin(text);
    TEST_ASSERT_EQUAL_DOUBLE(1234, rig_value("a"));
}

TEST(while_and_for_loops_end_at_their_conditions)
{
    (void)rig_begin("no = 0\nsum = 0\nn = 5\nwhile n\nn--\nsum++\nwend\nfor i = 10 to 1 step -3\nlast = i\nnext i\nfor j = 2 to 1\nno = 1\nnext\n");
    TEST_ASSERT_EQUAL_DOUBLE(5, rig_value("sum"));
    TEST_ASSERT_EQUAL_DOUBLE(1, rig_value("last"));
    TEST_ASSERT_EQUAL_DOUBLE(0, rig_value("no"));
}

TEST(repeat_ends_when_its_condition_is_true)
{
    (void)rig_begin("n=0\nrepeat\nn++\nuntil n=3\nrepeat\nn++\nuntil true\n");
    TEST_ASSERT_EQUAL_DOUBLE(4, rig_value("n"));
}

TEST(break_and_continue_apply_to_the_innermost_loop)
{
    (void)rig_begin("a=0\nb=0\nfor i=1 to 9\nif i>4 then break\nif i=2\ncontinue\nendif\na=a*10+i\nnext\n"
                    "repeat\nb++\nwhile 1\nif b then break\nwend\nif b<3 then continue\nuntil b>=3\n"
                    "while b>0\nb-=1\nif b=1 then break\nif 1 then continue else b=99\nwend");
    TEST_ASSERT_EQUAL_DOUBLE(134, rig_value("a"));
    TEST_ASSERT_EQUAL_DOUBLE(1, rig_value("b"));
}

TEST(goto_jumps_to_a_label_before_or_after_it)
{
    (void)rig_begin("n=0\nAgain:\nn++\nwhile 1\nif n<3 then goto Again\ngoto Done\nwend\nn=99\nDone:\nm=n");
    TEST_ASSERT_EQUAL_DOUBLE(3, rig_value("m"));
}

TEST(compound_assignments_change_variables_and_cells)
{
    (void)rig_begin("x=6\nx+=2\nx*=3\nx-=4\nx/=5\ndim a[3]\ni=0\na[i+1]+=7\na[1]++\na[1]--\na[1]*=x\ny=a[1]\n"
                    "call Add(y)\nend\nsub Add(&z)\nz+=0.5");
    TEST_ASSERT_EQUAL_DOUBLE(4, rig_value("x"));
    TEST_ASSERT_EQUAL_DOUBLE(28.5, rig_value("y"));
}

TEST(compound_assignment_evaluates_its_index_once)
{
    struct random before;

    (void)rig_begin("dim a[9]\na[random(9)]+=1\n");
    before = brain.random;
    rig_reset();
    (void)rig_begin("x=random(9)\n");
    TEST_ASSERT_EQUAL_MEMORY(&before, &brain.random, sizeof before);
}

TEST(print_writes_lines_of_texts_and_numbers)
{
    (void)rig_begin("print \"Hello\"\nprint\nprint 1,2;3 // note\nprint \"a\";\nprint \"b\",\nprint -0.5 ' note");
    TEST_ASSERT_EQUAL_STRING("Hello\n\n1 23\nab -0.5\n", program.printed);
}

TEST(print_beyond_the_buffer_is_dropped)
{
    (void)rig_begin("for i=1 to 2000\nprint \"abc\"\nnext");
    TEST_ASSERT_EQUAL(PROGRAM_PRINTED_MAX - 1, strlen(program.printed));
    TEST_ASSERT_EQUAL(PROGRAM_ENDED, program.state);
}

TEST(gosub_returns_to_its_caller)
{
    (void)rig_begin("n=0\ngosub Twice\ngosub Twice\nend\nTwice:\ngosub Once\ngosub Once\nreturn\nOnce:\nn++\nreturn\n");
    TEST_ASSERT_EQUAL_DOUBLE(4, rig_value("n"));
    TEST_ASSERT_EQUAL(PROGRAM_ENDED, program.state);
}

TEST(sub_changes_only_arguments_by_reference)
{
    (void)rig_begin("a=1\nb=1\ndim c[2]\ncall Add(a,b,c[1])\nd=c[1]\nend\nsub Add(x,&y,&z)\nx=x+5\ny=y+5\nz=x+y\n");
    TEST_ASSERT_EQUAL_DOUBLE(1, rig_value("a"));
    TEST_ASSERT_EQUAL_DOUBLE(6, rig_value("b"));
    TEST_ASSERT_EQUAL_DOUBLE(12, rig_value("d"));
}

TEST(recursive_sub_passes_its_reference_on)
{
    (void)rig_begin("n=0\ncall Count(5,n)\nend\nsub Count(more,&n)\nif more=0 then return\nn++\ncall Count(more-1,n)\nreturn");
    TEST_ASSERT_EQUAL_DOUBLE(5, rig_value("n"));
}

TEST(parameters_can_be_loop_limits_and_counters)
{
    (void)rig_begin("a=0\ncall Sum(3,a)\nend\nsub Sum(n,&total)\nfor i = 1 to n\ntotal = total + i\nnext\nn--\ntotal++\nreturn");
    TEST_ASSERT_EQUAL_DOUBLE(7, rig_value("a"));
}

TEST(dim_clears_arrays_other_than_mem)
{
    brain.memory.cell[3] = SIDE_RIGHT;
    (void)rig_begin("dim a[3]\na[2]=7\nb=a[2]\ndim a[3]\nc=a[2]\ndim Mem[8]\nd=Mem[3]");
    TEST_ASSERT_EQUAL_DOUBLE(7, rig_value("b"));
    TEST_ASSERT_EQUAL_DOUBLE(0, rig_value("c"));
    TEST_ASSERT_EQUAL_DOUBLE(SIDE_RIGHT, rig_value("d"));
}

TEST(typographic_characters_are_read_as_plain_ones)
{
    (void)rig_begin("\xef\xbb\xbfx = 5 \xe2\x80\x93 2\xc2\xa0// \xe2\x80\x9cthree\xe2\x80\x9d\r\nxyString 1,2,\xe2\x80\x9d" "ALL DONE\xe2\x80\x9d\r\ny = \xe2\x88\x92x\n");
    TEST_ASSERT_EQUAL_DOUBLE(-3, rig_value("y"));
    TEST_ASSERT_EQUAL_STRING("ALL DONE", program.shown[0].text);
}

TEST(xystring_shows_texts_and_numbers_at_positions)
{
    (void)rig_begin("xyString 1,1,\"a\",-1.5,\" \",2\nxyString 2,1,0.0004\nxyString 1,1,\"b\",0.9999,2.25\n");
    TEST_ASSERT_EQUAL_STRING("b12.25", program.shown[0].text);
    TEST_ASSERT_EQUAL_STRING("0", program.shown[1].text);
    (void)rig_begin("xyString 1,1,\"a\",-1.5,\" \",2\n");
    TEST_ASSERT_EQUAL_STRING("a-1.5 2", program.shown[0].text);
}

TEST(xystring_truncates_long_texts)
{
    (void)rig_begin("for i = 1 to 99\nxyString i,0,\"12345678901234567890\",\"12345678901234567890\",\"1234567890\"\nnext");
    TEST_ASSERT_EQUAL(PROGRAM_SHOWN_TEXT - 1, strlen(program.shown[PROGRAM_SHOWN_MAX - 1].text));
}

TEST(trace_holds_the_statements_of_the_last_decision)
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

TEST(tokens_have_kind_and_line)
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
