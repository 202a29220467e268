/* sim/scene.c -- see scene.h. The order of construction; the parts are scene_*.c. */
#include "sim/scene_build.h"

#include <string.h>

void *list_add(list *l, arena *a, size_t size, size_t align, lux_error *err)
{
    if (l->count == l->room) {
        size_t room = l->room ? 2 * l->room : 16;
        void *items = arena_alloc(a, room, size, align, err);
        if (!items)
            return NULL;
        if (l->count)
            memcpy(items, l->items, l->count * size);
        l->items = items;
        l->room  = room;
    }
    return (char *)l->items + size * l->count++;
}

transform scene_copy_place(const study_scene *s, int k)
{
    double turn = s->rotate_deg * (M_PI / 180.0);
    double c = cos(turn) * s->scale, d = sin(turn) * s->scale;
    dvec3 at = s->at[k];
    if (s->rotate_deg == 0.0)
        c = s->scale, d = 0.0;
    return (transform){ { { c, -d, 0, at.x }, { d, c, 0, at.y }, { 0, 0, s->scale, at.z } } };
}

static bool read_files(scene_build *b)
{
    const study *s = b->study;
    b->files       = arena_array(b->a, const gltf *, (size_t)s->scene_count + 1, b->err);
    if (!b->files)
        return false;
    for (int i = 0; i < s->scene_count; i++) {
        for (int j = 0; j < i && !b->files[i]; j++)
            if (!strcmp(s->scenes[i].file, s->scenes[j].file))
                b->files[i] = b->files[j];
        if (!b->files[i])
            b->files[i] = gltf_read(b->a, s->scenes[i].file, b->notices, b->err);
        if (!b->files[i])
            return false;
    }
    return true;
}

static bool build_cameras(scene_build *b)
{
    for (int i = 0; i < b->study->scene_count; i++) {
        const study_scene *s = &b->study->scenes[i];
        for (uint32_t c = 0; c < b->files[i]->camera_count; c++) {
            const gltf_camera *from = &b->files[i]->cameras[c];
            scene_camera *to        = list_new(&b->cameras, b->a, scene_camera, b->err);
            if (!to)
                return false;
            transform copy = scene_copy_place(s, 0);
            *to            = (scene_camera){ .name        = from->name,
                                             .place       = transform_product(&copy, &from->place),
                                             .perspective = from->perspective,
                                             .yfov        = from->yfov,
                                             .aspect      = from->aspect,
                                             .xmag        = from->xmag * s->scale,
                                             .ymag        = from->ymag * s->scale };
        }
    }
    return true;
}

static bool is_dark(vec3 c) { return c.x == 0.0f && c.y == 0.0f && c.z == 0.0f; }

static void say_what_surfaces_do(const scene_build *b, scene *s)
{
    for (int i = 0; i < s->material_count; i++) {
        const scene_material *m = &s->material_info[i];
        s->reflects |= m->used && !is_dark(m->reflectance);
        s->glows |= m->used && !is_dark(m->emission);
    }
    s->glow_share = b->area > 0.0 ? b->glowing_area / b->area : 0.0;
    if (s->light_count == 0 && !s->glows)
        notice_add(b->notices, "%s: nothing gives light: every result will be 0 lx",
                   b->study->path);
}

const scene *scene_new(arena *a, const study *from, int threads, notices *n, lux_error *err)
{
    scene_build b = { .a = a, .study = from, .notices = n, .err = err };
    scene *s      = arena_new(a, scene, err);
    if (!s || !read_files(&b) || !build_materials(&b) || !build_bounds(&b))
        return NULL;
    s->world = build_world(&b, threads);
    if (!s->world || !build_lights(&b) || !build_cameras(&b))
        return NULL;

    s->study          = from;
    s->centre         = b.centre;
    s->low            = b.low;
    s->high           = b.high;
    s->material_count = (int)b.materials.count;
    s->materials      = b.materials.items;
    s->material_info  = b.material_info.items;
    s->light_count    = (int)b.lights.count;
    s->lights         = b.lights.items;
    s->light_info     = b.light_info.items;
    s->lights_differ  = b.lights_differ;
    s->camera_count   = (int)b.cameras.count;
    s->cameras        = b.cameras.items;
    say_what_surfaces_do(&b, s);
    s->small_patches = scene_small_patches(s, n);
    return s;
}
