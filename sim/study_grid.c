/* sim/study_grid.c -- where illuminance is asked for: `grids` of a study.
 *
 *     on, margin       a surface of the room, or over it    v +-----+
 *     origin, u, v     a parallelogram                        | . . |  sensors at
 *     points           a file (sim/probes.h)                  | . . |  cell centres
 *                                                      origin +-----+ u
 */
#include "sim/study_read.h"

#include <stdio.h>
#include <string.h>

#define MOST_SENSORS 4e6

/* What is less of a right angle is none: of planes, and of what stands upright. */
static const double least_sine = 1e-6;

/* All walls, each of which becomes a grid of its own: of no use to anybody but this file. */
enum { SIDE_WALLS = SIDE_WEST + 1 };

static const study_word sides[] = {
    [SIDE_NONE] = { "" }, /* what is not written */
    [SIDE_ROOM] = { "room" },   [SIDE_FLOOR] = { "floor" }, [SIDE_CEILING] = { "ceiling" },
    [SIDE_SOUTH] = { "south" }, [SIDE_EAST] = { "east" },   [SIDE_NORTH] = { "north" },
    [SIDE_WEST] = { "west" },   [SIDE_WALLS] = { "walls" },
};

static bool read_on(const study_reader *r, const yaml_node_t *value, void *field)
{
    enum { FIRST = SIDE_ROOM };
    int i = study_read_word(r, value, sides + FIRST, SIDE_WALLS + 1 - FIRST, sizeof *sides);
    if (i >= 0)
        *(study_side *)field = (study_side)(i + FIRST);
    return i >= 0;
}

static const study_word quantities[] = {
    [QUANTITY_PLANAR]          = { "planar" },
    [QUANTITY_VERTICAL]        = { "vertical" },
    [QUANTITY_CYLINDRICAL]     = { "cylindrical" },
    [QUANTITY_SEMICYLINDRICAL] = { "semicylindrical" },
};

static bool read_quantity(const study_reader *r, const yaml_node_t *value, void *field)
{
    int i = study_read_word(r, value, quantities, sizeof quantities / sizeof *quantities,
                            sizeof *quantities);
    if (i >= 0)
        *(study_quantity *)field = (study_quantity)i;
    return i >= 0;
}

/* A direction that is level, made so to the last bit, of length 1. */
static bool read_facing(const study_reader *r, const yaml_node_t *value, void *field)
{
    dvec3 d;
    if (!study_read_direction(r, value, &d))
        return false;
    double level = hypot(d.x, d.y);
    if (!(fabs(d.z) <= least_sine * level))
        return study_node_failed(r, value, ERR_FORMAT,
                                 "expected a level direction, [x, y, 0], found %g upward", d.z);
    *(dvec3 *)field = (dvec3){ d.x / level, d.y / level, 0.0 };
    return true;
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
        { "maximum", STUDY_OPTIONAL, study_read_positive, offsetof(study_grid, require_maximum) },
        { "uniformity", STUDY_OPTIONAL, study_read_share,
          offsetof(study_grid, require_uniformity) },
    };
    static const study_keys keys = STUDY_KEYS("require", table);
    return study_read_map(r, value, &keys, record);
}

static const study_key grid_table[] = {
    { "name", STUDY_REQUIRED, study_read_name, offsetof(study_grid, name) },
    { "on", STUDY_OPTIONAL, read_on, offsetof(study_grid, on) },
    { "height", STUDY_OPTIONAL, study_read_nonnegative, offsetof(study_grid, height) },
    { "margin", STUDY_OPTIONAL, study_read_nonnegative, offsetof(study_grid, margin) },
    { "origin", STUDY_OPTIONAL, study_read_place, offsetof(study_grid, origin) },
    { "u", STUDY_OPTIONAL, study_read_direction, offsetof(study_grid, u) },
    { "v", STUDY_OPTIONAL, study_read_direction, offsetof(study_grid, v) },
    { "spacing", STUDY_OPTIONAL, read_spacing, 0 },
    { "points", STUDY_OPTIONAL, study_read_path, offsetof(study_grid, points) },
    { "quantity", STUDY_OPTIONAL, read_quantity, offsetof(study_grid, quantity) },
    { "facing", STUDY_OPTIONAL, read_facing, offsetof(study_grid, facing) },
    { "require", STUDY_OPTIONAL, read_require, 0 },
};
static const study_keys grid_keys = STUDY_KEYS("a grid", grid_table);

/* The three ways to write a grid: which keys make one, which of them it cannot do without. */
typedef struct grid_form {
    const char *key, *needs[4], *takes[4]; /* up to a NULL */
} grid_form;

