/* sim/photometry_report.h -- what `lux4 photometry` says of photometric files. */
#ifndef SIM_PHOTOMETRY_REPORT_H
#define SIM_PHOTOMETRY_REPORT_H

#include "lights/photometry.h"

#include <stdio.h>

typedef struct photometry_options {
    bool json;
    const char *plot;  /* an SVG file to write, or NULL; with one file only */
    const char *write; /* an .ies or .ldt file to write, or NULL; with one file only */
    bool overwrite;    /* replace what stands at these names */
} photometry_options;

/* Reads the files and reports on each to `out`: labelled figures, or with o->json one object as
 * interface.md has it. Warnings go into n, and into the object. A file that is refused does not
 * keep the others from being reported: the first one's error is returned at the end, the others'
 * are in n. False, with *err, if a file was refused or an output could not be written. */
bool photometry_report(FILE *out, const char *const *files, int count, const photometry_options *o,
                       notices *n, lux_error *err);

/* Writes the polar diagram of data sheets as SVG: gamma 0 down, C0-C180 a full line with C0 on
 * the right, C90-C270 a broken one with C90 on the right; in cd/klm where the lamps' lumens are
 * known, else in cd. */
bool photometry_plot(const photometry *p, const char *title, const char *path, lux_error *err);

#endif
