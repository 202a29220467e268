/* sim/study_grid.c -- where illuminance is asked for: `grids` of a study.
 *
 *     on: room, height, margin   a plane over the room's floor     v +-----+
 *     origin, u, v               a parallelogram                     | . . |  sensors at
 *     points                     a file (sim/probes.h)               | . . |  cell centres
 *                                                             origin +-----+ u
 */
#include "sim/study_read.h"

#include <string.h>

#define MOST_SENSORS 4e6

static bool read_on(const study_reader *r, const yaml_node_t *value, void *field)
{
    static const study_word words[] = { { "room", STUDY_OPTIONAL } };
    *(bool *)field                  = study_read_word(r, value, words, 1, sizeof *words) == 0;
    return *(bool *)field;
}

static bool read_spacing(const study_reader *r, const yaml_node_t *value, void *record)
{
    study_grid *g = record;
    double x;
    if (value->type == YAML_SCALAR_NODE && !strcmp(study_node_text(value), "en12464"))
        return g->en12464 = true;
    study_reader quiet = *r; /* its error would not know of the standard */
    quiet.err          = NULL;
    if (study_read_number(&quiet, value, &x))
        return study_read_positive(r, value, &g->spacing);
    return study_unexpected(r, value, "a number > 0 or en12464");
}

static bool read_require(const study_reader *r, const yaml_node_t *value, void *record)
{
    static const study_key table[] = {
        { "average", STUDY_OPTIONAL, study_read_positive, offsetof(study_grid, require_average) },
        { "minimum", STUDY_OPTIONAL, study_read_positive, offsetof(study_grid, require_minimum) },
        { "uniformity", STUDY_OPTIONAL, study_read_share,
          offsetof(study_grid, require_uniformity) },
    };
    static const study_keys keys = STUDY_KEYS("require", table);
    return study_read_map(r, value, &keys, record);
}

static const study_key grid_table[] = {
    { "name", STUDY_REQUIRED, study_read_name, offsetof(study_grid, name) },
    { "on", STUDY_OPTIONAL, read_on, offsetof(study_grid, on_room) },
    { "height", STUDY_OPTIONAL, study_read_nonnegative, offsetof(study_grid, height) },
    { "margin", STUDY_OPTIONAL, study_read_nonnegative, offsetof(study_grid, margin) },
    { "origin", STUDY_OPTIONAL, study_read_place, offsetof(study_grid, origin) },
    { "u", STUDY_OPTIONAL, study_read_direction, offsetof(study_grid, u) },
    { "v", STUDY_OPTIONAL, study_read_direction, offsetof(study_grid, v) },
    { "spacing", STUDY_OPTIONAL, read_spacing, 0 },
    { "points", STUDY_OPTIONAL, study_read_path, offsetof(study_grid, points) },
    { "require", STUDY_OPTIONAL, read_require, 0 },
};
static const study_keys grid_keys = STUDY_KEYS("a grid", grid_table);

/* The three ways to write a grid: which keys make one, which of them it cannot do without. */
typedef struct grid_form {
    const char *key, *needs[4], *takes[4]; /* up to a NULL */
} grid_form;

static const grid_form grid_forms[] = {
    { "on", { "height", "spacing" }, { "height", "margin", "spacing" } },
    { "points", { NULL }, { NULL } },
    { "origin", { "u", "v", "spacing" }, { "u", "v", "spacing" } },
};
enum { GRID_FORMS = sizeof grid_forms / sizeof *grid_forms };

static bool form_takes(const grid_form *f, const char *key)
{
    bool takes = !strcmp(f->key, key);
    for (int i = 0; i < 4 && f->takes[i]; i++)
        takes = takes || !strcmp(f->takes[i], key);
    return takes;
}

static bool grid_form_kept(const study_reader *r, const yaml_node_t *value, const grid_form *f)
{
    for (int i = 0; i < 4 && f->needs[i]; i++)
        if (!study_map_value(r, value, f->needs[i]))
            return study_node_failed(r, value, ERR_FORMAT, "a grid with `%s` needs the key `%s`",
                                     f->key, f->needs[i]);

    /* Nothing of the other ways */
    for (const grid_form *other = grid_forms; other < grid_forms + GRID_FORMS; other++) {
        const char *keys[] = { other->key, other->takes[0], other->takes[1], other->takes[2] };
        for (int i = 0; i < 4 && keys[i]; i++) {
            const yaml_node_t *stray = study_map_value(r, value, keys[i]);
            if (stray && !form_takes(f, keys[i]))
                return study_node_failed(r, stray, ERR_FORMAT, "`%s` does not go with `%s`",
                                         keys[i], f->key);
        }
    }
    return true;
}

