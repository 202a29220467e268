/* sim/photometry_report.c -- figures of photometric files as text and JSON; see the header. */
#include "sim/photometry_report.h"
#include "core/utf8.h"
#include "sim/output.h"

#include <math.h>
#include <string.h>

/* ---- JSON ------------------------------------------------------------------------------- */

/* A string with its quotes; bytes that are no UTF-8 (paths may have them) become U+FFFD. */
static void json_string(FILE *out, const char *s)
{
    size_t left = strlen(s);
    fputc('"', out);
    while (left > 0) {
        size_t n = utf8_length(s, left);
        if (n == 0)
            fputs("\\ufffd", out);
        else if (n == 1 && (*s == '"' || *s == '\\'))
            fprintf(out, "\\%c", *s);
        else if (n == 1 && *s < ' ')
            fprintf(out, "\\u%04x", *s);
        else
            fwrite(s, 1, n, out);
        n = n ? n : 1;
        s += n, left -= n;
    }
    fputc('"', out);
}

static void json_text(FILE *out, const char *key, const char *value)
{
    fprintf(out, "\"%s\":", key);
    json_string(out, value);
    fputc(',', out);
}

static void json_number(FILE *out, const char *key, bool known, double value)
{
    if (known)
        fprintf(out, "\"%s\":%.9g,", key, value);
    else
        fprintf(out, "\"%s\":null,", key);
}

static void flux_code_text(const photometry_figures *f, bool known, char out[64])
{
    int n = snprintf(out, 64, "%.0f %.0f %.0f %.0f", f->flux_code[0], f->flux_code[1],
                     f->flux_code[2], f->flux_code[3]);
    snprintf(out + n, (size_t)(64 - n), known ? " %.0f" : " -", f->flux_code[4]);
}

static void report_json(FILE *out, const char *file, const photometry *p,
                        const photometry_figures *f, const notices *warnings)
{
    char code[64];
    flux_code_text(f, f->lor_known, code);
    fputc('{', out);
    json_text(out, "file", file);
    json_text(out, "format", photometry_format_name(p->format));
    json_text(out, "type", (char[]){ p->type, 0 });
    json_number(out, "lamp_lm", p->lamp_lumens > 0.0, p->lamp_lumens);
    json_number(out, "luminaire_lm", true, p->luminaire_lumens);
    json_number(out, "lor", f->lor_known, f->lor);
    json_number(out, "lor_up", f->lor_known, f->lor_up);
    json_number(out, "watts", p->watts > 0.0, p->watts);
    json_number(out, "efficacy_lm_w", p->watts > 0.0, f->efficacy);
    json_number(out, "maximum_cd", true, f->maximum_cd);
    json_number(out, "maximum_c_deg", true, f->maximum_plane_deg);
    json_number(out, "maximum_gamma_deg", true, f->maximum_gamma_deg);
    fprintf(out, "\"beam_deg\":%.9g,\"beam_c90_deg\":%.9g,", f->beam_deg[0], f->beam_deg[1]);
    fprintf(out, "\"field_deg\":%.9g,\"field_c90_deg\":%.9g,", f->field_deg[0], f->field_deg[1]);
    json_text(out, "flux_code", code);
    json_text(out, "symmetry", photometry_symmetry_name(p->symmetry));
    json_text(out, "opening", opening_shape_name(p->opening));
    fprintf(out, "\"opening_m\":[%.6g,%.6g,%.6g],", (double)p->length, (double)p->width,
            (double)p->height);
    json_text(out, "length_along", p->length_along_deg == 0.0f ? "C0" : "C90");
    fputs("\"warnings\":[", out);
    for (const notice *w = warnings->first; w; w = w->next) {
        json_string(out, w->text);
        fputs(w->next ? "," : "", out);
    }
    fputs("]}", out);
}

/* ---- text ------------------------------------------------------------------------------- */

static void text_words(FILE *out, const char *label, const char *value)
{
    if (value[0])
        fprintf(out, "  %-34s%s\n", label, value);
}

static void text_number(FILE *out, const char *label, bool known, int digits, double value)
{
    if (known && value > 0.0 && value < 0.05) /* not as 0.0 */
        fprintf(out, "  %-34s%.3g\n", label, value);
    else if (known)
        fprintf(out, "  %-34s%.*f\n", label, digits, value);
    else
        fprintf(out, "  %-34snot stated\n", label);
}

static double least_tilt_factor(const photometry *p)
{
    double least = (double)p->tilt_factor[0];
    for (int i = 1; i < p->tilt_count; i++)
        least = fmin(least, (double)p->tilt_factor[i]);
    return least;
}

