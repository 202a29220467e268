/* sim/path_tracer.c -- see path.h: the scratch of a thread, and the kernel that its scene calls
 * for.
 */
#include "core/without.h"
#include "sim/path_parts.h"

#include <string.h>

typedef void path_follower(path_tracer *t);
path_follower path_follow_k0, path_follow_k1, path_follow_k2, path_follow_k3;

static path_follower *const followers[KERNELS] = { path_follow_k0, path_follow_k1, path_follow_k2,
                                                   path_follow_k3 };

/* The bits of what the scene does not call for. */
static int without(const scene *s)
{
    bool matt = !s->narrow && !s->hollow && !s->smooth && !s->textured && !s->exteriors &&
                !s->mirror_images;
    return (s->grey ? KERNEL_GREY : 0) | (matt ? KERNEL_MATT : 0);
}

/* Whether the paths' own rays find light. */
static bool finds_light(const scene *s)
{
    return s->glows || has_narrow(s) || has_hollow(s) || has_skies(s) || has_suns(s);
}

path_tracer *path_tracer_new(arena *a, const scene *s, lux_error *err)
{
    path_tracer *t = arena_new(a, path_tracer, err);
    if (!t)
        return NULL;
    t->s      = s;
    t->kernel = without(s);
    t->fields = has_textures(s)        ? FIELDS
                : has_mirror_images(s) ? FARTHER
                : finds_light(s)       ? BASE
                                       : PLAIN_FIELDS;
    t->direct = direct_scratch_new(a, err);
    t->shown  = lamps_that_show(a, s, err);
    if (!t->direct || !t->shown.lamps)
        return NULL;
    if (t->fields == PLAIN_FIELDS)
        return t;
    t->list  = arena_array(a, int32_t, (size_t)t->shown.count + 1, err);
    t->boxes = lamp_boxes_new(a, s, &t->shown, err);
    return t->list && t->boxes ? t : NULL;
}

int path_use_kernel(path_tracer *t, int kernel)
{
    if ((kernel & ~without(t->s)) == 0)
        t->kernel = kernel & (KERNELS - 1);
    return t->kernel;
}

void path_use_patches(path_tracer *t, const sun_patches *patches)
{
    t->patches = patches;
    if (patches && t->fields < WIDTH)
        t->fields = WIDTH;
}

void path_use_maps(path_tracer *t, const illumination_map *indirect,
                   const illumination_map *focused)
{
    t->indirect = indirect;
    t->focused  = focused;
}

void path_leave_focused(path_tracer *t) { t->leaves_focused = true; }

int64_t path_rays(const path_tracer *t) { return t->ray_count + direct_rays(t->direct); }

/* ---- the sums of a bundle -------------------------------------------------------------------- */

static void clear(path_sums *of, int count)
{
    (void)count; /* those behind the last are 0, too */
    memset(of, 0, sizeof *of);
}

/* In a grey scene all channels are as the first. */
static void copy_first_channel(path_sums *of, int count)
{
    for (int c = 1; c < 3; c++)
        memcpy((*of)[c], (*of)[0], (size_t)count * sizeof(float));
}

static void for_all_sums(const scene *s, path_bundle *b, void (*deed)(path_sums *of, int count))
{
    path_sums *all[] = { &b->direct, &b->indirect, b->mirrored, b->outside, b->daylight };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        if (all[i])
            deed(all[i], b->count);
    for (int l = 0; b->layers && l < 2 * s->group_count; l++)
        deed(&b->layers[l], b->count);
}

void path_trace(path_tracer *t, path_bundle *b, const path_options *o)
{
    t->b = b;
    t->o = o;
    for_all_sums(t->s, b, clear);
    memset(b->met, 0, sizeof b->met);
    if (b->smoothed)
        memset(b->smoothed, 0, PATHS * sizeof *b->smoothed);
    followers[t->kernel](t);
    if (t->kernel & KERNEL_GREY)
        for_all_sums(t->s, b, copy_first_channel);
}
