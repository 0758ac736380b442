#include "host_sim/program/native/compiler.h"

/* Operators, in ascending order of precedence. */
static const struct {
    const char *sign;
    enum operation operation;
    unsigned strength;
} operators[] = {
    {"or", DO_OR, 1}, {"||", DO_OR, 1}, {"and", DO_AND, 2}, {"&&", DO_AND, 2}, {"=", DO_EQUAL, 4},
    {"==", DO_EQUAL, 4}, {"<>", DO_UNEQUAL, 4}, {"!=", DO_UNEQUAL, 4}, {"<", DO_LESS, 4}, {"<=", DO_LESS_EQUAL, 4},
    {">", DO_GREATER, 4}, {">=", DO_GREATER_EQUAL, 4}, {"|", DO_BIT_OR, 5}, {"&", DO_BIT_AND, 6},
    {"<<", DO_SHIFT_LEFT, 7}, {">>", DO_SHIFT_RIGHT, 7}, {"+", DO_ADD, 8}, {"-", DO_SUBTRACT, 8},
    {"*", DO_MULTIPLY, 9}, {"/", DO_DIVIDE, 9}, {"%", DO_MODULO, 9}, {"mod", DO_MODULO, 9},
};

enum { ANY = 1, NOT = 3, SIGNED = 10 };   /* precedences; NOT: of the operand of NOT */

static void expression(struct compiler *compiler, unsigned strength);

static int next_operator(const struct compiler *compiler)
{
    for (unsigned i = 0; i < sizeof operators / sizeof *operators; i++)
        if (compiler_is_word(compiler, operators[i].sign)
            || token_is(compiler->program->text, &compiler->token, operators[i].sign))
            return (int)i;
    return -1;
}

static uint16_t number_place(struct compiler *compiler, double number)
{
    struct program *program = compiler->program;

    for (uint16_t i = 0; i < program->number_count; i++)
        if (program->numbers[i] == number)
            return i;
    if (program->number_count == PROGRAM_NUMBERS_MAX) {
        compiler_fail(compiler, EXPECTED_SHORTER);
        return 0;
    }
    program->numbers[program->number_count] = number;
    return program->number_count++;
}

void compile_number(struct compiler *compiler, double number)
{
    (void)compiler_emit(compiler, OP_NUMBER, number_place(compiler, number), 0);
}

unsigned compile_arguments(struct compiler *compiler, const char *close)
{
    unsigned count = 0;

    if (close ? compiler_takes(compiler, close) : compiler_ends_statement(compiler))
        return 0;
    do {
        expression(compiler, ANY);
        count++;
    } while (compiler_takes(compiler, ","));
    if (close)
        compiler_expect(compiler, close, EXPECTED_CLOSE);
    return count;
}

static enum program_expected expected_values(const struct known_word *known)
{
    if (known->most <= 1)
        return known->most == 0 ? EXPECTED_NO_VALUE : known->least == 0 ? EXPECTED_AHEAD : EXPECTED_ONE_VALUE;
    return EXPECTED_PLACE;
}

unsigned compile_values(struct compiler *compiler, const struct token *word, const struct known_word *known,
                        const char *close)
{
    unsigned count;

    if (close)
        compiler_expect(compiler, "(", EXPECTED_BRACKETS);
    count = compile_arguments(compiler, close);
    if (count < known->least || count > known->most)
        compiler_fail_at(compiler, word, expected_values(known));
    return count;
}

static void function(struct compiler *compiler, const struct token *word, int number)
{
    unsigned count = compile_values(compiler, word, &CODE_FUNCTIONS[number], ")");

    compiler->program->measures = compiler->program->measures || number == DO_RANGE;
    (void)compiler_emit(compiler, OP_FUNCTION, (unsigned)number, count);
}

static int parameter(const struct compiler *compiler, const struct token *word)
{
    const char *text = compiler->program->text;
    char name[PROGRAM_WORD_MAX];

    for (unsigned i = 0; i < compiler->parameter_count; i++) {
        const struct token *it = &compiler->parameters[i];
        size_t len = 0;

        for (; len < it->len && len < sizeof name - 1; len++)
            name[len] = text[it->at + len];
        name[len] = '\0';
        if (code_same(text + word->at, word->len, name))
            return (int)i;
    }
    return -1;
}

