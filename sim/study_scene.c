/* sim/study_scene.c -- what light falls on: `room` and `scene` of a study. */
#include "sim/study_read.h"

/* ---- room ----------------------------------------------------------------------------------- */

static bool read_room_reflectance(const study_reader *r, const yaml_node_t *value, void *record)
{
    static const study_key table[] = {
        { "ceiling", STUDY_REQUIRED, study_read_reflectance, offsetof(study_room, ceiling) },
        { "walls", STUDY_REQUIRED, study_read_reflectance, offsetof(study_room, walls) },
        { "floor", STUDY_REQUIRED, study_read_reflectance, offsetof(study_room, floor) },
    };
    static const study_keys keys = STUDY_KEYS("a room's reflectance", table);
    study_room *room             = record;
    if (value->type == YAML_MAPPING_NODE)
        return study_read_map(r, value, &keys, room);
    if (!study_read_reflectance(r, value, &room->floor)) /* the same on all sides */
        return false;
    room->ceiling = room->walls = room->floor;
    return true;
}

bool study_read_room(const study_reader *r, const yaml_node_t *value, void *field)
{
    static const study_key table[] = {
        { "size", STUDY_REQUIRED, study_read_size, offsetof(study_room, size) },
        { "reflectance", STUDY_REQUIRED, read_room_reflectance, 0 },
        { "windows", STUDY_OPTIONAL, study_read_windows, 0 },
    };
    static const study_keys keys = STUDY_KEYS("a room", table);
    study_room *room             = field;
    *room                        = (study_room){ .where = study_node_where(value), .given = true };
    return study_read_map(r, value, &keys, room) &&
           study_check_windows(r, room, study_map_value(r, value, "windows"));
}

/* ---- scene ---------------------------------------------------------------------------------- */

static bool read_scene_at(const study_reader *r, const yaml_node_t *value, void *record)
{
    study_scene *s = record;
    return (s->at = study_read_places(r, value, &s->at_count)) != NULL;
}

enum { MOST_PATTERNS = 100 }; /* each is held against all nodes */

/* One pattern, or a list of them. */
static bool read_patterns(const study_reader *r, const yaml_node_t *value, const char ***out,
                          int *count)
{
    if (value->type == YAML_SEQUENCE_NODE && study_items(value) > MOST_PATTERNS)
        return study_node_failed(r, value, ERR_ARGUMENT, "%d patterns, expected at most %d",
                                 study_items(value), MOST_PATTERNS);
    if (value->type == YAML_SEQUENCE_NODE)
        return (*out = study_read_list(r, value, sizeof(char *), study_read_text, count)) != NULL;
    *out   = arena_new(r->a, const char *, r->err);
    *count = 1;
    return *out && study_read_text(r, value, *out);
}

static bool read_exterior(const study_reader *r, const yaml_node_t *value, void *record)
{
    study_scene *s = record;
    return read_patterns(r, value, &s->exterior, &s->exterior_count);
}

static bool read_portals(const study_reader *r, const yaml_node_t *value, void *record)
{
    study_scene *s = record;
    return read_patterns(r, value, &s->portals, &s->portal_count);
}

static bool read_scene(const study_reader *r, const yaml_node_t *value, void *record)
{
    static const study_key table[] = {
        { "file", STUDY_REQUIRED, study_read_path, offsetof(study_scene, file) },
        { "scale", STUDY_OPTIONAL, study_read_positive, offsetof(study_scene, scale) },
        { "lights", STUDY_OPTIONAL, study_read_switch, offsetof(study_scene, lights) },
        { "at", STUDY_OPTIONAL, read_scene_at, 0 },
        { "rotate", STUDY_OPTIONAL, study_read_number, offsetof(study_scene, rotate_deg) },
        { "exterior", STUDY_OPTIONAL, read_exterior, 0 },
        { "portals", STUDY_OPTIONAL, read_portals, 0 },
    };
    static const study_keys keys = STUDY_KEYS("a scene", table);
    study_scene *s               = record;
    *s = (study_scene){ .where = study_node_where(value), .scale = 1.0, .lights = true };

    bool good = value->type == YAML_SCALAR_NODE ? study_read_path(r, value, &s->file)
                                                : study_read_map(r, value, &keys, s);
    if (good && !s->at) { /* once, at the origin */
        s->at       = arena_new(r->a, dvec3, r->err);
        s->at_count = 1;
    }
    return good && s->at;
}

bool study_read_scenes(const study_reader *r, const yaml_node_t *value, void *record)
{
    study *s = record;
    if (value->type == YAML_SEQUENCE_NODE) {
        s->scenes = study_read_list(r, value, sizeof(study_scene), read_scene, &s->scene_count);
        return s->scenes != NULL;
    }
    s->scenes      = arena_new(r->a, study_scene, r->err);
    s->scene_count = 1;
    return s->scenes && read_scene(r, value, s->scenes);
}
