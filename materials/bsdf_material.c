/* materials/bsdf_material.c -- a measured layer as a material.
 *
 * Of f(wo, wi) the file's value for light that arrives from wo and leaves to wi is taken: by
 * reciprocity it is the same, and it is that way round that a file keeps energy. Directions are
 * drawn from the very table: a cell, and evenly in projected solid angle within it,
 *
 *     pdf = P(cell | wo) / (projected solid angle of the cell) |cos|       [1/sr]
 *
 * Tensor trees finer than the cells that are drawn from are drawn by their mean there.
 */
#include "materials/bsdf_parts.h"
#include "materials/material_parts.h"

typedef struct layer {
    material base;
    const bsdf *data;
    vec3 up; /* unit */
    bool front_outside;
} layer;

/* The file's x and y axes, what side of the layer wo is on, and whence light comes from it. */
typedef struct layer_place {
    vvec3 x, y;
    vmask back;
    vvec3 in;
} layer_place;

/* Of the directions, the first that does not stand square to the surface, laid into it. */
static vvec3 laid(vvec3 n, vec3 up)
{
    enum { TRIES = 3 };
    const vec3 tries[TRIES] = { up, { 1, 0, 0 }, { 0, 1, 0 } };
    vvec3 y                 = { 0 };
    vmask open              = ALL_LANES;
    for (int i = 0; i < TRIES; i++) {
        vvec3 t    = vspread(tries[i]);
        vvec3 flat = vsub(t, vscale(n, vdot(t, n)));
        vmask good = open & (vdot(flat, flat) > 1e-6f); /* a thousandth of a radian away */
        y          = vselect3(good, vnormalize(flat), y);
        open       = open & ~good;
    }
    return y;
}

/* A direction in the file's axes; z is its cosine with the normal of the side it is on. */
static vvec3 in_file(const layer_place *p, vvec3 n, vvec3 w, vmask active)
{
    vfloat x = vdot(w, p->x), y = vdot(w, p->y);
    return vkeep3(active, (vvec3){ x, y, vabs(vdot(w, n)) });
}

static layer_place place_of(const layer *l, const vshading *s, vmask active)
{
    layer_place p;
    p.back     = active & (l->front_outside ? ~s->front : s->front);
    vvec3 room = vselect3(p.back, s->n, vneg(s->n));
    p.y        = laid(room, l->up);
    p.x        = vcross(p.y, room);
    p.in       = in_file(&p, s->n, s->wo, active);
    p.in.x     = -p.in.x;
    p.in.y     = -p.in.y;
    return p;
}

static vrgb grey(vfloat a) { return (vrgb){ a, a, a }; }

/* f |cos| and the density of the lanes whose wo is on this side. */
static vfloat side_reflect(const bsdf *b, bsdf_side_name side, const vbsdf_place *p, vfloat cosine,
                           vmask same_side, vmask here, vfloat *density)
{
    vmask over = here & same_side, under = here & ~same_side;
    vfloat f =
        vbsdf_value(b, side, BSDF_REFLECT, p, over) + vbsdf_value(b, side, BSDF_TRANSMIT, p, under);
    vint drawn = p->cell + vkeep_int(under, vsplat_int(b->cells));
    vint at    = vkeep_int(here, p->row * (2 * b->cells + 1) + drawn);
    vfloat low = vgather(b->side[side].cdf, at), high = vgather(b->side[side].cdf, at + 1);
    *density = vkeep(here, (high - low) / vbsdf_area(b, p->cell) * cosine);
    return vkeep(here, f * cosine);
}

static vrgb layer_reflect(const material *self, const vshading *s, const vvec3 *wi, vmask active,
                          vfloat *pdf)
{
    const layer *l = (const layer *)self;
    layer_place p  = place_of(l, s, active);
    vfloat cosine  = vdot(*wi, s->n);
    vmask lit      = active & (cosine != 0.0f);
    vvec3 out      = in_file(&p, s->n, *wi, lit);
    vbsdf_place at = vbsdf_find(l->data, &p.in, &out);
    vfloat f = vsplat(0.0f), density = vsplat(0.0f);
    for (int side = 0; side < 2; side++) {
        vmask here = lit & (side == BSDF_BACK ? p.back : ~p.back);
        vfloat part;
        if (!vany(here))
            continue;
        f = f + side_reflect(l->data, (bsdf_side_name)side, &at, out.z, cosine > 0.0f, here, &part);
        density = density + part;
    }
    if (pdf)
        *pdf = density;
    return grey(f);
}