static bool read_grid(const study_reader *r, const yaml_node_t *value, void *record)
{
    study_grid *g = record;
    *g            = (study_grid){ .where              = study_node_where(value),
                                  .spacing            = (double)NAN,
                                  .require_average    = (double)NAN,
                                  .require_minimum    = (double)NAN,
                                  .require_uniformity = (double)NAN,
                                  .height             = (double)NAN };
    if (!study_read_map(r, value, &grid_keys, g))
        return false;
    for (const grid_form *f = grid_forms; f < grid_forms + GRID_FORMS; f++)
        if (study_map_value(r, value, f->key))
            return grid_form_kept(r, value, f);
    return study_node_failed(r, value, ERR_FORMAT,
                             "a grid needs `on: room`, or `origin`, `u` and `v`, or `points`");
}

bool study_read_grids(const study_reader *r, const yaml_node_t *value, void *record)
{
    study *s = record;
    s->grids = study_read_list(r, value, sizeof(study_grid), read_grid, &s->grid_count);
    return s->grids != NULL;
}

/* ---- once the room is known ----------------------------------------------------------------- */

double study_spacing_en12464(double side, double other)
{
    double longer  = fmax(side, other);
    double shorter = fmin(side, other);
    double d       = longer / shorter >= 2.0 ? shorter : longer;
    double p       = fmin(0.2 * pow(5.0, log10(d)), 10.0);
    double cells   = ceil(d / p - 1e-9); /* 10 m at 1 m: 10, whatever pow() rounds to */
    return d / cells;
}

void study_grid_counts(const study_grid *g, double *along_u, double *along_v)
{
    *along_u = fmax(1.0, round(d3_length(g->u) / g->spacing));
    *along_v = fmax(1.0, round(d3_length(g->v) / g->spacing));
}

static bool place_in_room(const study *s, study_grid *g, lux_error *err)
{
    const study_room *room = &s->room;
    if (!room->given)
        return study_failed(s, g->where, err, ERR_FORMAT, "`on: room`, but there is no `room`");
    if (!(g->height < room->size.z))
        return study_failed(s, g->where, err, ERR_FORMAT,
                            "`height: %g` is not below the ceiling at %g m", g->height,
                            room->size.z);

    double x = room->size.x - 2.0 * g->margin;
    double y = room->size.y - 2.0 * g->margin;
    if (!(x > 0.0 && y > 0.0))
        return study_failed(s, g->where, err, ERR_FORMAT,
                            "`margin: %g` leaves nothing of a room of %g by %g m", g->margin,
                            room->size.x, room->size.y);
    g->origin = (dvec3){ g->margin, g->margin, g->height };
    g->u      = (dvec3){ x, 0, 0 };
    g->v      = (dvec3){ 0, y, 0 };
    return true;
}

static bool finish_grid(const study *s, study_grid *g, lux_error *err)
{
    if (g->points)
        return true;
    if (g->on_room && !place_in_room(s, g, err))
        return false;

    /* Below a millionth of a right angle there is no plane to speak of */
    double across = d3_length(d3_cross(g->u, g->v));
    if (!(across > 1e-6 * d3_length(g->u) * d3_length(g->v)))
        return study_failed(s, g->where, err, ERR_FORMAT, "`u` and `v` are parallel");
    if (g->en12464)
        g->spacing = study_spacing_en12464(d3_length(g->u), d3_length(g->v));

    double along_u, along_v;
    study_grid_counts(g, &along_u, &along_v);
    if (!(along_u * along_v <= MOST_SENSORS))
        return study_failed(s, g->where, err, ERR_FORMAT,
                            "%.0f by %.0f sensors, expected at most %.0f", along_u, along_v,
                            MOST_SENSORS);
    return true;
}

bool study_finish_grids(const study *s, lux_error *err)
{
    for (int i = 0; i < s->grid_count; i++)
        if (!finish_grid(s, &s->grids[i], err))
            return false;
    return true;
}
