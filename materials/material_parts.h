/* materials/material_parts.h -- what the makers of materials share; only materials/ includes it. */
#ifndef MATERIALS_MATERIAL_PARTS_H
#define MATERIALS_MATERIAL_PARTS_H

#include "core/without.h"
#include "materials/material.h"

static inline bool has_textures(const material *m) { return HAS_TEXTURES && m->textures; }

/* A field of the look at each point: as textures make it, or the constant. */
static inline vrgb look_color(const material *m, const vshading *s)
{
    return has_textures(m) ? s->look.color : vspread(m->look.color);
}

/* All of it. */
static inline vlook look_of(const material *m, const vshading *s)
{
    return has_textures(m) ? s->look : look_plain(m);
}

/* Whether each channel is in [0, 1]; whether extra's fields are in their ranges: else false with
 * *err, which begins with the material's name. */
bool share_valid(const char *material_name, const char *what, vec3 share, lux_error *err);
bool extra_valid(const char *material_name, const material_extra *extra, lux_error *err);

/* Sets type, look (color, extra's emission and openness, and else 1) and textures. */
void material_begin(material *m, const material_type *type, vec3 color,
                    const material_extra *extra);

/* A new material whose look is its reflectance and textures alone; NULL as a maker's. */
material *material_reflecting(arena *a, const material_type *type, vec3 reflectance,
                              const material_extra *extra, lux_error *err);

/* The mean of a texture of the base colour; white where there is none. */
vec3 textures_mean_color(const material_textures *t);

#endif
