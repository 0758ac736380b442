#include "host_sim/program/native/compiler.h"

/* Defines a label or a sub. */
static struct program_name *define(struct compiler *compiler, const struct token *word, enum name_kind kind)
{
    struct program_name *name = &compiler->program->names[compiler_name(compiler, word, kind)];

    if (name->given || compiler_is_reserved(compiler->program->text + word->at, word->len))
        compiler_fail_at(compiler, word, EXPECTED_NEW_NAME);
    name->given = true;
    return name;
}

/* A sub ends where the next one or a label begins. */
void compile_end_of_sub(struct compiler *compiler)
{
    if (compiler->in_sub)
        (void)compiler_emit(compiler, OP_RETURN, 0, 0);
    compiler->in_sub = false;
    compiler->parameter_count = 0;
}

void compile_label(struct compiler *compiler, const struct token *word)
{
    compile_unclosed(compiler);
    compile_end_of_sub(compiler);
    define(compiler, word, NAME_LABEL)->place = compiler->program->code_count;
}

static void compile_parameter(struct compiler *compiler, struct program_name *sub)
{
    unsigned count = compiler->parameter_count;
    bool refers = compiler_takes(compiler, "&");

    if (compiler->token.kind != TOKEN_WORD || count == PROGRAM_ARGUMENTS_MAX
        || compiler_is_reserved(compiler->program->text + compiler->token.at, compiler->token.len)) {
        compiler_fail(compiler, EXPECTED_NAME);
        return;
    }
    if (refers)
        sub->references = (uint8_t)(sub->references | 1u << count);
    compiler->parameters[compiler->parameter_count++] = compiler->token;
    compiler_advance(compiler);
}

void compile_sub(struct compiler *compiler)
{
    struct token word = compiler->token;
    struct program_name *sub;

    compile_unclosed(compiler);
    compile_end_of_sub(compiler);
    (void)compiler_emit(compiler, OP_LINE, word.line, 0);
    (void)compiler_emit(compiler, OP_FALL, 0, 0);
    if (word.kind != TOKEN_WORD)
        compiler_fail(compiler, EXPECTED_NAME);
    compiler_advance(compiler);
    sub = define(compiler, &word, NAME_SUB);
    sub->place = compiler->program->code_count;
    compiler->in_sub = true;
    if (compiler_takes(compiler, "(") && !compiler_takes(compiler, ")")) {
        do
            compile_parameter(compiler, sub);
        while (compiler_takes(compiler, ","));
        compiler_expect(compiler, ")", EXPECTED_CLOSE);
    }
    sub->parameters = (uint8_t)compiler->parameter_count;
}

void compile_goto(struct compiler *compiler)
{
    struct token word = compiler->token;

    if (word.kind != TOKEN_WORD)
        compiler_fail(compiler, EXPECTED_NAME);
    if (compiler->in_sub)
        compiler_fail_at(compiler, &word, EXPECTED_NO_GOTO);
    compiler_advance(compiler);
    (void)compiler_emit(compiler, OP_GOTO, compiler_name(compiler, &word, NAME_LABEL), 0);
}

/* Compiles GOSUB and CALL: the destination, and the arguments. */
void compile_call(struct compiler *compiler, enum name_kind kind)
{
    struct token word = compiler->token;
    unsigned count = 0;
    uint16_t name;

    if (word.kind != TOKEN_WORD)
        compiler_fail(compiler, EXPECTED_NAME);
    compiler_advance(compiler);
    name = compiler_name(compiler, &word, kind);
    if (kind == NAME_SUB && compiler_takes(compiler, "("))
        count = compile_arguments(compiler, ")");
    if (count > PROGRAM_ARGUMENTS_MAX)
        compiler_fail_at(compiler, &word, EXPECTED_ARGUMENTS);
    (void)compiler_emit(compiler, kind == NAME_SUB ? OP_CALL : OP_GOSUB, name, count);
}