static void report_text(FILE *out, const char *file, const photometry *p,
                        const photometry_figures *f)
{
    char code[64];
    flux_code_text(f, f->lor_known, code);
    fprintf(out, "%s\n", file);
    fprintf(out, "  %-34s%s, type %c, symmetry: %s\n", "format", photometry_format_name(p->format),
            p->type, photometry_symmetry_name(p->symmetry));
    text_words(out, "manufacturer", p->manufacturer);
    text_words(out, "luminaire", p->name);
    text_words(out, "catalogue number", p->catalog);
    text_words(out, "lamp", p->lamp);
    fprintf(out, "  %-34s%s", "opening (m)", opening_shape_name(p->opening));
    if (p->opening != OPENING_POINT)
        fprintf(out, ", length %g, width %g, height %g", (double)p->length, (double)p->width,
                (double)p->height);
    fprintf(out, ", length along C%g\n", (double)p->length_along_deg);
    if (p->absolute)
        fprintf(out, "  %-34sabsolute photometry\n", "lamp flux (lm)");
    else
        text_number(out, "lamp flux (lm)", p->lamp_lumens > 0.0, 1, p->lamp_lumens);
    text_number(out, "luminaire flux (lm)", true, 1, p->luminaire_lumens);
    text_number(out, "light output ratio (%)", f->lor_known, 1, 100.0 * f->lor);
    text_number(out, "light output ratio upward (%)", f->lor_known, 1, 100.0 * f->lor_up);
    text_number(out, "input power (W)", p->watts > 0.0, 1, p->watts);
    text_number(out, "efficacy (lm/W)", p->watts > 0.0, 1, f->efficacy);
    fprintf(out,
            f->maximum_cd < 0.05 ? "  %-34s%.3g at C %g, gamma %g deg\n"
                                 : "  %-34s%.1f at C %g, gamma %g deg\n",
            "greatest intensity (cd)", f->maximum_cd, f->maximum_plane_deg, f->maximum_gamma_deg);
    fprintf(out, "  %-34s%.1f in C0-C180, %.1f in C90-C270\n", "beam angle, 50 % (deg)",
            f->beam_deg[0], f->beam_deg[1]);
    fprintf(out, "  %-34s%.1f in C0-C180, %.1f in C90-C270\n", "field angle, 10 % (deg)",
            f->field_deg[0], f->field_deg[1]);
    text_words(out, "CIE flux code", code);
    if (p->tilt_count > 0)
        fprintf(out, "  %-34s%g at least, up to %g deg from down\n",
                "factor of the lamp when tilted", least_tilt_factor(p),
                (double)p->tilt_deg[p->tilt_count - 1]);
}

/* ---- files ------------------------------------------------------------------------------ */

/* The luminaire's name, or its number, or that of the file. */
static const char *title_of(const photometry *p, const char *file)
{
    const char *slash = strrchr(file, '/');
    return p->name[0] ? p->name : p->catalog[0] ? p->catalog : slash ? slash + 1 : file;
}

static bool report_file(FILE *out, const char *file, const photometry_options *o, bool *first,
                        notices *n, lux_error *err)
{
    arena a             = { 0 };
    notices warnings    = { .a = &a };
    const photometry *p = photometry_read(&a, file, &warnings, err);
    bool done           = p != NULL;
    if (p) {
        photometry_figures f = photometry_figure(p, file, &warnings);
        if (o->write)
            done = output_free(o->write, o->overwrite, err) &&
                   photometry_write(p, o->write, &warnings, err);
        if (done && o->plot)
            done = output_free(o->plot, o->overwrite, err) &&
                   photometry_plot(p, title_of(p, file), o->plot, err);
        fputs(*first ? "" : o->json ? "," : "\n", out);
        *first = false;
        if (o->json)
            report_json(out, file, p, &f, &warnings);
        else
            report_text(out, file, p, &f);
    }
    for (const notice *w = warnings.first; w; w = w->next)
        notice_add(n, "%s", w->text);
    arena_clear(&a);
    return done;
}

bool photometry_report(FILE *out, const char *const *files, int count, const photometry_options *o,
                       notices *n, lux_error *err)
{
    if (count < 1)
        return failed(err, ERR_ARGUMENT, "photometry: expected at least one .ies or .ldt file");
    if (count > 1 && (o->plot || o->write))
        return failed(err, ERR_ARGUMENT,
                      "photometry: found %d files, expected one with --plot or "
                      "--write",
                      count);
    bool all = true, first = true;
    fputs(o->json ? "{\"files\":[" : "", out);
    for (int i = 0; i < count; i++) {
        lux_error e = { 0 };
        if (report_file(out, files[i], o, &first, n, &e))
            continue;
        if (all)
            failed(err, e.code, "%s", e.text);
        else
            notice_add(n, "%s", e.text);
        all = false;
    }
    fputs(o->json ? "]}\n" : "", out);
    return all;
}
