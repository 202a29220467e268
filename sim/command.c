/* sim/command.c -- see command.h. */
#include "sim/command.h"

#include "core/parallel.h"
#include "sim/accuracy.h"
#include "sim/light_maps.h"

const study *command_study(const command_context *c, lux_error *err)
{
    if (c->line->file_count != 1)
        return failed(err, ERR_ARGUMENT,
                      c->line->file_count ? "one study at a time, please"
                                          : "which study? (a .yaml file)");
    return study_read(c->a, c->line->files[0], c->line->variant, c->notices, err);
}

const scene *command_scene(const command_context *c, lux_error *err)
{
    scene_options o = { .threads = command_threads(c), .layered = c->line->groups };
    const study *s  = command_study(c, err);
    return s ? scene_new(c->a, s, &o, c->notices, err) : NULL;
}

plan_options command_plan_options(const command_context *c, bool views)
{
    const command_line *l = c->line;
    return (plan_options){ .accuracy    = l->accuracy,
                           .direct_only = l->direct_only,
                           .views       = views,
                           .no          = l->off,
                           .only        = l->only,
                           .has_only    = l->has_only,
                           .transport   = l->maps ? TRANSPORT_MAPS : l->transport,
                           .seed        = l->seed,
                           .threads     = command_threads(c),
                           .seconds     = isnan(l->seconds) ? 0.0 : l->seconds,
                           .progress    = c->progress };
}

/* What the first scene told of holds for the second. */
const scene *command_planned(const command_context *c, const study *s, const scene_options *o,
                             bool views, plan *out, lux_error *err)
{
    plan_options asked  = command_plan_options(c, views);
    const scene *all    = scene_new(c->a, s, o, c->notices, err);
    scene_options built = *o;
    if (!all || !plan_make(all, &asked, out, c->notices, err))
        return NULL;
    built.off = plan_without(out);
    built.on  = out->on;
    return built.off | built.on ? scene_new(c->a, s, &built, NULL, err) : all;
}

const scene *command_planned_scene(const command_context *c, bool views, plan *out, lux_error *err)
{
    scene_options o = { .threads = command_threads(c), .layered = c->line->groups };
    const study *s  = command_study(c, err);
    return s ? command_planned(c, s, &o, views, out, err) : NULL;
}

int command_threads(const command_context *c)
{
    return c->line->threads ? c->line->threads : parallel_processors();
}

run_options command_run_options(const command_context *c, int left)
{
    double end = c->begun + c->line->seconds;
    return (run_options){ .accuracy    = c->line->accuracy,
                          .deadline    = deadline_share(isnan(end) ? HUGE_VAL : end, left),
                          .seed        = c->line->seed,
                          .threads     = command_threads(c),
                          .direct_only = c->line->direct_only,
                          .progress    = c->progress };
}

bool command_transport_fits(const command_context *c, lux_error *err)
{
    return !c->line->maps || c->line->transport != TRANSPORT_PATH ||
           failed(err, ERR_ARGUMENT, "--save-maps: with --transport path there are no maps");
}

bool command_maps(const command_context *c, const scene *s, int runs, run_options *o,
                  const illumination_map **made, lux_error *err)
{
    o->maps = c->line->maps;
    if (o->transport != TRANSPORT_MAPS || s->by_moment || o->direct_only || !s->reflects)
        return true;
    double asked = !isnan(o->accuracy)          ? o->accuracy
                   : !isnan(s->study->accuracy) ? s->study->accuracy
                                                : GRID_DEFAULT_PERCENT / 100.0;
    if (!*made && (runs > 1 || o->maps) &&
        !light_maps_indirect(c->a, s, o, asked, made, c->notices, err))
        return false;
    o->indirect = *made;
    return true;
}

