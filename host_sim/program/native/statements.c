#include "host_sim/program/native/compiler.h"

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

/* Compiles x++ and x-- for a variable or a parameter. */
static void compile_count(struct compiler *compiler, struct instruction store, enum operation operation)
{
    enum op load = store.op == OP_STORE ? OP_LOAD : OP_LOAD_PARAMETER;

    if (store.op == OP_STORE_CELL)
        compiler_fail(compiler, EXPECTED_EQUALS);
    compiler_advance(compiler);
    (void)compiler_emit(compiler, load, store.operand, 0);
    compile_number(compiler, 1);
    (void)compiler_emit(compiler, OP_BINARY, operation, 0);
    give(compiler, store);
}

static void compile_assignment(struct compiler *compiler, const struct token *word)
{
    const char *text = compiler->program->text;
    struct instruction store;

    if (!token_is(text, &compiler->token, "[") && !token_is(text, &compiler->token, "=")
        && !token_is(text, &compiler->token, "++") && !token_is(text, &compiler->token, "--")) {
        compiler_fail_at(compiler, word, EXPECTED_STATEMENT);
        return;
    }
    store = compile_place(compiler, word, true);
    if (token_is(text, &compiler->token, "++") || token_is(text, &compiler->token, "--")) {
        compile_count(compiler, store, token_is(text, &compiler->token, "++") ? DO_ADD : DO_SUBTRACT);
        return;
    }
    compiler_expect(compiler, "=", EXPECTED_EQUALS);
    compile_expression(compiler);
    give(compiler, store);
}

static void compile_keyword(struct compiler *compiler, const struct token *word, int keyword)
{
    if (keyword <= KEY_NEXT)
        compile_block(compiler, word, keyword);
    else if (keyword == KEY_GOSUB || keyword == KEY_CALL)
        compile_call(compiler, keyword == KEY_CALL ? NAME_SUB : NAME_LABEL);
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
        || (keyword > KEY_NEXT && keyword != KEY_SUB);
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
