#include "host_sim/program/native/compiler.h"

#include <string.h>

static const struct known_word keywords[] = {
    [KEY_IF] = {"if", 0, 0}, [KEY_ELSEIF] = {"elseif", 0, 0}, [KEY_ELSE] = {"else", 0, 0},
    [KEY_ENDIF] = {"endif", 0, 0}, [KEY_WHILE] = {"while", 0, 0}, [KEY_WEND] = {"wend", 0, 0},
    [KEY_FOR] = {"for", 0, 0}, [KEY_NEXT] = {"next", 0, 0}, [KEY_REPEAT] = {"repeat", 0, 0},
    [KEY_UNTIL] = {"until", 0, 0}, [KEY_BREAK] = {"break", 0, 0}, [KEY_CONTINUE] = {"continue", 0, 0},
    [KEY_GOTO] = {"goto", 0, 0}, [KEY_PRINT] = {"print", 0, 0}, [KEY_GOSUB] = {"gosub", 0, 0},
    [KEY_RETURN] = {"return", 0, 0}, [KEY_CALL] = {"call", 0, 0}, [KEY_SUB] = {"sub", 0, 0},
    [KEY_END] = {"end", 0, 0}, [KEY_DIM] = {"dim", 0, 0}, [KEY_THEN] = {"then", 0, 0}, [KEY_TO] = {"to", 0, 0},
    [KEY_STEP] = {"step", 0, 0}, [KEY_AND] = {"and", 0, 0}, [KEY_OR] = {"or", 0, 0}, [KEY_NOT] = {"not", 0, 0},
    [KEY_MOD] = {"mod", 0, 0},
};

int compiler_keyword(const char *word, size_t len)
{
    return code_find(keywords, sizeof keywords / sizeof *keywords, word, len);
}

bool compiler_is_reserved(const char *word, size_t len)
{
    double value;

    return compiler_keyword(word, len) >= 0 || code_constant(word, len, &value)
        || code_find(CODE_COMMANDS, CODE_COMMAND_COUNT, word, len) >= 0
        || code_find(CODE_FUNCTIONS, CODE_FUNCTION_COUNT, word, len) >= 0;
}

static void quote(struct program_mistake *mistake, const char *text, size_t len)
{
    size_t most = len < PROGRAM_WORD_MAX - 1 ? len : PROGRAM_WORD_MAX - 1;

    while (most > 0 && most < len && ((unsigned char)text[most] & 0xC0u) == 0x80u)
        most--;   /* do not cut a UTF-8 character */
    memcpy(mistake->word, text, most);
    mistake->word[most] = '\0';
}

void compiler_fail_at(struct compiler *compiler, const struct token *token, enum program_expected expected)
{
    struct program *program = compiler->program;
    bool has_word = token->kind != TOKEN_LINE_END && token->kind != TOKEN_END;

    if (program->mistake.expected != EXPECTED_NOTHING)
        return;
    program->mistake = (struct program_mistake){.line = token->line, .expected = (uint8_t)expected};
    if (has_word)
        quote(&program->mistake, program->text + token->at, token->len);
    compiler->token = (struct token){.kind = TOKEN_END, .at = (uint16_t)strlen(program->text), .line = token->line};
}

void compiler_fail(struct compiler *compiler, enum program_expected expected)
{
    compiler_fail_at(compiler, &compiler->token, expected);
}

void compiler_advance(struct compiler *compiler)
{
    token_next(compiler->program->text, &compiler->token);
    if (compiler->token.kind == TOKEN_UNFINISHED)
        compiler_fail(compiler, EXPECTED_QUOTE);
}

bool compiler_takes(struct compiler *compiler, const char *sign)
{
    bool is = token_is(compiler->program->text, &compiler->token, sign);

    if (is)
        compiler_advance(compiler);
    return is;
}

void compiler_expect(struct compiler *compiler, const char *sign, enum program_expected expected)
{
    if (!compiler_takes(compiler, sign))
        compiler_fail(compiler, expected);
}

bool compiler_is_word(const struct compiler *compiler, const char *word)
{
    const struct token *token = &compiler->token;

    return token->kind == TOKEN_WORD && code_same(compiler->program->text + token->at, token->len, word);
}

uint16_t compiler_emit(struct compiler *compiler, enum op op, unsigned operand, unsigned count)
{
    struct program *program = compiler->program;

    if (program->code_count == PROGRAM_CODE_MAX) {
        compiler_fail(compiler, EXPECTED_SHORTER);
        return PROGRAM_CODE_MAX - 1;
    }
    program->code[program->code_count] =
        (struct instruction){.op = (uint8_t)op, .count = (uint8_t)count, .operand = (uint16_t)operand};
    return program->code_count++;
}

uint16_t compiler_cell(struct compiler *compiler, unsigned count)
{
    struct program *program = compiler->program;
    uint16_t first = program->cell_count;

    if (count > (unsigned)(PROGRAM_CELLS_MAX - first)) {
        compiler_fail(compiler, EXPECTED_SHORTER);
        return 0;
    }
    program->cell_count = (uint16_t)(first + count);
    return first;
}

static bool same_letters(const struct program *program, const struct program_name *name, const struct token *word)
{
    char known[PROGRAM_WORD_MAX];

    if (name->len != word->len)
        return false;
    memcpy(known, program->text + name->at, name->len);
    known[name->len] = '\0';
    return code_same(program->text + word->at, word->len, known);
}


uint16_t compiler_name(struct compiler *compiler, const struct token *word, enum name_kind kind)
{
    struct program *program = compiler->program;
    struct program_name *made = &program->names[program->name_count];

    if (word->len >= PROGRAM_WORD_MAX) {
        compiler_fail_at(compiler, word, EXPECTED_SHORTER);
        return 0;
    }
    for (uint16_t i = 0; i < program->name_count; i++)
        if (program->names[i].kind == kind && same_letters(program, &program->names[i], word))
            return i;
    if (program->name_count == PROGRAM_NAMES_MAX - 1) {
        compiler_fail_at(compiler, word, EXPECTED_SHORTER);
        return 0;
    }
    *made = (struct program_name){.at = word->at, .len = word->len, .line = word->line, .kind = (uint8_t)kind};
    if (kind == NAME_VARIABLE)
        made->place = compiler_cell(compiler, 1);
    if (kind == NAME_ARRAY && code_same(program->text + word->at, word->len, "mem")) {
        made->place = program->memory = compiler_cell(compiler, CELL_COUNT);
        made->size = CELL_COUNT;
        made->given = program->learns = true;
    }
    return program->name_count++;
}

enum program_expected compiler_foreign(const struct compiler *compiler, const struct token *word,
                                       enum program_expected otherwise)
{
    for (unsigned i = 0; i < CODE_FOREIGN_COUNT; i++)
        if (code_same(compiler->program->text + word->at, word->len, CODE_FOREIGN[i].name))
            return CODE_FOREIGN[i].instead;
    return otherwise;
}

bool compiler_ends_statement(const struct compiler *compiler)
{
    enum token_kind kind = compiler->token.kind;

    return kind == TOKEN_SEPARATOR || kind == TOKEN_LINE_END || kind == TOKEN_END
        || compiler_is_word(compiler, "else");
}
