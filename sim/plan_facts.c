/* sim/plan_facts.c -- what a plan needs to know of the scene, its sensors and its eyes. */
#include "core/color.h"
#include "sim/camera.h"
#include "sim/plan_parts.h"
#include "sim/render.h"

static double largest(vec3 c) { return (double)fmaxf(c.x, fmaxf(c.y, c.z)); }

static void add_material(const scene *s, int i, plan_materials *to)
{
    const scene_material *info = &s->material_info[i];
    const material *m          = s->materials[i];
    dvec3 back_and_through =
        d3_add(d3_scale(d3_from(info->reflectance), info->there), d3_from(info->transmittance));
    vec3 on     = d3_to_float(back_and_through);
    double back = (double)rgb_luminance(on);
    bool sharp  = !m->type->reflect && largest(info->reflectance) > 0.0;
    to->area += info->area;
    to->matt_share += m->matt ? info->area : 0.0;
    to->bright_share += back > BRIGHT * (1.0 + 1e-6) /* as floats round */ ? info->area : 0.0;
    to->mean += back * info->area;
    to->most = fmax(to->most, largest(on));
    to->textured += info->textured;
    to->bumpy += info->bumpy;
    to->measured += info->file != NULL;
    to->mirrors += sharp;
    to->solids += m->solid;
    to->hollow += m->type->through || info->holes;
    if (sharp)
        to->sharpest = fmax(to->sharpest, largest(info->reflectance));
    if (info->textured && !to->first_textured)
        to->first_textured = info->name;
    if (info->file && !to->first_measured)
        to->first_measured = info->file;
}

static plan_materials look_at_materials(const scene *s)
{
    plan_materials all = { 0 };
    for (int i = 0; i < s->material_count; i++)
        if (s->material_info[i].used)
            add_material(s, i, &all);
    double of = all.area > 0.0 ? 1.0 / all.area : 0.0;
    all.matt_share *= of;
    all.bright_share *= of;
    all.mean *= of;
    return all;
}

/* On its walls a sensor may look outward. */
static bool is_within_room(const scene *s, dvec3 p)
{
    dvec3 size = s->study->room.size;
    return s->study->room.given && p.x > 0.0 && p.x < size.x && p.y > 0.0 && p.y < size.y &&
           p.z > 0.0 && p.z < size.z;
}

/* A room without windows keeps all outer light out, whatever stands in it, if its sides do. */
static bool is_closed(const scene *s)
{
    enum { SIDES = 3 }; /* ceiling, walls, floor: the first materials */
    bool closed = s->study->room.given && s->study->room.window_count == 0;
    for (int i = 0; closed && i < SIDES; i++)
        closed = !s->material_info[i].holes && largest(s->material_info[i].transmittance) == 0.0;
    return closed;
}

static bool look_at_grids(arena *a, plan_facts *f, lux_error *err)
{
    const study *from  = f->s->study;
    grid_result *grids = arena_array(a, grid_result, (size_t)from->grid_count + 1, err);
    for (int i = 0; grids && i < from->grid_count; i++) {
        if (!grid_sensors(a, f->s, &from->grids[i], &grids[i], err))
            return false;
        f->sensors += grids[i].sensor_count;
        for (int k = 0; k < grids[i].sensor_count; k++) {
            dvec3 at = grids[i].sensors[k].at;
            f->outside |= !scene_is_in_room(f->s, at);
            f->sealed &= is_within_room(f->s, at);
        }
    }
    f->grids = grids;
    return grids != NULL;
}

/* A parallel eye's rays begin beside it, too. */
static bool look_at_views(plan_facts *f, lux_error *err)
{
    const study *from = f->s->study;
    for (int i = 0; i < from->view_count; i++) {
        camera c;
        if (!camera_of_view(f->s, &from->views[i], &c, err))
            return false;
        dvec3 eye = d3_add(d3_from(c.eye), f->s->centre);
        f->pixels += (double)c.width * c.height;
        f->sealed &= c.projection != PROJECTION_ORTHOGRAPHIC && is_within_room(f->s, eye);
    }
    return true;
}

bool plan_look(arena *a, const scene *s, const plan_options *o, plan_facts *out, lux_error *err)
{
    double usual = isnan(s->study->accuracy) ? GRID_DEFAULT_PERCENT / 100.0 : s->study->accuracy;
    if (o->views)
        usual = VIEW_DEFAULT_PERCENT / 100.0;
    *out = (plan_facts){ .s         = s,
                         .o         = o,
                         .accuracy  = isnan(o->accuracy) ? usual : o->accuracy,
                         .sealed    = is_closed(s),
                         .materials = look_at_materials(s) };
    return o->views ? look_at_views(out, err) : look_at_grids(a, out, err);
}
