/* lights/photometry_tilt.c -- LM-63: what TILT= says of a lamp's output in a tilted luminaire.
 *
 *     TILT=NONE           the same in every tilt
 *     TILT=INCLUDE        the table follows
 *     TILT=FILE           the table is in a file; not since 2019
 *
 *     geometry            of the lamp when the luminaire is aimed down, 1: vertical;
 *                         2: horizontal, in every tilt; 3: horizontal, tilting with the luminaire
 *     n, n angles, n factors
 *
 * Only a file in the same folder is read: a photometric file from elsewhere is not to open
 * whatever it names. The light of the luminaire as it was measured is known without it.
 */
#include "core/file.h"
#include "lights/photometry_parts.h"

#include <stdio.h>
#include <string.h>

enum { MOST_TILT_ANGLES = 1000, MOST_TILT_BYTES = 64 << 10 };

static bool read_table(photometry *p, scanner *c, lux_error *err)
{
    int count;
    if (!scan_count(c, "the lamp-to-luminaire geometry of TILT", 1, 3, &p->tilt_geometry, err) ||
        !scan_count(c, "the number of tilt angles", 1, MOST_TILT_ANGLES, &count, err))
        return false;
    float *angle  = arena_array(c->a, float, (size_t)count, err);
    float *factor = angle ? arena_array(c->a, float, (size_t)count, err) : NULL;
    if (!factor)
        return false;
    for (int i = 0; i < 2 * count; i++) {
        double value;
        bool is_angle    = i < count;
        const char *what = is_angle ? "a tilt angle, from 0 to 180 deg and ascending"
                                    : "a tilt factor, from 0 to 1000";
        scan_left(c);
        scanner start = *c;
        if (!scan_number(c, what, &value, err))
            return false;
        if (!(value >= 0.0 && value <= (is_angle ? 180.0 : 1000.0)) ||
            (is_angle && i > 0 && !((float)value > angle[i - 1])))
            return scan_wrong(&start, what, err);
        *(is_angle ? &angle[i] : &factor[i - count]) = (float)value;
    }
    p->tilt_count = count, p->tilt_deg = angle, p->tilt_factor = factor;
    return true;
}

/* The name of a file beside the one that c reads; NULL if it is none, or in another folder. */
static const char *beside(const scanner *c, const scanned_line *tilt)
{
    for (size_t i = 0; i < tilt->length; i++)
        if (strchr("/\\:", tilt->text[i]) || (unsigned char)tilt->text[i] < ' ')
            return NULL;
    const char *slash = strrchr(c->path, '/');
    size_t folder     = slash ? (size_t)(slash + 1 - c->path) : 0;
    char *path        = arena_array(c->a, char, folder + tilt->length + 1, NULL);
    if (!path)
        return NULL;
    memcpy(path, c->path, folder);
    memcpy(path + folder, tilt->text, tilt->length);
    return path;
}

static bool read_file(photometry *p, scanner *c, const scanned_line *tilt, lux_error *err)
{
    const char *path = beside(c, tilt);
    if (!path) {
        notice_add(c->n,
                   "%s:%d: TILT=%s: only a file in the same folder is read: the light is taken as "
                   "the same in every tilt",
                   c->path, tilt->line, scan_words(c, tilt->text, tilt->length));
        return true;
    }
    size_t size;
    lux_error why     = { 0 };
    const char *bytes = file_read(c->a, path, MOST_TILT_BYTES, &size, &why);
    if (!bytes && why.code == ERR_MEMORY)
        return failed(err, why.code, "%s", why.text);
    if (!bytes) {
        notice_add(c->n, "%s:%d: TILT: %s: the light is taken as the same in every tilt", c->path,
                   tilt->line, why.text);
        return true;
    }
    scanner table = { path, bytes, bytes + size, bytes, 1, c->n, c->a };
    if (!read_table(p, &table, err))
        return false;
    if (scan_left(&table))
        notice_add(c->n, "%s:%d: text behind the last tilt factor: ignored", path, table.line);
    return true;
}

bool ies_read_tilt(photometry *p, scanner *c, const scanned_line *tilt, lux_error *err)
{
    if (tilt->length == 4 && scan_begins(tilt->text, 4, "NONE"))
        return true;
    if (tilt->length == 7 && scan_begins(tilt->text, 7, "INCLUDE"))
        return read_table(p, c, err);
    if (tilt->length == 0) {
        notice_add(c->n, "%s:%d: TILT= without NONE, INCLUDE or a file: taken as NONE", c->path,
                   tilt->line);
        return true;
    }
    if (p->format == PHOTOMETRY_LM63_2019)
        notice_add(c->n, "%s:%d: LM-63-2019 does not allow TILT in a file of its own", c->path,
                   tilt->line);
    return read_file(p, c, tilt, err);
}

double photometry_tilt_factor(const photometry *p, double tilt_deg)
{
    int n = p->tilt_count;
    if (n == 0)
        return 1.0;
    if (!(tilt_deg > (double)p->tilt_deg[0]))
        return (double)p->tilt_factor[0];
    for (int i = 1; i < n; i++) {
        double from = (double)p->tilt_deg[i - 1], to = (double)p->tilt_deg[i];
        double a = (double)p->tilt_factor[i - 1], b = (double)p->tilt_factor[i];
        if (tilt_deg < to)
            return a + (b - a) * (tilt_deg - from) / (to - from);
    }
    return (double)p->tilt_factor[n - 1];
}
