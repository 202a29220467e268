/* lights/photometry_parts.h -- what the readers of photometric files share; not for others.
 *
 * A scanner walks over the bytes of a file, which end in a NUL, and counts lines: they end
 * in LF, CR LF or CR alone. Its functions return false with *err filled in as "path:line:column:
 * found, expected".
 */
#ifndef LIGHTS_PHOTOMETRY_PARTS_H
#define LIGHTS_PHOTOMETRY_PARTS_H

#include "lights/photometry.h"

enum {
    MOST_BYTES  = 16 << 20, /* of a file */
    MOST_ANGLES = 20000,    /* along one axis */
    MOST_VALUES = 4 << 20,  /* of a web, unfolded */
};

typedef struct scanner {
    const char *path; /* for messages */
    const char *at, *end;
    const char *line_start;
    int line; /* 1, 2, ... */
    notices *n;
    arena *a;
    bool shift_jis;                  /* what is not ASCII */
    bool noted_blank, noted_crowded; /* notices of scan_value() that were given */
} scanner;

/* A line without its end. */
typedef struct scanned_line {
    const char *text;
    size_t length;
    int line;
} scanned_line;

/* The next line; false at the end of the text. */
bool scan_line(scanner *c, scanned_line *out);

/* The next number of a text in which blanks, line ends and commas separate them; `what` names it
 * for the message. Finite always. */
bool scan_number(scanner *c, const char *what, double *out, lux_error *err);

/* The same, a whole number in least..most, however written ("37", "37.0"). */
bool scan_count(scanner *c, const char *what, int least, int most, int *out, lux_error *err);

/* The next line as one number, with a point or a comma; what follows a blank is passed over. An
 * empty line is 0, with a notice, where blank_is_0; else an error. */
bool scan_line_number(scanner *c, const char *what, bool blank_is_0, double *out, lux_error *err);
bool scan_line_count(scanner *c, const char *what, int least, int most, int *out, lux_error *err);

/* Skips blanks, line ends and commas; true if anything is left. */
bool scan_left(scanner *c);

/* The next value of EULUMDAT's table, with a point or a comma: one a line, but blank lines are
 * passed over and several on a line are read, each with a notice, given once. *start: where the
 * value is. */
bool scan_value(scanner *c, const char *what, scanner *start, double *out, lux_error *err);

/* Whether all of a file that is not UTF-8 is likely Shift-JIS. */
bool text_is_shift_jis(const char *text, size_t length);

/* The trimmed line as UTF-8 in c->a, from UTF-8, Shift-JIS where c says so, or Latin-1; control
 * characters are made blanks; "" where the arena gives nothing. */
const char *scan_words(const scanner *c, const char *text, size_t length);

/* Whether the n bytes begin with the word, in any case. */
bool scan_begins(const char *text, size_t length, const char *word);

/* Where on its line the cursor is: 1, 2, ... */
int scan_column(const scanner *c);

/* "path:line:column: found 'x', expected WHAT" for the place the cursor is at. */
void *scan_wrong(const scanner *c, const char *expected, lux_error *err);

/* The web as a file stores it, before symmetry: rows[i] of gamma_count candelas at plane[i]. */
typedef struct stored_web {
    int plane_count, gamma_count;
    double *plane, *gamma;      /* deg; planes as stored, perhaps beyond [0, 360) */
    float *candela;             /* cd, plane after plane */
    int plane_line, gamma_line; /* of the file, where the angles begin */
    int plane_column;
} stored_web;

/* Room for a web in c->a; the product of the counts, which c stands at, is checked. */
bool stored_web_new(stored_web *w, int planes, int gammas, scanner *c, lux_error *err);

/* The same for one that is written out in what is left of the text: no room is made for more. */
bool stored_web_of_text(stored_web *w, int planes, int gammas, scanner *c, lux_error *err);

/* Makes *p's web of w, mirrored as p->symmetry says. */
bool web_unfold(photometry *p, const stored_web *w, scanner *c, lux_error *err);

/* Makes *p's web, type C, of one in type A or B (p->type): w->plane holds H, w->gamma V. */
bool web_from_ab(photometry *p, const stored_web *w, scanner *c, lux_error *err);

/* A candela value as the web takes it: times factor; negative ones are 0 and counted. False where
 * it is too large for a float. */
bool web_candela(double value, double factor, float *out, int *negative);

/* The opening of a LM-63 file by the signs of its dimensions in metres; false where the version
 * has no such signs, with the best guess in *p. */
bool opening_from_signs(photometry *p, double width, double length, double height);

/* LM-63: what follows "TILT =" on this line, trimmed; false if the line is another. */
bool ies_tilt_line(const scanned_line *l, scanned_line *value);

/* LM-63: everything up to the TILT line, whose value it gives. */
bool ies_read_labels(photometry *p, scanner *c, scanned_line *tilt, lux_error *err);

/* LM-63: the table that the TILT line stands for, if any. */
bool ies_read_tilt(photometry *p, scanner *c, const scanned_line *tilt, lux_error *err);

bool photometry_read_ies(photometry *p, scanner *c, lux_error *err);
bool photometry_read_eulumdat(photometry *p, scanner *c, lux_error *err);

#endif
