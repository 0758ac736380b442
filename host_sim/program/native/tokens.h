/* tokens.h: splits a program's text into tokens. */
#ifndef OCTET_PROGRAM_TOKENS_H
#define OCTET_PROGRAM_TOKENS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

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

#endif
