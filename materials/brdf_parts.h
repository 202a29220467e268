/* materials/brdf_parts.h -- what a table of reflection is made of; only brdf*.c include it.
 *
 * All tables begin at theta 0 and end at 90 degrees and go round in azimuth: what the file does not
 * have was made by repeating its border. So the cell that a look-up falls into is known by its
 * first corner, and directions are drawn from the cells of the table itself:
 *
 *               axes                                       cells that wi is drawn from
 *   isotropic   theta_out, theta_in, delta_phi             theta_in x delta_phi
 *   anisotropic theta_out, phi_out, theta_in, phi_in       theta_in x phi_in
 *   half        theta_h, theta_d, phi_d                    theta_h x azimuth of h from wo
 */
#ifndef MATERIALS_BRDF_PARTS_H
#define MATERIALS_BRDF_PARTS_H

#include "core/lane_math.h"
#include "core/packet_math.h"
#include "core/table.h"
#include "materials/brdf.h"

enum { BRDF_MOST_PLACES = 4 << 20, BRDF_MOST_AXIS = 2000 };

/* Directions of wo for which the table is integrated, and from whose rows wi is drawn: albedo and
 * densities are linear between them. */
typedef struct brdf_nodes {
    table_axis theta, phi; /* rad; phi has one place unless the table is anisotropic */
    float *albedo;         /* 4 a node: RGB and their mean */
} brdf_nodes;

/* Cells of even density, cell_thetas x cell_phis of them for each node. Their measure is projected
 * solid angle of wi, or of half tables solid angle of h; theta_edges (one more than cells) are
 * sin^2 theta, or of half tables sin^2(theta_h / 2), in which it is even. */
typedef struct brdf_cells {
    int thetas, phis;
    const float *theta_edges, *phi_edges; /* phi: rad */
    const float *rows, *columns;          /* cumulative: of each node, of each row of each node */
    const float *density;                 /* mean albedo * share of the cell / its measure, 1/sr */
} brdf_cells;

struct brdf {
    brdf_kind kind;
    table_axis axes[4]; /* rad */
    float *values;      /* 1/sr, 4 a place: RGB and a spare; on a multiple of 16 bytes */
    brdf_nodes nodes;
    brdf_cells cells;
    vec3 reflectance; /* of diffuse light */
    brdf_figures figures;
    table_measures measures;
};

/* What a pair of directions finds in a table. */
typedef struct vbrdf_place {
    vtable_place axes[4];    /* of the values */
    vtable_place theta, phi; /* of wo among the nodes */
    vint cell;               /* of wi: which of those that one node has */
    vfloat to_sr;            /* from the cells' measure to 1/sr of wi */
} vbrdf_place;

/* Where wo is among the nodes. */
static inline void vbrdf_node(const brdf *b, const vvec3 *wo, vtable_place *theta,
                              vtable_place *phi)
{
    *theta = vtable_find(&b->nodes.theta, vatan2(vsqrt(wo->x * wo->x + wo->y * wo->y), wo->z));
    *phi   = vtable_find(&b->nodes.phi, vatan2(wo->y, wo->x));
}

/* An angle by which the values are looked up. */
static inline vfloat vbrdf_angle(const brdf *b, vfloat y, vfloat x)
{
    return b->measures.libm ? lane_atan2(y, x) : vatan2(y, x);
}

/* The horizontal direction of wo, of some length; x where wo is upright. */
static inline void vbrdf_heading(const vvec3 *wo, vfloat *x, vfloat *y)
{
    vmask leans = wo->x * wo->x + wo->y * wo->y > 1e-30f;
    *x          = vselect(leans, wo->x, vsplat(1.0f));
    *y          = vkeep(leans, wo->y);
}

/* The whole place for wo and wi above the horizon; `cell` and what follows only if `drawn`. */
void vbrdf_find(const brdf *b, const vvec3 *wo, const vvec3 *wi, bool drawn, vbrdf_place *out);

/* The values there: RGB and the spare. (Where they are those of the nearest places, what is drawn,
 * and how often, is as ever.) */
static inline void vbrdf_blend(const brdf *b, const vbrdf_place *p, vfloat out[4])
{
    const vtable_place *axes = p->axes;
    vtable_place nearest[4];
    if (b->measures.nearest) {
        for (int i = 0; i < (b->kind == BRDF_ANISOTROPIC ? 4 : 3); i++)
            nearest[i] = vtable_nearest(p->axes[i]);
        axes = nearest;
    }
    if (b->kind == BRDF_ANISOTROPIC)
        vtable_fours4(b->values, b->axes, axes, out);
    else
        vtable_fours3(b->values, b->axes, axes, out);
}

/* What one of four numbers a node, `every` floats apart, is at wo. */
vfloat vbrdf_of_nodes(const brdf *b, const float *values, int every, vtable_place theta,
                      vtable_place phi);

/* wi of each lane, which may be below the horizon: drawn from the cells, now and then by the cosine
 * alone. */
vvec3 vbrdf_draw(const brdf *b, const vvec3 *wo, vfloat u, vfloat v, vfloat pick);

/* The density of that, 1/sr. */
vfloat vbrdf_pdf(const brdf *b, const vbrdf_place *p, vfloat cos_in);

/* Integrals of a table whose axes and values are there; scales it and tells of it. */
bool brdf_integrate(brdf *b, arena *a, const char *name, notices *n, lux_error *err);

/* Sets figures.reciprocity_mean and _worst. */
void brdf_measure_reciprocity(brdf *b);

/* Weights of the cells of one node, thetas * phis, and its albedo: in brdf_half.c for half tables.
 */
void brdf_half_node(const brdf *b, int node, double *cells, double rgb[3]);

/* Whether an axis is as brdf_data wants it; else false with *err, which `where` begins. */
bool brdf_check_places(const char *where, brdf_kind kind, int axis, const double *deg, int count,
                       lux_error *err);

/* The readers. The text ends in a NUL. */
const brdf *brdf_read_text(arena *a, const char *path, const char *text, size_t size, notices *n,
                           lux_error *err);
const brdf *brdf_read_merl(arena *a, const char *path, const char *bytes, size_t size, notices *n,
                           lux_error *err);

#endif
