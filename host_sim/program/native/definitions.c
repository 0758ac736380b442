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