static vfloat side_share(const bsdf *b, int side, int part, const layer_place *p, vmask here)
{
    return vkeep(here, vgather(b->side[side].share[part], vkeep_int(here, vbsdf_row(b, &p->in))));
}

static vmask layer_scatter(const material *self, const vshading *s, vfloat u, vfloat v, vfloat pick,
                           vmask active, vscatter *out)
{
    const layer *l = (const layer *)self;
    const bsdf *b  = l->data;
    layer_place p  = place_of(l, s, active);
    vvec3 wi       = { 0 };
    for (int side = 0; side < 2; side++) {
        vmask here = active & (side == BSDF_BACK ? p.back : ~p.back);
        if (!vany(here))
            continue;
        vfloat rest, share;
        vint row     = vkeep_int(here, vbsdf_row(b, &p.in));
        vint drawn   = vdistribution_draw(b->side[side].cdf, row * (2 * b->cells + 1), 2 * b->cells,
                                          pick, &rest, &share);
        vmask passes = drawn >= b->cells;
        vint cell    = vselect_int(passes, drawn - b->cells, drawn);
        vvec3 to     = vbsdf_direction(b, &p.in, vkeep_int(here, cell), u, v);
        vfloat z     = vselect(passes, -to.z, to.z);
        vvec3 way    = vadd(vscale(s->n, z), vadd(vscale(p.x, to.x), vscale(p.y, to.y)));
        wi           = vselect3(here, way, wi);
    }
    vfloat pdf;
    vrgb f        = layer_reflect(self, s, &wi, active, &pdf);
    vmask goes    = active & (pdf > 0.0f) & (f.x > 0.0f);
    out->wi       = vkeep3(goes, wi);
    out->weight   = vkeep3(goes, vscale(f, 1.0f / pdf));
    out->pdf      = vkeep(goes, pdf);
    out->straight = out->bent = (vmask){ 0 };
    return goes;
}

static vrgb layer_albedo(const material *self, const vshading *s, vmask active)
{
    const layer *l = (const layer *)self;
    layer_place p  = place_of(l, s, active);
    vfloat front   = side_share(l->data, BSDF_FRONT, BSDF_REFLECT, &p, active & ~p.back);
    vfloat back    = side_share(l->data, BSDF_BACK, BSDF_REFLECT, &p, active & p.back);
    return grey(front + back);
}

static const material_type layer_type = {
    .name = "bsdf", .scatter = layer_scatter, .reflect = layer_reflect, .albedo = layer_albedo
};

static vec3 even(double a) { return (vec3){ (float)a, (float)a, (float)a }; }

const material *material_bsdf(arena *a, const bsdf_desc *d, lux_error *err)
{
    static const char name[] = "bsdf material";
    const float length       = v3_length(d->up);
    if (!(length > 1e-18f && length < 1e18f))
        return failed(err, ERR_ARGUMENT, "%s: up is no direction", name);
    if (!extra_valid(name, &d->extra, err))
        return NULL;
    layer *l = arena_new(a, layer, err);
    if (!l)
        return NULL;
    material_begin(&l->base, &layer_type, (vec3){ 1, 1, 1 }, &d->extra);
    l->data          = d->data;
    l->up            = v3_scale(d->up, 1.0f / length);
    l->front_outside = d->front_outside;

    const int front       = d->front_outside ? BSDF_FRONT : BSDF_BACK;
    l->base.reflectance   = even(d->data->figures.reflectance[front]);
    l->base.transmittance = even(d->data->figures.transmittance[front]);
    l->base.two_sided     = true;
    return &l->base;
}
