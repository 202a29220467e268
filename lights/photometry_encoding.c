/* lights/photometry_encoding.c -- labels of photometric files, in whatever encoding, as UTF-8.
 *
 * LM-63 and EULUMDAT name no encoding. What is not UTF-8 comes from Windows: code page 932
 * (Shift-JIS) where the whole file can be read so and looks so, else code page 1252, which is
 * Latin-1 with quotes, dashes and signs where Latin-1 has control codes. Half-width katakana alone
 * cannot be told from capital letters with accents and are taken as these.
 */
#include "core/utf8.h"
#include "lights/photometry_parts.h"

#include <iconv.h>
#include <string.h>

enum { LONGEST_WORDS = 512 /* bytes of a label that are kept: LM-63 allows 256 */ };

static bool is_utf8(const char *text, size_t length)
{
    for (size_t i = 0; i < length;) {
        size_t n = utf8_length(text + i, length - i);
        if (n == 0)
            return false;
        i += n;
    }
    return true;
}

/* ---- Shift-JIS -------------------------------------------------------------------------- */

static bool is_lead(unsigned char b)
{
    return (b >= 0x81 && b <= 0x9f) || (b >= 0xe0 && b <= 0xfc);
}
static bool is_trail(unsigned char b) { return b >= 0x40 && b <= 0xfc && b != 0x7f; }
static bool is_kana(unsigned char b) { return b >= 0xa1 && b <= 0xdf; } /* half-width */

/* Two characters of two bytes side by side, one of them with a lead byte that Latin-1 has no use
 * for, are Japanese: accents and typographic quotes stand alone among Latin letters. */
bool text_is_shift_jis(const char *text, size_t length)
{
    if (is_utf8(text, length))
        return false;
    bool seen = false, beside = false, low_before = false;
    for (size_t i = 0; i < length; i++) {
        unsigned char b = (unsigned char)text[i];
        if (!is_lead(b)) {
            if (b >= 0x80 && !is_kana(b))
                return false;
            beside = false;
            continue;
        }
        if (++i == length || !is_trail((unsigned char)text[i]))
            return false;
        bool low   = b <= 0x9f;
        seen       = seen || (beside && (low || low_before));
        beside     = true;
        low_before = low;
    }
    return seen;
}

/* From Shift-JIS by what the system knows of it; '?' for a character that it does not. */
static size_t from_shift_jis(const char *text, size_t length, char *out, size_t room)
{
    iconv_t to_utf8 = iconv_open("UTF-8", "CP932");
    if (to_utf8 == (iconv_t)-1)
        to_utf8 = iconv_open("UTF-8", "SHIFT_JIS");
    size_t n = 0;
    for (size_t i = 0; i < length;) {
        size_t bytes = is_lead((unsigned char)text[i]) && i + 1 < length ? 2 : 1;
        char from[2] = { text[i], text[i + bytes - 1] }, *in = from, *to = out + n;
        size_t in_left = bytes, out_left = room - n;
        bool known =
            to_utf8 != (iconv_t)-1 && iconv(to_utf8, &in, &in_left, &to, &out_left) != (size_t)-1;
        if (known)
            n = room - out_left;
        else
            out[n++] = (unsigned char)text[i] < 0x80 ? text[i] : '?';
        i += bytes;
    }
    if (to_utf8 != (iconv_t)-1)
        iconv_close(to_utf8);
    return n;
}

/* ---- Latin-1, code page 1252 ------------------------------------------------------------ */

static size_t from_latin(const char *text, size_t length, char *out)
{
    /* 0x80 to 0x9f; 0 where the code page has none */
    static const unsigned short signs[32] = {
        0x20ac, 0,      0x201a, 0x0192, 0x201e, 0x2026, 0x2020, 0x2021, 0x02c6, 0x2030, 0x0160,
        0x2039, 0x0152, 0,      0x017d, 0,      0,      0x2018, 0x2019, 0x201c, 0x201d, 0x2022,
        0x2013, 0x2014, 0x02dc, 0x2122, 0x0161, 0x203a, 0x0153, 0,      0x017e, 0x0178,
    };
    size_t n = 0;
    for (size_t i = 0; i < length; i++) {
        unsigned b    = (unsigned char)text[i];
        unsigned code = b < 0x80 || b > 0x9f ? b : signs[b - 0x80] ? signs[b - 0x80] : ' ';
        if (code < 0x80) {
            out[n++] = (char)code;
        } else if (code < 0x800) {
            out[n++] = (char)(0xc0 | (code >> 6));
            out[n++] = (char)(0x80 | (code & 0x3f));
        } else {
            out[n++] = (char)(0xe0 | (code >> 12));
            out[n++] = (char)(0x80 | ((code >> 6) & 0x3f));
            out[n++] = (char)(0x80 | (code & 0x3f));
        }
    }
    return n;
}

/* ---- labels ----------------------------------------------------------------------------- */

static bool is_around(char c) { return c == ' ' || c == '\t' || c == ',' || c == '\f'; }

const char *scan_words(const scanner *c, const char *text, size_t length)
{
    while (length > 0 && is_around(text[0]))
        text++, length--;
    while (length > 0 && is_around(text[length - 1]))
        length--;
    bool utf8   = !c->shift_jis && is_utf8(text, length);
    bool cut    = length > LONGEST_WORDS;
    size_t kept = cut ? LONGEST_WORDS : length;
    while (cut && utf8 && (text[kept] & 0xc0) == 0x80) /* not within a character */
        kept--;

    size_t room = 3 * kept + 1, n;
    char *out   = arena_array(c->a, char, room, NULL);
    if (!out)
        return "";
    if (utf8)
        memcpy(out, text, n = kept);
    else if (c->shift_jis)
        n = from_shift_jis(text, kept, out, room);
    else
        n = from_latin(text, kept, out);
    out[n] = '\0';
    for (size_t i = 0; i < n; i++)
        out[i] = (unsigned char)out[i] < ' ' || out[i] == 0x7f ? ' ' : out[i];
    return out;
}