void command_grid_remarks(const grid_result *r, run_end end, int missed, double asked,
                          const char *left_to_chance)
{
    if (r->left_out)
        printf("  %d sensor%s left out: inside furniture\n", r->left_out,
               r->left_out > 1 ? "s" : "");
    if (end != RUN_DONE || missed)
        printf("  accuracy: %d of %d sensors are not within %g %%%s\n", missed, r->sensor_count,
               100.0 * asked,
               end != RUN_DONE ? " yet"
               : r->smoothed   ? ", with what maps smooth"
                               : " of all as dimmed (layers are)");
    if (r->left_out_lm > 0.0)
        printf("  left out by maps: %.3g lm\n", r->left_out_lm);
    if (left_to_chance)
        printf("  interval not valid: %s\n", left_to_chance);
}

int command_end(run_end end, const char *what, const char *name, lux_error *err)
{
    if (end == RUN_DONE)
        return EXIT_DONE;
    failed(err, end == RUN_INTERRUPTED ? ERR_INTERRUPTED : ERR_NONE, "%s %s: %s", what, name,
           run_end_text(end));
    return end == RUN_INTERRUPTED ? EXIT_INTERRUPTED : EXIT_INACCURATE;
}

bool command_check_grids(const scene *s, const output_place *o, const char *const *extensions,
                         int count, lux_error *err)
{
    const study *from = s->study;
    bool good         = true;
    for (int i = 0; i < from->grid_count && good; i++) {
        arena scratch = { 0 };
        grid_result ignored;
        good = grid_sensors(&scratch, s, &from->grids[i], &ignored, err);
        arena_clear(&scratch);
    }
    for (int i = 0; i < from->grid_count && good; i++)
        good = output_check(from, o, from->grids[i].name, extensions, count, err);
    return good;
}

int exit_code_of(const lux_error *err, bool reading)
{
    switch (err->code) {
    case ERR_INTERRUPTED:
        return EXIT_INTERRUPTED;
    case ERR_MEMORY:
        return EXIT_RUNTIME;
    case ERR_IO:
        return reading ? EXIT_INPUT : EXIT_RUNTIME;
    default:
        return EXIT_INPUT;
    }
}

/* Bytes that go on with a character of UTF-8 take no column. */
static bool begins_character(char c) { return ((unsigned char)c & 0xc0) != 0x80; }

static int characters(const char *text)
{
    int count = 0;
    for (; *text; text++)
        count += begins_character(*text);
    return count;
}

void print_words(FILE *to, const char *text, int width, int most)
{
    int all = characters(text), shown = 0;
    int cut = all > most ? most - 3 : all; /* ... */
    for (const char *c = text; *c; c++) {
        shown += begins_character(*c);
        if (shown <= cut)
            putc((unsigned char)*c < 0x20 || *c == 0x7f ? '?' : *c, to);
    }
    if (all > most)
        fputs("...", to);
    for (int i = all > most ? most : all; i < width; i++)
        putc(' ', to);
}

int print_width(const char *text, int so_far)
{
    enum { LEAST = 16, MOST = 40 };
    int wanted = characters(text);
    wanted     = wanted < MOST ? wanted : MOST;
    wanted     = wanted > LEAST ? wanted : LEAST;
    return wanted > so_far ? wanted : so_far;
}

void json_string(FILE *to, const char *text)
{
    putc('"', to);
    for (const unsigned char *c = (const unsigned char *)text; *c; c++) {
        if (*c == '"' || *c == '\\')
            fprintf(to, "\\%c", *c);
        else if (*c < 0x20)
            fprintf(to, "\\u%04x", *c);
        else
            putc(*c, to);
    }
    putc('"', to);
}

void json_number(FILE *to, double value)
{
    if (isfinite(value))
        fprintf(to, "%.9g", value);
    else
        fputs("null", to);
}

void json_field(const char *name, double value)
{
    printf(",\"%s\":", name);
    json_number(stdout, value);
}

void json_field_text(const char *name, const char *value)
{
    printf(",\"%s\":", name);
    json_string(stdout, value);
}
