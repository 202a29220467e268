/* materials/look.c -- see look.h: what textures make of a material's look, and normal maps. */
#include "materials/material_parts.h"
#include "materials/shading_normal.h"

/* Where a packet is on a material's textures. */
typedef struct place {
    const vdetail *detail;
    vfloat width; /* m */
    vmask lanes;
} place;

static vfloat share(vfloat a) { return vmin(vmax(a, vsplat(0.0f)), vsplat(1.0f)); }
static vrgb share3(vrgb a) { return (vrgb){ share(a.x), share(a.y), share(a.z) }; }

static vrgb not_below_0(vrgb a)
{
    const vfloat zero = vsplat(0.0f);
    return (vrgb){ vmax(a.x, zero), vmax(a.y, zero), vmax(a.z, zero) };
}

static vrgb times(vec3 constant, vtexel t)
{
    return (vrgb){ constant.x * t.red, constant.y * t.green, constant.z * t.blue };
}

/* White where there is no texture. A square of the surface stays as large as its area is. */
static vtexel look_up(const texture_slot *slot, const place *at)
{
    const vfloat one = vsplat(1.0f);
    if (!slot->texture)
        return (vtexel){ one, one, one, one };
    const float *m = slot->m;
    vfloat u       = at->detail->u[slot->set];
    vfloat v       = at->detail->v[slot->set];
    vfloat scale   = vsqrt(vabs(vsplat(m[0] * m[4] - m[1] * m[3])));
    return vtexture_lookup(slot->texture, m[0] * u + m[1] * v + m[2], m[3] * u + m[4] * v + m[5],
                           at->width * at->detail->scale[slot->set] * scale, at->lanes);
}

/* glTF 2.0, 3.9.4. Where a mask has holes does not depend on how wide the ray is that asks: the
 * mean of fine lace would be all or nothing. */
static vfloat openness_of(const material *m, const place *at, vfloat alpha)
{
    place sharp  = { at->detail, vsplat(0.0f), at->lanes };
    vfloat there = (1.0f - m->look.openness) * alpha;
    switch (m->textures->alpha) {
    case ALPHA_MASK:
        there = (1.0f - m->look.openness) * look_up(&m->textures->base, &sharp).alpha;
        return vselect(there >= m->textures->cutoff, vsplat(0.0f), vsplat(1.0f));
    case ALPHA_BLEND:
        return share(1.0f - there);
    default:
        return vsplat(m->look.openness);
    }
}

static vlook look_at(const material *m, const place *at)
{
    const material_textures *t = m->textures;
    const material_look *c     = &m->look;
    vtexel base                = look_up(&t->base, at);
    if (t->alpha_only)
        base.red = base.green = base.blue = vsplat(1.0f);
    vtexel surface = look_up(&t->surface, at);
    return (vlook){
        .color           = share3(times(c->color, base)),
        .emission        = not_below_0(times(c->emission, look_up(&t->emission, at))),
        .specular        = not_below_0(times(c->specular, look_up(&t->specular_color, at))),
        .openness        = openness_of(m, at, base.alpha),
        .metallic        = share(c->metallic * surface.blue),
        .roughness       = share(c->roughness * surface.green),
        .transmission    = share(c->transmission * look_up(&t->transmission, at).red),
        .specular_weight = share(c->specular_weight * look_up(&t->specular_weight, at).alpha),
    };
}

static void take(vlook *to, const vlook *from, vmask m)
{
    to->color           = vselect3(m, from->color, to->color);
    to->emission        = vselect3(m, from->emission, to->emission);
    to->specular        = vselect3(m, from->specular, to->specular);
    to->openness        = vselect(m, from->openness, to->openness);
    to->metallic        = vselect(m, from->metallic, to->metallic);
    to->roughness       = vselect(m, from->roughness, to->roughness);
    to->transmission    = vselect(m, from->transmission, to->transmission);
    to->specular_weight = vselect(m, from->specular_weight, to->specular_weight);
}

/* ---- normal maps ----------------------------------------------------------------------------- */

