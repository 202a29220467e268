/* lights/luminaire.h -- what the files of the luminaire share: luminaire.c makes one that shines
 * from a point, luminaire_area.c has those that shine from their openings, luminaire_error.c says
 * how far the one is off the other, luminaire_model.c makes what all of one web share.
 */
#ifndef LIGHTS_LUMINAIRE_H
#define LIGHTS_LUMINAIRE_H

#include "core/lane_math.h"
#include "core/packet_math.h"
#include "core/table.h"
#include "lights/light.h"
#include "lights/opening.h"

/* The web in cells, for drawing directions: luminaire_emit.c. Ring edges are counted by 1 - cos
 * of the angle from the nearer pole. */
typedef struct web_cells {
    int planes, rings;       /* of cells */
    const float *plane;      /* rad: planes + 1 edges, all around */
    const float *low, *wide; /* of each ring: where it begins, to where it ends */
    const float *candela;    /* planes + 1 of each ring edge */
    const float *ring_cdf;   /* of rings */
    const float *plane_cdf;  /* of planes, for each ring */
    const int32_t *down;     /* of each ring: counted from gamma 0; else from 180 degrees */
} web_cells;

/* A web as luminaires look it up, whatever their opening. */
struct luminaire_model {
    double lumens;  /* cd sr: the integral of the web */
    vec3 strongest; /* unit, along C0, C90 and gamma 0: where the largest candela points */
    float most;     /* cd: the largest */
    const float *candela;
    table_axis axes[2];          /* rad: C, gamma */
    float gamma_from, gamma_to;  /* rad: dark outside of them */
    float down_least, down_most; /* cosines of gamma, a rounding apart: dark outside of them */
    const float *error;          /* by direction: luminaire_error.c */
    web_cells cells;
    table_measures measures;
};

typedef struct luminaire {
    light base;
    const luminaire_model *model;
    vec3 position;      /* m */
    vec3 c0, c90, axis; /* unit: where C0, C90 and gamma 0 point */
    vec3 scale;         /* W/sr for each candela */

    opening opening;
    vec3 own[3]; /* unit: the opening's own axes */
    vec3 reach;  /* m: half the size of the box around the opening, along the world's axes */
} luminaire;

extern const light_type luminaire_area_type, luminaire_line_type;

vec3 luminaire_flux(const light *self);
vec3 luminaire_peak(const light *self, vec3 *toward);
light_bounds luminaire_bounds(const light *self);

/* What luminaire_as_point needs to know of the web; NULL: memory is out. */
const float *luminaire_error_table(arena *a, const photometry *web, lux_error *err);

/* In memory of a; false: it is out. */
bool luminaire_cells_make(arena *a, const photometry *web, web_cells *to, lux_error *err);

/* light.h's emit. */
vmask luminaire_emit(const light *self, const light_target *to, vfloat s, vfloat t, vfloat u,
                     vfloat v, vmask active, vlight_ray *out);

/* light.h's as_point. */
vmask luminaire_as_point(const light *self, const vvec3 *p, vmask active, vlight_sample *out,
                         vfloat *error);

static inline vfloat vluminaire_angle(const luminaire_model *m, vfloat y, vfloat x)
{
    return m->measures.libm ? lane_atan2(y, x) : vatan2(y, x);
}

/* cd in the direction (x, y, down) of the luminaire's frame, which is at gamma: gamma =
 * atan2(sqrt(x^2
 * + y^2), down), C = atan2(y, x); the lanes where it is not dark. */
static inline vmask vluminaire_lookup(const luminaire_model *m, vfloat x, vfloat y, vfloat gamma,
                                      vmask active, vfloat *cd)
{
    vfloat plane = m->axes[0].count > 1 ? vluminaire_angle(m, y, x) : vsplat(0.0f);
    if (m->measures.nearest)
        *cd = vtable_blend2(m->candela, m->axes[1].count,
                            vtable_nearest(vtable_find(&m->axes[0], plane)),
                            vtable_nearest(vtable_find(&m->axes[1], gamma)));
    else
        *cd = vtable_lookup2(m->candela, m->axes, plane, gamma);
    return active & (gamma >= m->gamma_from) & (gamma <= m->gamma_to) & (*cd > 0.0f);
}

/* cd toward a point that sees the place along the unit vector wi; the lanes where it is not dark.
 */
static inline vmask vluminaire_candela(const luminaire *l, vvec3 wi, vmask active, vfloat *cd)
{
    vfloat x     = -vdot(wi, vspread(l->c0));
    vfloat y     = -vdot(wi, vspread(l->c90));
    vfloat down  = -vdot(wi, vspread(l->axis));
    vmask inside = active & (down >= l->model->down_least) & (down <= l->model->down_most);
    if (!vany(inside))
        return inside;
    vfloat gamma = vluminaire_angle(l->model, vsqrt(x * x + y * y), down);
    return vluminaire_lookup(l->model, x, y, gamma, inside, cd);
}

#endif
