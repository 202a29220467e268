/* tests/bsdf_twin.h -- BSDFs for tests: texts as files have them, and what they mean, in double.
 *
 * Directions leave the layer: from where light comes, to where it goes; z > 0 on the side of the
 * room. All parts are numbered as in twin_names[].
 */
#ifndef TESTS_BSDF_TWIN_H
#define TESTS_BSDF_TWIN_H

#include "materials/bsdf.h"

typedef struct twin_basis {
    const char *name;
    int rings, cells;
    const double *edge; /* deg, rings + 1 of them */
    const int *count;
} twin_basis;

extern const twin_basis twin_full, twin_half, twin_quarter;
extern const char *const twin_names[4]; /* Transmission Front, Back, Reflection Front, Back */

/* sr; of (x, y, |z|); its middle, likewise. */
double twin_area(const twin_basis *b, int cell);
int twin_cell(const twin_basis *b, double x, double y, double z);
void twin_middle(const twin_basis *b, int cell, double out[3]);

/* Whether a direction is within a millionth of a border between cells, where floats may differ. */
bool twin_at_edge(const twin_basis *b, double x, double y, double z);

/* A whole file; a bit of `parts` for each part it holds. `value` is asked for cells in and out of
 * part i; rows: a row for each in. Freed by the caller. */
typedef double twin_value(int part, int in, int out, const void *with);
char *twin_text(const twin_basis *b, unsigned parts, bool rows, twin_value *value,
                const void *with);

/* A file of tensor trees: those parts, of random branches and leaves; what stands at a place. */
char *twin_tree_text(int rank, unsigned parts);
double twin_tree_value(int rank, int part, const double place[4]);

/* Writes a text to a file in a folder and reads it; NULL, with *err. */
const bsdf *twin_read(arena *a, const char *text, notices *n, lux_error *err);

#endif
