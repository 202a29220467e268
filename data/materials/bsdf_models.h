/* data/materials/bsdf_models.h -- the models that glazing.xml and blind.xml are made of.
 *
 * Directions are the ways light takes, in the file's axes: x and y as they are, z by which side
 * light arrives at or leaves from. Cells are those of LBNL's Klems full basis.
 */
#ifndef DATA_MATERIALS_BSDF_MODELS_H
#define DATA_MATERIALS_BSDF_MODELS_H

#include <stdbool.h>
#include <stdio.h>

enum { FULL_CELLS = 145, FULL_SAMPLES = 16 }; /* samples of a cell along each of its axes */

/* f(in, out), 1/sr, of light that arrives in front (the outside) or at the back (the room). */
typedef struct bsdf_model {
    const char *name;
    double transmission[2][FULL_CELLS][FULL_CELLS]; /* [front, back][in][out] */
    double reflection[2][FULL_CELLS][FULL_CELLS];
} bsdf_model;

/* Projected solid angle, sr; the sample (i, j) of a cell, all even in projected solid angle. */
double full_area(int cell);
void full_sample(int cell, int i, int j, double way[3]);

/* Of a pane: shares reflected and let through, for one polarisation each. */
typedef struct pane_share {
    double reflected[2], passed[2];
} pane_share;

/* n: index; clear: what of light passes the glass once, square to it; cos_in, (0, 1]. */
pane_share pane_of(double n, double clear, double cos_in);
pane_share pane_behind_pane(pane_share outer, pane_share inner);

/* Two panes of clear glass. */
void model_glazing(bsdf_model *m);

/* Flat, thin, matt slats. */
typedef struct slats {
    double width, spacing; /* m */
    double tilt;           /* rad: how far they rise toward the room */
    double reflectance;    /* of both faces */
} slats;

/* Those of blind.xml: 25 mm deep, 20 mm apart, at 45 deg, 0.7. */
slats slats_shipped(void);

/* What of light that arrives at a side goes straight through. */
double slats_open(const slats *s, int side, const double way[3]);
bool model_blind(bsdf_model *m, const slats *s); /* false: out of memory */

/* The file. */
bool model_write(const bsdf_model *m, FILE *to);

#endif
