/* sim/gltf_uri.c -- where a URI of a scene leads: bytes within it, or a file in its folder.
 *
 * JSON's escapes are undone first (RFC 8259, section 7), then base64 (RFC 4648) or percent
 * signs (RFC 3986, section 2.1). What leaves the folder, be it by "..", by a root or by a
 * link, is refused.
 */
#include "sim/gltf_source.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- strings of JSON ---- */

/* -1 if it is none. */
static int hex_digit(char c)
{
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}

/* Four hexadecimal digits, or -1. */
static int32_t hex4(const char *p, const char *end)
{
    int32_t value = 0;
    if (end - p < 4)
        return -1;
    for (int i = 0; i < 4; i++) {
        int digit = hex_digit(p[i]);
        if (digit < 0)
            return -1;
        value = value * 16 + digit;
    }
    return value;
}

static char *put_utf8(char *out, int32_t code)
{
    int more                     = code < 0x80 ? 0 : code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
    static const uint8_t first[] = { 0, 0xc0, 0xe0, 0xf0 };
    *out++                       = (char)(first[more] | code >> (6 * more));
    while (more-- > 0)
        *out++ = (char)(0x80 | (code >> (6 * more) & 0x3f));
    return out;
}

/* The character behind a backslash at *p, which is moved behind it; -1 if it is none. */
static int32_t escaped(const char **p, const char *end)
{
    static const char letters[] = "\"\\/bfnrt", meant[] = "\"\\/\b\f\n\r\t";
    char letter       = *(*p)++;
    const char *found = letter ? strchr(letters, letter) : NULL;
    if (found)
        return meant[found - letters];
    if (letter != 'u')
        return -1;
    int32_t code = hex4(*p, end);
    if (code < 0)
        return -1;
    *p += 4;
    if (code < 0xd800 || code > 0xdfff)
        return code;
    int32_t low = end - *p >= 6 && (*p)[0] == '\\' && (*p)[1] == 'u' ? hex4(*p + 2, end) : -1;
    if (code > 0xdbff || low < 0xdc00 || low > 0xdfff)
        return -1;
    *p += 6;
    return 0x10000 + ((code - 0xd800) << 10) + (low - 0xdc00);
}

/* The string that the text between two quotes of JSON stands for. NULL, with *err, if it holds a
 * NUL, half of a surrogate pair, or an escape that JSON has not. */
static char *unescape(arena *a, const char *text, size_t length, lux_error *err)
{
    char *out = arena_array(a, char, length + 1, err); /* an escape is never shorter than UTF-8 */
    if (!out)
        return NULL;
    char *to        = out;
    const char *end = text + length;
    for (const char *p = text; p < end;) {
        if (*p != '\\') {
            *to++ = *p++;
            continue;
        }
        p++;
        int32_t code = p < end ? escaped(&p, end) : -1;
        if (code <= 0)
            return failed(err, ERR_FORMAT, "an escape that stands for no character");
        to = put_utf8(to, code);
    }
    return out;
}

/* ---- URIs ---- */

/* %41 -> A, in place. False if that makes a NUL. */
static bool percent_decode(char *uri)
{
    char *to = uri;
    for (const char *p = uri; *p; p++) {
        int high = p[0] == '%' ? hex_digit(p[1]) : -1;
        int low  = high >= 0 ? hex_digit(p[2]) : -1;
        *to++    = low >= 0 ? (char)(high * 16 + low) : *p;
        if (low >= 0 && !to[-1])
            return false;
        p += low >= 0 ? 2 : 0;
    }
    *to = 0;
    return true;
}