void compile_dim(struct compiler *compiler)
{
    struct token word = compiler->token;
    double size;
    uint16_t name;
    struct program_name *array;

    if (word.kind != TOKEN_WORD || compiler_is_reserved(compiler->program->text + word.at, word.len))
        compiler_fail(compiler, EXPECTED_NAME);
    compiler_advance(compiler);
    compiler_expect(compiler, "[", EXPECTED_OPEN);
    size = compiler->token.kind == TOKEN_NUMBER ? compiler->token.number : 0;
    name = compiler_name(compiler, &word, NAME_ARRAY);
    array = &compiler->program->names[name];
    if (size < 1 || size > PROGRAM_CELLS_MAX || (array->given && size != array->size))
        compiler_fail(compiler, EXPECTED_SIZE);
    compiler_advance(compiler);
    compiler_expect(compiler, "]", EXPECTED_BRACKET);
    if (!array->given) {
        array->place = compiler_cell(compiler, (unsigned)size);
        array->size = (uint16_t)size;
        array->given = true;
    }
    (void)compiler_emit(compiler, OP_DIM, name, 0);
}

static void compile_shown(struct compiler *compiler)
{
    struct token item;

    while (compiler_takes(compiler, ",")) {
        item = compiler->token;
        if (item.kind == TOKEN_TEXT) {
            compiler_advance(compiler);
            (void)compiler_emit(compiler, OP_SHOW_TEXT, item.at, item.len < UINT8_MAX ? item.len : UINT8_MAX);
        } else {
            compile_expression(compiler);
            (void)compiler_emit(compiler, OP_SHOW_NUMBER, 0, 0);
        }
    }
}

/* Compiles the position on the screen, then what to show there. */
static void compile_show(struct compiler *compiler)
{
    compile_expression(compiler);
    compiler_expect(compiler, ",", EXPECTED_COMMA);
    compile_expression(compiler);
    (void)compiler_emit(compiler, OP_COMMAND, DO_SHOW, 2);
    compile_shown(compiler);
}

static void compile_command(struct compiler *compiler, const struct token *word, int command)
{
    unsigned count;

    if (command == DO_SHOW) {
        compile_show(compiler);
        return;
    }
    count = compile_values(compiler, word, &CODE_COMMANDS[command], NULL);
    (void)compiler_emit(compiler, OP_COMMAND, (unsigned)command, count);
}

static void give(struct compiler *compiler, struct instruction store)
{
    (void)compiler_emit(compiler, (enum op)store.op, store.operand, 0);
}

/* What changes a variable that has a value already. */
static const struct {
    const char *sign;
    enum operation operation;
    bool by_one;
} changes[] = {
    {"++", DO_ADD, true}, {"--", DO_SUBTRACT, true}, {"+=", DO_ADD, false}, {"-=", DO_SUBTRACT, false},
    {"*=", DO_MULTIPLY, false}, {"/=", DO_DIVIDE, false},
};

static int next_change(const struct compiler *compiler)
{
    for (unsigned i = 0; i < sizeof changes / sizeof *changes; i++)
        if (token_is(compiler->program->text, &compiler->token, changes[i].sign))
            return (int)i;
    return -1;
}

/* The index of a cell of an array is on the stack, and serves for both. */
static void compile_change(struct compiler *compiler, struct instruction store, int change)
{
    static const enum op loads[] = {
        [OP_STORE] = OP_LOAD, [OP_STORE_CELL] = OP_LOAD_CELL, [OP_STORE_PARAMETER] = OP_LOAD_PARAMETER,
    };

    compiler_advance(compiler);
    if (store.op == OP_STORE_CELL)
        (void)compiler_emit(compiler, OP_COPY, 0, 0);
    (void)compiler_emit(compiler, loads[store.op], store.operand, 0);
    if (changes[change].by_one)
        compile_number(compiler, 1);
    else
        compile_expression(compiler);
    (void)compiler_emit(compiler, OP_BINARY, changes[change].operation, 0);
    give(compiler, store);
}

static void compile_assignment(struct compiler *compiler, const struct token *word)
{
    const char *text = compiler->program->text;
    struct instruction store;

    if (!token_is(text, &compiler->token, "[") && !token_is(text, &compiler->token, "=")
        && next_change(compiler) < 0) {
        compiler_fail_at(compiler, word, compiler_foreign(compiler, word, EXPECTED_STATEMENT));
        return;
    }
    store = compile_place(compiler, word, true);
    if (next_change(compiler) >= 0) {
        compile_change(compiler, store, next_change(compiler));
        return;
    }
    compiler_expect(compiler, "=", EXPECTED_EQUALS);
    compile_expression(compiler);
    give(compiler, store);
}

