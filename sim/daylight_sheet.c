/* sim/daylight_sheet.c -- see daylight_sheet.h. */
#include "sim/daylight_sheet.h"

#include "core/file.h"
#include "sim/sheet.h"
#include "sim/svg.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* px, after A4 across at 96 a inch. */
static const double PAGE_WIDTH = 1120.0, PAGE_HEIGHT = 790.0, MARGIN = 40.0;
static const double HEADER = 128.0; /* title and legend, above the plans */
static const double GAP = 14.0, LABEL = 36.0, DATE_WIDTH = 92.0;
static const double LEAST_WIDTH = 56.0, MOST_WIDTH = 400.0, LEAST_HEIGHT = 14.0;
static const char *const INK = "#202020", *const PALE = "#606060";

/* A time of the day that some date of the series has; what clocks show twice has two. */
typedef struct slot {
    double second;
    int repeat;
} slot;

/* Where the plans stand: `columns` of them beside each other, below each other in rows. */
typedef struct sheet_layout {
    int columns, rows;
    bool by_date; /* a row a date, a column a slot; else one after the other */
    int slots, dates;
    int every;            /* n-th date (or moment) is drawn */
    double width, height; /* of a plan */
    double sun_scale;     /* of the plan of sun, in these */
    double left;          /* where plans begin */
    double page_width, page_height;
} sheet_layout;

typedef struct sheet {
    FILE *out;
    const daylight_series *s;
    arena a;
    slot *slots;
    sheet_layout at;
    color_scale light, hours;
} sheet;

/* ---- what stands where ----------------------------------------------------------------------- */

static slot slot_of(const daylight_series *s, int h)
{
    const civil_time *t = &s->moments[h].local;
    slot it             = { 3600.0 * t->hour + 60.0 * t->minute + t->second, 0 };
    /* Times are ascending: what goes back within a date has been put back. */
    for (int i = h - 1; i >= 0 && daylight_same_date(&s->moments[i], &s->moments[h]); i--) {
        const civil_time *before = &s->moments[i].local;
        it.repeat |= 3600.0 * before->hour + 60.0 * before->minute + before->second == it.second;
    }
    return it;
}

static int by_slot(const void *left, const void *right)
{
    const slot *a = left, *b = right;
    int order = (a->second > b->second) - (a->second < b->second);
    return order ? order : a->repeat - b->repeat;
}

static bool find_slots(sheet *d, lux_error *err)
{
    const daylight_series *s = d->s;
    d->slots                 = arena_array(&d->a, slot, (size_t)s->count, err);
    if (!d->slots)
        return false;
    for (int h = 0; h < s->count; h++)
        d->slots[h] = slot_of(s, h);
    qsort(d->slots, (size_t)s->count, sizeof *d->slots, by_slot);
    for (int h = 0; h < s->count; h++)
        if (h == 0 || by_slot(&d->slots[h], &d->slots[d->at.slots - 1]) != 0)
            d->slots[d->at.slots++] = d->slots[h];
    return true;
}

static int column_of(const sheet *d, int h)
{
    slot it     = slot_of(d->s, h);
    slot *found = bsearch(&it, d->slots, (size_t)d->at.slots, sizeof it, by_slot);
    return (int)(found - d->slots);
}

static void size_plans(sheet_layout *l, double aspect)
{
    double room = PAGE_WIDTH - MARGIN - l->left - GAP * (l->columns - 1);
    l->width    = fmin(fmax(room / l->columns, LEAST_WIDTH), MOST_WIDTH);
    l->height   = fmax(l->width * aspect, LEAST_HEIGHT);
    if (l->height > MOST_WIDTH) {
        l->height = MOST_WIDTH;
        l->width  = fmax(MOST_WIDTH / aspect, LEAST_WIDTH);
    }
    l->page_width  = fmax(PAGE_WIDTH, l->left + l->columns * (l->width + GAP) - GAP + MARGIN);
    l->page_height = HEADER + l->rows * (l->height + LABEL) + MARGIN;
}

static int divided(int a, int b) { return (a + b - 1) / b; }

/* As few columns, so as large plans, as let all stand on the page. */
static void flow(sheet_layout *l, int plans, double aspect)
{
    enum { MOST_COLUMNS = 16 };
    for (l->columns = plans < 3 ? plans : 3;; l->columns++) {
        l->rows = divided(plans, l->columns);
        size_plans(l, aspect);
        if (l->page_height <= PAGE_HEIGHT || l->columns >= plans || l->columns == MOST_COLUMNS)
            return;
    }
}