/* Squares of lengths below which a vector has no direction to speak of. */
static const float SHORTEST = 1e-8f;

/* The map's x, y and z on the front side of the surface, whose smooth normal there is n: x along
 * the picture's rows, y up its columns. The picture is as slot->m turns it. Lanes without a
 * direction of u are not in the mask. */
static vmask map_frame(const texture_slot *slot, const vdetail *d, vvec3 n, vvec3 *x, vvec3 *y)
{
    /* Where u and v grow, made square to n */
    const vvec3 along = d->along_u[slot->set];
    vvec3 u           = vsub(along, vscale(n, vdot(along, n)));
    vfloat squared    = vdot(u, u);
    u                 = vscale(u, 1.0f / vsqrt(squared));
    vvec3 left        = vcross(n, u);
    vvec3 v           = vselect3(d->mirrored[slot->set], left, vneg(left));

    /* Where the picture's u' grows and v' stays: the inverse matrix's first column */
    const float *m  = slot->m;
    const float det = m[0] * m[4] - m[1] * m[3];
    const float s   = det < 0.0f ? -1.0f : 1.0f;
    vvec3 row       = vadd(vscale(u, vsplat(s * m[4])), vscale(v, vsplat(-s * m[3])));
    vfloat length   = vdot(row, row);
    *x              = vscale(row, 1.0f / vsqrt(length));

    /* Up is against v': to the left of x, unless the picture is seen as in a mirror */
    vvec3 up       = vcross(n, *x);
    vmask mirrored = det < 0.0f ? ~d->mirrored[slot->set] : d->mirrored[slot->set];
    *y             = vselect3(mirrored, vneg(up), up);
    return (squared > SHORTEST) & (length > 0.0f) & (length < INFINITY);
}

/* Turns s->n by the map. Seen from behind, the whole of the surface is turned about: what is a bump
 * in front is a dent there. */
static void bend_normal(const material_textures *t, const place *at, vshading *s)
{
    vvec3 x, y;
    vvec3 front = vselect3(s->front, s->n, vneg(s->n));
    vmask bent  = at->lanes & map_frame(&t->normal, at->detail, front, &x, &y);

    vtexel map     = look_up(&t->normal, at);
    vfloat red     = 2.0f * map.red - 1.0f;
    vfloat green   = 2.0f * map.green - 1.0f;
    bent           = bent & ((vabs(red) > NORMAL_MAP_FLAT) | (vabs(green) > NORMAL_MAP_FLAT));
    vfloat along_x = t->normal_scale * red;
    vfloat along_y = t->normal_scale * green;
    vfloat along_n = 2.0f * map.blue - 1.0f;
    vvec3 n        = vadd(vadd(vscale(x, along_x), vscale(y, along_y)), vscale(front, along_n));
    vfloat squared = vdot(n, n);
    bent           = bent & (squared > SHORTEST) & (squared < INFINITY);

    n    = vscale(vselect3(s->front, n, vneg(n)), 1.0f / vsqrt(squared));
    s->n = vselect3(bent, vnormal_keep_valid(s->wo, n, s->flat), s->n);
}

/* ---- all of it ------------------------------------------------------------------------------- */

void materials_look(const material *const *all, vint index, const vdetail *detail, vfloat width,
                    vmask active, vshading *s)
{
    while (vany(active)) {
        int which;
        vmask same        = vtake_same(index, &active, &which);
        const material *m = all[which];
        if (!m->textures)
            continue;
        place at   = { detail, width, same };
        vlook look = look_at(m, &at);
        take(&s->look, &look, same);
        if (m->textures->normal.texture)
            bend_normal(m->textures, &at, s);
    }
}

vec3 textures_mean_color(const material_textures *t)
{
    float mean[4] = { 1, 1, 1, 1 };
    if (t && t->base.texture && !t->alpha_only)
        texture_mean(t->base.texture, mean);
    for (int c = 0; c < 3; c++)
        mean[c] = fminf(fmaxf(mean[c], 0.0f), 1.0f);
    return (vec3){ mean[0], mean[1], mean[2] };
}
