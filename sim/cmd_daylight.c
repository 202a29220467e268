/* sim/cmd_daylight.c -- lux4 daylight: the study's grids through the day, or the daylight factor.
 */
#include "sim/command.h"
#include "sim/daylight.h"
#include "sim/daylight_factor.h"
#include "sim/daylight_print.h"
#include "sim/daylight_sheet.h"
#include "sim/daylight_write.h"

#include <math.h>
#include <string.h>

static const char *const series_extensions[] = { ".csv", ".exr", ".svg", "-sun.csv" };
static const char *const factor_extensions[] = { ".csv", ".exr", ".svg" };
enum { SERIES_EXTENSIONS = 4, FACTOR_EXTENSIONS = 3 };

typedef struct totals {
    plan plan; /* of the daylight factor */
    double seconds;
    int64_t rays;
    bool interval_valid;
    int printed; /* grids */
    int code;    /* EXIT_INACCURATE once a grid was */
} totals;

/* The path of one result, or NULL; *err says why. */
static const char *path_of(const command_context *c, const study *s, const study_grid *g,
                           const char *extension, lux_error *err)
{
    return output_path(c->a, s, &c->line->place, g->name, extension, err);
}

/* What all commands on grids check; and that no grid is called as another one's hours of sun. */
static bool check_places(const command_context *c, const scene *s, const char *const *extensions,
                         int count, lux_error *err)
{
    const study *from = s->study;
    for (int i = 0; i < from->grid_count && count == SERIES_EXTENSIONS; i++)
        for (int j = 0; j < from->grid_count; j++) {
            const char *name = from->grids[i].name, *other = from->grids[j].name;
            size_t length = strlen(name);
            if (!strncmp(name, other, length) && !strcmp(other + length, "-sun"))
                return study_failed(from, from->grids[j].where, err, ERR_ARGUMENT,
                                    "a grid called `%s`: so the hours of sun of grid `%s` are "
                                    "called",
                                    other, name);
        }
    return command_check_grids(s, &c->line->place, extensions, count, err);
}

static void print_end(const command_context *c, const totals *t)
{
    if (c->line->json) {
        fputs(t->printed ? "]" : "{\"grids\":[]", stdout);
        json_field("seconds", t->seconds);
        json_field("rays", (double)t->rays);
        printf(",\"interval_valid\":%s}\n", t->interval_valid ? "true" : "false");
    } else if (t->printed) {
        printf("%.2f s, %.1f million rays\n", t->seconds, 1e-6 * (double)t->rays);
    }
}

/* What a grid's run comes to: an interruption ends all, what is not accurate is remembered. */
static int end_of(run_end end, const char *name, totals *t, lux_error *err)
{
    int code = command_end(end, "grid", name, err);
    if (code == EXIT_INACCURATE)
        t->code = code;
    return code == EXIT_INACCURATE ? EXIT_DONE : code;
}

/* ---- a series -------------------------------------------------------------------------------- */

static bool is_series_asked(const command_line *l)
{
    return l->date || l->from || l->to || !isnan(l->step_min);
}

/* `when` of the study as the options change it. A single time is a series of that date and time. */
static bool when_asked(const command_line *l, const study *s, study_when *w, lux_error *err)
{
    *w = s->when;
    if (!is_series_asked(l))
        return true;
    if (!w->given && (!l->date || !l->from))
        return failed(err, ERR_ARGUMENT,
                      "%s: the study has no `when`: --date and --from are needed, and --to for "
                      "more than one time a day",
                      s->path);
    if (!w->series) {
        const civil_time *t = &s->when.at.time;
        *w = (study_when){ .where = s->when.where, .first = *t, .last = *t, .step_min = 60.0 };
        w->from_min = w->to_min = 60 * t->hour + t->minute;
    }
    w->given = w->series = true;
    if ((l->date && !when_read_dates(l->date, "--date", &w->first, &w->last, err)) ||
        (l->from && !when_read_minute(l->from, "--from", &w->from_min, err)) ||
        (l->to && !when_read_minute(l->to, "--to", &w->to_min, err)))
        return false;
    if (!isnan(l->step_min))
        w->step_min = l->step_min;
    if (l->from && !l->to && !s->when.series)
        w->to_min = w->from_min; /* once a day */
    return w->from_min <= w->to_min ||
           failed(err, ERR_ARGUMENT, "from %02d:%02d to %02d:%02d: expected the earlier time first",
                  w->from_min / 60, w->from_min % 60, w->to_min / 60, w->to_min % 60);
}