static void compile_printed(struct compiler *compiler)
{
    struct token item = compiler->token;

    if (item.kind == TOKEN_TEXT) {
        compiler_advance(compiler);
        (void)compiler_emit(compiler, OP_PRINT_TEXT, item.at, item.len < UINT8_MAX ? item.len : UINT8_MAX);
    } else {
        compile_expression(compiler);
        (void)compiler_emit(compiler, OP_PRINT_NUMBER, 0, 0);
    }
}

/* A comma separates by a blank, a semicolon by nothing; at the end, either one keeps the line open. */
static void compile_print(struct compiler *compiler)
{
    bool open = false;

    while (!compiler_ends_statement(compiler)) {
        compile_printed(compiler);
        open = compiler_takes(compiler, ",");
        if (open)
            (void)compiler_emit(compiler, OP_PRINT_CHARACTER, ' ', 0);
        open = compiler_takes(compiler, ";") || open;
        if (!open)
            break;
    }
    if (!open)
        (void)compiler_emit(compiler, OP_PRINT_CHARACTER, '\n', 0);
}

static void compile_keyword(struct compiler *compiler, const struct token *word, int keyword)
{
    if (keyword <= KEY_CONTINUE)
        compile_block(compiler, word, keyword);
    else if (keyword == KEY_GOSUB || keyword == KEY_CALL)
        compile_call(compiler, keyword == KEY_CALL ? NAME_SUB : NAME_LABEL);
    else if (keyword == KEY_GOTO)
        compile_goto(compiler);
    else if (keyword == KEY_PRINT)
        compile_print(compiler);
    else if (keyword == KEY_RETURN || keyword == KEY_END)
        (void)compiler_emit(compiler, keyword == KEY_END ? OP_END : OP_RETURN, 0, 0);
    else if (keyword == KEY_SUB)
        compile_sub(compiler);
    else if (keyword == KEY_DIM)
        compile_dim(compiler);
    else
        compiler_fail_at(compiler, word, EXPECTED_STATEMENT);
}

/* Whether it counts as a step: what only divides or closes a block does not, nor does SUB. */
static bool is_step(int keyword)
{
    return keyword < 0 || keyword == KEY_IF || keyword == KEY_WHILE || keyword == KEY_FOR
        || (keyword >= KEY_BREAK && keyword != KEY_SUB);
}

/* Returns whether the next statement may follow at once: after then, else, and a label. */
static bool compile_statement(struct compiler *compiler)
{
    struct token word = compiler->token;
    const char *text = compiler->program->text + word.at;
    int keyword = compiler_keyword(text, word.len);
    int command = code_find(CODE_COMMANDS, CODE_COMMAND_COUNT, text, word.len);

    if (word.kind != TOKEN_WORD) {
        compiler_fail(compiler, EXPECTED_STATEMENT);
        return true;
    }
    compiler_advance(compiler);
    if (compiler_takes(compiler, ":")) {
        compile_label(compiler, &word);
        return true;
    }
    if (is_step(keyword))
        (void)compiler_emit(compiler, OP_LINE, word.line, 0);
    if (keyword >= 0)
        compile_keyword(compiler, &word, keyword);
    else if (command >= 0)
        compile_command(compiler, &word, command);
    else
        compile_assignment(compiler, &word);
    return keyword == KEY_IF || keyword == KEY_ELSE || keyword == KEY_ELSEIF;
}

void compile_text(struct compiler *compiler)
{
    while (compiler->token.kind != TOKEN_END) {
        bool ends = compiler->token.kind == TOKEN_LINE_END;

        if (ends)
            compile_line_end(compiler);
        if (ends || compiler->token.kind == TOKEN_SEPARATOR)
            compiler_advance(compiler);
        else if (!compile_statement(compiler) && !compiler_ends_statement(compiler))
            compiler_fail(compiler, EXPECTED_LINE_END);
    }
    compile_line_end(compiler);
    compile_end_of_sub(compiler);
    (void)compiler_emit(compiler, OP_END, 0, 0);
    compile_unclosed(compiler);
}
