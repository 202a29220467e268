/* lights/photometry.h -- the light of a luminaire by direction, as a laboratory measured it.
 *
 * Read from LM-63 (.ies: 1986, 1991, 1995, 2002, 2019; types A, B and C) or EULUMDAT (.ldt)
 * files: the contents decide, not the name. Angles are in degrees, as the files have them,
 * lengths in metres, light in candelas and lumens. Everything lives in the arena that it was
 * read into and may be shared between threads.
 */
#ifndef LIGHTS_PHOTOMETRY_H
#define LIGHTS_PHOTOMETRY_H

#include "core/arena.h"
#include "core/error.h"
#include "core/notice.h"

#include <stddef.h>

typedef enum photometry_format {
    PHOTOMETRY_NO_FILE, /* made by a program */
    PHOTOMETRY_LM63_1986,
    PHOTOMETRY_LM63_1991,
    PHOTOMETRY_LM63_1995,
    PHOTOMETRY_LM63_2002,
    PHOTOMETRY_LM63_2019,
    PHOTOMETRY_EULUMDAT,
} photometry_format;

/* What the file says that its web is the same under. */
typedef enum photometry_symmetry {
    SYMMETRY_NONE,
    SYMMETRY_C0,         /* a mirror in the plane C0-C180 */
    SYMMETRY_C90,        /* a mirror in the plane C90-C270 */
    SYMMETRY_QUADRANT,   /* both mirrors */
    SYMMETRY_ROTATIONAL, /* any turn about the axis */
} photometry_symmetry;

/* The luminous opening. Round shapes have their diameters as length and width; elliptic ones, two
 * that differ. A line has one of length, width and height; a vertical disc has two, and faces
 * along the one that is 0. */
typedef enum opening_shape {
    OPENING_POINT,
    OPENING_LINE,
    OPENING_RECTANGLE,
    OPENING_BOX,
    OPENING_DISC,
    OPENING_VERTICAL_CYLINDER,
    OPENING_SPHERE,
    OPENING_CYLINDER_ALONG,  /* a horizontal cylinder, its axis along the length */
    OPENING_CYLINDER_ACROSS, /* the same along the width */
    OPENING_VERTICAL_DISC,   /* facing the horizontal, gamma 90 */
} opening_shape;

/* A web in type C: candela[plane * gamma_count + ring], linear between the angles given; planes
 * ascend through [0, 360) and wrap around; below the first and above the last gamma is darkness.
 * Symmetry is unfolded: one plane (rotational) or planes all the way around. What follows the
 * first group is for reports: a web made by a program may leave it zero. */
typedef struct photometry {
    int plane_count, gamma_count;
    const float *plane_deg;  /* [0, 360), ascending, C0 along the axes of interface.md */
    const float *gamma_deg;  /* [0, 180], ascending, 0 along the aim */
    const float *candela;    /* cd, >= 0, all factors of the file applied */
    double luminaire_lumens; /* lm, the integral of the web */
    double lamp_lumens;      /* lm, as the file says; 0: not said (absolute photometry) */

    photometry_format format;
    char type; /* 'A', 'B' or 'C', as measured */
    photometry_symmetry symmetry;
    bool absolute;     /* absolute photometry: measured with its own lamps, LOR 1 by definition */
    double watts;      /* W, input; 0: not said */
    double stated_lor; /* what EULUMDAT says of the LOR, 1 for 100 %; 0: not said */
    double stated_lumens; /* lm, of the luminaire, where an absolute EULUMDAT says it; else 0 */
    opening_shape opening;
    float length, width, height; /* m, of the luminous opening, >= 0 */
    float length_along_deg;      /* the C plane along which the length lies: 0 (LM-63), 90 */

    /* UTF-8, never NULL after reading: LM-63 keywords or their like in EULUMDAT */
    const char *manufacturer; /* MANUFAC, line 1 */
    const char *catalog;      /* LUMCAT, luminaire number */
    const char *name;         /* LUMINAIRE, luminaire name */
    const char *lamp;         /* LAMP, type of lamps */
    const char *report;       /* TEST, measurement report */
    const char *date;         /* ISSUEDATE, date/user */

    /* m, the heights of the opening's faces toward C0, C90, C180, C270: EULUMDAT may tell them
     * apart; else all are `height`, which is the greatest */
    float side_height[4];

    /* LM-63's TILT: what the lamp gives, of what it gave when measured, by how far the luminaire
     * is aimed from straight down; count 0: the same in every tilt */
    int tilt_count;
    int tilt_geometry;        /* 1: lamp vertical; 2: horizontal always; 3: horizontal, tilting */
    const float *tilt_deg;    /* [0, 180], ascending */
    const float *tilt_factor; /* >= 0 */
} photometry;

