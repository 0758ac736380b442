#include "host_sim/program/native/compiler.h"

static struct block *opened(struct compiler *compiler)
{
    return compiler->block_count > 0 ? &compiler->blocks[compiler->block_count - 1] : NULL;
}

static struct block *open(struct compiler *compiler, const struct token *word, enum block_kind kind)
{
    struct block *block = &compiler->blocks[compiler->block_count];

    if (compiler->block_count == BLOCKS_MAX)
        compiler_fail_at(compiler, word, EXPECTED_PLAIN);   /* the next block overwrites this one */
    else
        compiler->block_count++;
    *block = (struct block){.kind = kind, .word = *word, .otherwise = NO_PLACE, .ends = NO_PLACE,
                            .goes_on = NO_PLACE};
    return block;
}

static uint16_t here(const struct compiler *compiler)
{
    return compiler->program->code_count;
}

static void patch(struct compiler *compiler, uint16_t jump)
{
    if (jump != NO_PLACE)
        compiler->program->code[jump].operand = here(compiler);
}

/* Makes each jump of a linked list lead here. */
static void patch_all(struct compiler *compiler, uint16_t last)
{
    while (last != NO_PLACE) {
        uint16_t before = compiler->program->code[last].operand;

        patch(compiler, last);
        last = before;
    }
}

static void close(struct compiler *compiler)
{
    struct block *block = opened(compiler);

    patch(compiler, block->otherwise);
    patch_all(compiler, block->ends);
    compiler->block_count--;
}

void compile_unclosed(struct compiler *compiler)
{
    static const enum program_expected ends[] = {
        [BLOCK_IF] = EXPECTED_ENDIF, [BLOCK_IF_LINE] = EXPECTED_LINE_END, [BLOCK_WHILE] = EXPECTED_WEND,
        [BLOCK_FOR] = EXPECTED_NEXT, [BLOCK_REPEAT] = EXPECTED_UNTIL,
    };
    const struct block *block = opened(compiler);

    if (block)
        compiler_fail_at(compiler, &block->word, ends[block->kind]);
}

/* Compiles a condition, and the jump that is taken if it is false. */
static uint16_t condition(struct compiler *compiler)
{
    compile_expression(compiler);
    return compiler_emit(compiler, OP_JUMP_IF_NOT, NO_PLACE, 0);
}

static void take_then(struct compiler *compiler, struct block *block)
{
    if (!compiler_is_word(compiler, "then"))
        return;
    compiler_advance(compiler);
    if (block->kind == BLOCK_IF && !compiler_ends_statement(compiler) && block->ends == NO_PLACE)
        block->kind = BLOCK_IF_LINE;
}

static void compile_if(struct compiler *compiler, const struct token *word)
{
    struct block *block = open(compiler, word, BLOCK_IF);

    block->otherwise = condition(compiler);
    take_then(compiler, block);
    if (block->kind == BLOCK_IF && !compiler_ends_statement(compiler))
        compiler_fail(compiler, EXPECTED_LINE_END);
}

/* Ends the branch that runs if a condition is true. */
static void turn_over(struct compiler *compiler, struct block *block)
{
    block->ends = compiler_emit(compiler, OP_JUMP, block->ends, 0);
    patch(compiler, block->otherwise);
    block->otherwise = NO_PLACE;
}

static void compile_else(struct compiler *compiler, const struct token *word, bool again)
{
    struct block *block = opened(compiler);

    if (!block || (block->kind != BLOCK_IF && block->kind != BLOCK_IF_LINE) || block->otherwise == NO_PLACE) {
        compiler_fail_at(compiler, word, EXPECTED_IF);
        return;
    }
    turn_over(compiler, block);
    if (!again)
        return;
    (void)compiler_emit(compiler, OP_LINE, word->line, 0);
    block->otherwise = condition(compiler);
    take_then(compiler, block);
}

static void compile_while(struct compiler *compiler, const struct token *word)
{
    struct block *block = open(compiler, word, BLOCK_WHILE);

    block->top = (uint16_t)(here(compiler) - 1);   /* its OP_LINE */
    block->otherwise = condition(compiler);
}

static void store_cell(struct compiler *compiler, uint16_t cell)
{
    (void)compiler_emit(compiler, OP_STORE, cell, 0);
}

static void for_range(struct compiler *compiler, struct block *block)
{
    compile_expression(compiler);
    (void)compiler_emit(compiler, (enum op)block->store.op, block->store.operand, 0);
    if (!compiler_is_word(compiler, "to"))
        compiler_fail(compiler, EXPECTED_TO);
    compiler_advance(compiler);
    compile_expression(compiler);
    store_cell(compiler, block->limit);
    if (compiler_is_word(compiler, "step")) {
        compiler_advance(compiler);
        compile_expression(compiler);
    } else {
        compile_number(compiler, 1);
    }
    store_cell(compiler, block->step);
}

