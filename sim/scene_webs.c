/* sim/scene_webs.c -- the photometric files of a scene: each is read, and warned of, once, however
 * many lamps name it.
 */
#include "core/table.h"
#include "sim/scene_build.h"

#include <string.h>

/* How many of the webs have a name that sorts before this one. */
static size_t count_before(const list *webs, const char *name)
{
    const scene_web *const *all = webs->items;
    size_t from = 0, to = webs->count;
    while (from < to) {
        size_t middle = from + (to - from) / 2;
        if (strcmp(all[middle]->name, name) < 0)
            from = middle + 1;
        else
            to = middle;
    }
    return from;
}

/* A new entry in its place among the sorted ones. */
static const scene_web *insert(scene_build *b, size_t at, const scene_web *from, lux_error *err)
{
    scene_web *made = arena_new(b->a, scene_web, err);
    if (!made || !list_new(&b->webs, b->a, const scene_web *, err))
        return NULL;
    const scene_web **all = b->webs.items;
    memmove(all + at + 1, all + at, (b->webs.count - 1 - at) * sizeof *all);
    *made          = *from;
    return all[at] = made;
}

static const luminaire_model *model_of(scene_build *b, const photometry *web, lux_error *err)
{
    const scene_measures *m  = &b->options->measures;
    table_measures by        = { .nearest = m->nearest_tables, .libm = m->libm_tables };
    const luminaire_model *l = luminaire_model_new(b->a, web, err);
    return l && (by.nearest || by.libm) ? luminaire_model_measured(b->a, l, &by, err) : l;
}

const scene_web *scene_web_of(scene_build *b, const char *name, const char *bytes, size_t size,
                              lux_error *err)
{
    size_t at                   = count_before(&b->webs, name);
    const scene_web *const *all = b->webs.items;
    if (at < b->webs.count && !strcmp(all[at]->name, name))
        return all[at];

    scene_web read = { .name = name };
    read.web       = bytes ? photometry_parse(b->a, name, bytes, size, b->notices, err)
                           : photometry_read(b->a, name, b->notices, err);
    read.model     = read.web ? model_of(b, read.web, err) : NULL;
    return read.model ? insert(b, at, &read, err) : NULL;
}

const scene_web *study_web(scene_build *b, const char *path, study_where where)
{
    lux_error why        = { 0 };
    const scene_web *web = scene_web_of(b, path, NULL, 0, &why);
    if (!web && why.code == ERR_IO) /* the study names what is not there */
        return study_failed(b->study, where, b->err, ERR_IO, "%s", why.text);
    return web ? web : failed(b->err, why.code, "%s", why.text);
}
