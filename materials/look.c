/* materials/look.c -- see look.h. */
#include "materials/material_parts.h"

vec3 textures_mean_color(const material_textures *t)
{
    float mean[4] = { 1, 1, 1, 1 };
    if (t && t->base.texture && !t->alpha_only)
        texture_mean(t->base.texture, mean);
    return (vec3){ mean[0], mean[1], mean[2] };
}
