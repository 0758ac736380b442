#include "host_sim/program/native/compiler.h"

#include <limits.h>
#include <string.h>

/* Typographic forms of quote, minus and space in printed listings. */
static const struct {
    const char *printed;
    char meant;
} printed[] = {
    {"\xe2\x80\x9c", '"'}, {"\xe2\x80\x9d", '"'}, {"\xe2\x80\x9e", '"'}, {"\xe2\x80\x93", '-'}, {"\xe2\x88\x92", '-'},
    {"\xc2\xa0", ' '}, {"\xef\xbb\xbf", ' '},
};

enum { ASCII_MAX = 0x7F };   /* letters of other alphabets have bytes above it */

static const double FINEST = 1e9;   /* further decimals have no effect */

static const char *const PAIRS[] = {"==", "<>", "!=", "<=", ">=", "<<", ">>", "++", "--", "+=", "-=", "*=", "/=",
                                    "&&", "||"};

/* The character here, and how many bytes it takes. */
static char character(const char *text, size_t *bytes)
{
    *bytes = 1;
    for (size_t i = 0; i < sizeof printed / sizeof *printed; i++)
        if (strncmp(text, printed[i].printed, strlen(printed[i].printed)) == 0) {
            *bytes = strlen(printed[i].printed);
            return printed[i].meant;
        }
    return *text;
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || (unsigned char)c > ASCII_MAX;
}

static const char *skip_blanks(const char *at)
{
    size_t bytes;

    for (;;) {
        char c = character(at, &bytes);

        if ((c == '/' && at[1] == '/') || c == '\'')
            bytes = strcspn(at, "\n");
        else if (c != ' ' && c != '\t' && c != '\r')
            return at;
        at += bytes;
    }
}

static int digit(char c)
{
    if (is_digit(c))
        return c - '0';
    c = (char)(c | 0x20);   /* a small letter */
    return c >= 'a' && c <= 'f' ? c - 'a' + 10 : INT_MAX;
}

/* 0x1F and 0%1110. Returns 0 if it is neither. */
static size_t read_based(const char *at, double *number)
{
    int base = at[0] != '0' ? 0 : at[1] == 'x' || at[1] == 'X' ? 16 : at[1] == '%' ? 2 : 0;
    size_t len = 2;

    if (base == 0 || digit(at[len]) >= base)
        return 0;
    for (*number = 0; digit(at[len]) < base; len++)
        *number = *number * base + digit(at[len]);
    return len;
}

static size_t read_number(const char *at, double *number)
{
    double value = 0, parts = 1;
    size_t len = read_based(at, number);

    if (len > 0)
        return len;
    for (; is_digit(at[len]); len++)
        value = value * 10 + (at[len] - '0');
    if (at[len] == '.' && is_digit(at[len + 1]))
        for (len++; is_digit(at[len]); len++)
            if (parts < FINEST) {
                value = value * 10 + (at[len] - '0');
                parts *= 10;
            }
    *number = value / parts;
    return len;
}

/* The text after an opening quote, up to the closing one. Returns the bytes from the first quote through the last. */
static size_t read_text(const char *at, size_t opening, struct token *token)
{
    size_t bytes, len = opening;

    token->at = (uint16_t)(token->at + opening);
    for (char c = character(at + len, &bytes); c != '"'; c = character(at + len, &bytes)) {
        if (c == '\n' || c == '\0') {
            token->kind = TOKEN_UNFINISHED;
            token->len = (uint16_t)(len - opening);
            return len;
        }
        len += bytes;
    }
    token->kind = TOKEN_TEXT;
    token->len = (uint16_t)(len - opening);
    return len + bytes;
}

static size_t read_sign(const char *at, size_t bytes)
{
    for (size_t i = 0; i < sizeof PAIRS / sizeof *PAIRS; i++)
        if (strncmp(at, PAIRS[i], 2) == 0)
            return 2;
    return bytes;
}

static size_t read_word(const char *at)
{
    size_t len = 0, bytes;

    for (char c = character(at, &bytes); is_letter(c) || is_digit(c); c = character(at + len, &bytes))
        len += bytes;
    return len;
}

/* The kind of token that begins with this character. */
static enum token_kind kind_of(char c)
{
    switch (c) {
    case '\0':
        return TOKEN_END;
    case '\n':
        return TOKEN_LINE_END;
    case '\\':
        return TOKEN_SEPARATOR;
    case '"':
        return TOKEN_TEXT;
    default:
        return is_digit(c) ? TOKEN_NUMBER : is_letter(c) ? TOKEN_WORD : TOKEN_SIGN;
    }
}

/* Where the token ends in the text; the next one begins there or later. */
static size_t end_of(const char *text, const struct token *token)
{
    size_t end = (size_t)token->at + token->len, bytes;

    if (token->kind == TOKEN_TEXT) {
        (void)character(text + end, &bytes);
        end += bytes;
    }
    return end;
}

void token_next(const char *text, struct token *token)
{
    const char *at = skip_blanks(text + end_of(text, token));
    uint16_t line = (uint16_t)(token->line + (token->kind == TOKEN_LINE_END && token->len > 0));
    size_t bytes;
    char c = character(at, &bytes);

    *token = (struct token){.kind = kind_of(c), .at = (uint16_t)(at - text), .len = (uint16_t)bytes, .line = line};
    if (token->kind == TOKEN_NUMBER)
        token->len = (uint16_t)read_number(at, &token->number);
    else if (token->kind == TOKEN_WORD)
        token->len = (uint16_t)read_word(at);
    else if (token->kind == TOKEN_SIGN)
        token->len = (uint16_t)read_sign(at, bytes);
    else if (token->kind == TOKEN_TEXT)
        (void)read_text(at, bytes, token);
    else if (token->kind == TOKEN_END)
        token->len = 0;
}

bool token_is(const char *text, const struct token *token, const char *sign)
{
    size_t bytes;
    bool minus = character(text + token->at, &bytes) == '-' && bytes > 1 && strcmp(sign, "-") == 0;

    return token->kind == TOKEN_SIGN
        && (minus || (strlen(sign) == token->len && strncmp(text + token->at, sign, token->len) == 0));
}
