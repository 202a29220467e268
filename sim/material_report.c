/* sim/material_report.c -- figures of measured materials as text and JSON; see the header. */
#include "sim/material_report.h"

#include "materials/material_figures.h"
#include "sim/command.h"
#include "sim/swatch.h"

#include <string.h>
#include <strings.h>

enum { ANGLES = 10 };
static const double angles_deg[ANGLES] = { 0, 10, 20, 30, 40, 50, 60, 70, 80, 85 };

/* ---- files ----------------------------------------------------------------------------------- */

static bool ends_in(const char *path, const char *extension)
{
    const char *end = strrchr(path, '.');
    return end && !strcasecmp(end, extension);
}

bool measured_read(arena *a, const char *path, measured *out, notices *n, lux_error *err)
{
    *out = (measured){ .path = path };
    if (ends_in(path, ".xml")) {
        out->layer = bsdf_read(a, path, n, err);
        if (out->layer)
            out->made =
                material_bsdf(a, &(bsdf_desc){ .data = out->layer, .up = { 0, 1, 0 } }, err);
    } else {
        out->table = brdf_read(a, path, n, err);
        if (out->table)
            out->made =
                material_brdf(a, &(brdf_desc){ .table = out->table, .up = { 1, 0, 0 } }, err);
    }
    return out->made != NULL;
}

/* ---- beams ----------------------------------------------------------------------------------- */

beams beams_of(const measured *m)
{
    if (m->layer)
        return (beams){
            .side_count  = 2,
            .plane_count = 3,
            .sides       = { { "front", -1.0 }, { "back", 1.0 } },
            .planes = { { "from above", 90.0 }, { "from the side", 0.0 }, { "from below", 270.0 } }
        };
    bool around = brdf_figures_of(m->table)->kind == BRDF_ANISOTROPIC;
    return (beams){ .side_count  = 1,
                    .plane_count = around ? 2 : 1,
                    .sides       = { { "both", 1.0 } },
                    .planes      = { { around ? "azimuth 0" : "any azimuth", 0.0 },
                                     { "azimuth 90", 90.0 } } };
}

vec3 beam_from(double sign, double azimuth_deg, double angle_deg)
{
    const double phi = azimuth_deg * (M_PI / 180.0), theta = angle_deg * (M_PI / 180.0);
    return (vec3){ (float)(sin(theta) * cos(phi)), (float)(sin(theta) * sin(phi)),
                   (float)(sign * cos(theta)) };
}

/* What a file comes to. */
typedef struct findings {
    beams beams;
    material_share share[MOST_SIDES][MOST_PLANES][ANGLES];
    material_reciprocity reciprocity;
    double most, scale; /* the largest albedo as the file has it; by what it is scaled at most */
    vec3 reflectance[MOST_SIDES], transmittance[MOST_SIDES]; /* of diffuse light */
} findings;

static vec3 even(double a) { return (vec3){ (float)a, (float)a, (float)a }; }

static void find(const measured *m, findings *f)
{
    f->beams = beams_of(m);
    for (int s = 0; s < f->beams.side_count; s++)
        for (int p = 0; p < f->beams.plane_count; p++)
            for (int i = 0; i < ANGLES; i++)
                f->share[s][p][i] = material_share_of(
                    m->made, beam_from(f->beams.sides[s].sign, f->beams.planes[p].azimuth_deg,
                                       angles_deg[i]));
    f->reciprocity = material_reciprocity_of(m->made);
    if (m->table) {
        const brdf_figures *b = brdf_figures_of(m->table);
        f->most               = (double)b->albedo_most;
        f->scale              = (double)b->scale_least;
        f->reflectance[0]     = m->made->reflectance;
        return;
    }
    const bsdf_figures *b = bsdf_figure(m->layer);
    f->most               = b->most;
    f->scale              = b->scale;
    f->reciprocity.mean   = b->reciprocity; /* of many more pairs; the reader tells it, too */
    for (int s = 0; s < f->beams.side_count; s++) {
        f->reflectance[s]   = even(b->reflectance[s]);
        f->transmittance[s] = even(b->transmittance[s]);
    }
}

/* ---- words ----------------------------------------------------------------------------------- */

static const char *kind_of(const measured *m)
{
    static const char *const names[] = { [BRDF_ISOTROPIC]   = "isotropic table",
                                         [BRDF_ANISOTROPIC] = "anisotropic table",
                                         [BRDF_HALF]        = "isotropic table, half angles" };
    return m->layer ? bsdf_figure(m->layer)->basis : names[brdf_figures_of(m->table)->kind];
}

static const char *axis_name(const brdf_figures *f, int axis)
{
    static const char *const names[][4] = {
        [BRDF_ISOTROPIC]   = { "theta_in", "theta_out", "delta_phi" },
        [BRDF_ANISOTROPIC] = { "theta_in", "phi_in", "theta_out", "phi_out" },
        [BRDF_HALF]        = { "theta_h", "theta_d", "phi_d" },
    };
    return names[f->kind][axis];
}

/* ---- text ------------------------------------------------------------------------------------ */

static void label(FILE *out, const char *text) { fprintf(out, "  %-34s", text); }