static bool write_series(const command_context *c, const study *s, const daylight_series *r,
                         lux_error *err)
{
    const study_grid *g = r->plan.grid;
    const char *csv     = path_of(c, s, g, ".csv", err);
    const char *exr     = csv ? path_of(c, s, g, ".exr", err) : NULL;
    const char *svg     = exr ? path_of(c, s, g, ".svg", err) : NULL;
    const char *sun     = svg ? path_of(c, s, g, "-sun.csv", err) : NULL;
    if (!sun || !daylight_write_csv(csv, r, err) || !daylight_write_exr(exr, s, r, err) ||
        !daylight_sheet_write(svg, r, err) || (r->sun_hours && !daylight_write_sun(sun, r, err)))
        return false;
    if (!c->line->json)
        printf("  written: %s, %s, %s%s%s\n", csv, exr, svg, r->sun_hours ? ", " : "",
               r->sun_hours ? sun : "");
    return true;
}

static bool is_dark(const daylight_series *r)
{
    double most = 0.0;
    for (int h = 0; h < r->count; h++)
        most = fmax(most, r->of[h].maximum);
    return most == 0.0;
}

static int end_series(const command_context *c, const study *s, const daylight_series *r, totals *t,
                      lux_error *err)
{
    const char *name = r->plan.grid->name;
    t->seconds += r->seconds;
    t->rays += r->rays;
    t->interval_valid &= !r->left_to_chance;
    if (r->count > 0) {
        if (c->line->json)
            daylight_print_json(r, t->printed == 0);
        else
            daylight_print(r);
        t->printed++;
        if (is_dark(r))
            notice_add(c->notices, "grid %s: no daylight arrives at any time", name);
        if (!write_series(c, s, r, err))
            return exit_code_of(err, false);
    }
    return end_of(r->end, name, t, err);
}

/* An interruption is no reason to keep what other grids have. */
static int end_all_series(const command_context *c, const daylight *d, lux_error *err)
{
    totals t = { .interval_valid = true };
    int code = EXIT_DONE;
    for (int i = 0; i < d->study->grid_count; i++) {
        int own = end_series(c, d->study, &d->series[i], &t, err);
        if (own == EXIT_RUNTIME)
            return own;
        code = code == EXIT_DONE ? own : code;
    }
    print_end(c, &t);
    return code == EXIT_DONE ? t.code : code;
}

static bool run_planned(daylight *d, const plan *p, run_options *o, lux_error *err)
{
    plan_apply(p, o);
    return daylight_run(d, o, err);
}

static int run_series(const command_context *c, const study *s, lux_error *err)
{
    study_when when;
    daylight d = { .a = c->a, .study = s, .threads = command_threads(c), .notices = c->notices };
    if (!when_asked(c->line, s, &when, err))
        return exit_code_of(err, true);
    d.moments = moments_of(c->a, s, &when, &d.moment_count, c->notices, err);
    if (!d.moments)
        return exit_code_of(err, true);

    int code             = EXIT_DONE;
    run_options o        = command_run_options(c, 1);
    plan p               = { 0 };
    plan_options planned = command_plan_options(c, false);
    planned.series       = true;
    double step_h        = when.from_min < when.to_min ? when.step_min / 60.0 : (double)NAN;
    if (!daylight_begin(&d, step_h, err) || !plan_make(d.scene, &planned, &p, c->notices, err) ||
        !daylight_plan(&d, plan_without(&p), p.on, err) ||
        !check_places(c, d.scene, series_extensions, SERIES_EXTENSIONS, err) ||
        !run_planned(&d, &p, &o, err))
        code = exit_code_of(err, true);
    daylight_end(&d);
    terminal_clear(c->terminal);
    return code == EXIT_DONE ? end_all_series(c, &d, err) : code;
}

/* ---- the daylight factor --------------------------------------------------------------------- */

static bool write_factor(const command_context *c, const study *s, const daylight_factor *f,
                         lux_error *err)
{
    const study_grid *g = f->plan->grid;
    const char *csv     = path_of(c, s, g, ".csv", err);
    const char *exr     = csv ? path_of(c, s, g, ".exr", err) : NULL;
    const char *svg     = exr ? path_of(c, s, g, ".svg", err) : NULL;
    if (!svg || !daylight_factor_write_csv(csv, f, err) ||
        !daylight_factor_write_exr(exr, s, f, err) ||
        !daylight_factor_sheet_write(svg, f, daylight_factor_sky(s), err))
        return false;
    if (!c->line->json)
        printf("  written: %s, %s, %s\n", csv, exr, svg);
    return true;
}

