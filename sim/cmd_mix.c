/* sim/cmd_mix.c -- lux4 mix: the group layers of a result in other proportions, without a run. */
#define _GNU_SOURCE
#include "core/file.h"
#include "sim/command.h"
#include "sim/mix.h"
#include "sim/render.h"

#include <string.h>
#include <strings.h>
#include <sys/stat.h>

/* The files to write; NULL: none. */
typedef struct mix_outputs {
    const char *table, *exr, *png;
} mix_outputs;

static bool ends_in(const char *path, const char *extension)
{
    size_t length = strlen(path), end = strlen(extension);
    return length > end && !strcasecmp(path + length - end, extension);
}

/* PATH less its last four characters, `.exr` or the like, with another end. */
static char *renamed(arena *a, const char *path, const char *end, lux_error *err)
{
    size_t kept = strlen(path) - 4, room = kept + strlen(end) + 1;
    char *name = arena_array(a, char, room, err);
    if (name)
        snprintf(name, room, "%.*s%s", (int)kept, path, end);
    return name;
}

static bool may_write(const command_context *c, const mix *m, const char *path, lux_error *err)
{
    struct stat there, from;
    if (!path || stat(path, &there) != 0)
        return true;
    if (stat(m->path, &from) == 0 && from.st_dev == there.st_dev && from.st_ino == there.st_ino)
        return failed(err, ERR_ARGUMENT, "%s: is what is mixed; -o names another file", path);
    if (!S_ISREG(there.st_mode))
        return failed(err, ERR_ARGUMENT, "%s: is in the way of the result, and no plain file",
                      path);
    return c->line->place.overwrite ||
           failed(err, ERR_ARGUMENT,
                  "%s: is there already: --overwrite replaces it, -o FILE names another", path);
}

static bool choose_outputs(const command_context *c, const mix *m, mix_outputs *to, lux_error *err)
{
    bool csv = m->kind == MIX_GRID_CSV, view = m->kind == MIX_VIEW_EXR;
    const char *path = c->line->place.folder;
    *to              = (mix_outputs){ 0 };
    if (!path)
        path = renamed(c->a, m->path, csv ? "-mix.csv" : "-mix.exr", err);
    if (!path)
        return false;
    if (csv && ends_in(path, ".csv"))
        to->table = path;
    else if (!csv && ends_in(path, ".exr"))
        to->exr = path;
    else if (view && ends_in(path, ".png"))
        to->png = path;
    else
        return failed(err, ERR_ARGUMENT, "-o %s: expected a name that ends in %s", path,
                      csv    ? ".csv, as that of what is mixed"
                      : view ? ".exr, as that of what is mixed, or in .png"
                             : ".exr, as that of what is mixed");
    if (view && to->exr && !(to->png = renamed(c->a, path, ".png", err)))
        return false;
    return may_write(c, m, to->table, err) && may_write(c, m, to->exr, err) &&
           may_write(c, m, to->png, err);
}

static bool write_preview(const command_context *c, const image *im, const char *path,
                          lux_error *err)
{
    static const char *const names[3] = { "R", "G", "B" };
    view_result r                     = { .width = im->width, .height = im->height };
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < im->channel_count; i++)
            if (!strcmp(im->channels[i].name, names[k]))
                r.radiance[k] = im->channels[i].values;
    return view_write_png(path, &r, c->line->exposure_ev, err);
}

static bool write_outputs(const command_context *c, const mix *m, const mix_outputs *to,
                          double *average_lx, lux_error *err)
{
    image im;
    if (to->table)
        return mix_write_csv(m, to->table, average_lx, c->notices, err);
    if (!mix_image(m, c->a, &im, average_lx, err))
        return false;
    return (!to->exr || image_write_exr(to->exr, &im, c->line->half, c->notices, err)) &&
           (!to->png || write_preview(c, &im, to->png, err));
}

static void print_json(const mix *m, const char *file, const char *png, double average_lx)
{
    fputs("{\"file\":", stdout);
    json_string(stdout, file);
    if (png && png != file) {
        fputs(",\"png\":", stdout);
        json_string(stdout, png);
    }
    for (int g = 0; g < m->group_count; g++) {
        fputs(g ? ",{\"name\":" : ",\"groups\":[{\"name\":", stdout);
        json_string(stdout, m->groups[g].name);
        fputs(",\"factor\":", stdout);
        json_number(stdout, m->groups[g].factor);
        putchar('}');
    }
    putchar(']');
    if (m->kind != MIX_VIEW_EXR) {
        fputs(",\"average_lx\":", stdout);
        json_number(stdout, average_lx);
    }
    puts("}");
}

static void print_table(const mix *m, const char *file, const char *png, double average_lx)
{
    printf("%-16s %11s\n", "group", "factor");
    for (int g = 0; g < m->group_count; g++)
        printf("%-16s %11.6g\n", m->groups[g].name, m->groups[g].factor);
    if (m->kind != MIX_VIEW_EXR)
        printf("  average: %.6g lx\n", average_lx);
    printf("  written: %s%s%s\n", file, png && png != file ? ", " : "",
           png && png != file ? png : "");
}

static bool read_words(const command_context *c, mix *m, lux_error *err)
{
    const command_line *l = c->line;
    if (l->file_count == 0)
        return failed(err, ERR_ARGUMENT, "which result? (an .exr or .csv of a run with --groups)");
    if (!mix_read(c->a, l->files[0], m, err))
        return false;
    for (int i = 1; i < l->file_count; i++) {
        size_t name = strcspn(l->files[i], "=") + 1;
        for (int k = 1; k < i; k++)
            if (!strncmp(l->files[i], l->files[k], name))
                return failed(err, ERR_ARGUMENT, "%.80s: the group has a factor already: %.80s",
                              l->files[i], l->files[k]);
        if (!mix_set(m, l->files[i], err))
            return false;
    }
    return true;
}

static int mix_command(const command_context *c, lux_error *err)
{
    mix m;
    mix_outputs to;
    double average_lx;
    if (!read_words(c, &m, err) || !choose_outputs(c, &m, &to, err))
        return exit_code_of(err, true);
    if (!write_outputs(c, &m, &to, &average_lx, err))
        return exit_code_of(err, false);
    const char *file = to.table ? to.table : to.exr ? to.exr : to.png;
    (c->line->json ? print_json : print_table)(&m, file, to.png, average_lx);
    return EXIT_DONE;
}

const command command_mix = {
    .name    = "mix",
    .files   = "RESULT GROUP=FACTOR...",
    .summary = "the groups of a result (.exr, .csv) dimmed otherwise, without a new run",
    .help =
        "    lux4 mix office.exr general=0.5 sky=1 -o evening.exr\n\n"
        "RESULT is a grid's .csv or .exr, or a view's .exr, of a run with --groups. Its layers\n"
        "are undimmed, maintenance applied; groups that are not named count in full (1). The\n"
        "layers are kept, so that a mixture can be mixed again. Half widths are added: that of\n"
        "a mixture is at most their sum. From a .csv, direct and indirect light and half widths\n"
        "cannot be told: they are left out. With a view's .exr goes its .png.\n",
    .output      = "FILE",
    .output_help = "the result (default: RESULT's name with -mix, beside it)",
    .options     = " -o --overwrite --half --exposure --json --quiet ",
    .run         = mix_command,
};