/* One number if all channels have it. */
static void print_share(FILE *out, vec3 c)
{
    if (c.x == c.y && c.x == c.z)
        fprintf(out, "%6.3f", (double)c.x);
    else
        fprintf(out, "%6.3f %6.3f %6.3f", (double)c.x, (double)c.y, (double)c.z);
}

static void text_size(FILE *out, const measured *m)
{
    if (m->layer) {
        label(out, "directions on each side");
        fprintf(out, "%d\n", bsdf_figure(m->layer)->directions);
        return;
    }
    const brdf_figures *f = brdf_figures_of(m->table);
    label(out, "places");
    for (int i = 0; i < f->axes; i++)
        fprintf(out, "%s%s %d", i ? ", " : "", axis_name(f, i), f->counts[i]);
    fputc('\n', out);
    label(out, "bands");
    fprintf(out, "%d\n", f->bands);
    label(out, "memory (MiB)");
    fprintf(out, "%.3g\n", (double)f->bytes / (1024.0 * 1024.0));
    if (f->missing > 0.0f) {
        label(out, "not measured (%)");
        fprintf(out, "%.3g\n", 100.0 * (double)f->missing);
    }
}

static void text_energy(FILE *out, const measured *m, const findings *f)
{
    for (int s = 0; s < f->beams.side_count; s++) {
        label(out, m->table ? "reflects of diffuse light"
                   : s == 0 ? "of diffuse light from outside"
                            : "of diffuse light from the room");
        fputs(m->layer ? "reflects " : "", out);
        print_share(out, f->reflectance[s]);
        if (m->layer) {
            fputs(", lets through ", out);
            print_share(out, f->transmittance[s]);
        }
        fputc('\n', out);
    }
    label(out, m->layer ? "largest sum of both, as measured" : "largest albedo, as measured");
    fprintf(out, "%6.3f", f->most);
    if (m->table)
        fprintf(out, " at %.3g degrees", (double)brdf_figures_of(m->table)->theta_deg);
    fputc('\n', out);
    label(out, "scaled by");
    fprintf(out, m->table && f->scale < 1.0 ? "%6.4f at the most\n" : "%6.4g\n", f->scale);
    label(out, "reciprocity error (%)");
    fprintf(out, "mean %.3g, worst %.3g\n", 100.0 * f->reciprocity.mean,
            100.0 * f->reciprocity.worst);
}

static bool is_colored(const findings *f)
{
    bool colored = false;
    for (int p = 0; p < f->beams.plane_count; p++)
        for (int i = 0; i < ANGLES; i++) {
            vec3 c = f->share[0][p][i].reflected;
            colored |= c.x != c.y || c.x != c.z;
        }
    return colored;
}

static void text_table_albedo(FILE *out, const findings *f)
{
    const bool colored = is_colored(f);
    const int width    = colored ? 20 : 12;
    fprintf(out, "  %-15s", colored ? "reflects R, G, B" : "reflects");
    for (int p = 0; p < f->beams.plane_count; p++)
        fprintf(out, "   %*s", width, f->beams.planes[p].name);
    fputc('\n', out);
    for (int i = 0; i < ANGLES; i++) {
        fprintf(out, "  at %2.0f degrees  ", angles_deg[i]);
        for (int p = 0; p < f->beams.plane_count; p++) {
            vec3 c = f->share[0][p][i].reflected;
            if (colored)
                fprintf(out, "   %6.3f %6.3f %6.3f", (double)c.x, (double)c.y, (double)c.z);
            else
                fprintf(out, "   %*.3f", width, (double)c.x);
        }
        fputc('\n', out);
    }
}

static void text_layer_albedo(FILE *out, const findings *f)
{
    static const char *const titles[] = { "light from outside", "light from the room" };
    for (int s = 0; s < f->beams.side_count; s++) {
        fprintf(out, "  %-20s", titles[s]);
        for (int p = 0; p < f->beams.plane_count; p++)
            fprintf(out, "   %17s", f->beams.planes[p].name);
        fprintf(out, "\n  %-20s", "");
        for (int p = 0; p < f->beams.plane_count; p++)
            fputs("   reflects  through", out);
        for (int i = 0; i < ANGLES; i++) {
            fprintf(out, "\n  at %2.0f degrees       ", angles_deg[i]);
            for (int p = 0; p < f->beams.plane_count; p++) {
                const material_share *c = &f->share[s][p][i];
                fprintf(out, "   %8.3f %8.3f", (double)c->reflected.y, (double)c->through.y);
            }
        }
        fputc('\n', out);
    }
}

static void report_text(FILE *out, const measured *m, const findings *f)
{
    fprintf(out, "%s\n", m->path);
    label(out, "kind");
    fprintf(out, "%s%s\n", m->layer ? "BSDF, " : "", kind_of(m));
    text_size(out, m);
    text_energy(out, m, f);
    if (m->layer)
        text_layer_albedo(out, f);
    else
        text_table_albedo(out, f);
}

/* ---- JSON ------------------------------------------------------------------------------------ */

static void key(FILE *out, const char *name) { fprintf(out, ",\"%s\":", name); }

