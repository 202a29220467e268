/* sim/scene_material_study.c -- materials as a study says they are.
 *
 * What the study says replaces all of what the scene's file says, textures too, but for the light
 * that the surface gives off and for its holes.
 */
#include "core/table.h"
#include "materials/brdf.h"
#include "materials/bsdf.h"
#include "sim/scene_build.h"

/* ---- what is kept ---------------------------------------------------------------------------- */

/* false: memory is out. */
static bool keep_extra(scene_build *b, const gltf_material *from, material_extra *extra)
{
    const material_textures *t = from->textures;
    *extra                     = material_extra_of(from);
    extra->textures            = NULL;
    if (!t || (!t->emission.texture && t->alpha == ALPHA_OPAQUE))
        return true;
    material_textures *kept = arena_new(b->a, material_textures, b->err);
    if (!kept)
        return false;
    *kept = (material_textures){
        .emission = t->emission, .normal_scale = 1.0f, .alpha = t->alpha, .cutoff = t->cutoff
    };
    kept->alpha_only = true;
    if (t->alpha != ALPHA_OPAQUE)
        kept->base = t->base;
    extra->textures = kept;
    return true;
}

/* ---- makers ---------------------------------------------------------------------------------- */

static const vec3 white = { 1, 1, 1 };

static const material *make_matt(scene_build *b, const material_source *s,
                                 const material_extra *extra)
{
    const study_material *m = s->instead;
    vec3 d = scene_color(b, m->reflectance), k = scene_color(b, m->specular);
    vec3 sum     = { d.x + k.x, d.y + k.y, d.z + k.z };
    vec3 bounded = material_bounded(b, s, sum, white);
    vec3 share = { sum.x > 0.0f ? bounded.x / sum.x : 1.0f, sum.y > 0.0f ? bounded.y / sum.y : 1.0f,
                   sum.z > 0.0f ? bounded.z / sum.z : 1.0f };
    if (isnan(m->exponent) || !(k.x > 0.0f || k.y > 0.0f || k.z > 0.0f))
        return material_diffuse(b->a, &(diffuse_desc){ v3_mul(d, share), *extra }, b->err);
    phong_desc p = { .reflectance = v3_mul(d, share),
                     .specular    = v3_mul(k, share),
                     .exponent    = (float)m->exponent,
                     .extra       = *extra };
    return material_phong(b->a, &p, b->err);
}

static const material *make_mirror(scene_build *b, const material_source *s,
                                   const material_extra *extra)
{
    vec3 back = material_bounded(b, s, scene_color(b, s->instead->mirror), white);
    if (is_left_out(b, EFFECT_MIRRORS))
        return material_diffuse(b->a, &(diffuse_desc){ back, *extra }, b->err);
    return material_mirror(b->a, &(mirror_desc){ back, *extra }, b->err);
}

static void tell_of_boxes(scene_build *b, const material_source *s)
{
    const study_material *m = s->instead;
    const glass_shapes *g   = s->glass;
    const char *name        = s->from->name[0] ? s->from->name : "(unnamed)";
    if (!s->used)
        return;
    if (!m->box && g->plates)
        notice_add(b->notices,
                   "%s:%d:%d: material \"%s\" has closed boxes of glass, each side of which is "
                   "taken as a whole pane: say `pane: box`",
                   b->study->path, m->where.line, m->where.column, name);
    if (m->box && g->open)
        notice_add(b->notices,
                   "%s:%d:%d: `pane: box`, but material \"%s\" has surfaces that enclose nothing: "
                   "from behind they are taken as not there",
                   b->study->path, m->where.line, m->where.column, name);
}

static const material *make_pane(scene_build *b, const material_source *s,
                                 const material_extra *extra, scene_material *info)
{
    const study_material *m = s->instead;
    float ior               = is_left_out(b, EFFECT_MIRRORS) ? PANE_LEAST_IOR : (float)m->ior;
    pane_desc d             = { .transmittance = scene_color(b, m->transmittance),
                                .ior           = ior,
                                .box           = m->box,
                                .extra         = *extra };
    info->box               = m->box;
    tell_of_boxes(b, s);
    return material_pane(b->a, &d, b->err);
}

static const brdf *read_brdf(scene_build *b, const char *path, lux_error *err)
{
    const scene_measures *m = &b->options->measures;
    table_measures by       = { .nearest = m->nearest_tables, .libm = m->libm_tables };
    const brdf *read        = brdf_read(b->a, path, b->notices, err);
    return read && (by.nearest || by.libm) ? brdf_measured(b->a, read, &by, err) : read;
}

/* The table of an entry is read once, however many materials it fits. */
static const void *table_of(scene_build *b, const study_material *m)
{
    const void **table = &b->tables[m - b->study->materials];
    lux_error why      = { 0 };
    if (!*table)
        *table = m->surface == SURFACE_BSDF
                     ? (const void *)bsdf_read(b->a, m->brdf, b->notices, &why)
                     : (const void *)read_brdf(b, m->brdf, &why);
    if (!*table && why.code == ERR_IO) /* the study names what is not there */
        return study_failed(b->study, m->where, b->err, ERR_IO, "%s", why.text);
    return *table ? *table : failed(b->err, why.code, "%s", why.text);
}

static const material *make_glazing(scene_build *b, const bsdf *data, const bsdf_desc *d,
                                    scene_material *info)
{
    const bsdf_figures *f = bsdf_figure(data);
    info->reciprocity     = f->reciprocity;
    info->scaled_by       = f->scale;
    return material_bsdf(b->a, d, b->err);
}

static const material *make_table(scene_build *b, const brdf *table, const brdf_desc *d,
                                  scene_material *info)
{
    const brdf_figures *f = brdf_figures_of(table);
    info->reciprocity     = (double)f->reciprocity_mean;
    info->scaled_by       = (double)f->scale_least;
    return material_brdf(b->a, d, b->err);
}

static const material *make_measured(scene_build *b, const material_source *s,
                                     const material_extra *extra, scene_material *info)
{
    const study_material *m = s->instead;
    const void *table       = table_of(b, m);
    vec3 up                 = d3_to_float(d3_scale(m->up, 1.0 / d3_length(m->up)));
    info->file              = m->brdf;
    if (!table)
        return NULL;
    if (m->surface == SURFACE_BSDF)
        return make_glazing(
            b, table,
            &(bsdf_desc){
                .data = table, .up = up, .front_outside = m->front_outside, .extra = *extra },
            info);
    return make_table(b, table, &(brdf_desc){ .table = table, .up = up, .extra = *extra }, info);
}

const material *material_of_study(scene_build *b, const material_source *s, scene_material *info)
{
    const study_material *m = s->instead;
    material_extra extra;
    if (!keep_extra(b, s->from, &extra))
        return NULL;
    switch (m->surface) {
    case SURFACE_MATT:
        return make_matt(b, s, &extra);
    case SURFACE_MIRROR:
        return make_mirror(b, s, &extra);
    case SURFACE_PANE:
        return make_pane(b, s, &extra, info);
    case SURFACE_TABLE:
    case SURFACE_BSDF:
        break;
    }
    const material *table = make_measured(b, s, &extra, info);
    if (!table || !is_left_out(b, EFFECT_MEASURED_BRDF))
        return table;
    info->file = NULL;
    return material_unmeasured(b, table);
}
