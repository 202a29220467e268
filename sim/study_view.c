/* sim/study_view.c -- what is to be seen: `views` of a study. */
#include "sim/study_read.h"

enum { MOST_PIXELS_A_SIDE = 16384, MOST_PIXELS = 64 << 20 };

static bool read_view_size(const study_reader *r, const yaml_node_t *value, void *record)
{
    study_view *v = record;
    int size[2];
    if (!study_read_pair(r, value, MOST_PIXELS_A_SIDE, size))
        return false;
    if (size[0] > MOST_PIXELS / size[1])
        return study_node_failed(r, value, ERR_FORMAT,
                                 "%d by %d pixels, expected at most %d altogether", size[0],
                                 size[1], MOST_PIXELS);
    v->width      = size[0];
    v->height     = size[1];
    v->size_given = true;
    return true;
}

static bool read_projection(const study_reader *r, const yaml_node_t *value, void *field)
{
    static const study_word words[] = {
        [PROJECTION_PERSPECTIVE]  = { "perspective", STUDY_OPTIONAL },
        [PROJECTION_ORTHOGRAPHIC] = { "orthographic", STUDY_OPTIONAL },
        [PROJECTION_FISHEYE]      = { "fisheye", STUDY_OPTIONAL },
        [PROJECTION_PANORAMA]     = { "panorama", STUDY_OPTIONAL },
    };
    int i = study_read_word(r, value, words, sizeof words / sizeof *words, sizeof *words);
    if (i >= 0)
        *(study_projection *)field = (study_projection)i;
    return i >= 0;
}

static const study_key view_table[] = {
    { "name", STUDY_REQUIRED, study_read_name, offsetof(study_view, name) },
    { "camera", STUDY_OPTIONAL, study_read_text, offsetof(study_view, camera) },
    { "eye", STUDY_OPTIONAL, study_read_place, offsetof(study_view, eye) },
    { "target", STUDY_OPTIONAL, study_read_place, offsetof(study_view, target) },
    { "projection", STUDY_OPTIONAL, read_projection, offsetof(study_view, projection) },
    { "fov", STUDY_OPTIONAL, study_read_opening, offsetof(study_view, fov_deg) },
    { "width", STUDY_OPTIONAL, study_read_positive, offsetof(study_view, width_m) },
    { "size", STUDY_OPTIONAL, read_view_size, 0 },
};
static const study_keys view_keys = STUDY_KEYS("a view", view_table);

static bool without(const study_reader *r, const yaml_node_t *map, const char *key, const char *why)
{
    const yaml_node_t *stray = study_map_value(r, map, key);
    return !stray || study_node_failed(r, stray, ERR_FORMAT, "`%s` does not go with %s", key, why);
}

static bool with(const study_reader *r, const yaml_node_t *map, const char *key, const char *why)
{
    return study_map_value(r, map, key) ||
           study_node_failed(r, map, ERR_FORMAT, "a view %s needs the key `%s`", why, key);
}

/* Each way to look has its keys. */
static bool view_is_whole(const study_reader *r, const yaml_node_t *map, const study_view *v)
{
    if (v->camera) {
        static const char *const own[] = { "eye", "target", "projection", "fov", "width" };
        for (size_t i = 0; i < sizeof own / sizeof *own; i++)
            if (!without(r, map, own[i], "`camera`, which has its own"))
                return false;
        return true;
    }
    if (!with(r, map, "eye", "without `camera`") || !with(r, map, "target", "without `camera`"))
        return false;
    if (!(d3_length(d3_sub(v->target, v->eye)) >= 1e-9))
        return study_node_failed(r, map, ERR_FORMAT, "`eye` and `target` are at the same place");
    if (v->projection == PROJECTION_ORTHOGRAPHIC)
        return with(r, map, "width", "in orthographic projection") &&
               without(r, map, "fov", "orthographic projection, which has a `width`");
    if (v->projection == PROJECTION_PERSPECTIVE)
        return without(r, map, "width", "perspective, which has a `fov`");
    const char *why = v->projection == PROJECTION_FISHEYE ? "fisheye, which shows 180 degrees"
                                                          : "panorama, which shows all around";
    return without(r, map, "width", why) && without(r, map, "fov", why);
}

/* What is round is not squeezed where no size is given. */
static void fit_size(study_view *v)
{
    if (v->size_given)
        return;
    if (v->projection == PROJECTION_FISHEYE)
        v->width = v->height;
    if (v->projection == PROJECTION_PANORAMA)
        v->height = v->width / 2;
}

static bool read_view(const study_reader *r, const yaml_node_t *value, void *record)
{
    study_view *v = record;
    *v            = (study_view){ .where   = study_node_where(value),
                                  .fov_deg = 60.0,
                                  .width_m = (double)NAN,
                                  .width   = 1024,
                                  .height  = 768 };
    bool good     = study_read_map(r, value, &view_keys, v) && view_is_whole(r, value, v);
    fit_size(v);
    return good;
}

bool study_read_views(const study_reader *r, const yaml_node_t *value, void *record)
{
    study *s = record;
    s->views = study_read_list(r, value, sizeof(study_view), read_view, &s->view_count);
    return s->views != NULL;
}
