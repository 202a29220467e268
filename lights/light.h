/* lights/light.h -- what every light answers, for a packet of points at once.
 *
 * Lengths are in metres, angles in radians, light is radiometric: flux in W, intensity in
 * W/sr, radiance in W/(sr m^2), irradiance in W/m^2, in three channels of the same unit
 * (lumens are made of it at the user's side); directions are unit vectors that leave the
 * point being lit.
 *
 * Lights are immutable once made: every function here may run in any number of threads,
 * allocates nothing and cannot fail. Lanes outside `active` are not looked at. A function
 * returns the lanes that received light; in the other lanes its results are all zero,
 * so that sums over lanes and lights need no further masking.
 */
#ifndef LIGHTS_LIGHT_H
#define LIGHTS_LIGHT_H

#include "core/arena.h"
#include "core/error.h"
#include "core/packet.h"

typedef struct light light;
struct photometry;

/* One place of a light, as drawn for each point of a packet. */
typedef struct vlight_sample {
    vvec3 wi;    /* toward that place */
    vfloat dist; /* m, to that place, along which a shadow ray must be clear; INFINITY: far away */
    vrgb e;      /* W/m^2, on a surface facing wi, nothing in between; the pdf is divided out */
    vfloat pdf;  /* 1/sr; INFINITY for a light that no ray can find: without extent, or a line */
} vlight_sample;

/* What a ray meets of a light. */
typedef struct vlight_hit {
    vfloat dist;   /* m, along the ray */
    vrgb radiance; /* W/(sr m^2), toward the ray's origin */
    vfloat pdf;    /* 1/sr, with which sample() draws this direction from the ray's origin */
} vlight_hit;

/* Where a light is and where it shines to, for choosing among many: the orientation cone of Conty
 * Estevez and Kulla ("Importance Sampling of Many Lights with Adaptive Tree Splitting", HPG 2018,
 * section 4.1). Light goes only where its angle to some direction within `cos_spread` of the axis
 * is within `cos_reach`; the intensity in no direction is above `peak`. */
typedef struct light_bounds {
    vec3 low, high;   /* m, a box around the light */
    vec3 axis;        /* unit */
    float cos_spread; /* [-1, 1]; 1: the axis alone */
    float cos_reach;  /* [-1, 1]; 0: a hemisphere about each, -1: all around */
    float peak;       /* W/sr, as luminance; if far: W/m^2, on a surface facing it */
    bool far;         /* infinitely far: the box means nothing */
} light_bounds;

/* Light as it leaves a light, as drawn for each lane of a packet. */
typedef struct vlight_ray {
    vvec3 origin;    /* m: on the light; of one that is far away, before the target's sphere */
    vvec3 direction; /* unit, where it goes */
    vrgb flux;       /* W; the density of origin and direction is divided out: its mean over even
                        (s, t, u, v) is light_flux() or, of one that is far away, what of its light
                        would cross the target's sphere */
} vlight_ray;

/* Where the light of what is far away is wanted: within a sphere. */
typedef struct light_target {
    vec3 centre;  /* m */
    float radius; /* m, > 0 */
} light_target;

/* What a type of light is; one constant of this type per file of lights/. */
typedef struct light_type {
    const char *name; /* as study files write it */

    /* (s, t) in [0,1)^2 picks the place; even (s, t) make e an unbiased estimate. */
    vmask (*sample)(const light *self, const vvec3 *p, vfloat s, vfloat t, vmask active,
                    vlight_sample *out);

    /* What rays from p along wi meet of the light itself; the lanes that do. NULL: nothing can. */
    vmask (*hit)(const light *self, const vvec3 *p, const vvec3 *wi, vmask active, vlight_hit *out);

    /* The irradiance on a surface at p with unit normal n, W/m^2, exactly, nothing in between: the
     * part of the light that is below the surface's horizon left out. NULL: by samples alone. */
    vrgb (*irradiance)(const light *self, const vvec3 *p, const vvec3 *n, vmask active);

    /* About the same as a luminance, W/m^2, for choosing among lights: finite, and above 0 wherever
     * a sample may light the surface. NULL: what the one place of the light gives is that. */
    vfloat (*weight)(const light *self, const vvec3 *p, const vvec3 *n, vmask active);

    /* The light as if all of it came from its centre: *out as sample() gives it. In *error a bound
     * on what that is off, as a luminance in W/m^2, for a surface at p however it is turned, if its
     * horizon does not cut the light's box (vlight_is_whole): the part of a light that is below it
     * is worth more than that. Also in active lanes where the centre is dark; INFINITY close by,
     * where no such bound is known. NULL for a light without extent, of which sample() is exact. */
    vmask (*as_point)(const light *self, const vvec3 *p, vmask active, vlight_sample *out,
                      vfloat *error);

    /* Light as it sets out: (s, t) in [0,1)^2 picks the place, (u, v) the direction. The weights of
     * what is drawn differ as little as can be. `to` is read by lights that are far away. */
    vmask (*emit)(const light *self, const light_target *to, vfloat s, vfloat t, vfloat u, vfloat v,
                  vmask active, vlight_ray *out);

    vec3 (*flux)(const light *self); /* W, in all directions together; INFINITY if far away */

    /* The direction in which it shines strongest, and how strong, W/sr. NULL for a light that is as
     * strong in all directions, or far away. */
    vec3 (*peak)(const light *self, vec3 *toward);

    light_bounds (*bounds)(const light *self);
} light_type;

/* The first member of every light. */
struct light {
    const light_type *type;
};

