/* sim/schedule_print.c -- the schedule as a table and as JSON: schedule.h. */
#include "sim/command.h"
#include "sim/schedule.h"

#include <limits.h>

enum { MAKER = 32 }; /* characters at most */

static double efficacy_of(const schedule_row *r)
{
    double watts = r->first->watts;
    return watts > 0.0 && isfinite(r->lumens) ? r->lumens / watts : (double)NAN;
}

/* ---- as a table ------------------------------------------------------------------------------ */

/* A figure, or a dash for one that is not known. */
static void cell(FILE *to, int width, int digits, double value)
{
    if (isfinite(value))
        fprintf(to, " %*.*f", width, digits, value);
    else
        fprintf(to, " %*s", width, isinf(value) ? "far away" : "-");
}

static int width_of_names(const schedule *c)
{
    int width = print_width("as dimmed", 0);
    for (int i = 0; i < c->row_count; i++)
        width = print_width(c->rows[i].first->name, width);
    return width;
}

/* Who makes it, and its number there, as the file says. */
static void print_maker(FILE *to, const photometry *web)
{
    const char *maker = web && web->manufacturer ? web->manufacturer : "";
    const char *what  = web && web->catalog ? web->catalog : "";
    if (maker[0] || what[0])
        fputs("  ", to);
    print_words(to, maker, 0, MAKER);
    if (maker[0] && what[0])
        fputs(", ", to);
    print_words(to, what, 0, MAKER);
}

static void print_row(FILE *to, const schedule_row *r, int width)
{
    double watts = r->first->watts;
    print_words(to, r->first->name, width, INT_MAX);
    fprintf(to, " %7d", r->count);
    cell(to, 11, 1, r->lumens);
    cell(to, 9, 1, watts);
    cell(to, 7, 1, efficacy_of(r));
    fprintf(to, " %8.4g", r->first->dimmed_to);
    cell(to, 12, 1, isfinite(r->lumens) ? r->count * r->lumens : (double)NAN);
    cell(to, 10, 1, r->count * watts);
    print_maker(to, r->first->web);
    fputc('\n', to);
}

static void print_totals(FILE *to, const schedule *c, int width)
{
    print_words(to, "all", width, INT_MAX);
    fprintf(to, " %7d %11s %9s", c->count, "", "");
    cell(to, 7, 1, c->efficacy);
    fprintf(to, " %8s", "");
    cell(to, 12, 1, c->lumens);
    cell(to, 10, 1, c->watts);
    fputc('\n', to);
    if (c->dimmed) {
        print_words(to, "as dimmed", width, INT_MAX);
        fprintf(to, " %7s %11s %9s %7s %8s", "", "", "", "", "");
        cell(to, 12, 1, c->dimmed_lumens);
        cell(to, 10, 1, c->dimmed_watts);
        fputs(isnan(c->watts) ? "\n" : "  watts in proportion to light\n", to);
    }
    if (c->unrated)
        fprintf(to, "  %d of %d luminaire%s without watts: left out of all W and all lm/W\n",
                c->unrated, c->count, c->count > 1 ? "s" : "");
}

static void print_load(FILE *to, const schedule *c, const schedule_load *full,
                       const schedule_load *dimmed)
{
    cell(to, 9, 2, full->area);
    cell(to, 11, 1, full->average);
    cell(to, 9, 2, full->density);
    cell(to, 15, 3, full->per_100_lux);
    if (c->dimmed)
        cell(to, 11, 3, dimmed->per_100_lux);
    fputc('\n', to);
}

