/* sim/grid_sensors.c -- where the sensors of a grid are: grid.h. */
#include "sim/grid.h"
#include "sim/inside.h"
#include "sim/probes.h"

/* Which way a sensor looks: where the grid says so, or else along the normal of its place; the axis
 * of a cylinder is upright. */
static dvec3 normal_of(const study_grid *g, dvec3 own)
{
    switch (g->quantity) {
    case QUANTITY_VERTICAL:
    case QUANTITY_SEMICYLINDRICAL:
        return g->facing;
    case QUANTITY_CYLINDRICAL:
        return (dvec3){ 0, 0, 1 };
    case QUANTITY_PLANAR:
        break;
    }
    return own;
}

const char *grid_quantity_name(study_quantity q)
{
    static const char *const names[] = {
        [QUANTITY_PLANAR]          = "illuminance",
        [QUANTITY_VERTICAL]        = "vertical illuminance",
        [QUANTITY_CYLINDRICAL]     = "cylindrical illuminance",
        [QUANTITY_SEMICYLINDRICAL] = "semicylindrical illuminance",
    };
    return names[q];
}

static grid_sensor *plane_sensors(arena *a, const study_grid *g, grid_result *out, lux_error *err)
{
    double along_u, along_v;
    study_grid_counts(g, &along_u, &along_v);
    out->columns         = (int)along_u;
    out->rows            = (int)along_v;
    out->sensor_count    = out->columns * out->rows;
    grid_sensor *sensors = arena_array(a, grid_sensor, (size_t)out->sensor_count, err);
    if (!sensors)
        return NULL;
    dvec3 n = d3_cross(g->u, g->v);
    n       = normal_of(g, d3_scale(n, 1.0 / d3_length(n)));
    for (int k = 0; k < out->sensor_count; k++) {
        double s   = (k % out->columns + 0.5) / out->columns;
        double t   = (k / out->columns + 0.5) / out->rows;
        dvec3 off  = d3_add(d3_scale(g->u, s), d3_scale(g->v, t));
        sensors[k] = (grid_sensor){ d3_add(g->origin, off), n };
    }
    out->sensors = sensors;
    return sensors;
}

static bool point_sensors(arena *a, const study_grid *g, grid_result *out, lux_error *err)
{
    probes p;
    if (!probes_read(a, g->points, &p, err))
        return false;
    grid_sensor *sensors = arena_array(a, grid_sensor, (size_t)p.count, err);
    if (!sensors)
        return false;
    for (int k = 0; k < p.count; k++)
        sensors[k] = (grid_sensor){ p.position[k], normal_of(g, p.normal[k]) };
    out->columns = out->sensor_count = p.count;
    out->rows                        = 1;
    out->sensors                     = sensors;
    return true;
}

static bool count_cells(arena *a, grid_result *out, lux_error *err)
{
    int *cell = arena_array(a, int, (size_t)out->sensor_count, err);
    for (int k = 0; cell && k < out->sensor_count; k++)
        cell[k] = k;
    out->cell = cell;
    return cell != NULL;
}

/* Leaves out the sensors that lie inside something solid: nobody could put one there. */
static bool leave_out_inside(arena *a, const scene *s, grid_sensor *sensors, grid_result *out,
                             lux_error *err)
{
    arena scratch = { 0 };
    int n         = out->sensor_count;
    vec3 *places  = arena_array(&scratch, vec3, (size_t)n, err);
    bool *inside  = places ? arena_array(&scratch, bool, (size_t)n, err) : NULL;
    int *cell     = inside ? arena_array(a, int, (size_t)n, err) : NULL;
    if (cell) {
        for (int k = 0; k < n; k++)
            places[k] = scene_place(s, out->sensors[k].at);
        out->left_out     = inside_find(s->world, places, n, inside, &out->shell_outward);
        out->sensor_count = 0;
        for (int k = 0; k < n; k++) {
            if (inside[k])
                continue;
            cell[out->sensor_count]      = k;
            sensors[out->sensor_count++] = sensors[k];
        }
        out->cell = cell;
    }
    arena_clear(&scratch);
    return cell != NULL;
}

bool grid_sensors(arena *a, const scene *s, const study_grid *g, grid_result *out, lux_error *err)
{
    *out = (grid_result){ .grid = g };
    if (g->points) /* each has its row, wherever it is */
        return point_sensors(a, g, out, err) && count_cells(a, out, err);
    grid_sensor *sensors = plane_sensors(a, g, out, err);
    if (!sensors || !leave_out_inside(a, s, sensors, out, err))
        return false;
    return out->sensor_count > 0 ||
           study_failed(s->study, g->where, err, ERR_ARGUMENT,
                        "grid `%s`: all its sensors lie inside something solid", g->name);
}