static void lay_out(sheet *d)
{
    const daylight_series *s = d->s;
    sheet_layout *l          = &d->at;
    double aspect            = sheet_aspect(&s->plan);
    int sun                  = s->sun_hours != NULL;
    l->dates                 = s->dates;
    l->by_date               = s->dates > 1 && l->slots > 1;
    l->left                  = MARGIN + (l->by_date ? DATE_WIDTH : 0.0);
    l->every                 = 1;
    l->sun_scale             = 1.0;
    if (l->by_date) {
        int fit    = MOST_PLANS / l->slots > 1 ? MOST_PLANS / l->slots : 1;
        l->every   = divided(s->dates, fit);
        l->columns = l->slots;
        l->rows    = divided(s->dates, l->every) + sun;
        size_plans(l, aspect);
        l->sun_scale = l->slots > 3 && l->width < 0.5 * MOST_WIDTH ? 2.5 : 1.0;
        l->page_height += sun * (l->sun_scale - 1.0) * l->height;
    } else {
        l->every = divided(s->count, MOST_PLANS);
        flow(l, divided(s->count, l->every) + sun, aspect);
    }
}

static sheet_box box_of(const sheet_layout *l, int row, int column)
{
    return (sheet_box){ l->left + column * (l->width + GAP), HEADER + row * (l->height + LABEL),
                        l->width, l->height };
}

/* ---- what is drawn --------------------------------------------------------------------------- */

static void date_text(char out[16], const moment *m)
{
    snprintf(out, 16, "%.10s", m->text); /* empty where nothing depends on the time */
}

static void draw_label(const sheet *d, const sheet_box *b, const char *above, const char *below)
{
    double middle = b->x + 0.5 * b->width, y = b->y + b->height;
    sheet_write(d->out, &(sheet_text){ middle, y + 14.0, 12.0, INK, true, true }, "%s", above);
    sheet_write(d->out, &(sheet_text){ middle, y + 27.0, 10.5, PALE, true, false }, "%s", below);
}

/* "10:00"; where clocks are put back the second one is told by its offset. */
static void time_text(char out[24], const sheet *d, int h)
{
    const moment *m = &d->s->moments[h];
    if (!d->at.by_date && d->s->dates > 1)
        date_text(out, m);
    else if (!m->text[0])
        out[0] = '\0';
    else
        snprintf(out, 24, "%.5s%s", m->text + 11, slot_of(d->s, h).repeat ? " (2nd)" : "");
}

static void draw_moment(const sheet *d, int h, int row, int column)
{
    const daylight_series *s  = d->s;
    const moment *m           = &s->moments[h];
    const daylight_figures *f = &s->of[h];
    sheet_box b               = box_of(&d->at, row, column);
    char above[24], below[48];
    time_text(above, d, h);
    bool down = m->sun_known && m->sun.apparent_elevation_deg < 0.0;
    if (down && f->maximum == 0.0)
        snprintf(below, sizeof below, "sun down");
    else
        snprintf(below, sizeof below, "%s%.*f lx", b.width < 72.0 ? "" : "avg ",
                 f->average < 9.95 ? 1 : 0, f->average);
    sheet_plan(d->out, &b, &s->plan, s->light[h].illuminance, &d->light);
    draw_label(d, &b, above, below);
}

static void draw_sun(const sheet *d, int row, int column)
{
    const daylight_series *s = d->s;
    sheet_box b              = box_of(&d->at, row, column);
    b.width *= d->at.sun_scale, b.height *= d->at.sun_scale;
    double sum = 0.0;
    char below[48];
    for (int k = 0; k < s->plan.sensor_count; k++)
        sum += s->sun_hours[k] / s->plan.sensor_count;
    snprintf(below, sizeof below, "avg %.1f h%s", sum, s->dates > 1 ? " a day" : "");
    sheet_plan(d->out, &b, &s->plan, s->sun_hours, &d->hours);
    draw_label(d, &b, "direct sun", below);
}

static void draw_plans(const sheet *d)
{
    const daylight_series *s = d->s;
    int date = -1, last = 0;
    for (int h = 0; h < s->count; h++) {
        bool first = h == 0 || !daylight_same_date(&s->moments[h - 1], &s->moments[h]);
        date += first;
        int counted = d->at.by_date ? date : h;
        if (counted % d->at.every)
            continue;
        last = counted / d->at.every;
        if (!d->at.by_date) {
            draw_moment(d, h, last / d->at.columns, last % d->at.columns);
            continue;
        }
        draw_moment(d, h, last, column_of(d, h));
        sheet_box b = box_of(&d->at, last, 0);
        char text[16];
        date_text(text, &s->moments[h]);
        if (first)
            sheet_write(d->out,
                        &(sheet_text){ MARGIN, b.y + 0.5 * b.height + 5.0, 13.0, INK, false, true },
                        "%s", text);
    }
    last++;
    if (s->sun_hours && d->at.by_date)
        draw_sun(d, last, 0);
    else if (s->sun_hours)
        draw_sun(d, last / d->at.columns, last % d->at.columns);
}

