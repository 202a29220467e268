/* sim/scene_focus.c -- light that mirrors and solids of glass send on, which no sampler reaches.
 *
 * A path that goes from a matt surface to a mirror finds a lamp there by its own ray alone: never
 * if the lamp is a point or far away, and rarely if it is small. A solid that refracts gathers
 * light where no shadow ray, which passes it straight, knows of.
 */
#include "core/color.h"
#include "sim/scene_build.h"

static const float narrow_pdf  = 100.0f; /* 1/sr: a lobe of about 6 degrees */
static const float least_share = 0.02f;  /* of light, below which a mirror does not matter */
static const double found_size = 0.25;   /* m: lamps of that size are found often enough */

enum { SIDE = 8, DRAWS = SIDE * SIDE };

/* The share of light from 45 degrees that comes back in a narrow lobe, or in a single direction. */
static float mirrored_share(const material *const *all, int m)
{
    const vvec3 up = vspread((vec3){ 0, 0, 1 });
    vshading s     = { .wo       = vspread((vec3){ 0.70710678f, 0, 0.70710678f }),
                       .n        = up,
                       .flat     = up,
                       .front    = ALL_LANES,
                       .distance = vsplat(1.0f),
                       .look     = look_plain(all[m]) };
    float sum      = 0.0f;
    for (int k = 0; k < DRAWS; k += LANES) {
        vint number = vlane_index() + k;
        vfloat u    = (vto_float(number / SIDE) + 0.5f) * (1.0f / SIDE);
        vfloat v    = (vto_float(number % SIDE) + 0.5f) * (1.0f / SIDE);
        vfloat pick = (vto_float(number) + 0.5f) * (1.0f / DRAWS);
        vscatter drawn;
        vmask goes   = materials_scatter(all, vsplat_int(m), &s, u, v, pick, ALL_LANES, &drawn);
        vmask narrow = goes & ~drawn.straight & ~drawn.bent & (drawn.pdf > narrow_pdf);
        sum += vsum(vkeep(narrow, vrgb_luminance(drawn.weight)));
    }
    return sum / DRAWS;
}

/* The first material in use that is as good as a mirror; -1: none. */
static int first_mirror(const scene *s)
{
    for (int m = 0; s->narrow && m < s->material_count; m++)
        if (s->material_info[m].used && mirrored_share(s->materials, m) > least_share)
            return m;
    return -1;
}

/* The first lamp that rays do not find; -1: none. */
static int first_hidden_lamp(const scene *s)
{
    for (int l = 0; l < s->light_count; l++) {
        light_bounds b = light_bounds_of(s->lights[l]);
        dvec3 size     = d3_sub(d3_from(b.high), d3_from(b.low));
        bool small     = !light_has_extent(s->lights[l]) || b.far || d3_length(size) < found_size;
        if (small && b.peak > 0.0f)
            return l;
    }
    return -1;
}

static void tell_solids(const scene *s, notices *n)
{
    const char *first = NULL;
    int count         = 0;
    for (int m = s->material_count - 1; m >= 0; m--)
        if (s->material_info[m].used && s->materials[m]->solid)
            first = s->material_info[m].name, count++;
    notice_add(
        n,
        "%s: %d material%s of solids that refract, first \"%s\": what is seen through them is "
        "bent, but direct light is taken to pass them straight: intervals are not valid",
        s->study->path, count, count > 1 ? "s" : "", first);
}

void scene_find_focus(scene *s, notices *n)
{
    int mirror = first_mirror(s), lamp = first_hidden_lamp(s);
    s->mirrors_hide = mirror >= 0 && lamp >= 0;
    if (s->mirrors_hide)
        notice_add(n,
                   "%s: material \"%s\" reflects like a mirror: the light of small lamps (first "
                   "`%s`) that falls on other surfaces by way of it is not found, intervals are "
                   "not valid",
                   s->study->path, s->material_info[mirror].name, s->light_info[lamp].name);
    if (s->solids)
        tell_solids(s, n);
}
