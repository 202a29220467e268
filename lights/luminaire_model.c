/* lights/luminaire_model.c -- what all luminaires of one web share: its tables, in radians.
 *
 * The error table alone takes a thousand times as long to make as a lamp does.
 */
#include "lights/luminaire.h"

#include <math.h>

/* A copy of angles in rad. */
static const float *radians(arena *a, const float *deg, int count, lux_error *err)
{
    float *rad = arena_array(a, float, (size_t)count, err);
    for (int i = 0; rad && i < count; i++)
        rad[i] = (float)((double)deg[i] * (M_PI / 180.0));
    return rad;
}

static bool ring_is_dark(const photometry *web, int ring)
{
    for (int i = 0; i < web->plane_count; i++)
        if (web->candela[i * web->gamma_count + ring] > 0.0f)
            return false;
    return true;
}

/* The angles gamma between which there is light, less a rounding of their cosines. */
static void find_cone(luminaire_model *m, const photometry *web)
{
    int first = 0, last = web->gamma_count - 1;
    while (first < last && ring_is_dark(web, first + 1))
        first++;
    while (last > 0 && ring_is_dark(web, last - 1))
        last--;
    if (!ring_is_dark(web, 0))
        first = 0;
    if (!ring_is_dark(web, web->gamma_count - 1))
        last = web->gamma_count - 1;
    m->down_least = (float)cos((double)web->gamma_deg[last] * (M_PI / 180.0)) - 1e-5f;
    m->down_most  = (float)cos((double)web->gamma_deg[first] * (M_PI / 180.0)) + 1e-5f;
}

/* The web as tables have it. From straight down to straight up no rounding of gamma is dark. */
static bool make_table(luminaire_model *m, const photometry *web, arena *a, lux_error *err)
{
    const float *plane = radians(a, web->plane_deg, web->plane_count, err);
    const float *gamma = plane ? radians(a, web->gamma_deg, web->gamma_count, err) : NULL;
    if (!gamma)
        return false;
    m->candela = web->candela;
    m->axes[0] = (table_axis){ plane, web->plane_count, true, (float)(2.0 * M_PI) };
    m->axes[1] = (table_axis){ gamma, web->gamma_count };
    for (int i = 0; i < 2; i++)
        m->axes[i].density = table_axis_density(&m->axes[i]);
    m->gamma_from = gamma[0];
    m->gamma_to   = gamma[web->gamma_count - 1];
    if (web->gamma_deg[0] <= 0.0f)
        m->gamma_from = -1.0f;
    if (web->gamma_deg[web->gamma_count - 1] >= 180.0f)
        m->gamma_to = 4.0f;
    find_cone(m, web);
    return true;
}

static void find_strongest(luminaire_model *m, const photometry *web)
{
    int at = 0;
    for (int i = 1; i < web->plane_count * web->gamma_count; i++)
        if (web->candela[i] > web->candela[at])
            at = i;
    double plane = (double)web->plane_deg[at / web->gamma_count] * (M_PI / 180.0);
    double gamma = (double)web->gamma_deg[at % web->gamma_count] * (M_PI / 180.0);
    m->most      = web->candela[at];
    m->strongest = (vec3){ (float)(sin(gamma) * cos(plane)), (float)(sin(gamma) * sin(plane)),
                           (float)cos(gamma) };
}

/* What a web made by a program may lack. */
static bool check_web(const photometry *web, lux_error *err)
{
    if (!web || web->plane_count < 1 || web->gamma_count < 1)
        return failed(err, ERR_ARGUMENT, "luminaire: there is no photometric web");
    const table_axis plane = { web->plane_deg, web->plane_count, true, 360.0f };
    const table_axis gamma = { web->gamma_deg, web->gamma_count, false, 0.0f };
    return table_axis_check(&plane, "luminaire: C planes", err) &&
           table_axis_check(&gamma, "luminaire: angles gamma", err);
}

const luminaire_model *luminaire_model_new(arena *a, const photometry *web, lux_error *err)
{
    luminaire_model *m = check_web(web, err) ? arena_new(a, luminaire_model, err) : NULL;
    if (!m || !make_table(m, web, a, err))
        return NULL;
    m->lumens = web->luminaire_lumens;
    find_strongest(m, web);
    m->error = luminaire_error_table(a, web, err);
    return m->error && luminaire_cells_make(a, web, &m->cells, err) ? m : NULL;
}

const luminaire_model *luminaire_model_measured(arena *a, const luminaire_model *m,
                                                const table_measures *by, lux_error *err)
{
    luminaire_model *copy = arena_new(a, luminaire_model, err);
    if (!copy)
        return NULL;
    *copy          = *m;
    copy->measures = *by;
    return copy;
}
