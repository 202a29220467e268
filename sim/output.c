/* sim/output.c -- see output.h. */
#define _GNU_SOURCE
#include "sim/output.h"

#include "core/file.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

const char *output_study_name(const study *s)
{
    const char *slash = strrchr(s->path, '/');
    return slash ? slash + 1 : s->path;
}

int output_attributes(image_attribute all[MOST_ATTRIBUTES], char date[CAP_DATE], const study *s,
                      const moment *m, bool partial)
{
    int count = 0;
    while (count < MOST_OWN_ATTRIBUTES && all[count].name)
        count++;
    count += daylight_attributes(all + count, date, s, m);
    if (s->variant)
        all[count++] = (image_attribute){ "lux4:variant", ATTRIBUTE_STRING, s->variant, 0 };
    if (partial)
        all[count++] = (image_attribute){ "lux4:partial", ATTRIBUTE_STRING, "interrupted", 0 };
    return count;
}

bool output_free(const char *path, bool overwrite, lux_error *err)
{
    if (!path || overwrite || access(path, F_OK) != 0)
        return true;
    return failed(err, ERR_ARGUMENT, "%s: is there already; --overwrite replaces it", path);
}

static char *join(arena *a, const char *folder, const char *name, const char *extension,
                  lux_error *err)
{
    size_t bytes = strlen(folder) + strlen(name) + strlen(extension) + 3;
    char *path   = arena_array(a, char, bytes, err);
    if (path)
        snprintf(path, bytes, "%s%s%s%s", folder, name[0] ? "/" : "", name, extension);
    return path;
}

static const char *folder_of(arena *a, const study *s, const output_place *o, lux_error *err)
{
    return o->folder ? o->folder : join(a, s->folder, "out", "", err);
}

char *output_path(arena *a, const study *s, const output_place *o, const char *name,
                  const char *extension, lux_error *err)
{
    const char *folder = folder_of(a, s, o, err);
    return folder ? join(a, folder, name, extension, err) : NULL;
}

/* Whether the EXR at path says that this study made it. */
static bool made_by(arena *a, const char *path, const study *s)
{
    image im;
    if (!image_read_exr_part(path, 0, a, &im, NULL))
        return false;
    for (int i = 0; i < im.attribute_count; i++) {
        const image_attribute *at = &im.attributes[i];
        if (at->type == ATTRIBUTE_STRING && !strcmp(at->name, "lux4:study"))
            return !strcmp(at->text, output_study_name(s));
    }
    return false;
}

static bool check(arena *a, const study *s, const output_place *o, const char *name,
                  const char *const *extensions, int count, lux_error *err)
{
    const char *folder = folder_of(a, s, o, err), *exr = output_path(a, s, o, name, ".exr", err);
    if (!folder || !exr)
        return false;
    lux_error why = { 0 };
    if (!folder_make(folder, &why))
        return failed(err, why.code == ERR_MEMORY ? ERR_MEMORY : ERR_ARGUMENT, "%s", why.text);
    char text[128];
    if (access(folder, W_OK | X_OK) != 0)
        return failed(err, ERR_ARGUMENT, "%s: cannot write into this folder: %s", folder,
                      strerror_r(errno, text, sizeof text));
    for (int i = 0; i < count; i++) {
        struct stat st;
        const char *path = output_path(a, s, o, name, extensions[i], err);
        if (!path)
            return false;
        if (stat(path, &st) != 0)
            continue;
        if (!S_ISREG(st.st_mode))
            return failed(err, ERR_ARGUMENT, "%s: is in the way of a result, and no plain file",
                          path);
        if (!o->overwrite && !(!o->folder && made_by(a, exr, s)))
            return failed(err, ERR_ARGUMENT,
                          "%s: is there already: --overwrite replaces it, -o "
                          "puts the results elsewhere",
                          path);
    }
    return true;
}

bool output_check(const study *s, const output_place *o, const char *name,
                  const char *const *extensions, int count, lux_error *err)
{
    arena scratch = { 0 };
    bool good     = check(&scratch, s, o, name, extensions, count, err);
    arena_clear(&scratch);
    return good;
}
