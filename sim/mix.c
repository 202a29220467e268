/* sim/mix.c -- see mix.h: groups and their factors. */
#include "sim/mix.h"

#include "core/text.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

int mix_group_add(arena *a, mix *m, const char *name, size_t length, lux_error *err)
{
    for (int i = 0; i < m->group_count; i++)
        if (strlen(m->groups[i].name) == length && !strncmp(m->groups[i].name, name, length))
            return i;
    char *copy = arena_array(a, char, length + 1, err);
    if (!copy)
        return -1;
    memcpy(copy, name, length);
    for (char *c = copy; *c; c++) /* messages are to stay one line */
        if ((unsigned char)*c < ' ')
            *c = '?';
    m->groups[m->group_count] = (mix_group){ .name = copy, .factor = 1.0 };
    return m->group_count++;
}

bool mix_read(arena *a, const char *path, mix *m, lux_error *err)
{
    const char *dot = strrchr(path, '.');
    bool csv = dot && !strcasecmp(dot, ".csv"), exr = dot && !strcasecmp(dot, ".exr");
    *m = (mix){ .path = path };
    if (!csv && !exr)
        return failed(err, ERR_ARGUMENT, "%s: expected a result of a run: .exr or .csv", path);
    if (csv ? !mix_read_csv(a, m, err) : !mix_read_exr(a, m, err))
        return false;
    return m->group_count > 0 ||
           failed(err, ERR_ARGUMENT, "%s: no group layers in it: run lux4 with --groups", path);
}

static void *unknown_group(const mix *m, const char *name, lux_error *err)
{
    const char *nearest = m->groups[0].name;
    int best            = INT_MAX;
    char all[200]       = "";
    for (int i = 0; i < m->group_count; i++) {
        int distance = text_distance(name, m->groups[i].name);
        if (distance < best)
            best = distance, nearest = m->groups[i].name;
        size_t used = strlen(all);
        snprintf(all + used, sizeof all - used, "%s%s", i ? ", " : "", m->groups[i].name);
    }
    return failed(err, ERR_ARGUMENT, "%.100s: no group `%.40s`: did you mean `%.40s`? It has: %s",
                  m->path, name, nearest, all);
}

bool mix_set(mix *m, const char *word, lux_error *err)
{
    const char *equals = strchr(word, '='), *end;
    if (!equals || equals == word)
        return failed(err, ERR_ARGUMENT, "%.80s: expected GROUP=FACTOR, for instance general=0.5",
                      word);
    char name[256];
    snprintf(name, sizeof name, "%.*s", (int)(equals - word), word);
    int g = 0;
    while (g < m->group_count && strcmp(m->groups[g].name, name) != 0)
        g++;
    if (g == m->group_count)
        return unknown_group(m, name, err);
    double factor;
    if (!text_number(equals + 1, &end, &factor) || *end || !(factor >= 0.0 && factor <= 1e12))
        return failed(err, ERR_ARGUMENT, "%.80s: expected a factor, 0 or more, behind the =", word);
    m->groups[g].factor = factor;
    return true;
}