static const grid_form grid_forms[] = {
    { "on", { "spacing" }, { "height", "margin", "spacing" } },
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

/* A height over the floor, of the plane over it and of nothing else. */
static bool height_kept(const study_reader *r, const yaml_node_t *value, const study_grid *g)
{
    const yaml_node_t *height = study_map_value(r, value, "height");
    if (g->on == SIDE_ROOM && !height)
        return study_node_failed(r, value, ERR_FORMAT,
                                 "a grid with `on: room` needs the key `height`");
    if (g->on != SIDE_ROOM && height)
        return study_node_failed(r, height, ERR_FORMAT, "`height` does not go with `on: %s`",
                                 sides[g->on].name);
    return true;
}

static bool faces(const study_grid *g)
{
    return g->quantity == QUANTITY_VERTICAL || g->quantity == QUANTITY_SEMICYLINDRICAL;
}

static bool facing_kept(const study_reader *r, const yaml_node_t *value, const study_grid *g)
{
    const yaml_node_t *facing = study_map_value(r, value, "facing");
    if (facing && !faces(g))
        return study_node_failed(r, facing, ERR_FORMAT, "`facing` does not go with `quantity: %s`",
                                 quantities[g->quantity].name);
    return true;
}

static bool read_grid(const study_reader *r, const yaml_node_t *value, void *record)
{
    study_grid *g = record;
    *g            = (study_grid){ .where              = study_node_where(value),
                                  .spacing            = (double)NAN,
                                  .require_average    = (double)NAN,
                                  .require_minimum    = (double)NAN,
                                  .require_maximum    = (double)NAN,
                                  .require_uniformity = (double)NAN,
                                  .height             = (double)NAN };
    if (!study_read_map(r, value, &grid_keys, g))
        return false;
    for (const grid_form *f = grid_forms; f < grid_forms + GRID_FORMS; f++)
        if (study_map_value(r, value, f->key))
            return grid_form_kept(r, value, f) && (!g->on || height_kept(r, value, g)) &&
                   facing_kept(r, value, g);
    return study_node_failed(r, value, ERR_FORMAT,
                             "a grid needs `on`, or `origin`, `u` and `v`, or `points`");
}

/* ---- four walls ----------------------------------------------------------------------------- */

static char *wall_name(const study_reader *r, const char *grid, const char *wall)
{
    size_t size = strlen(grid) + strlen(wall) + 2;
    char *name  = arena_array(r->a, char, size, r->err);
    if (name)
        snprintf(name, size, "%s-%s", grid, wall);
    return name;
}

/* For each grid `on: walls` four, one a wall, in the order of the compass from the south. */
static bool part_walls(const study_reader *r, study *s)
{
    int walls = 0;
    for (int i = 0; i < s->grid_count; i++)
        walls += (int)s->grids[i].on == SIDE_WALLS;
    if (walls == 0)
        return true;
    const study_grid *from = s->grids;
    int count = s->grid_count, to = 0;
    s->grid_count = count + 3 * walls;
    s->grids      = arena_array(r->a, study_grid, (size_t)s->grid_count, r->err);
    for (int i = 0; s->grids && i < count; i++) {
        bool all = (int)from[i].on == SIDE_WALLS;
        for (int side = SIDE_SOUTH; side <= (all ? SIDE_WEST : SIDE_SOUTH); side++) {
            study_grid *g = &s->grids[to++];
            *g            = from[i];
            if (!all)
                continue;
            g->on = (study_side)side;
            if (!(g->name = wall_name(r, from[i].name, sides[side].name)))
                return false;
        }
    }
    return s->grids != NULL;
}

bool study_read_grids(const study_reader *r, const yaml_node_t *value, void *record)
{
    study *s = record;
    s->grids = study_read_list(r, value, sizeof(study_grid), read_grid, &s->grid_count);
    return s->grids && part_walls(r, s);
}

/* ---- once the room is known ----------------------------------------------------------------- */

/* Sensors that face somewhere, and are not told where, face as the plane does, if it is upright. */
static bool face(const study *s, study_grid *g, dvec3 normal, lux_error *err)
{
    if (!faces(g) || d3_length(g->facing) > 0.0)
        return true;
    double level = hypot(normal.x, normal.y);
    if (!(level > 0.0 && fabs(normal.z) <= least_sine * level))
        return study_failed(s, g->where, err, ERR_FORMAT,
                            "`quantity: %s` needs the key `facing`, as the grid does not stand "
                            "upright",
                            quantities[g->quantity].name);
    g->facing = (dvec3){ normal.x / level, normal.y / level, 0.0 };
    return true;
}

static bool count_sensors(const study *s, study_grid *g, lux_error *err)
{
    double along_u, along_v;
    if (g->en12464)
        g->spacing = study_counts_en12464(d3_length(g->u), d3_length(g->v), &along_u, &along_v);
    else
        study_grid_counts(g, &along_u, &along_v);
    if (!(along_u * along_v <= MOST_SENSORS))
        return study_failed(s, g->where, err, ERR_FORMAT,
                            "%.0f by %.0f sensors, expected at most %.0f", along_u, along_v,
                            MOST_SENSORS);
    g->count[0] = (int)along_u;
    g->count[1] = (int)along_v;
    return true;
}

static bool finish_grid(const study *s, study_grid *g, lux_error *err)
{
    if (g->points) {
        if (faces(g) && !(d3_length(g->facing) > 0.0))
            return study_failed(s, g->where, err, ERR_FORMAT,
                                "`quantity: %s` of `points` needs the key `facing`",
                                quantities[g->quantity].name);
        return true;
    }
    if (g->on && !study_grid_place(s, g, err))
        return false;
    dvec3 normal  = d3_cross(g->u, g->v);
    double across = d3_length(normal);
    if (!(across > least_sine * d3_length(g->u) * d3_length(g->v)))
        return study_failed(s, g->where, err, ERR_FORMAT, "`u` and `v` are parallel");
    return face(s, g, d3_scale(normal, 1.0 / across), err) && count_sensors(s, g, err);
}

bool study_finish_grids(const study *s, lux_error *err)
{
    for (int i = 0; i < s->grid_count; i++)
        if (!finish_grid(s, &s->grids[i], err))
            return false;
    return true;
}