static void json_number_of(FILE *out, const char *name, double value)
{
    key(out, name);
    json_number(out, value);
}

static void json_channels(FILE *out, const char *name, vec3 c)
{
    key(out, name);
    fprintf(out, "[%.6g,%.6g,%.6g]", (double)c.x, (double)c.y, (double)c.z);
}

static void json_size(FILE *out, const measured *m)
{
    if (m->layer) {
        json_number_of(out, "directions", bsdf_figure(m->layer)->directions);
        return;
    }
    const brdf_figures *f = brdf_figures_of(m->table);
    fputs(",\"axes\":{", out);
    for (int i = 0; i < f->axes; i++)
        fprintf(out, "%s\"%s\":%d", i ? "," : "", axis_name(f, i), f->counts[i]);
    fprintf(out, "},\"bands\":%d,\"bytes\":%zu", f->bands, f->bytes);
    json_number_of(out, "not_measured_percent", 100.0 * (double)f->missing);
}

static void json_albedo(FILE *out, const findings *f)
{
    const char *comma = "";
    fputs(",\"albedo\":[", out);
    for (int s = 0; s < f->beams.side_count; s++)
        for (int p = 0; p < f->beams.plane_count; p++)
            for (int i = 0; i < ANGLES; i++, comma = ",") {
                const material_share *c = &f->share[s][p][i];
                fprintf(out, "%s{\"side\":\"%s\",\"azimuth_deg\":%g,\"angle_deg\":%g", comma,
                        f->beams.sides[s].name, f->beams.planes[p].azimuth_deg, angles_deg[i]);
                fprintf(out, ",\"r\":%.6g,\"g\":%.6g,\"b\":%.6g", (double)c->reflected.x,
                        (double)c->reflected.y, (double)c->reflected.z);
                json_channels(out, "through", c->through);
                fputc('}', out);
            }
    fputc(']', out);
}

static void report_json(FILE *out, const measured *m, const findings *f, const notices *warnings)
{
    fputs("{\"file\":", out);
    json_string(out, m->path);
    key(out, "kind");
    json_string(out, kind_of(m));
    json_size(out, m);
    json_number_of(out, "largest_albedo", f->most);
    json_number_of(out, "scale", f->scale);
    json_number_of(out, "reciprocity_error", f->reciprocity.mean);
    json_number_of(out, "reciprocity_worst", f->reciprocity.worst);
    json_channels(out, "reflectance", f->reflectance[0]);
    json_channels(out, "transmittance", f->transmittance[0]);
    if (m->layer) {
        json_channels(out, "reflectance_back", f->reflectance[1]);
        json_channels(out, "transmittance_back", f->transmittance[1]);
    }
    json_albedo(out, f);
    key(out, "warnings");
    fputc('[', out);
    for (const notice *w = warnings->first; w; w = w->next) {
        json_string(out, w->text);
        fputs(w->next ? "," : "", out);
    }
    fputs("]}", out);
}

/* ---- all of it ------------------------------------------------------------------------------- */

/* The file's name without its folders. */
static const char *title_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

static bool draw(const measured *m, const material_options *o, lux_error *err)
{
    study_material of = { .surface = m->layer ? SURFACE_BSDF : SURFACE_TABLE,
                          .brdf    = m->path,
                          .up      = { 0, 0, 1 } };
    if (o->plot && !material_plot(m, title_of(m->path), o->plot, err))
        return false;
    return !o->swatch || swatch_write(&of, o->swatch, o->run, err);
}

static bool report_file(FILE *out, const char *file, const material_options *o, bool *first,
                        notices *n, lux_error *err)
{
    arena a          = { 0 };
    notices warnings = { .a = &a };
    measured m;
    findings *f = arena_new(&a, findings, err);
    bool done   = f && measured_read(&a, file, &m, &warnings, err);
    if (done) {
        find(&m, f);
        fputs(*first ? "" : o->json ? "," : "\n", out);
        *first = false;
        if (o->json)
            report_json(out, &m, f, &warnings);
        else
            report_text(out, &m, f);
        done = draw(&m, o, err);
    }
    for (const notice *w = warnings.first; w; w = w->next)
        notice_add(n, "%s", w->text);
    arena_clear(&a);
    return done;
}

/* NULL is no name, and good. */
static bool is_named(const char *path, const char *extension, const char *option, lux_error *err)
{
    return !path || ends_in(path, extension) ||
           failed(err, ERR_ARGUMENT, "%s %s: expected a file *%s", option, path, extension);
}

bool material_report(FILE *out, const char *const *files, int count, const material_options *o,
                     notices *n, lux_error *err)
{
    if (count < 1)
        return failed(err, ERR_ARGUMENT, "which files? (.brdf, .binary, .xml)");
    if (count > 1 && (o->plot || o->swatch))
        return failed(err, ERR_ARGUMENT, "found %d files, expected one with --plot or --swatch",
                      count);
    if (!is_named(o->plot, ".svg", "--plot", err) || !is_named(o->swatch, ".png", "--swatch", err))
        return false;
    if (!output_free(o->plot, o->overwrite, err) || !output_free(o->swatch, o->overwrite, err))
        return false;
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
