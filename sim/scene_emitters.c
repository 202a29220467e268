/* sim/scene_emitters.c -- the triangles of glowing surfaces as lights, and which triangle is which.
 */
#include "core/color.h"
#include "sim/scene_build.h"

static const material *material_at(const scene_build *b, const mesh *m, uint32_t t)
{
    const material *const *all = b->materials.items;
    return all[m->material ? m->material[t] : 0];
}

static bool glows(const material *m)
{
    vec3 e = m->look.emission;
    return e.x > 0.0f || e.y > 0.0f || e.z > 0.0f;
}

/* Lights that are asked shine the same all over. */
static bool is_uniform(const material *m)
{
    const material_textures *t = m->textures;
    return !t || (!t->emission.texture && t->alpha == ALPHA_OPAQUE);
}

static bool any_glows(const scene_build *b, const mesh *m)
{
    for (uint32_t t = 0; t < m->triangle_count; t++)
        if (glows(material_at(b, m, t)))
            return true;
    return false;
}

/* What a surface gives off in the mean, W/(sr m^2): of a cut-out, as if it were there by its alpha.
 */
static vec3 mean_radiance(const material *m)
{
    const material_textures *t = m->textures;
    float glow[4] = { 1, 1, 1, 1 }, base[4] = { 1, 1, 1, 1 };
    if (t && t->emission.texture)
        texture_mean(t->emission.texture, glow);
    if (t && t->base.texture && t->alpha != ALPHA_OPAQUE)
        texture_mean(t->base.texture, base);
    vec3 e = v3_mul(m->look.emission, (vec3){ glow[0], glow[1], glow[2] });
    return v3_scale(e, (1.0f - m->look.openness) * base[3]);
}

/* The light of triangle t; -1 in *number where it has none: where it has no area that a float could
 * hold, or does not glow the same all over. */
static bool add_triangle(scene_build *b, const mesh *m, const world_instance *in, uint32_t t,
                         int32_t *number)
{
    const material *made_of = material_at(b, m, t);
    triangle_desc d         = { .radiance = mean_radiance(made_of) };
    dvec3 p[3];
    for (int c = 0; c < 3; c++) {
        p[c] = transform_point(&in->place, d3_from(m->positions[m->corners[3 * t + (uint32_t)c]]));
        d.corner[c] = d3_to_float(p[c]);
    }
    double area = 0.5 * d3_length(d3_cross(d3_sub(p[1], p[0]), d3_sub(p[2], p[0])));
    *number     = -1;
    if (!is_uniform(made_of)) /* pi L A to each side */
        b->glow_watts += 2.0 * M_PI * area * (double)rgb_luminance(d.radiance);
    if (!((float)area > 1e-30f) || !is_uniform(made_of))
        return true;
    const light *made = light_triangle(b->a, &d, b->err);
    const light **to  = made ? list_new(&b->emitters, b->a, const light *, b->err) : NULL;
    if (!to)
        return false;
    *to     = made;
    *number = (int32_t)b->emitters.count - 1;
    return true;
}

static bool add_instance(scene_build *b, const mesh *m, const world_instance *in)
{
    for (uint32_t t = 0; t < m->triangle_count; t++) {
        int32_t number = -1;
        if (glows(material_at(b, m, t)) && !add_triangle(b, m, in, t, &number))
            return false;
        int32_t *of = list_new(&b->emitter_of, b->a, int32_t, b->err);
        if (!of)
            return false;
        *of = number;
    }
    return true;
}

bool build_emitters(scene_build *b, const mesh *meshes, const world_instance *instances,
                    uint32_t count)
{
    b->first_emitter = arena_array(b->a, int64_t, (size_t)count + 1, b->err);
    if (!b->first_emitter)
        return false;
    for (uint32_t i = 0; i < count; i++) {
        const mesh *m       = &meshes[instances[i].mesh];
        b->first_emitter[i] = -1;
        if (!any_glows(b, m))
            continue;
        b->first_emitter[i] = (int64_t)b->emitter_of.count;
        if (!add_instance(b, m, &instances[i]))
            return false;
    }
    return true;
}

double scene_glow_lumens(const scene *s)
{
    double watts = s->glow_watts;
    for (int e = 0; e < s->emitter_count; e++)
        watts += (double)rgb_luminance(light_flux(s->lights[s->light_count + e]));
    return LUMENS_PER_WATT * (double)s->glow_dimming * watts;
}