static struct instruction cell(struct compiler *compiler, const struct token *word, bool gives)
{
    uint16_t name = compiler_name(compiler, word, NAME_ARRAY);

    expression(compiler, ANY);
    compiler_expect(compiler, "]", EXPECTED_BRACKET);
    return (struct instruction){.op = gives ? OP_STORE_CELL : OP_LOAD_CELL, .operand = name};
}

struct instruction compile_place(struct compiler *compiler, const struct token *word, bool gives)
{
    int place = parameter(compiler, word);
    struct program_name *name;

    if (compiler_is_reserved(compiler->program->text + word->at, word->len))
        compiler_fail_at(compiler, word, gives ? EXPECTED_NAME : EXPECTED_VALUE);
    if (compiler_takes(compiler, "["))
        return cell(compiler, word, gives);
    if (place >= 0)
        return (struct instruction){.op = gives ? OP_STORE_PARAMETER : OP_LOAD_PARAMETER, .operand = (uint16_t)place};
    if (token_is(compiler->program->text, &compiler->token, "("))
        compiler_fail_at(compiler, word, compiler_foreign(compiler, word, EXPECTED_VALUE));
    name = &compiler->program->names[compiler_name(compiler, word, NAME_VARIABLE)];
    name->given = name->given || gives;
    return (struct instruction){.op = gives ? OP_STORE : OP_LOAD, .operand = name->place};
}

static void word_value(struct compiler *compiler)
{
    struct token word = compiler->token;
    const char *text = compiler->program->text + word.at;
    int number = code_find(CODE_FUNCTIONS, CODE_FUNCTION_COUNT, text, word.len);
    struct instruction load;
    double value;

    compiler_advance(compiler);
    if (number >= 0) {
        function(compiler, &word, number);
    } else if (code_constant(text, word.len, &value)) {
        compile_number(compiler, value);
    } else {
        load = compile_place(compiler, &word, false);
        (void)compiler_emit(compiler, (enum op)load.op, load.operand, 0);
    }
}

static void value(struct compiler *compiler)
{
    double number = compiler->token.number;

    if (compiler->token.kind == TOKEN_NUMBER) {
        compiler_advance(compiler);
        compile_number(compiler, number);
    } else if (compiler_takes(compiler, "(")) {
        expression(compiler, ANY);
        compiler_expect(compiler, ")", EXPECTED_CLOSE);
    } else if (compiler->token.kind == TOKEN_WORD) {
        word_value(compiler);
    } else {
        compiler_fail(compiler, compiler->token.kind == TOKEN_TEXT ? EXPECTED_NO_TEXT : EXPECTED_VALUE);
    }
}

static void signed_value(struct compiler *compiler)
{
    if (compiler_takes(compiler, "-")) {
        expression(compiler, SIGNED);
        (void)compiler_emit(compiler, OP_UNARY, DO_NEGATE, 0);
    } else if (compiler_takes(compiler, "!")) {
        expression(compiler, SIGNED);
        (void)compiler_emit(compiler, OP_UNARY, DO_NOT, 0);
    } else if (compiler_is_word(compiler, "not")) {
        compiler_advance(compiler);
        expression(compiler, NOT);
        (void)compiler_emit(compiler, OP_UNARY, DO_NOT, 0);
    } else {
        (void)compiler_takes(compiler, "+");
        value(compiler);
    }
}

/* Compiles an expression of operators of at least this precedence. */
static void expression(struct compiler *compiler, unsigned strength)
{
    if (compiler->depth == DEPTH_MAX) {
        compiler_fail(compiler, EXPECTED_PLAIN);
        return;
    }
    compiler->depth++;
    signed_value(compiler);
    for (int i = next_operator(compiler); i >= 0 && operators[i].strength >= strength; i = next_operator(compiler)) {
        compiler_advance(compiler);
        expression(compiler, operators[i].strength + 1);
        (void)compiler_emit(compiler, OP_BINARY, operators[i].operation, 0);
    }
    compiler->depth--;
}

void compile_expression(struct compiler *compiler)
{
    expression(compiler, ANY);
}
