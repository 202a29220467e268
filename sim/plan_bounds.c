/* sim/plan_bounds.c -- what an effect that is left out may change a result by, at most.
 *
 * Interreflection, in a room that nothing stands in, with rho the largest reflectance of its
 * sides: of the flux phi of all lamps, rho phi is reflected once, rho^2 phi twice and so on, so
 * that sides send out rho / (1 - rho) phi at most, wherever that lies. A matt piece of B W/m^2 and
 * of area dA gives a sensor r away B dA cos cos' / (pi r^2), so that with d the distance to the
 * nearest side above the sensor's horizon
 *
 *     E_indirect <= rho / (1 - rho) phi / (pi d^2)
 *
 * (round quantities weigh light by less than 1, too). It is held against direct light, as a run
 * of direct light alone finds it at least.
 *
 * Lamps as points: the lights' own bounds (light.h), added up at each sensor.
 *
 * Pictures whose texels are within a factor 1 + e of their mean, either way, by channel: whatever
 * light falls on them, and were all of it on the darkest or the brightest texels, what meets them k
 * times is off by (1 + e)^k - 1 at most. Light that surfaces of reflectance rho are to send on more
 * than
 *
 *     k = log(0.0001) / log((1 + e) rho)
 *
 * times is less than a ten thousandth of all.
 */
#include "core/color.h"
#include "sim/accuracy.h"
#include "sim/plan_parts.h"
#include "sim/sensor.h"

#include <string.h>

/* ---- interreflection ------------------------------------------------------------------------- */

/* Above that no bound of this kind is of use, and what follows need not be worked out. */
static const double most_worth_a_look = 0.01;

static double lumens_of_all(const scene *s)
{
    double all = s->glows ? HUGE_VAL : 0.0;
    for (int l = 0; l < s->light_count; l++)
        all += s->light_info[l].lumens;
    return s->sky_count > 0 ? HUGE_VAL : all;
}

/* Whether some of the side of a box, 0 to `size`, where coordinate `axis` is `at`, is above the
 * horizon: one of its corners then is. */
static bool is_above(const grid_sensor *k, dvec3 size, int axis, double at)
{
    bool above = false;
    for (int c = 0; c < 4; c++) {
        double first = c & 1, second = c >> 1;
        dvec3 p = axis == 0   ? (dvec3){ at, first * size.y, second * size.z }
                  : axis == 1 ? (dvec3){ first * size.x, at, second * size.z }
                              : (dvec3){ first * size.x, second * size.y, at };
        above   = above || d3_dot(d3_sub(p, k->at), k->normal) > 0.0;
    }
    return above;
}

static double distance_to_sides(const grid_sensor *k, dvec3 size, bool round)
{
    const double at[3] = { k->at.x, k->at.y, k->at.z }, far[3] = { size.x, size.y, size.z };
    double nearest = HUGE_VAL;
    for (int axis = 0; axis < 3; axis++)
        for (int side = 0; side < 2; side++) {
            double place = side ? far[axis] : 0.0;
            if (round || is_above(k, size, axis, place))
                nearest = fmin(nearest, fabs(at[axis] - place));
        }
    return nearest;
}

/* Of one grid, by what it gets directly. */
static double bound_of_grid(const plan_facts *f, const grid_result *direct, double lumens)
{
    const scene *s  = f->s;
    double rho      = f->materials.most;
    double sent_out = rho / (1.0 - rho) * lumens;
    double average = direct->average - direct->average_half_width, worst = 0.0;
    bool round = quantity_is_round(direct->grid->quantity);
    for (int k = 0; k < direct->sensor_count; k++) {
        double d       = distance_to_sides(&direct->sensors[k], s->study->room.size, round);
        double got     = direct->illuminance[k] - direct->half_width[k];
        double against = fmax(got, 0.1 * average);
        double more    = s->study->maintenance * sent_out / (M_PI * d * d);
        worst          = fmax(worst, against > 0.0 ? more / against : HUGE_VAL);
    }
    return worst;
}

static double bound_of_interreflection(const plan_facts *f)
{
    const scene *s    = f->s;
    const study *from = s->study;
    double lumens     = lumens_of_all(s);
    bool bare         = from->room.given && from->room.window_count == 0 && from->scene_count == 0;
    const run_options o = { .accuracy    = 10.0 * f->accuracy,
                            .deadline    = HUGE_VAL,
                            .seed        = 1,
                            .threads     = 1,
                            .direct_only = true };
    if (!bare || !f->sealed || !f->grids || s->layered || !isfinite(lumens) ||
        f->materials.most > most_worth_a_look || f->materials.hollow)
        return HUGE_VAL;
    double worst = 0.0;
    for (int i = 0; i < from->grid_count && isfinite(worst); i++) {
        arena scratch     = { 0 };
        lux_error ignored = { 0 };
        grid_result r     = { 0 };
        bool good         = grid_run(&scratch, s, &from->grids[i], &o, &r, &ignored);
        worst             = good ? fmax(worst, bound_of_grid(f, &r, lumens)) : HUGE_VAL;
        arena_clear(&scratch);
    }
    return worst;
}

