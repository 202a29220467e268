/* sim/daylight_print.c -- see daylight_print.h. */
#include "sim/daylight_print.h"

#include "sim/command.h"

#include <limits.h>
#include <math.h>

typedef struct sun_range {
    double average, minimum, maximum; /* h */
} sun_range;

static sun_range range_of(const daylight_series *s)
{
    sun_range r = { .minimum = HUGE_VAL };
    for (int k = 0; k < s->plan.sensor_count; k++) {
        r.average += s->sun_hours[k] / s->plan.sensor_count;
        r.minimum = fmin(r.minimum, s->sun_hours[k]);
        r.maximum = fmax(r.maximum, s->sun_hours[k]);
    }
    return r;
}

/* ---- tables ---------------------------------------------------------------------------------- */

static void print_moment(const daylight_series *s, int h)
{
    const moment *m           = &s->moments[h];
    const daylight_figures *f = &s->of[h];
    printf("  %-25s", m->text[0] ? m->text : "(at any time)");
    if (m->sun_known)
        printf(" %7.2f %9.2f", m->sun.azimuth_deg, m->sun.elevation_deg);
    else
        printf(" %7s %9s", "-", "-");
    printf(" %11.1f %11.1f %11.1f %8.3f %7.1f %12.2f\n", f->average, f->minimum, f->maximum,
           f->uniformity, 100.0 * f->sun, 100.0 * f->worst_half_width);
}

void daylight_print(const daylight_series *s)
{
    int sensors = s->plan.sensor_count;
    printf("%s: %d sensor%s, %d of %d moments", s->plan.grid->name, sensors, sensors > 1 ? "s" : "",
           s->count, s->wanted);
    if (s->plan.grid->quantity != QUANTITY_PLANAR)
        printf(", %s", grid_quantity_name(s->plan.grid->quantity));
    printf("\n  %-25s %7s %9s %11s %11s %11s %8s %7s %12s\n", "time", "azimuth", "elevation",
           "average/lx", "minimum/lx", "maximum/lx", "min/avg", "sun/%", "half-width/%");
    for (int h = 0; h < s->count; h++)
        print_moment(s, h);
    if (s->sun_hours) {
        sun_range r = range_of(s);
        printf("  direct sun: %.2f h%s on average, %.2f to %.2f h\n", r.average,
               s->dates > 1 ? " a day" : "", r.minimum, r.maximum);
    }
    command_grid_remarks(&s->plan, s->end, s->missed, s->asked, s->left_to_chance);
}

void daylight_factor_print(const daylight_factor *f, bool first, int name_width)
{
    const grid_result *r = f->plan;
    if (first) {
        print_words(stdout, "grid", name_width, INT_MAX);
        printf(" %8s %9s %9s %9s %9s %9s %8s %12s\n", "sensors", "average/%", "median/%",
               "minimum/%", "maximum/%", ">=2%/%", "min/avg", "half-width/%");
    }
    print_words(stdout, r->grid->name, name_width, INT_MAX);
    printf(" %8d %9.3f %9.3f %9.3f %9.3f %9.1f %8.3f %12.2f\n", r->sensor_count, f->average,
           f->median, f->minimum, f->maximum, 100.0 * f->share, f->uniformity,
           100.0 * r->worst_half_width);
    printf("  of the average: sky %.3f %%, reflected outside %.3f %%, reflected inside %.3f %%\n",
           f->average_sky, f->average_external, f->average_internal);
    command_grid_remarks(r, r->end, r->missed, r->asked, r->left_to_chance);
}

/* ---- JSON ------------------------------------------------------------------------------------ */

static void begin_grid(const grid_result *r, bool first)
{
    fputs(first ? "{\"grids\":[{\"name\":" : ",{\"name\":", stdout);
    json_string(stdout, r->grid->name);
    json_field_text("quantity", grid_quantity_name(r->grid->quantity));
    json_field("sensors", r->sensor_count);
    if (r->left_out)
        json_field("sensors_left_out", r->left_out);
}

static void end_grid(run_end end, int missed)
{
    json_field("sensors_missed", missed);
    if (end == RUN_INTERRUPTED)
        fputs(",\"partial\":true", stdout);
    putchar('}');
}

static void json_moment(const daylight_series *s, int h)
{
    const moment *m           = &s->moments[h];
    const daylight_figures *f = &s->of[h];
    double none               = (double)NAN; /* null */
    fputs(h ? ",{\"time\":" : "{\"time\":", stdout);
    if (m->text[0])
        json_string(stdout, m->text);
    else
        fputs("null", stdout);
    json_field("sun_azimuth_deg", m->sun_known ? m->sun.azimuth_deg : none);
    json_field("sun_elevation_deg", m->sun_known ? m->sun.elevation_deg : none);
    json_field("sun_apparent_elevation_deg", m->sun_known ? m->sun.apparent_elevation_deg : none);
    json_field("average_lx", f->average);
    json_field("minimum_lx", f->minimum);
    json_field("maximum_lx", f->maximum);
    json_field("uniformity", f->uniformity);
    json_field("average_half_width_lx", f->average_half_width);
    json_field("worst_half_width_percent", 100.0 * f->worst_half_width);
    json_field("direct_sun_percent", 100.0 * f->sun);
    putchar('}');
}

void daylight_print_json(const daylight_series *s, bool first)
{
    begin_grid(&s->plan, first);
    fputs(",\"moments\":[", stdout);
    for (int h = 0; h < s->count; h++)
        json_moment(s, h);
    putchar(']');
    if (s->sun_hours) {
        sun_range r = range_of(s);
        fputs(",\"sun_hours\":{\"dates\":", stdout);
        json_number(stdout, s->dates);
        json_field("average_h", r.average);
        json_field("minimum_h", r.minimum);
        json_field("maximum_h", r.maximum);
        putchar('}');
    }
    end_grid(s->end, s->missed);
}

void daylight_factor_print_json(const daylight_factor *f, bool first)
{
    const grid_result *r = f->plan;
    begin_grid(r, first);
    json_field("average_percent", f->average);
    json_field("median_percent", f->median);
    json_field("minimum_percent", f->minimum);
    json_field("maximum_percent", f->maximum);
    json_field("share_at_2_percent", f->share);
    json_field("uniformity", f->uniformity);
    json_field("average_sky_percent", f->average_sky);
    json_field("average_external_percent", f->average_external);
    json_field("average_internal_percent", f->average_internal);
    json_field("average_half_width_percent", f->average_half_width);
    json_field("worst_half_width_percent", 100.0 * r->worst_half_width);
    end_grid(r->end, r->missed);
}
