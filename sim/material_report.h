/* sim/material_report.h -- what `lux4 material` says of measured materials. */
#ifndef SIM_MATERIAL_REPORT_H
#define SIM_MATERIAL_REPORT_H

#include "materials/brdf.h"
#include "materials/bsdf.h"
#include "sim/grid.h"

#include <stdio.h>

typedef struct material_options {
    bool json;
    const char *plot;       /* an SVG file to write, or NULL; with one file only */
    const char *swatch;     /* a PNG file to write, or NULL; with one file only */
    bool overwrite;         /* replace what stands at these names */
    const run_options *run; /* of the swatch */
} material_options;

/* Reads the files and reports on each to `out`: labelled figures, or with o->json one object, as
 * `lux4 help material` has it. Warnings go into n, and into the object. A file that is refused does
 * not keep the others from being reported: the first one's error is returned at the end, the
 * others' are in n. False, with *err, if a file was refused or an output could not be written. */
bool material_report(FILE *out, const char *const *files, int count, const material_options *o,
                     notices *n, lux_error *err);

/* ---- between report and plot ----------------------------------------------------------------- */

/* A file as read: a table of reflection, or a layer that lets light through. */
typedef struct measured {
    const char *path;
    const brdf *table;    /* NULL, */
    const bsdf *layer;    /* or this */
    const material *made; /* of it; in the surface's frame, z its normal, x a table's azimuth 0.
                             A layer is in the file's: z into the room, y up */
} measured;

/* Reads the file at path, in a; *.xml is a BSDF. False, with *err. */
bool measured_read(arena *a, const char *path, measured *out, notices *n, lux_error *err);

/* Where beams come from: planes of incidence that differ, on the sides that do. */
enum { MOST_SIDES = 2, MOST_PLANES = 3 };
typedef struct beam_side {
    const char *name; /* "front" */
    double sign;      /* of the beam's z */
} beam_side;
typedef struct beam_plane {
    const char *name;   /* "from above" */
    double azimuth_deg; /* of the beam */
} beam_plane;
typedef struct beams {
    int side_count, plane_count;
    beam_side sides[MOST_SIDES];
    beam_plane planes[MOST_PLANES];
} beams;
beams beams_of(const measured *m);
vec3 beam_from(double sign, double azimuth_deg, double angle_deg);

/* Draws the lobes and the albedo of each side, or of each plane of a table that has several. */
bool material_plot(const measured *m, const char *title, const char *path, lux_error *err);

#endif