static void print_loads(FILE *to, const scene *s, const schedule *c, const double *averages)
{
    const study_grid *grids = s->study->grids;
    int count = s->study->grid_count, width = print_width("grid", 0);
    bool headed = false;
    for (int i = 0; i < count; i++)
        width = print_width(grids[i].name, width);
    if (isnan(c->floor))
        fprintf(to, "connected load %.1f W, on each grid's own area: there is no `room`\n",
                c->watts);
    else
        fprintf(to, "connected load %.1f W, on %s of %.2f m2: %.2f W/m2\n", c->watts,
                c->of_model ? "the ground that the model covers, its box" : "the room's floor",
                c->floor, c->watts / c->floor);
    for (int i = 0; i < count; i++) {
        schedule_load full, dimmed;
        if (!schedule_load_of(c, c->watts, &grids[i], averages[i], &full) ||
            !schedule_load_of(c, c->dimmed_watts, &grids[i], averages[i], &dimmed))
            continue;
        if (!headed) {
            print_words(to, "grid", width, INT_MAX);
            fprintf(to, " %9s %11s %9s %15s%s\n", "area/m2", "average/lx", "W/m2", "W/m2 per 100lx",
                    c->dimmed ? "   as dimmed" : "");
        }
        headed = true;
        print_words(to, grids[i].name, width, INT_MAX);
        print_load(to, c, &full, &dimmed);
    }
}

void schedule_print(FILE *to, const scene *s, const schedule *c, const double *averages)
{
    int width = width_of_names(c);
    fputc('\n', to);
    print_words(to, "luminaire", width, INT_MAX);
    fprintf(to, " %7s %11s %9s %7s %8s %12s %10s\n", "number", "each/lm", "each/W", "lm/W",
            "dimming", "all/lm", "all/W");
    for (int i = 0; i < c->row_count; i++)
        print_row(to, &c->rows[i], width);
    print_totals(to, c, width);
    if (s->emitter_count)
        fprintf(to, "  glowing surfaces, of no known watts, give another %.1f lm\n",
                scene_glow_lumens(s));
    if (!isnan(c->watts))
        print_loads(to, s, c, averages);
    fputc('\n', to);
}

/* ---- as JSON --------------------------------------------------------------------------------- */

static void field(FILE *to, const char *name, double value)
{
    fprintf(to, ",\"%s\":", name);
    json_number(to, value);
}

static void text_field(FILE *to, const char *name, const char *text)
{
    fprintf(to, ",\"%s\":", name);
    json_string(to, text ? text : "");
}

static void row_json(FILE *to, const schedule_row *r)
{
    double dimming = r->first->dimmed_to;
    fputs("{\"name\":", to);
    json_string(to, r->first->name);
    if (r->first->web) {
        text_field(to, "manufacturer", r->first->web->manufacturer);
        text_field(to, "catalog", r->first->web->catalog);
    }
    field(to, "count", r->count);
    field(to, "lumens_each", r->lumens);
    field(to, "watts_each", r->first->watts);
    field(to, "efficacy_lm_w", efficacy_of(r));
    field(to, "dimming", dimming);
    field(to, "lumens", r->count * r->lumens);
    field(to, "watts", r->count * r->first->watts);
    fputc('}', to);
}

void schedule_print_json(FILE *to, const scene *s, const schedule *c, const double *averages)
{
    fputs("{\"rows\":[", to);
    for (int i = 0; i < c->row_count; i++) {
        fputs(i ? "," : "", to);
        row_json(to, &c->rows[i]);
    }
    fputc(']', to);
    field(to, "count", c->count);
    field(to, "without_watts", c->unrated);
    field(to, "lumens", c->lumens);
    field(to, "watts", c->watts);
    field(to, "efficacy_lm_w", c->efficacy);
    field(to, "dimmed_lumens", c->dimmed_lumens);
    field(to, "dimmed_watts", c->dimmed_watts);
    field(to, "area_m2", c->floor);
    field(to, "power_density_w_m2", c->watts / c->floor);
    fputs(",\"grids\":[", to);
    bool any = false;
    for (int i = 0; i < s->study->grid_count; i++) {
        schedule_load full, dimmed;
        if (!schedule_load_of(c, c->watts, &s->study->grids[i], averages[i], &full) ||
            !schedule_load_of(c, c->dimmed_watts, &s->study->grids[i], averages[i], &dimmed))
            continue;
        fputs(any ? ",{\"name\":" : "{\"name\":", to);
        any = true;
        json_string(to, s->study->grids[i].name);
        field(to, "area_m2", full.area);
        field(to, "w_m2_per_100lx", full.per_100_lux);
        field(to, "dimmed_w_m2_per_100lx", dimmed.per_100_lux);
        fputc('}', to);
    }
    fputs("]}", to);
}