static void draw_header(const sheet *d)
{
    const daylight_series *s = d->s;
    char first[16], last[16];
    date_text(first, &s->moments[0]);
    date_text(last, &s->moments[s->count - 1]);
    sheet_write(d->out, &(sheet_text){ MARGIN, 44.0, 20.0, INK, false, true }, "%s%s%s%s%s",
                s->plan.grid->name, first[0] ? ", " : "", first, s->dates > 1 ? " to " : "",
                s->dates > 1 ? last : "");
    sheet_text line   = { MARGIN, 63.0, 12.0, PALE, false, false };
    char left_out[64] = "";
    if (d->at.every > 1)
        snprintf(left_out, sizeof left_out, "; one %s of %d is drawn",
                 d->at.by_date || s->dates > 1 ? "date" : "time", d->at.every);
    sheet_write(d->out, &line, "%s, %d sensor%s%s%s%s%s",
                grid_quantity_name(s->plan.grid->quantity), s->plan.sensor_count,
                s->plan.sensor_count > 1 ? "s" : "", s->under[0] ? "; " : "", s->under, left_out,
                s->end == RUN_INTERRUPTED ? "; partial: interrupted" : "");
    double room = PAGE_WIDTH - 2.0 * MARGIN;
    sheet_legend(d->out, MARGIN + 8.0, 80.0, 0.5 * room, &d->light, "lx");
    if (s->sun_hours)
        sheet_legend(d->out, MARGIN + 0.64 * room, 80.0, 0.22 * room, &d->hours,
                     s->dates > 1 ? "hours of sun a day" : "hours of sun");
    sheet_north(d->out, d->at.page_width - MARGIN - 16.0, 44.0, &s->plan, s->north_deg);
}

static bool draw(sheet *d, lux_error *err)
{
    const daylight_series *s = d->s;
    if (!find_slots(d, err))
        return false;
    double least = HUGE_VAL, most = 0.0, longest = 0.0;
    for (int h = 0; h < s->count; h++) {
        least = fmin(least, s->of[h].minimum);
        most  = fmax(most, s->of[h].maximum);
    }
    for (int k = 0; s->sun_hours && k < s->plan.sensor_count; k++)
        longest = fmax(longest, s->sun_hours[k]);
    d->light = color_scale_of(RAMP_LIGHT, least, most);
    d->hours = color_scale_even(RAMP_HOURS, longest);
    lay_out(d);
    svg_begin(d->out, d->at.page_width, d->at.page_height);
    draw_header(d);
    draw_plans(d);
    svg_end(d->out);
    return true;
}

bool daylight_sheet_write(const char *path, const daylight_series *s, lux_error *err)
{
    output_file f;
    sheet d = { .s = s };
    if (!file_create(&f, path, err))
        return false;
    d.out     = f.stream;
    bool good = draw(&d, err);
    arena_clear(&d.a);
    if (good)
        return file_commit(&f, err);
    file_discard(&f);
    return false;
}

/* ---- the daylight factor --------------------------------------------------------------------- */

static void draw_factor(FILE *out, const daylight_factor *f, const char *under)
{
    color_scale scale = color_scale_of(RAMP_LIGHT, f->minimum, f->maximum);
    double aspect = sheet_aspect(f->plan), room = PAGE_WIDTH - 2.0 * MARGIN;
    double width = fmin(room, (PAGE_HEIGHT - HEADER - MARGIN) / aspect);
    sheet_box b  = { MARGIN, HEADER, width, fmax(width * aspect, 2.0 * LEAST_HEIGHT) };
    svg_begin(out, PAGE_WIDTH, b.y + b.height + MARGIN);
    sheet_write(out, &(sheet_text){ MARGIN, 44.0, 20.0, INK, false, true },
                "%s, daylight factor in %%", f->plan->grid->name);
    sheet_write(out, &(sheet_text){ MARGIN, 63.0, 12.0, PALE, false, false },
                "%s; average %.2f %%, median %.2f %%, minimum %.2f %%, %.0f %% of the sensors "
                "at %g %% or more%s",
                under, f->average, f->median, f->minimum, 100.0 * f->share, FACTOR_LEAST,
                f->plan->end == RUN_INTERRUPTED ? "; partial: interrupted" : "");
    sheet_legend(out, MARGIN + 8.0, 80.0, 0.5 * room, &scale, "%");
    sheet_plan(out, &b, f->plan, f->all, &scale);
    sheet_numbers(out, &b, f->plan, f->all, &scale);
    svg_end(out);
}

bool daylight_factor_sheet_write(const char *path, const daylight_factor *f, const char *under,
                                 lux_error *err)
{
    output_file to;
    if (!file_create(&to, path, err))
        return false;
    draw_factor(to.stream, f, under);
    return file_commit(&to, err);
}
