/* sim/study.c -- see study.h. The top of a study, and what concerns its parts together. */
#include "sim/study.h"

#include "core/file.h"
#include "sim/study_read.h"
#include "sim/yaml_guard.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- keys of the top ------------------------------------------------------------------------ */

static bool read_version(const study_reader *r, const yaml_node_t *value, void *record)
{
    (void)record; /* there is but one version to be told from others */
    double version;
    if (!study_read_number(r, value, &version))
        return false;
    return version == 1.0 ||
           study_node_failed(r, value, ERR_UNSUPPORTED,
                             "version %g of study files, this program knows 1", version);
}

static bool read_maintenance(const study_reader *r, const yaml_node_t *value, void *record)
{
    study *s                    = record;
    return s->maintenance_given = study_read_share(r, value, &s->maintenance);
}

static const study_key top_table[] = {
    { "lux4", STUDY_REQUIRED, read_version, 0 },
    { "room", STUDY_OPTIONAL, study_read_room, offsetof(study, room) },
    { "scene", STUDY_OPTIONAL, study_read_scenes, 0 },
    { "site", STUDY_OPTIONAL, study_read_site, offsetof(study, site) },
    { "when", STUDY_OPTIONAL, study_read_when, offsetof(study, when) },
    { "sky", STUDY_OPTIONAL, study_read_sky, offsetof(study, sky) },
    { "maintenance", STUDY_OPTIONAL, read_maintenance, 0 },
    { "luminaires", STUDY_OPTIONAL, study_read_luminaires, 0 },
    { "lights", STUDY_OPTIONAL, study_read_lights, 0 },
    { "dimming", STUDY_OPTIONAL, study_read_dimmings, 0 },
    { "materials", STUDY_OPTIONAL, study_read_materials, 0 },
    { "grids", STUDY_OPTIONAL, study_read_grids, 0 },
    { "views", STUDY_OPTIONAL, study_read_views, 0 },
    { "accuracy", STUDY_OPTIONAL, study_read_percent, offsetof(study, accuracy) },
    { "variants", STUDY_OPTIONAL, study_read_variants, 0 },
};
static const study_keys top_keys = STUDY_KEYS("a study", top_table);

/* ---- names ---------------------------------------------------------------------------------- */

typedef struct named {
    const char *name;
    study_where where;
} named;

static int by_name_and_place(const void *left, const void *right)
{
    const named *a = left, *b = right;
    int order = strcmp(a->name, b->name);
    order     = order ? order : a->where.line - b->where.line;
    return order ? order : a->where.column - b->where.column;
}

static bool names_differ(const study *s, const char *what, named *list, int count, lux_error *err)
{
    qsort(list, (size_t)count, sizeof *list, by_name_and_place);
    for (int i = 1; i < count; i++)
        if (!strcmp(list[i].name, list[i - 1].name))
            return study_failed(s, list[i].where, err, ERR_FORMAT,
                                "the name `%s` is taken by the %s of line %d", list[i].name, what,
                                list[i - 1].where.line);
    return true;
}

/* Grids and views name files, which must differ; luminaires are to be told apart. */
static bool names_are_unique(const study *s, lux_error *err)
{
    size_t room   = (size_t)s->grid_count + (size_t)s->view_count + (size_t)s->luminaire_count;
    arena scratch = { 0 };
    named *list   = arena_array(&scratch, named, room, err);
    bool good     = list != NULL;

    int count = 0;
    for (int i = 0; good && i < s->grid_count; i++)
        list[count++] = (named){ s->grids[i].name, s->grids[i].where };
    for (int i = 0; good && i < s->view_count; i++)
        list[count++] = (named){ s->views[i].name, s->views[i].where };
    good = good && names_differ(s, "grid or view", list, count, err);

    count = 0;
    for (int i = 0; good && i < s->luminaire_count; i++)
        if (s->luminaires[i].name)
            list[count++] = (named){ s->luminaires[i].name, s->luminaires[i].where };
    good = good && names_differ(s, "luminaire", list, count, err);
    arena_clear(&scratch);
    return good;
}

/* ---- the whole ------------------------------------------------------------------------------ */

/* "a/b" of "a/b/c.yaml", "." of "c.yaml", "/" of "/c.yaml". */
static char *folder_of(arena *a, const char *path, lux_error *err)
{
    const char *slash = strrchr(path, '/');
    size_t length     = slash && slash > path ? (size_t)(slash - path) : 1;
    char *folder      = arena_array(a, char, length + 1, err);
    if (folder)
        memcpy(folder, slash ? path : ".", length);
    return folder;
}