/* ---- lamps as points ------------------------------------------------------------------------- */

static bool is_of_file(const scene *s, int l) { return s->light_info[l].web != NULL; }

/* Whether what is left out makes lamp l a point. */
static bool becomes_point(const scene *s, int l, effect e)
{
    return light_has_extent(s->lights[l]) && is_of_file(s, l) == (e == EFFECT_NEAR_FIELD);
}

/* Lamps that nothing hides, and for which a point can stand. */
static bool all_can_be_points(const plan_facts *f, effect e)
{
    const scene *s = f->s;
    bool can       = !f->outside && (e == EFFECT_NEAR_FIELD || s->emitter_count == 0);
    for (int l = 0; l < scene_lamp_count(s) && can; l++) {
        const char *type = s->lights[l]->type->name;
        bool flat        = !strcmp(type, "disk") || !strcmp(type, "rect");
        if (becomes_point(s, l, e))
            can = s->light_info[l].clear && (flat || is_of_file(s, l));
    }
    return can;
}

typedef struct point_sums {
    vfloat e, error; /* W/m^2, at least; at most */
} point_sums;

static point_sums sum_lamps(const scene *s, effect e, const vsurface *at, vmask active)
{
    point_sums sums = { 0 };
    vfloat middle   = vsplat(0.5f);
    for (int l = 0; l < scene_lamp_count(s); l++) {
        const light *lamp = s->lights[l];
        vlight_sample one = { 0 };
        vfloat error      = { 0 };
        vmask whole       = active;
        if (!s->light_info[l].clear)
            continue;
        if (light_has_extent(lamp)) {
            light_bounds box = light_bounds_of(lamp);
            whole            = vlight_is_whole(&box, &at->position, &at->normal, active);
            lamp->type->as_point(lamp, &at->position, active, &one, &error);
        } else {
            light_sample(lamp, &at->position, middle, middle, active, &one);
        }
        vfloat cosine = vmax(vdot(one.wi, at->normal), vsplat(0.0f));
        error         = vselect(whole, error, vsplat(INFINITY));
        sums.e        = sums.e + vmax(vrgb_luminance(one.e) * cosine - error, vsplat(0.0f));
        if (becomes_point(s, l, e))
            sums.error = sums.error + error;
    }
    return sums;
}

/* The sensors of a packet, the last one again in what lanes are left. */
static vsurface packet_of(const scene *s, const grid_result *g, int first)
{
    float x[LANES], y[LANES], z[LANES], nx[LANES], ny[LANES], nz[LANES];
    for (int i = 0; i < LANES; i++) {
        int k               = first + i < g->sensor_count ? first + i : g->sensor_count - 1;
        vec3 p              = scene_place(s, g->sensors[k].at);
        const dvec3 *normal = &g->sensors[k].normal;
        x[i] = p.x, y[i] = p.y, z[i] = p.z;
        nx[i] = (float)normal->x, ny[i] = (float)normal->y, nz[i] = (float)normal->z;
    }
    return (vsurface){ .position = { vload(x), vload(y), vload(z) },
                       .normal   = { vload(nx), vload(ny), vload(nz) } };
}

/* sums: of a grid's sensors, packet by packet. */
static double worst_of(const point_sums *sums, int count)
{
    double average = 0.0, worst = 0.0;
    for (int k = 0; k < count; k++)
        average += (double)lane(sums[k / LANES].e, k % LANES) / count;
    for (int k = 0; k < count; k++) {
        double error   = (double)lane(sums[k / LANES].error, k % LANES);
        double against = fmax((double)lane(sums[k / LANES].e, k % LANES), 0.1 * average);
        worst = fmax(worst, error == 0.0 ? 0.0 : against > 0.0 ? error / against : HUGE_VAL);
    }
    return worst;
}

