/* sim/scene_luminaires.c -- `luminaires` of a study as lights of the scene. */
#include "core/color.h"
#include "sim/scene_build.h"

#include <string.h>

static const char *file_name(const char *path)
{
    return strrchr(path, '/') ? strrchr(path, '/') + 1 : path;
}

/* ---- strength -------------------------------------------------------------------------------- */

/* What the file's candelas are multiplied by, but for TILT. */
static bool find_factor(scene_build *b, const study_luminaire *l, const photometry *web,
                        double *factor)
{
    *factor = 1.0;
    if (!isnan(l->lumens)) {
        if (!(web->luminaire_lumens > 0.0))
            return study_failed(b->study, l->where, b->err, ERR_ARGUMENT,
                                "`lumens` cannot scale %s: it gives no light", l->photometry);
        *factor = l->lumens / web->luminaire_lumens;
    } else if (!isnan(l->lamp_lumens)) {
        if (!(web->lamp_lumens > 0.0))
            return study_failed(b->study, l->where, b->err, ERR_ARGUMENT,
                                "`lamp_lumens` cannot scale %s: its photometry is absolute (say "
                                "`lumens`)",
                                l->photometry);
        *factor = l->lamp_lumens / web->lamp_lumens;
    }
    return true;
}

/* ---- places ---------------------------------------------------------------------------------- */

typedef struct luminaire_work {
    scene_build *b;
    const study_luminaire *from;
    const scene_web *file;
    double factor; /* of the file's candelas, not dimmed */
    lamps_outside outside;
} luminaire_work;

static bool add_luminaire(luminaire_work *w, luminaire_desc *d, dvec3 at, int32_t owner)
{
    scene_build *b           = w->b;
    const study_luminaire *l = w->from;
    const photometry *web    = w->file->web;
    double factor            = w->factor * lamp_tilt(web, d3_from(d->aim), l->lumens);
    double watts = !isnan(l->watts) ? l->watts : web->watts > 0.0 ? web->watts : (double)NAN;
    lamp_entry e = { .where     = l->where,
                     .luminaire = l,
                     .name      = l->name ? l->name : file_name(l->photometry),
                     .at        = at,
                     .emission  = &l->emission,
                     .lumens    = factor * web->luminaire_lumens,
                     .watts     = watts,
                     .web       = web,
                     .owner     = owner };
    d->position  = lamp_place(b, at);
    d->scale     = lamp_watts(b, l->emission.color, factor * lamp_made_with(b, &l->emission));
    d->web       = web;
    d->model     = w->file->model;
    d->point     = is_left_out(b, EFFECT_NEAR_FIELD);
    lamp_look_outside(b, at, &w->outside);
    return lamp_add(b, light_luminaire(b->a, d, b->err), &e);
}

static bool add_at_places(luminaire_work *w)
{
    const study_luminaire *l = w->from;
    for (int k = 0; k < l->at_count; k++) {
        dvec3 aim        = l->aim_at_given ? d3_sub(l->aim_at, l->at[k]) : l->aim;
        luminaire_desc d = { .aim    = d3_to_float(d3_scale(aim, 1.0 / d3_length(aim))),
                             .rotate = (float)(l->rotate_deg * (M_PI / 180.0)) };
        if (!add_luminaire(w, &d, l->at[k], 0))
            return false;
    }
    return true;
}

/* As the node is turned: its -y, which glTF has down, is gamma 0, and its x is C0, turned by
 * `rotate` about the axis; unless the study says where to aim. */
static bool add_at_nodes(luminaire_work *w, const node_lamps *nodes)
{
    const study_luminaire *l = w->from;
    const node_lamp *lamps   = nodes->lamps.items;
    double turn              = l->rotate_deg * (M_PI / 180.0);
    for (size_t k = 0; k < nodes->lamps.count; k++) {
        const transform *place = &lamps[k].place;
        dvec3 at               = transform_point(place, (dvec3){ 0, 0, 0 });
        dvec3 aim              = transform_vector(place, (dvec3){ 0, -1, 0 });
        dvec3 c0               = transform_vector(place, (dvec3){ 1, 0, 0 });
        luminaire_desc d       = { .rotate = (float)turn };
        if (l->aim_at_given || l->aim_given) {
            aim = l->aim_at_given ? d3_sub(l->aim_at, at) : l->aim;
        } else {
            aim       = d3_scale(aim, 1.0 / d3_length(aim));
            dvec3 c90 = d3_cross(c0, aim);
            d.c0      = d3_to_float(d3_add(d3_scale(c0, cos(turn)), d3_scale(c90, sin(turn))));
        }
        if (!(d3_length(aim) > 0.0) || !isfinite(d3_length(aim)))
            return study_failed(w->b->study, l->where, w->b->err, ERR_ARGUMENT,
                                "a luminaire at (%g, %g, %g) m has no direction to shine to", at.x,
                                at.y, at.z);
        d.aim = d3_to_float(d3_scale(aim, 1.0 / d3_length(aim)));
        if (!add_luminaire(w, &d, at, lamps[k].owner))
            return false;
    }
    return true;
}

bool build_luminaires(scene_build *b)
{
    for (int i = 0; i < b->study->luminaire_count; i++) {
        const study_luminaire *l = &b->study->luminaires[i];
        luminaire_work w = { .b = b, .from = l, .file = study_web(b, l->photometry, l->where) };
        if (!w.file || !find_factor(b, l, w.file->web, &w.factor))
            return false;
        lamp_check_dimming(b, l->where, l->emission.dimming);
        if (!(l->nodes ? add_at_nodes(&w, &b->at_nodes[i]) : add_at_places(&w)))
            return false;
        lamp_tell_outside(b, l->where, "luminaire", &w.outside);
    }
    return true;
}