/* Base64 (RFC 4648), in place; *size counts bytes. False at a character that is none of it. */
static bool base64_decode(char *text, size_t length, size_t *size)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    uint8_t value[256];
    memset(value, 64, sizeof value);
    for (int i = 0; i < 64; i++)
        value[(uint8_t)digits[i]] = (uint8_t)i;

    while (length && text[length - 1] == '=')
        length--;
    uint32_t bits = 0;
    *size         = 0;
    for (size_t i = 0; i < length; i++) {
        uint32_t digit = value[(uint8_t)text[i]];
        if (digit > 63)
            return false;
        bits = bits << 6 | digit;
        if (i % 4)
            text[(*size)++] = (char)(bits >> (6 - 2 * (i % 4)) & 0xff);
    }
    return true;
}

/* The decoded bytes of data:[type];base64,... */
static bool locate_data(const gltf_file *f, const char *pointer, char *uri, const uint8_t **bytes,
                        size_t *size, lux_error *err)
{
    char *comma = strchr(uri, ',');
    if (!comma || comma - uri < 7 || memcmp(comma - 7, ";base64", 7) != 0)
        return failed(err, ERR_FORMAT, "%s: %s: a data: URI without \";base64,\"", f->path,
                      pointer);
    if (!base64_decode(comma + 1, strlen(comma + 1), size))
        return failed(err, ERR_FORMAT, "%s: %s: a character that is not base64", f->path, pointer);
    *bytes = (const uint8_t *)comma + 1;
    return true;
}

/* Whether path, its links resolved, lies below folder. */
static bool lies_within(const char *folder, const char *path)
{
    char *top = realpath(folder, NULL), *place = realpath(path, NULL);
    size_t length = top ? strlen(top) : 0;
    bool within   = top && place && !strncmp(top, place, length) &&
                  (place[length] == '/' || (length && top[length - 1] == '/'));
    free(top);
    free(place);
    return within;
}

static bool has_scheme(const char *uri)
{
    size_t length = strcspn(uri, ":/?#");
    return length > 1 && uri[length] == ':';
}

static bool locate_file(const gltf_file *f, const char *pointer, char *uri, const char **path,
                        lux_error *err)
{
    if (has_scheme(uri))
        return failed(err, ERR_UNSUPPORTED,
                      "%s: %s: \"%.120s\", wanted a file in the scene's folder", f->path, pointer,
                      uri);
    if (!percent_decode(uri) || !*uri)
        return failed(err, ERR_FORMAT, "%s: %s: a URI that names no file", f->path, pointer);

    const char *slash = strrchr(f->path, '/');
    size_t folder     = slash ? (size_t)(slash - f->path) + 1 : 0;
    size_t length     = folder + strlen(uri) + 3;
    char *joined      = arena_array(f->scratch, char, length, err);
    char *top         = arena_array(f->scratch, char, folder + 2, err);
    if (!joined || !top)
        return false;
    snprintf(top, folder + 2, "%.*s.", (int)folder, f->path);
    snprintf(joined, length, "%.*s%s", (int)folder, f->path, uri);

    /* What is not there cannot be resolved: then the way itself must not leave */
    char *place  = realpath(joined, NULL);
    bool missing = !place;
    free(place);
    bool leaves = uri[0] == '/' || (missing ? !strncmp(uri, "../", 3) || strstr(uri, "/../") != NULL
                                            : !lies_within(top, joined));
    if (leaves)
        return failed(err, ERR_UNSUPPORTED, "%s: %s: \"%.120s\" leaves the scene's folder", f->path,
                      pointer, uri);
    *path = joined;
    return true;
}

bool gltf_file_locate(const gltf_file *f, const char *pointer, const char *uri, size_t length,
                      const uint8_t **bytes, size_t *size, const char **path, lux_error *err)
{
    lux_error why = { 0 };
    *bytes        = NULL;
    char *plain   = unescape(f->scratch, uri, length, &why);
    if (!plain)
        return failed(err, why.code, "%s: %s: %s", f->path, pointer, why.text);
    if (!strncmp(plain, "data:", 5))
        return locate_data(f, pointer, plain, bytes, size, err);
    return locate_file(f, pointer, plain, path, err);
}