static inline vmask light_sample(const light *l, const vvec3 *p, vfloat s, vfloat t, vmask active,
                                 vlight_sample *out)
{
    return l->type->sample(l, p, s, t, active, out);
}

static inline vec3 light_flux(const light *l) { return l->type->flux(l); }

static inline light_bounds light_bounds_of(const light *l) { return l->type->bounds(l); }

/* Whether it has one place only, so that (s, t) change nothing. */
static inline bool light_has_extent(const light *l) { return l->type->as_point != NULL; }

/* An upper bound of the irradiance, as a luminance in W/m^2, on any surface at p, nothing in
 * between: peak / distance^2 to the box; INFINITY within the box. */
vfloat vlight_power_bound(const light_bounds *b, const vvec3 *p, vmask active);

/* The lanes where the light's box is all above or all below the horizon of a surface at p with the
 * normal n. */
vmask vlight_is_whole(const light_bounds *b, const vvec3 *p, const vvec3 *n, vmask active);

/* Makers: check *d, copy it into a, and return a light that lives as long as a does,
 * or NULL with *err filled in; a is then as it was. */
typedef struct point_desc {
    vec3 position;  /* m */
    vec3 intensity; /* W/sr, the same in all directions, >= 0 */
} point_desc;

typedef struct cone_desc {
    vec3 position;      /* m */
    vec3 aim;           /* where the axis points; any length but 0 */
    vec3 intensity;     /* W/sr, within the inner cone, >= 0 */
    float inner, outer; /* rad, half angles, 0 <= inner < outer <= pi */
} cone_desc;

typedef struct parallel_desc {
    vec3 aim;        /* where the light goes; any length but 0 */
    vec3 irradiance; /* W/m^2, on a plane square to it, >= 0 */
    vec3 at;         /* m, the middle of the beam where it begins, if radius > 0 */
    float radius;    /* m, of the beam; 0: everywhere */
} parallel_desc;

/* The directional source of Barladian et al. (2007): I0 cos^n of the angle to the axis. */
typedef struct cosine_desc {
    vec3 position;  /* m */
    vec3 aim;       /* where the axis points; any length but 0 */
    vec3 intensity; /* W/sr, along the axis, >= 0 */
    float exponent; /* n >= 0, at most 1e4; 1: as a small matt surface */
} cosine_desc;

/* A line that shines around itself as a thin matt cylinder does: with the sine of the angle to it.
 */
typedef struct linear_desc {
    vec3 from, to;  /* m, two places */
    vec3 intensity; /* W/sr, of the whole line, square to it, >= 0; its flux is pi^2 times that */
} linear_desc;

/* Flat, Lambertian, shining from one side only. */
typedef struct disk_desc {
    vec3 centre;   /* m */
    vec3 aim;      /* the side that shines; any length but 0 */
    float radius;  /* m, > 0 */
    vec3 radiance; /* W/(sr m^2), >= 0 */
} disk_desc;

typedef struct rect_desc {
    vec3 centre; /* m */
    vec3 aim;    /* the side that shines; any length but 0 */
    vec3 up;     /* along `height`, after what of it lies along aim is taken off; not parallel */
    float width, height; /* m, > 0; width along aim x up: +x if aimed down with up = +y */
    vec3 radiance;       /* W/(sr m^2), >= 0 */
} rect_desc;

/* A triangle of a glowing surface: Lambertian, shining from both sides. */
typedef struct triangle_desc {
    vec3 corner[3]; /* m; an area > 0 */
    vec3 radiance;  /* W/(sr m^2), >= 0 */
} triangle_desc;

/* What luminaires of one web share: tables of some 20 KB that take milliseconds to make. */
typedef struct luminaire_model luminaire_model;

typedef struct luminaire_desc {
    vec3 position; /* m, centre of the luminous opening */
    vec3 aim;      /* where gamma = 0 points; any length but 0 */
    float rotate;  /* rad, counter-clockwise about +z seen from above, before aiming */
    vec3 scale;    /* W/sr for each candela of the file: dimming, colour, 1/179; >= 0 */
    const struct photometry *web; /* must outlive the light; several lights may share it */
    const luminaire_model *model; /* of this web, or of one that differs in its opening alone; must
                                     outlive the light; NULL: one is made for it */
    vec3 c0; /* where C0 points, in place of `rotate`, after what of it lies along aim is taken off;
                0 0 0: as `rotate` says. C90 is C0 x aim: +y if aimed down with C0 = +x */
    bool point; /* leave the opening out: all light comes from the position */
} luminaire_desc;

const light *light_point(arena *a, const point_desc *d, lux_error *err);
const light *light_cone(arena *a, const cone_desc *d, lux_error *err);
const light *light_parallel(arena *a, const parallel_desc *d, lux_error *err);
const light *light_cosine(arena *a, const cosine_desc *d, lux_error *err);
const light *light_linear(arena *a, const linear_desc *d, lux_error *err);
const light *light_disk(arena *a, const disk_desc *d, lux_error *err);
const light *light_rect(arena *a, const rect_desc *d, lux_error *err);
const light *light_triangle(arena *a, const triangle_desc *d, lux_error *err);
const light *light_luminaire(arena *a, const luminaire_desc *d, lux_error *err);

/* For all luminaires of that web, which must outlive them. NULL, with *err, where a light could not
 * be made of it either. */
const luminaire_model *luminaire_model_new(arena *a, const struct photometry *web, lux_error *err);

/* The same one, looked up in another way; m must outlive it. */
struct table_measures;
const luminaire_model *luminaire_model_measured(arena *a, const luminaire_model *m,
                                                const struct table_measures *by, lux_error *err);

#endif