static int names_width(const study *s)
{
    int width = 0;
    for (int i = 0; i < s->grid_count; i++)
        width = print_width(s->grids[i].name, width);
    return width;
}

static int run_grid(const command_context *c, const scene *s, int index, totals *t, lux_error *err)
{
    arena of_grid = { 0 };
    grid_result r;
    daylight_factor f;
    run_options o = command_run_options(c, s->study->grid_count - index);
    plan_apply(&t->plan, &o);
    o.outside = true;
    int code  = EXIT_DONE;
    if (!grid_run(&of_grid, s, &s->study->grids[index], &o, &r, err) ||
        !daylight_factor_of(&of_grid, &r, &f, err))
        code = exit_code_of(err, true);
    if (code == EXIT_DONE) {
        terminal_clear(c->terminal);
        if (c->line->json)
            daylight_factor_print_json(&f, t->printed == 0);
        else
            daylight_factor_print(&f, t->printed == 0, names_width(s->study));
        t->printed++;
        t->seconds += r.seconds;
        t->rays += r.rays;
        t->interval_valid &= !r.left_to_chance;
        if (f.maximum == 0.0)
            notice_add(c->notices, "grid %s: no daylight arrives", r.grid->name);
        code = write_factor(c, s->study, &f, err) ? end_of(r.end, r.grid->name, t, err)
                                                  : exit_code_of(err, false);
    }
    arena_clear(&of_grid);
    return code;
}

static int run_factor(const command_context *c, const study *s, lux_error *err)
{
    if (is_series_asked(c->line)) {
        failed(err, ERR_ARGUMENT,
               "--factor is the same at any time: --date, --from, --to and --step have no meaning "
               "with it");
        return EXIT_INPUT;
    }
    scene_options o       = { .threads = command_threads(c), .lamps_off = true };
    const study *overcast = daylight_factor_study(c->a, s, err);
    totals t              = { .interval_valid = true };
    const scene *under    = overcast ? command_planned(c, overcast, &o, false, &t.plan, err) : NULL;
    if (!under || !check_places(c, under, factor_extensions, FACTOR_EXTENSIONS, err))
        return exit_code_of(err, true);

    int code = EXIT_DONE;
    if (!c->line->json)
        printf("daylight factor: %s\n", daylight_factor_sky(overcast));
    for (int i = 0; i < s->grid_count && code == EXIT_DONE; i++)
        code = run_grid(c, under, i, &t, err);
    print_end(c, &t);
    return code == EXIT_DONE ? t.code : code;
}

/* ---- the command ----------------------------------------------------------------------------- */

static int daylight_command(const command_context *c, lux_error *err)
{
    const study *s = command_study(c, err);
    if (!s)
        return exit_code_of(err, true);
    if (s->grid_count == 0) {
        failed(err, ERR_ARGUMENT, "%s: the study has no `grids`", s->path);
        return EXIT_INPUT;
    }
    return c->line->factor ? run_factor(c, s, err) : run_series(c, s, err);
}

const command command_daylight = {
    .name    = "daylight",
    .files   = "STUDY.yaml",
    .summary = "the study's grids through the day and the year, or the daylight factor",
    .help =
        "The series is the study's `when`, or as --date, --from, --to and --step say. Of each "
        "grid:\n"
        "  GRID.csv      time,x,y,z,nx,ny,nz,illuminance_lx,direct_lx,indirect_lx,half_width_lx\n"
        "  GRID.exr      a part a moment, named by its time: Y, direct.Y, indirect.Y, halfWidth.Y\n"
        "                in lux, sun.Y: the share of the sun's disk that is seen\n"
        "  GRID.svg      all plans in false colours, the hours under them, one legend\n"
        "  GRID-sun.csv  hours of direct sun: each moment stands for one step; over several dates\n"
        "                the mean of a day (sun_hours_per_day)\n"
        "While the sun is below the horizon, skies that follow the sun are dark: twilight is left\n"
        "out. Lamps shine as in `lux4 grid`.\n"
        "--factor: 100 E inside / E outside under the traditional overcast sky, (1 + 2 sin h)/3,\n"
        "or the study's own if that is CIE type 1 or 3; sun and lamps off. GRID.csv has the "
        "parts:\n"
        "from the sky, reflected outside (last surface `exterior` or ground), reflected inside;\n"
        "GRID.svg the plan.\n",
    .options = " -o --overwrite --date --from --to --step --factor --accuracy --time --variant "
               "--threads --seed --direct-only --transport --no --only --json --quiet ",
    .run     = daylight_command,
};
