/* sim/cost_write.c -- see cost_write.h. */
#include "sim/cost_write.h"

#include "core/file.h"
#include "sim/command.h"
#include "sim/output.h"

#include <limits.h>
#include <math.h>
#include <string.h>

/* ---- as a table ------------------------------------------------------------------------------ */

/* In a column of that many characters, a blank before it; a dash for what is not known. */
static void print_figure(FILE *to, int width, int digits, double x)
{
    char text[32];
    if (!isfinite(x))
        snprintf(text, sizeof text, "-");
    else if (fabs(x) >= pow(10.0, digits) - 0.5)
        snprintf(text, sizeof text, "%.0f", x);
    else
        snprintf(text, sizeof text, "%.*g", digits, x);
    fprintf(to, " %*s", width, text);
}

static void print_row(FILE *to, const cost_row *r, int width)
{
    print_words(to, r->setting, width, INT_MAX);
    print_figure(to, 9, 3, r->seconds);
    print_figure(to, 11, 3, 1e-6 * (double)r->rays);
    print_figure(to, 9, 2, 100.0 * r->rms);
    print_figure(to, 9, 2, 100.0 * r->worst);
    print_figure(to, 13, 2, 100.0 * r->half_width);
    if (isnan(r->seconds_for_1))
        fprintf(to, " %9s", "never");
    else
        print_figure(to, 9, 2, r->seconds_for_1);
    fprintf(to, "%s\n", r->reaches ? "  meets" : "");
}

void cost_print(FILE *to, const cost_result *r)
{
    int width = 16;
    for (int i = 0; i < r->row_count; i++)
        width = print_width(r->rows[i].setting, width);
    fprintf(to, "%s %s, accuracy %g %%: each setting %s\n", r->view ? "view" : "grid", r->what,
            100.0 * r->asked, "three times in turns, against a reference");
    fprintf(to, "  reference: --accuracy %.2g%%, half-width %.2g %% (RMS), %.3g s\n",
            100.0 * r->reference_accuracy, 100.0 * r->reference_half_width, r->reference_seconds);
    if (r->left_to_chance)
        fprintf(to, "  interval not valid: %s\n", r->left_to_chance);
    print_words(to, "setting", width, INT_MAX);
    fprintf(to, " %9s %11s %9s %9s %13s %9s\n", "seconds", "rays/10^6", "RMS/%", "worst/%",
            "half-width/%", "s for 1%");
    for (int i = 0; i < r->row_count; i++) {
        if (i && r->rows[i].ladder != r->rows[i - 1].ladder)
            fputc('\n', to);
        print_row(to, &r->rows[i], width);
    }
    if (isfinite(r->slope))
        fprintf(to, "error falls as rays^%.2f (plain Monte Carlo: rays^-0.50)\n", r->slope);
    for (int i = 0; i < r->dropped_count; i++)
        fprintf(to, "%s%s%s", i ? ", " : "left out, there was no time for them: ", r->dropped[i],
                i + 1 < r->dropped_count ? "" : "\n");
    if (r->end == RUN_LATE)
        fputs("the time was out early: some settings ran less than three times\n", to);
    fprintf(to, "%s\n", r->advice);
}

/* ---- as JSON --------------------------------------------------------------------------------- */

static void json_member(FILE *to, const char *name, double value)
{
    fprintf(to, ",\"%s\":", name);
    json_number(to, value);
}

void cost_print_json(FILE *to, const cost_result *r)
{
    fputs("{\"rows\":[", to);
    for (int i = 0; i < r->row_count; i++) {
        const cost_row *row = &r->rows[i];
        fprintf(to, "%s{\"ladder\":\"%s\",\"setting\":", i ? "," : "",
                cost_ladder_name(row->ladder));
        json_string(to, row->setting);
        json_member(to, "seconds", row->seconds);
        json_member(to, "rays", (double)row->rays);
        json_member(to, "rms_percent", 100.0 * row->rms);
        json_member(to, "worst_percent", 100.0 * row->worst);
        json_member(to, "half_width_percent", 100.0 * row->half_width);
        json_member(to, "seconds_for_1_percent", row->seconds_for_1);
        json_member(to, "bias_percent", 100.0 * row->bias);
        json_member(to, "runs", row->runs);
        fprintf(to, ",\"meets\":%s}", row->reaches ? "true" : "false");
    }
    fprintf(to, "],\"%s\":", r->view ? "view" : "grid");
    json_string(to, r->what);
    json_member(to, "accuracy_percent", 100.0 * r->asked);
    json_member(to, "slope", r->slope);
    json_member(to, "reference_half_width_percent", 100.0 * r->reference_half_width);
    json_member(to, "reference_seconds", r->reference_seconds);
    fprintf(to, ",\"interval_valid\":%s,\"dropped\":[", r->left_to_chance ? "false" : "true");
    for (int i = 0; i < r->dropped_count; i++) {
        fputs(i ? "," : "", to);
        json_string(to, r->dropped[i]);
    }
    fputs("],\"advice\":", to);
    json_string(to, r->advice);
    fprintf(to, "%s}\n", r->end == RUN_INTERRUPTED ? ",\"partial\":true" : "");
}

/* ---- as CSV ---------------------------------------------------------------------------------- */

static const char mark[] = "# lux4 cost of ";

/* Empty where a number is not known. */
static void write_figure(FILE *to, double x)
{
    fputc(',', to);
    if (isfinite(x))
        fprintf(to, "%.6g", x);
}

bool cost_write_csv(const char *path, const study *s, const cost_result *r, lux_error *err)
{
    output_file f;
    if (!file_create(&f, path, err))
        return false;
    fputs("ladder,setting,seconds,rays,rms_percent,worst_percent,half_width_percent,"
          "seconds_for_1_percent,bias_percent,runs\n",
          f.stream);
    for (int i = 0; i < r->row_count; i++) {
        const cost_row *row = &r->rows[i];
        fprintf(f.stream, "%s,%s", cost_ladder_name(row->ladder), row->setting);
        write_figure(f.stream, row->seconds);
        fprintf(f.stream, ",%lld", (long long)row->rays);
        write_figure(f.stream, 100.0 * row->rms);
        write_figure(f.stream, 100.0 * row->worst);
        write_figure(f.stream, 100.0 * row->half_width);
        write_figure(f.stream, row->seconds_for_1);
        write_figure(f.stream, 100.0 * row->bias);
        fprintf(f.stream, ",%d\n", row->runs);
    }
    if (r->end == RUN_INTERRUPTED)
        fprintf(f.stream, "# partial: %s\n", run_end_text(r->end));
    fprintf(f.stream, "%s%s\n", mark, output_study_name(s));
    return file_commit(&f, err);
}

bool cost_csv_is_of(const char *path, const study *s)
{
    enum { MOST_BYTES = 1 << 20 };
    arena scratch    = { 0 };
    size_t size      = 0;
    const char *name = output_study_name(s);
    const char *text = file_read(&scratch, path, MOST_BYTES, &size, NULL);
    const char *at   = text ? strstr(text, mark) : NULL;
    size_t length    = strlen(name);
    bool is          = at && !strncmp(at + sizeof mark - 1, name, length) &&
              !strcmp(at + sizeof mark - 1 + length, "\n");
    arena_clear(&scratch);
    return is;
}