static void compile_for(struct compiler *compiler, const struct token *word)
{
    struct block *block = open(compiler, word, BLOCK_FOR);
    struct token name = compiler->token;

    block->limit = compiler_cell(compiler, 2);
    block->step = (uint16_t)(block->limit + 1);
    if (name.kind != TOKEN_WORD)
        compiler_fail(compiler, EXPECTED_NAME);
    compiler_advance(compiler);
    block->store = compile_place(compiler, &name, true);
    block->load = (struct instruction){.op = block->store.op == OP_STORE ? OP_LOAD : OP_LOAD_PARAMETER,
                                       .operand = block->store.operand};
    if (block->store.op == OP_STORE_CELL)
        compiler_fail_at(compiler, &name, EXPECTED_NAME);
    compiler_expect(compiler, "=", EXPECTED_EQUALS);
    for_range(compiler, block);
    block->top = compiler_emit(compiler, OP_LINE, word->line, 0);
    (void)compiler_emit(compiler, (enum op)block->load.op, block->load.operand, 0);
    (void)compiler_emit(compiler, OP_LOAD, block->limit, 0);
    (void)compiler_emit(compiler, OP_LOAD, block->step, 0);
    (void)compiler_emit(compiler, OP_FOR, 0, 0);
    block->otherwise = compiler_emit(compiler, OP_JUMP_IF_NOT, NO_PLACE, 0);
}

static void compile_repeat(struct compiler *compiler, const struct token *word)
{
    open(compiler, word, BLOCK_REPEAT)->top = here(compiler);
}

/* Compiles BREAK and CONTINUE, which leave the ifs inside their loop. */
static void compile_leave(struct compiler *compiler, const struct token *word, bool goes_on)
{
    struct block *block = opened(compiler);
    uint16_t *jumps;

    while (block && (block->kind == BLOCK_IF || block->kind == BLOCK_IF_LINE))
        block = block > compiler->blocks ? block - 1 : NULL;
    if (!block) {
        compiler_fail_at(compiler, word, EXPECTED_LOOP);
        return;
    }
    jumps = goes_on ? &block->goes_on : &block->ends;
    *jumps = compiler_emit(compiler, OP_JUMP, *jumps, 0);
}

static void end_for(struct compiler *compiler, const struct block *block)
{
    if (compiler->token.kind == TOKEN_WORD && !compiler_ends_statement(compiler))
        compiler_advance(compiler);   /* NEXT may name its variable */
    (void)compiler_emit(compiler, (enum op)block->load.op, block->load.operand, 0);
    (void)compiler_emit(compiler, OP_LOAD, block->step, 0);
    (void)compiler_emit(compiler, OP_BINARY, DO_ADD, 0);
    (void)compiler_emit(compiler, (enum op)block->store.op, block->store.operand, 0);
}

/* Compiles the word that ends a block. */
static void compile_end(struct compiler *compiler, const struct token *word, enum block_kind kind,
                        enum program_expected otherwise)
{
    struct block *block = opened(compiler);

    if (!block || block->kind != kind) {
        compiler_fail_at(compiler, word, otherwise);
        return;
    }
    patch_all(compiler, block->goes_on);
    if (kind == BLOCK_FOR)
        end_for(compiler, block);
    if (kind == BLOCK_REPEAT) {
        (void)compiler_emit(compiler, OP_LINE, word->line, 0);
        compile_expression(compiler);
        (void)compiler_emit(compiler, OP_JUMP_IF_NOT, block->top, 0);
    } else if (kind != BLOCK_IF)
        (void)compiler_emit(compiler, OP_JUMP, block->top, 0);
    close(compiler);
}

void compile_block(struct compiler *compiler, const struct token *word, int keyword)
{
    switch (keyword) {
    case KEY_IF:
        compile_if(compiler, word);
        break;
    case KEY_ELSEIF:
    case KEY_ELSE:
        compile_else(compiler, word, keyword == KEY_ELSEIF);
        break;
    case KEY_ENDIF:
        compile_end(compiler, word, BLOCK_IF, EXPECTED_IF);
        break;
    case KEY_WHILE:
        compile_while(compiler, word);
        break;
    case KEY_WEND:
        compile_end(compiler, word, BLOCK_WHILE, EXPECTED_WHILE);
        break;
    case KEY_FOR:
        compile_for(compiler, word);
        break;
    case KEY_REPEAT:
        compile_repeat(compiler, word);
        break;
    case KEY_UNTIL:
        compile_end(compiler, word, BLOCK_REPEAT, EXPECTED_REPEAT);
        break;
    case KEY_BREAK:
    case KEY_CONTINUE:
        compile_leave(compiler, word, keyword == KEY_CONTINUE);
        break;
    default:
        compile_end(compiler, word, BLOCK_FOR, EXPECTED_FOR);
        break;
    }
}

void compile_line_end(struct compiler *compiler)
{
    while (opened(compiler) && opened(compiler)->kind == BLOCK_IF_LINE)
        close(compiler);
}
