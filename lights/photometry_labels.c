/* lights/photometry_labels.c -- how a LM-63 file begins: its version, labels, the TILT line.
 *
 * Versions are told by the year that ends the first line, however the rest of it is written; a
 * file of 1986 has no such line, and any text instead of labels.
 */
#include "lights/photometry_parts.h"

#include <string.h>

/* The line in capitals, without blanks, as far as it may say a version. */
static void squeeze(const scanned_line *l, char out[32])
{
    size_t n = 0;
    for (size_t i = 0; i < l->length; i++) {
        char ch = l->text[i];
        if (ch == ' ' || ch == '\t')
            continue;
        if (n == 31)
            break;
        out[n++] = ch >= 'a' && ch <= 'z' ? (char)(ch + 'A' - 'a') : ch;
    }
    out[n] = '\0';
}

/* The year of a version line, which should end it; 0 if the line is none. */
static int version_year(const char *squeezed)
{
    const char *s = squeezed;
    if (strncmp(s, "IES", 3))
        return 0;
    s += 3;
    s += strncmp(s, "NA", 2) ? 0 : 2;
    s += strspn(s, ":-_/");
    s += strncmp(s, "LM", 2) ? 0 : 2;
    s += strspn(s, ":-_/");
    s += strncmp(s, "63", 2) ? 0 : 2;
    s += strspn(s, ":-_/");
    size_t digits = strspn(s, "0123456789");
    if (digits != 2 && digits != 4)
        return 0;
    int year = 0;
    for (size_t i = 0; i < digits; i++)
        year = 10 * year + (s[i] - '0');
    return year < 100 ? year + (year < 80 ? 2000 : 1900) : year;
}

/* Sets the format; true if the line was a version line. */
static bool read_version(photometry *p, scanner *c, const scanned_line *l)
{
    static const struct {
        int year;
        photometry_format format;
        const char *line;
    } versions[] = {
        { 1986, PHOTOMETRY_LM63_1986, "IESNA86" },
        { 1991, PHOTOMETRY_LM63_1991, "IESNA91" },
        { 1995, PHOTOMETRY_LM63_1995, "IESNA:LM-63-1995" },
        { 2002, PHOTOMETRY_LM63_2002, "IESNA:LM-63-2002" },
        { 2019, PHOTOMETRY_LM63_2019, "IES:LM-63-2019" },
    };
    char squeezed[32];
    squeeze(l, squeezed);
    int year  = version_year(squeezed);
    p->format = PHOTOMETRY_LM63_1986;
    if (year == 0) {
        if (!strncmp(squeezed, "IES", 3))
            notice_add(c->n, "%s:%d: the version line names no year: read as LM-63-1986", c->path,
                       l->line);
        return false;
    }

    for (size_t i = 0; i < sizeof versions / sizeof *versions; i++) {
        if (versions[i].year != year)
            continue;
        p->format           = versions[i].format;
        const char *canonic = versions[i].line;
        size_t length       = l->length;
        while (length > 0 && (l->text[length - 1] == ' ' || l->text[length - 1] == '\t'))
            length--;
        if (length != strlen(canonic) || memcmp(l->text, canonic, length) != 0)
            notice_add(c->n, "%s:%d: the version line is not '%s' as LM-63 has it: read as %s",
                       c->path, l->line, canonic, photometry_format_name(p->format));
        return true;
    }
    p->format = PHOTOMETRY_LM63_2002;
    notice_add(c->n, "%s:%d: LM-63 has no version of %d: read as that of 2002", c->path, l->line,
               year);
    return true;
}

static void read_label(photometry *p, scanner *c, const scanned_line *l)
{
    const struct {
        const char *key;
        const char **value;
    } keys[] = {
        { "[TEST]", &p->report },    { "[MANUFAC]", &p->manufacturer },
        { "[LUMCAT]", &p->catalog }, { "[LUMINAIRE]", &p->name },
        { "[LAMP]", &p->lamp },      { "[ISSUEDATE]", &p->date },
        { "[DATE]", &p->date },
    };
    const char *text = l->text;
    size_t length    = l->length;
    for (; length > 0 && (*text == ' ' || *text == '\t'); text++)
        length--;
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) {
        size_t n = strlen(keys[i].key);
        if (scan_begins(text, length, keys[i].key) && !**keys[i].value)
            *keys[i].value = scan_words(c, text + n, length - n);
    }
}

bool ies_tilt_line(const scanned_line *l, scanned_line *value)
{
    const char *s = l->text, *end = l->text + l->length;
    while (s < end && (*s == ' ' || *s == '\t'))
        s++;
    if (!scan_begins(s, (size_t)(end - s), "TILT"))
        return false;
    s += 4;
    while (s < end && (*s == ' ' || *s == '\t'))
        s++;
    if (s == end || *s++ != '=')
        return false;
    while (s < end && (*s == ' ' || *s == '\t'))
        s++;
    while (end > s && (end[-1] == ' ' || end[-1] == '\t'))
        end--;
    *value = (scanned_line){ s, (size_t)(end - s), l->line };
    return true;
}

static bool is_blank(const scanned_line *l)
{
    for (size_t i = 0; i < l->length; i++)
        if (l->text[i] != ' ' && l->text[i] != '\t')
            return false;
    return true;
}

bool ies_read_labels(photometry *p, scanner *c, scanned_line *tilt, lux_error *err)
{
    scanned_line l;
    bool first = true;
    while (scan_line(c, &l)) {
        if (ies_tilt_line(&l, tilt))
            return true;
        if (first && !is_blank(&l)) {
            first = false;
            if (read_version(p, c, &l))
                continue;
        }
        read_label(p, c, &l);
    }
    return scan_wrong(c, "a line 'TILT='", err);
}