/* Reads the file at path into a. NULL, with *err naming file, line and what was expected. What
 * breaks the format but can be understood is, and says so in n (may be NULL). */
const photometry *photometry_read(arena *a, const char *path, notices *n, lux_error *err);

/* The same from the bytes of a file, followed by a NUL that size does not count; path is for
 * messages, and its folder is where the file that TILT= names is looked for. */
const photometry *photometry_parse(arena *a, const char *path, const char *bytes, size_t size,
                                   notices *n, lux_error *err);

/* The light between two angles gamma, 0 <= from <= to <= 180 deg, in lm: the exact integral of
 * the web as it is interpolated,
 *
 *     F = integral of I(C, gamma) sin(gamma) dC dgamma
 *
 * Along C the web is linear between planes, so its integral over C is the sum of the planes,
 * each times half the angle between its neighbours. Along gamma it is linear in a cell, and
 *
 *     integral from g to h of I sin = I(g) cos g - I(h) cos h + (I(h) - I(g)) (sin h - sin g) / (h
 * - g)
 */
double photometry_flux(const photometry *p, double from_deg, double to_deg);

/* cd, at any C and at gamma in [0, 180] deg, by bilinear interpolation in double. */
double photometry_candela(const photometry *p, double plane_deg, double gamma_deg);

/* What the light of a luminaire aimed tilt_deg from straight down is to be multiplied by, for what
 * that does to its lamp: linear in the angle, the ends' values beyond them; 1 without a table. */
double photometry_tilt_factor(const photometry *p, double tilt_deg);

/* What data sheets say of a luminaire, all worked out from the web. */
typedef struct photometry_figures {
    double maximum_cd, maximum_plane_deg, maximum_gamma_deg; /* the first, of equal ones */

    /* Output over that of the lamps, and its part above the horizon; absolute photometry has
     * LOR 1. Known where lor_known: else both are 0, the file does not say the lamps' lumens. */
    bool lor_known;
    double lor, lor_up;
    double efficacy; /* lm/W, of the luminaire; 0 where the watts are not known */

    /* Full angles in deg: the smallest one in the plane C0-C180 [0] and C90-C270 [1] that holds
     * each direction in which the intensity is at least half (beam) or a tenth (field) of the
     * greatest intensity in that plane; 360 if they are everywhere, 0 in a dark plane. */
    double beam_deg[2], field_deg[2];

    /* CIE flux code, in per cent. With FC1..4 the flux within gamma 41.4, 60, 75.5 and 90 deg
     * (cosines 3/4, 1/2, 1/4, 0: cones of pi/2, pi, 3 pi/2, 2 pi sr) and F the whole flux:
     * N1..3 = FC1..3 / FC4, N4 = FC4 / F, N5 = LOR (CIE 52; EN 13032-2). 0 where undefined. */
    double flux_code[5];
} photometry_figures;

/* Works out the figures, and adds what is doubtful about them to n (may be NULL): a LOR above
 * 1.02, an output that differs by more than 5 % from the one stated. path is for messages. */
photometry_figures photometry_figure(const photometry *p, const char *path, notices *n);

/* Writes p to path as LM-63-2002 (.ies) or EULUMDAT (.ldt), as the name ends; whole or not at all.
 * C planes and light stay where they are, whatever the format: a study gives the same result
 * with either. So does the opening: as its length lies along C0 in one format and along C90 in
 * the other, length and width are exchanged between them. What a format has no word for is said
 * in n (may be NULL). */
bool photometry_write(const photometry *p, const char *path, notices *n, lux_error *err);

const char *photometry_format_name(photometry_format f);     /* "LM-63-2002" */
const char *photometry_symmetry_name(photometry_symmetry s); /* "C0-C180" */
const char *opening_shape_name(opening_shape s);             /* "disc" */

#endif
