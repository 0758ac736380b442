#include "host_sim/program/native/program.h"

#include <string.h>

#include "host_sim/program/native/compiler.h"

static const char *const expected_words[] = {
    [EXPECTED_NOTHING] = "nothing else",
    [EXPECTED_STATEMENT] = "a command, a label, or a variable with = after it",
    [EXPECTED_VALUE] = "a number such as 0.5, a variable or a function",
    [EXPECTED_LINE_END] = "the end of the line, or \\ before another statement",
    [EXPECTED_CLOSE] = "a closing )",
    [EXPECTED_BRACKET] = "a closing ]",
    [EXPECTED_QUOTE] = "a string that ends with \" on the same line",
    [EXPECTED_EQUALS] = "=",
    [EXPECTED_TO] = "to, as in for i = 1 to 9",
    [EXPECTED_NAME] = "a name that is not a word of the language",
    [EXPECTED_COMMA] = "a comma",
    [EXPECTED_ENDIF] = "an endif for it",
    [EXPECTED_WEND] = "a wend for it",
    [EXPECTED_NEXT] = "a next for it",
    [EXPECTED_IF] = "an if before it, on a line that ends after the condition or then",
    [EXPECTED_WHILE] = "a while before it",
    [EXPECTED_FOR] = "a for before it",
    [EXPECTED_LABEL] = "a label of this name, followed by :",
    [EXPECTED_SUB] = "a sub of this name",
    [EXPECTED_GIVEN] = "a variable that gets a value with = somewhere",
    [EXPECTED_DIM] = "a dim for this array, as in dim a[10]",
    [EXPECTED_NEW_NAME] = "a name that neither the language nor another line uses",
    [EXPECTED_SIZE] = "a number of cells, 1 to 1024; for Mem, 8",
    [EXPECTED_PLAIN] = "fewer nested blocks or brackets",
    [EXPECTED_SHORTER] = "a shorter program, of up to 16383 bytes",
    [EXPECTED_END] = "an end before it: the program runs into it",
    [EXPECTED_INDEX] = "an index from 0 to the size of the array minus 1",
    [EXPECTED_SIDE] = "0 (nothing), 1 (left) or 2 (right) in Mem, and 0 in Mem[0]",
    [EXPECTED_ACTION] = "rForward, rTurn or delay in the loop, which never ends without one",
    [EXPECTED_RETURN] = "fewer gosub and call without their return",
    [EXPECTED_GOSUB] = "a gosub or a call before it",
    [EXPECTED_ARGUMENTS] = "a value for each parameter of its sub",
    [EXPECTED_DIVISOR] = "a divisor other than 0",
    [EXPECTED_DEGREES] = "-720 to 720 degrees",
    [EXPECTED_WAY] = "-800 to 800 pixels",
    [EXPECTED_DELAY] = "0 to 60000 ms",
    [EXPECTED_CHOICES] = "random of 1 to 1000000",
    [EXPECTED_AHEAD] = "rLook(0): the robot looks straight ahead only",
    [EXPECTED_OPEN] = "[ and a number of cells, as in dim a[10]",
    [EXPECTED_ONE_VALUE] = "exactly one value with it, such as 2.5",
    [EXPECTED_NO_VALUE] = "no value with it",
    [EXPECTED_PLACE] = "two or three values with it: x, y and a heading",
    [EXPECTED_UNTIL] = "an until for it",
    [EXPECTED_REPEAT] = "a repeat before it",
    [EXPECTED_LOOP] = "a while, repeat or for around it",
    [EXPECTED_NO_GOTO] = "return: goto does not leave a sub",
    [EXPECTED_BRACKETS] = "brackets after the function, as in rFeel()",
    [EXPECTED_WRITTEN] = "a value for it before it is read",
    [EXPECTED_ANGLE] = "-90 to 90 degrees for rRange",
    [EXPECTED_NO_TEXT] = "a number: RobotBASIC has texts as values, this language only in print and xyString",
    [EXPECTED_NO_DRAWING] = "another command: RobotBASIC draws with this one; print and xyString show values here",
    [EXPECTED_NO_KEYS] = "another command: RobotBASIC reads keys with this one; a program here has only sensors",
    [EXPECTED_NO_SENSOR] = "rFeel(), rBumper() or rRange(0): this robot has no such sensor of RobotBASIC",
    [EXPECTED_NO_SETTING] = "another command: RobotBASIC sets up its simulator with this one; a run has options",
};

const char *program_expected(uint8_t expected)
{
    return expected_words[expected < EXPECTED_COUNT ? expected : EXPECTED_NOTHING];
}

static void fail_at_name(struct compiler *compiler, const struct program_name *name, uint16_t line,
                         enum program_expected expected)
{
    struct token word = {.kind = TOKEN_WORD, .at = name->at, .len = name->len, .line = line};

    compiler_fail_at(compiler, &word, expected);
}

/* Names that are used and never defined. */
static void check_names(struct compiler *compiler)
{
    static const enum program_expected missing[] = {
        [NAME_VARIABLE] = EXPECTED_GIVEN, [NAME_ARRAY] = EXPECTED_DIM, [NAME_LABEL] = EXPECTED_LABEL,
        [NAME_SUB] = EXPECTED_SUB,
    };
    const struct program *program = compiler->program;

    for (uint16_t i = 0; i < program->name_count; i++) {
        const struct program_name *name = &program->names[i];

        if (!name->given)
            fail_at_name(compiler, name, name->line, missing[name->kind]);
    }
}

static void check_calls(struct compiler *compiler)
{
    const struct program *program = compiler->program;
    uint16_t line = 1;

    for (uint16_t i = 0; i < program->code_count; i++) {
        const struct instruction *it = &program->code[i];

        line = it->op == OP_LINE ? it->operand : line;
        if (it->op == OP_CALL && it->count != program->names[it->operand].parameters)
            fail_at_name(compiler, &program->names[it->operand], line, EXPECTED_ARGUMENTS);
    }
}

bool program_compile(struct program *program, const char *text, size_t len)
{
    struct compiler compiler = {.program = program, .token = {.line = 1}};

    memset(program, 0, sizeof *program);
    if (len >= PROGRAM_TEXT_MAX || memchr(text, 0, len)) {
        program->mistake = (struct program_mistake){.line = 1, .expected = EXPECTED_SHORTER};
        program->state = PROGRAM_MISTAKEN;
        return false;
    }
    memcpy(program->text, text, len);
    compiler_advance(&compiler);
    compile_text(&compiler);
    check_names(&compiler);
    check_calls(&compiler);
    if (program->mistake.expected != EXPECTED_NOTHING)
        program->code_count = 0;
    program_begin(program);
    return program->code_count > 0;
}
