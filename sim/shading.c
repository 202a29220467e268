/* sim/shading.c -- see shading.h. */
#include "sim/shading.h"

#include "core/without.h"
#include "materials/shading_normal.h"

void scene_shade(const scene *s, const vhit *hit, const vvec3 *direction, vfloat width, vmask met,
                 vsurface *at, vshading *shading)
{
    world_surface(s->world, hit, met, at);
    vvec3 wo          = vneg(*direction);
    vmask front       = vdot(wo, at->normal) >= 0.0f;
    at->normal        = vselect3(front, at->normal, vneg(at->normal));
    shading->wo       = wo;
    shading->n        = at->normal;
    shading->flat     = at->normal;
    shading->front    = front;
    shading->distance = hit->distance;
    bool textured     = HAS_TEXTURES && s->textured;
    if (!s->smooth && !textured)
        return;

    vdetail detail;
    world_detail(s->world, hit, met, &detail);
    if (s->smooth) {
        vvec3 n    = vselect3(front, detail.normal, vneg(detail.normal));
        shading->n = vnormal_keep_valid(wo, n, at->normal);
    }
    if (textured)
        materials_look(s->materials, at->material, &detail, width, met, shading);
}
