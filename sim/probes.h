/* sim/probes.h -- places and directions at which illuminance is asked for, from a CSV file.
 *
 *     x,y,z,nx,ny,nz
 *     1.5,2.0,0.75,0,0,1
 *
 * Metres; the normal has any length but 0. The columns may stand in any order, but all are named
 * in the first row. Spaces around numbers, blank lines, lines that begin with #, a byte-order
 * mark and CRLF are passed over. No quotes.
 */
#ifndef SIM_PROBES_H
#define SIM_PROBES_H

#include "core/arena.h"
#include "core/error.h"
#include "core/transform.h"

typedef struct probes {
    int count;       /* 1 .. 4,000,000 */
    dvec3 *position; /* m, each coordinate at most 1e12 */
    dvec3 *normal;   /* unit length */
} probes;

/* Reads the file at path into a. False, with *err naming file, line, column and what was
 * expected. */
bool probes_read(arena *a, const char *path, probes *out, lux_error *err);

/* The same for a text in memory that ends with a NUL; path is for messages. */
bool probes_parse(arena *a, const char *path, const char *text, probes *out, lux_error *err);

#endif