static char *text_kept(arena *a, const char *text, lux_error *err)
{
    size_t bytes = strlen(text) + 1;
    char *copy   = arena_array(a, char, bytes, err);
    return copy ? memcpy(copy, text, bytes) : NULL;
}

static bool read_top(const study_reader *r, study *s, int index)
{
    const yaml_node_t *top = yaml_document_get_node(r->tree, index);
    if (top->type != YAML_MAPPING_NODE)
        return study_unexpected(r, top, "a study (lux4: 1 ...)");

    /* The keys of another version are not this one's: that is said first */
    const yaml_node_t *version = study_map_value(r, top, "lux4");
    if (version && !read_version(r, version, s))
        return false;
    return study_read_map(r, top, &top_keys, s) && study_finish_luminaires(s, r->a, r->err) &&
           study_finish_dimmings(s, r->err) && study_finish_grids(s, r->err) &&
           study_finish_when(s, r->a, r->err) && names_are_unique(s, r->err);
}

/* The study whose keys are those of the node, kept in r->a. */
static study *read_whole(const study_reader *r, int index)
{
    study *s = arena_new(r->a, study, r->err);
    if (!s)
        return NULL;
    *s = (study){ .path        = r->path,
                  .folder      = r->folder,
                  .variant     = r->variant,
                  .maintenance = 1.0,
                  .accuracy    = (double)NAN };
    return read_top(r, s, index) ? s : NULL;
}

/* Every variant is read, so that an error in one shows before it is needed; what they come to is
 * dropped, but for the one that was chosen. NULL, with the error, if one is wrong. */
static study *read_variants(const study_reader *r, study *plain, int chosen)
{
    study *s = plain;
    for (int i = 0; s && i < study_variant_count(r); i++) {
        arena scratch    = { 0 };
        study_reader one = *r;
        one.a            = i == chosen ? r->a : &scratch;
        one.notices      = i == chosen ? r->notices : NULL;
        one.variant      = text_kept(one.a, study_variant_name(r, i), r->err);
        int merged       = one.variant ? study_variant_merge(&one, i) : -1;
        study *read      = merged < 0 ? NULL : read_whole(&one, merged);
        if (!read)
            s = NULL;
        else if (i == chosen)
            s = read;
        arena_clear(&scratch);
    }
    return s;
}

const study *study_parse(arena *a, const char *path, const char *variant, const char *text,
                         size_t size, notices *n, lux_error *err)
{
    enum { ROOT = 1 }; /* libyaml's first node */
    yaml_document_t tree;
    int items_left = STUDY_MOST_READ;
    study_reader r = { .a          = a,
                       .items_left = &items_left,
                       .tree       = &tree,
                       .path       = text_kept(a, path, err),
                       .folder     = folder_of(a, path, err),
                       .notices    = n,
                       .err        = err };
    if (!r.path || !r.folder || !yaml_guard_load(&tree, path, text, size, err))
        return NULL;

    study *s   = read_whole(&r, ROOT); /* it must be good by itself */
    int chosen = s && variant ? study_variant_find(&r, variant) : -1;
    s          = !s || (variant && chosen < 0) ? NULL : read_variants(&r, s, chosen);
    yaml_document_delete(&tree);
    return s;
}

const study *study_read(arena *a, const char *path, const char *variant, notices *n, lux_error *err)
{
    arena scratch  = { 0 };
    size_t size    = 0;
    char *text     = file_read(&scratch, path, YAML_GUARD_BYTES, &size, err);
    const study *s = text ? study_parse(a, path, variant, text, size, n, err) : NULL;
    arena_clear(&scratch);
    return s;
}

void *study_failed(const study *s, study_where where, lux_error *err, error_code code,
                   const char *format, ...)
{
    lux_error text;
    va_list args;
    va_start(args, format);
    vsnprintf(text.text, sizeof text.text, format, args);
    va_end(args);
    if (s->variant)
        return failed(err, code, "%s:%d:%d: with the variant `%s`: %s", s->path, where.line,
                      where.column, s->variant, text.text);
    return failed(err, code, "%s:%d:%d: %s", s->path, where.line, where.column, text.text);
}

bool study_match(const char *pattern, const char *name)
{
    const char *star = NULL, *from = NULL; /* the last *, and where in name it ends for now */
    while (*name) {
        if (*pattern == '*') {
            star = pattern++, from = name;
        } else if (*pattern == '?' || *pattern == *name) {
            pattern++, name++;
            while (pattern[-1] == '?' && ((unsigned char)*name & 0xc0) == 0x80)
                name++; /* the rest of one character */
        } else if (star) {
            pattern = star + 1, name = ++from;
        } else {
            return false;
        }
    }
    while (*pattern == '*')
        pattern++;
    return *pattern == '\0';
}
