/* materials/brdf.c -- see brdf.h: files, and the material that a table makes. */
#include "materials/brdf.h"
#include "core/color.h"
#include "core/file.h"
#include "materials/brdf_parts.h"
#include "materials/material_parts.h"

#include <string.h>

/* ---- files ----------------------------------------------------------------------------------- */

enum { MOST_BYTES = 256 << 20 };

const brdf *brdf_read(arena *a, const char *path, notices *n, lux_error *err)
{
    arena scratch = { 0 };
    size_t size   = 0;
    char *bytes   = file_read(&scratch, path, MOST_BYTES, &size, err);
    const brdf *b = NULL;
    if (bytes && !strncmp(bytes, "lux4", 4))
        b = brdf_read_text(a, path, bytes, size, n, err);
    else if (bytes)
        b = brdf_read_merl(a, path, bytes, size, n, err);
    arena_clear(&scratch);
    return b;
}

const brdf *brdf_measured(arena *a, const brdf *b, const table_measures *by, lux_error *err)
{
    brdf *copy = arena_new(a, brdf, err);
    if (!copy)
        return NULL;
    *copy          = *b;
    copy->measures = *by;
    return copy;
}

const brdf_figures *brdf_figures_of(const brdf *b) { return &b->figures; }

/* ---- the material ---------------------------------------------------------------------------- */

typedef struct brdf_material {
    material base;
    const brdf *table;
    vec3 up, other; /* unit; other: in up's place where that is square to the surface */
} brdf_material;

typedef struct frame {
    vvec3 x, y, n;
} frame;

static frame frame_of(const brdf_material *m, vvec3 n)
{
    vvec3 up    = vspread(m->up);
    vvec3 flat  = vsub(up, vscale(n, vdot(up, n)));
    vvec3 other = vspread(m->other);
    vmask steep = ~(vdot(flat, flat) > 1e-8f);
    flat        = vselect3(steep, vsub(other, vscale(n, vdot(other, n))), flat);
    vvec3 x     = vnormalize(flat);
    return (frame){ x, vcross(n, x), n };
}

static vvec3 to_local(const frame *f, vvec3 w)
{
    return (vvec3){ vdot(w, f->x), vdot(w, f->y), vdot(w, f->n) };
}

/* f cos, and the density of wi, for directions in the surface's frame, both above it. */
static vrgb ask(const brdf *b, const vvec3 *wo, const vvec3 *wi, vfloat *pdf)
{
    vbrdf_place p;
    vfloat rgb[4];
    vbrdf_find(b, wo, wi, pdf != NULL, &p);
    vbrdf_blend(b, &p, rgb);
    if (pdf)
        *pdf = vbrdf_pdf(b, &p, wi->z);
    return vscale((vrgb){ rgb[0], rgb[1], rgb[2] }, wi->z);
}

static vrgb brdf_reflect(const material *self, const vshading *s, const vvec3 *wi, vmask active,
                         vfloat *pdf)
{
    const brdf_material *m = (const brdf_material *)self;
    frame f                = frame_of(m, s->n);
    vvec3 o = to_local(&f, s->wo), i = to_local(&f, *wi);
    vmask lit  = active & (o.z > 0.0f) & (i.z > 0.0f);
    vrgb value = ask(m->table, &o, &i, pdf);
    if (pdf)
        *pdf = vkeep(lit, *pdf);
    return vkeep3(lit, vmul(value, look_color(self, s)));
}

static vmask brdf_scatter(const material *self, const vshading *s, vfloat u, vfloat v, vfloat pick,
                          vmask active, vscatter *out)
{
    const brdf_material *m = (const brdf_material *)self;
    frame f                = frame_of(m, s->n);
    vvec3 o                = to_local(&f, s->wo);
    vvec3 i                = vbrdf_draw(m->table, &o, u, v, pick);
    vmask goes             = active & (o.z > 0.0f) & (i.z > 0.0f);

    /* The direction as the caller will ask for it again */
    vvec3 wi = vadd(vscale(f.n, i.z), vadd(vscale(f.x, i.x), vscale(f.y, i.y)));
    vfloat pdf;
    vrgb value    = vmul(ask(m->table, &o, &i, &pdf), look_color(self, s));
    goes          = goes & (pdf > 0.0f);
    out->wi       = vkeep3(goes, vnormalize(wi));
    out->weight   = vkeep3(goes, vscale(value, 1.0f / pdf));
    out->pdf      = vkeep(goes, pdf);
    out->straight = out->bent = (vmask){ 0 };
    return goes;
}

static vrgb brdf_albedo(const material *self, const vshading *s, vmask active)
{
    const brdf_material *m = (const brdf_material *)self;
    const brdf *b          = m->table;
    frame f                = frame_of(m, s->n);
    vvec3 o                = to_local(&f, s->wo);
    vtable_place theta, phi;
    vbrdf_node(b, &o, &theta, &phi);
    vrgb rgb = { vbrdf_of_nodes(b, b->nodes.albedo, 4, theta, phi),
                 vbrdf_of_nodes(b, b->nodes.albedo + 1, 4, theta, phi),
                 vbrdf_of_nodes(b, b->nodes.albedo + 2, 4, theta, phi) };
    return vkeep3(active & (o.z > 0.0f), vmul(rgb, look_color(self, s)));
}

static const material_type brdf_type = {
    .name = "brdf", .scatter = brdf_scatter, .reflect = brdf_reflect, .albedo = brdf_albedo
};

const material *material_brdf(arena *a, const brdf_desc *d, lux_error *err)
{
    static const char name[] = "brdf material";
    float length             = v3_length(d->up);
    if (!(length > 0.0f && length < INFINITY))
        return failed(err, ERR_ARGUMENT, "%s: up %g %g %g is no direction", name, (double)d->up.x,
                      (double)d->up.y, (double)d->up.z);
    if (!extra_valid(name, &d->extra, err))
        return NULL;
    brdf_material *m = arena_new(a, brdf_material, err);
    if (!m)
        return NULL;
    material_begin(&m->base, &brdf_type, (vec3){ 1, 1, 1 }, &d->extra);
    m->table            = d->table;
    m->up               = v3_scale(d->up, 1.0f / length);
    m->other            = fabsf(m->up.x) < 0.99f ? (vec3){ 1, 0, 0 } : (vec3){ 0, 1, 0 };
    m->base.reflectance = v3_mul(d->table->reflectance, textures_mean_color(d->extra.textures));
    return &m->base;
}
