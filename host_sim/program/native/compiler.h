/* compiler.h: shared by the parts of the compiler. The first mistake acts as the end of the text: each part stops. */
#ifndef OCTET_COMPILER_H
#define OCTET_COMPILER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "host_sim/program/native/machine.h"

/* Splits a program's text into tokens. */

enum token_kind {
    TOKEN_WORD, TOKEN_NUMBER, TOKEN_TEXT, TOKEN_SIGN,   /* a sign is one or two characters */
    TOKEN_SEPARATOR,                                    /* between statements of one line */
    TOKEN_LINE_END, TOKEN_END, TOKEN_UNFINISHED         /* a text without its closing quote */
};

struct token {
    enum token_kind kind;
    uint16_t at, len;   /* in the text; of a TOKEN_TEXT, what is between the quotes */
    uint16_t line;      /* from 1 */
    double number;
};

void token_next(const char *text, struct token *token);
        /* Advances to the next token; to begin, pass a token that is all 0 except line 1. Skips comments and blanks,
           and accepts the typographic quotes and dashes of printed text. */

bool token_is(const char *text, const struct token *token, const char *sign);
        /* Whether a token is this sign. */

enum { BLOCKS_MAX = 32, DEPTH_MAX = 24, NO_PLACE = 0xFFFF };

enum block_kind { BLOCK_IF, BLOCK_IF_LINE, BLOCK_WHILE, BLOCK_FOR, BLOCK_REPEAT };

/* A block that has been opened. */
struct block {
    enum block_kind kind;
    struct token word;                /* that has opened it */
    uint16_t top;                     /* the instruction that a loop goes back to */
    uint16_t otherwise;               /* the jump if a condition is false, */
    uint16_t ends;                    /* and the last of a linked list of jumps to the end; or NO_PLACE */
    uint16_t goes_on;                 /* likewise, of jumps to the next round of a loop */
    struct instruction load, store;   /* a for's variable, */
    uint16_t limit, step;             /* and its cells */
};

struct compiler {
    struct program *program;
    struct token token;               /* that comes next */
    unsigned depth;                   /* of brackets */
    struct block blocks[BLOCKS_MAX + 1];   /* the last one is for overflow */
    unsigned block_count;
    struct token parameters[PROGRAM_ARGUMENTS_MAX];   /* of the sub */
    unsigned parameter_count;
    bool in_sub;
};

void compiler_fail_at(struct compiler *compiler, const struct token *token, enum program_expected expected);
void compiler_fail(struct compiler *compiler, enum program_expected expected);
        /* Reports what was expected in place of this token, or of the next one. Only the first mistake counts. */

void compiler_advance(struct compiler *compiler);
        /* Moves on to the next token. */

bool compiler_takes(struct compiler *compiler, const char *sign);
        /* Takes this sign if it comes next. */

void compiler_expect(struct compiler *compiler, const char *sign, enum program_expected expected);
        /* Takes this sign, or reports that it is missing. */

bool compiler_is_word(const struct compiler *compiler, const char *word);
        /* Whether this word comes next. */

uint16_t compiler_emit(struct compiler *compiler, enum op op, unsigned operand, unsigned count);
        /* Adds an instruction and returns its place. */

uint16_t compiler_cell(struct compiler *compiler, unsigned count);
        /* Allocates cells and returns the first one. */

uint16_t compiler_name(struct compiler *compiler, const struct token *word, enum name_kind kind);
        /* The index of a name, which is added if it is new. */

void compile_expression(struct compiler *compiler);
        /* Compiles an expression, whose value is left on the stack. */

void compile_number(struct compiler *compiler, double number);
        /* Compiles a number, which is left on the stack. */

struct instruction compile_place(struct compiler *compiler, const struct token *word, bool gives);
        /* After the name of a variable, a parameter, or an array (with its index, left on the stack): the instruction
           that stores or loads it. */

unsigned compile_arguments(struct compiler *compiler, const char *close);
        /* Compiles expressions between commas, up to a sign or, if null, the statement's end. Returns how many. */

unsigned compile_values(struct compiler *compiler, const struct token *word, const struct known_word *known,
                        const char *close);
        /* Compiles the arguments of a command or, with a closing sign, of a function. Returns how many. */

enum program_expected compiler_foreign(const struct compiler *compiler, const struct token *word,
                                       enum program_expected otherwise);
        /* What to write instead of a word that only RobotBASIC has; otherwise, for any other word. */

bool compiler_ends_statement(const struct compiler *compiler);
        /* Whether a statement can end here. */

void compile_text(struct compiler *compiler);
        /* All statements. */

void compile_block(struct compiler *compiler, const struct token *word, int keyword);
        /* Compiles a statement that opens, divides or closes a block. */

void compile_unclosed(struct compiler *compiler);
        /* Reports any open block: none may be open at a label, at a sub or at the end of the text. */

void compile_label(struct compiler *compiler, const struct token *word);
void compile_sub(struct compiler *compiler);
void compile_end_of_sub(struct compiler *compiler);
void compile_goto(struct compiler *compiler);
void compile_call(struct compiler *compiler, enum name_kind kind);
void compile_dim(struct compiler *compiler);
        /* Compile the statements that define a label, a sub or an array, or that go to one. */

void compile_line_end(struct compiler *compiler);
        /* Ends a line, and with it an if on one line. */

bool compiler_is_reserved(const char *word, size_t len);
        /* Whether a word is reserved. */

/* Words of the language; those up to KEY_CONTINUE belong to blocks. */
enum keyword {
    KEY_IF, KEY_ELSEIF, KEY_ELSE, KEY_ENDIF, KEY_WHILE, KEY_WEND, KEY_FOR, KEY_NEXT, KEY_REPEAT, KEY_UNTIL, KEY_BREAK,
    KEY_CONTINUE, KEY_GOTO, KEY_GOSUB, KEY_RETURN, KEY_CALL, KEY_SUB, KEY_END, KEY_DIM, KEY_PRINT, KEY_THEN, KEY_TO,
    KEY_STEP, KEY_AND, KEY_OR, KEY_NOT, KEY_MOD
};

int compiler_keyword(const char *word, size_t len);
        /* An enum keyword; -1: it is none. */

#endif
