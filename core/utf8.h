/* core/utf8.h -- telling UTF-8 (RFC 3629) from other bytes. */
#ifndef CORE_UTF8_H
#define CORE_UTF8_H

#include <stdbool.h>
#include <stddef.h>

/* Bytes of the character that s begins with, of the `left` that there are; 0 if it begins with
 * none: a stray or overlong byte, a surrogate, a character cut short. */
static inline size_t utf8_length(const char *s, size_t left)
{
    static const struct {
        unsigned char least, most, second_least, second_most;
        size_t length;
    } forms[] = {
        { 0xc2, 0xdf, 0x80, 0xbf, 2 }, { 0xe0, 0xe0, 0xa0, 0xbf, 3 }, { 0xe1, 0xec, 0x80, 0xbf, 3 },
        { 0xed, 0xed, 0x80, 0x9f, 3 }, { 0xee, 0xef, 0x80, 0xbf, 3 }, { 0xf0, 0xf0, 0x90, 0xbf, 4 },
        { 0xf1, 0xf3, 0x80, 0xbf, 4 }, { 0xf4, 0xf4, 0x80, 0x8f, 4 },
    };
    const unsigned char *b = (const unsigned char *)s;
    if (left > 0 && b[0] < 0x80)
        return 1;
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++) {
        if (left < forms[i].length || b[0] < forms[i].least || b[0] > forms[i].most)
            continue;
        bool good = b[1] >= forms[i].second_least && b[1] <= forms[i].second_most;
        for (size_t j = 2; j < forms[i].length; j++)
            good = good && (b[j] & 0xc0) == 0x80;
        return good ? forms[i].length : 0;
    }
    return 0;
}

#endif