static double bound_of_points(const plan_facts *f, effect e)
{
    const scene *s = f->s;
    double worst   = 0.0;
    if (!f->grids || s->layered || !all_can_be_points(f, e))
        return HUGE_VAL;
    for (int i = 0; i < s->study->grid_count && isfinite(worst); i++) {
        const grid_result *g = &f->grids[i];
        arena scratch        = { 0 };
        lux_error ignored    = { 0 };
        size_t packets       = ((size_t)g->sensor_count + LANES - 1) / LANES;
        point_sums *sums     = arena_array(&scratch, point_sums, packets, &ignored);
        for (size_t k = 0; sums && k < packets; k++) {
            vsurface at = packet_of(s, g, (int)k * LANES);
            sums[k]     = sum_lamps(s, e, &at, ALL_LANES);
        }
        bool known = sums && !quantity_is_round(g->grid->quantity);
        worst      = known ? fmax(worst, worst_of(sums, g->sensor_count)) : HUGE_VAL;
        arena_clear(&scratch);
    }
    return worst;
}

/* ---- pictures -------------------------------------------------------------------------------- */

static const double forgotten = 1e-4; /* of all light */

/* How far the mean and texels of the first `channels` are apart, relative to the lesser. */
static double contrast_of(const texture_slot *slot, int first, int channels)
{
    float low[4], high[4], mean[4];
    double most = 0.0;
    if (!slot->texture)
        return 0.0;
    texture_range(slot->texture, low, high);
    texture_mean(slot->texture, mean);
    for (int c = first; c < first + channels; c++)
        if (high[c] > low[c])
            most =
                fmax(most, low[c] > 0.0f ? (double)fmaxf(high[c] / mean[c], mean[c] / low[c]) - 1.0
                                         : HUGE_VAL);
    return most;
}

/* Pictures of anything but colour must be of one value. */
static double contrast_of_all(const material_textures *t)
{
    double other = contrast_of(&t->surface, 1, 2) + contrast_of(&t->transmission, 0, 1) +
                   contrast_of(&t->specular_weight, 3, 1) + contrast_of(&t->specular_color, 0, 3);
    if (t->alpha != ALPHA_OPAQUE)
        other += contrast_of(&t->base, 3, 1);
    double color = t->alpha_only ? 0.0 : contrast_of(&t->base, 0, 3);
    return other > 0.0 ? HUGE_VAL : fmax(color, contrast_of(&t->emission, 0, 3));
}

/* After how many meetings with surfaces of that share next to no light is left. */
static double meetings_of(double share)
{
    if (!(share > 0.0))
        return 0.0;
    return share < 1.0 ? ceil(log(forgotten) / log(share)) : HUGE_VAL;
}

static double bound_of_textures(const plan_facts *f, bool direct)
{
    double e = 0.0, glowing = 0.0;
    for (int i = 0; i < f->s->material_count; i++) {
        const material *m = f->s->materials[i];
        if (!f->s->material_info[i].used || !m->textures)
            continue;
        e       = fmax(e, contrast_of_all(m->textures));
        glowing = fmax(glowing, m->textures->emission.texture ? 1.0 : 0.0);
    }
    if (e == 0.0 || !isfinite(e))
        return e;
    bool on      = !direct || f->materials.hollow; /* what passes surfaces meets them, too */
    double times = on ? meetings_of((1.0 + e) * f->materials.most) : 0.0;
    double seen  = f->o->views ? 1.0 : 0.0; /* by the eye itself */
    return pow(1.0 + e, times + glowing + seen) - 1.0;
}

/* So that runs leave them alone, too (materials/look.h). */
static bool is_flat(const material_textures *t)
{
    float low[4], high[4];
    bool flat = true;
    if (!t || !t->normal.texture || t->normal_scale == 0.0f)
        return true;
    texture_range(t->normal.texture, low, high);
    for (int c = 0; c < 2; c++)
        flat = flat && 2.0f * low[c] - 1.0f >= -NORMAL_MAP_FLAT &&
               2.0f * high[c] - 1.0f <= NORMAL_MAP_FLAT;
    return flat;
}

static double bound_of_normal_maps(const scene *s)
{
    bool flat = true;
    for (int i = 0; i < s->material_count && flat; i++)
        flat = !s->material_info[i].used || is_flat(s->materials[i]->textures);
    return flat ? 0.0 : HUGE_VAL;
}

double plan_bound(const plan_facts *f, effect e, bool direct)
{
    if (f->o->series)
        return HUGE_VAL;
    switch (e) {
    case EFFECT_INTERREFLECTION:
        return bound_of_interreflection(f);
    case EFFECT_NEAR_FIELD:
    case EFFECT_AREA_LIGHTS:
        return direct ? bound_of_points(f, e) : HUGE_VAL;
    case EFFECT_TEXTURES:
        return bound_of_textures(f, direct);
    case EFFECT_NORMAL_MAPS:
        return bound_of_normal_maps(f->s);
    default:
        return HUGE_VAL;
    }
}
