/* tests/json.c -- JSON as RFC 8259 has it, and nothing beside: program.h. */
#include "tests/program.h"
#include "tests/test.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

/* Each of these takes text, and gives what is behind the thing it is named after; NULL if it is not
 * there. */
static const char *skip_value(const char *c);

static const char *skip_blanks(const char *c) { return c + strspn(c, " \t\r\n"); }

static const char *skip_string(const char *c)
{
    if (*c++ != '"')
        return NULL;
    for (; *c != '"'; c++) {
        if ((unsigned char)*c < 0x20)
            return NULL;
        if (*c != '\\')
            continue;
        c++;
        if (*c == 'u') {
            for (int i = 0; i < 4; i++)
                if (!isxdigit((unsigned char)*++c))
                    return NULL;
        } else if (!*c || !strchr("\"\\/bfnrt", *c)) {
            return NULL;
        }
    }
    return c + 1;
}

static const char *skip_digits(const char *c)
{
    return isdigit((unsigned char)*c) ? c + strspn(c, "0123456789") : NULL;
}

static const char *skip_number(const char *c)
{
    c += *c == '-';
    const char *rest = *c == '0' ? c + 1 : skip_digits(c);
    if (rest && *rest == '.')
        rest = skip_digits(rest + 1);
    if (rest && (*rest == 'e' || *rest == 'E'))
        rest = skip_digits(rest + 1 + (rest[1] == '+' || rest[1] == '-'));
    return rest;
}

static const char *skip_member(const char *c)
{
    c = skip_string(skip_blanks(c));
    c = c ? skip_blanks(c) : NULL;
    return c && *c == ':' ? skip_value(c + 1) : NULL;
}

static const char *skip_list(const char *c, char close, const char *(*behind_one)(const char *))
{
    const char *behind = skip_blanks(c + 1);
    if (*behind == close)
        return behind + 1;
    for (c = behind_one(c + 1); c; c = behind_one(c + 1)) {
        c = skip_blanks(c);
        if (*c == close)
            return c + 1;
        if (*c != ',')
            return NULL;
    }
    return NULL;
}

static const char *skip_value(const char *c)
{
    c = skip_blanks(c);
    if (*c == '{')
        return skip_list(c, '}', skip_member);
    if (*c == '[')
        return skip_list(c, ']', skip_value);
    if (*c == '"')
        return skip_string(c);
    static const char *const words[] = { "true", "false", "null" };
    for (int i = 0; i < 3; i++)
        if (!strncmp(c, words[i], strlen(words[i])))
            return c + strlen(words[i]);
    return skip_number(c);
}

bool json_is_valid(const char *text)
{
    const char *end = skip_value(text);
    return end && *skip_blanks(end) == '\0';
}

/* The value of the member, or the element, that the first `length` bytes of path name. */
static const char *within(const char *c, const char *path, size_t length)
{
    bool object = *c == '{';
    long index  = object ? -1 : strtol(path, NULL, 10);
    if (!object && *c != '[')
        return NULL;
    for (c = skip_blanks(c + 1); *c != '}' && *c != ']'; c = skip_blanks(c + 1)) {
        const char *value = object ? skip_blanks(skip_string(c)) + 1 : c;
        bool named        = object && !strncmp(c + 1, path, length) && c[1 + length] == '"';
        if (named || (!object && index-- == 0))
            return skip_blanks(value);
        c = skip_blanks(skip_value(value));
        if (*c != ',')
            break;
    }
    return NULL;
}

const char *json_at(const char *text, const char *path)
{
    const char *c = skip_blanks(text);
    while (c && *path) {
        size_t length = strcspn(path, ".");
        c             = within(c, path, length);
        path += length + (path[length] == '.');
    }
    return c;
}

double json_number_at(const char *text, const char *path)
{
    const char *c = json_at(text, path);
    if (!c || !skip_number(c))
        fail_msg("no number at %s in %s", path, text);
    return strtod(c, NULL);
}
