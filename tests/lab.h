/* tests/lab.h -- whole studies for tests of physics: the files beside them, models made of quads,
 * sensors at points; and what Lambert says that a polygon gives.
 */
#ifndef TESTS_LAB_H
#define TESTS_LAB_H

#include "sim/grid.h"

/* A folder for a study's files, and the memory of what is made from them. */
typedef struct lab {
    arena a;
    char *folder;
} lab;

void lab_open(lab *l);
void lab_close(lab *l);
void lab_write(lab *l, const char *name, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

typedef struct quad {
    dvec3 corner[4]; /* m, z up, in their order around it */
} quad;

/* Members of a glTF file, "buffers" to "meshes": mesh 0 is these quads, of material 0, and accessor
 * 2 holds the places, if there are any. */
char *lab_mesh(lab *l, const quad *q, int count, const dvec3 *place, int places);

/* A file of these quads at one node, of a material with these members. */
void lab_quads(lab *l, const char *name, const quad *q, int count, const char *made_of);

/* The six sides of a box. */
void quads_of_box(dvec3 low, dvec3 high, quad out[6]);

/* A material that glows with so many cd/m^2 and reflects nothing. */
char *lab_glow(lab *l, double luminance);

/* Something somewhere, far from all that matters, so that lamps count as shaded by it: for
 * `scene:`. Below the lamps and sensors of a test, 30 m away. */
void lab_speck(lab *l, const char *name);

/* The scene of a study in that folder. */
const scene *lab_scene(lab *l, const char *yaml);

typedef struct lab_probe {
    dvec3 at, normal;
} lab_probe;

/* Runs the study with a grid of these sensors. `grid` holds more members of it (", quantity: ..."),
 * NULL: none. */
void lab_measure(lab *l, const char *yaml, const char *grid, const lab_probe *p, int count,
                 const run_options *o, grid_result *out);

/* Fails unless each sensor has the lux wanted within its interval, stretched from 95 % to 99.9 % (t
 * of 15 degrees of freedom), and `exact` of it; and its interval is as narrow as asked for: within
 * accuracy of max(want, a tenth of their mean). What is as accurate as asked is good enough:
 * behind a straight edge, even samples may all but agree on a value that is a little off. */
void lab_check(const char *what, const grid_result *r, const double *want, double exact,
               double accuracy);

/* The same by every transport with every depth of roulette (transports.h), each of another seed,
 * but for the one map. */
void lab_check_all_ways(const char *what, const char *yaml, lab *l, const lab_probe *p, int count,
                        const double *want, double exact, double accuracy);

/* Lux of a polygon of 1 cd/m^2, both sides of it shining, at p on a surface with that normal
 * (Lambert's formula), what is below the surface's horizon cut off. At most 8 corners. */
double polygon_lux(const dvec3 *corner, int count, dvec3 p, dvec3 normal);

#endif
