/* data/model/paint.c -- see model.h: paints as glTF's materials, textures and images. */
#include "data/model/model.h"

#include <math.h>
#include <string.h>

#define RAD (3.14159265358979323846 / 180.0)

static void add_picture(const picture *list[], int *count, const picture *p)
{
    for (int i = 0; i < *count; i++)
        if (list[i] == p)
            return;
    if (p)
        list[(*count)++] = p;
}

int model_pictures(const model *m, const picture *list[2 * INK_MAX])
{
    int count = 0;
    for (int i = 0; i < m->paint_count; i++) {
        add_picture(list, &count, m->paints[i].base);
        add_picture(list, &count, m->paints[i].relief);
    }
    return count;
}

static int number_of(const model *m, const picture *p)
{
    const picture *list[2 * INK_MAX];
    int i = model_pictures(m, list);
    while (i-- > 0 && list[i] != p) {
    }
    return i;
}

/* The pictures that have colours are sRGB by what they are used for. */
static void texture_json(FILE *to, const model *m, const paint *p, const char *key,
                         const picture *of)
{
    if (!of)
        return;
    fprintf(to, ",\"%s\":{\"index\":%d", key, number_of(m, of));
    if (p->turn_deg != 0.0 || p->shrink > 0.0) {
        const double s = p->shrink > 0.0 ? 1.0 / p->shrink : 1.0;
        fprintf(to,
                ",\"extensions\":{\"KHR_texture_transform\":{\"rotation\":%.7g,"
                "\"scale\":[%.7g,%.7g]}}",
                p->turn_deg * RAD, s, s);
    }
    fprintf(to, "}");
}

static void surface_json(FILE *to, const model *m, const paint *p)
{
    fprintf(to,
            "\n{\"name\":\"%s\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[%g,%g,%g,1],"
            "\"metallicFactor\":%g,\"roughnessFactor\":%g",
            p->name, p->color[0], p->color[1], p->color[2], p->metallic, 1.0 - p->gloss);
    texture_json(to, m, p, "baseColorTexture", p->base);
    fprintf(to, "}");
    texture_json(to, m, p, "normalTexture", p->relief);
    if (p->cutoff > 0.0)
        fprintf(to, ",\"alphaMode\":\"MASK\",\"alphaCutoff\":%g", p->cutoff);
    if (p->seen_from_both)
        fprintf(to, ",\"doubleSided\":true");
    if (p->emission > 0.0)
        fprintf(to, ",\"emissiveFactor\":[1,1,1]");
}

static void volume_json(FILE *to, const paint *p)
{
    fprintf(to, ",\"KHR_materials_volume\":{\"thicknessFactor\":%g", p->thickness);
    if (p->tint_distance > 0.0)
        fprintf(to, ",\"attenuationDistance\":%g,\"attenuationColor\":[%g,%g,%g]", p->tint_distance,
                p->tint[0], p->tint[1], p->tint[2]);
    fprintf(to, "}");
}

static void extensions_json(FILE *to, const paint *p)
{
    const char *comma = "";
    if (p->emission <= 0.0 && p->ior <= 0.0 && p->transmission <= 0.0)
        return;
    fprintf(to, ",\"extensions\":{");
    if (p->emission > 0.0) {
        fprintf(to, "\"KHR_materials_emissive_strength\":{\"emissiveStrength\":%g}", p->emission);
        comma = ",";
    }
    if (p->ior > 0.0) {
        fprintf(to, "%s\"KHR_materials_ior\":{\"ior\":%g}", comma, p->ior);
        comma = ",";
    }
    if (p->transmission > 0.0) {
        fprintf(to, "%s\"KHR_materials_transmission\":{\"transmissionFactor\":%g}", comma,
                p->transmission);
        if (p->thickness > 0.0)
            volume_json(to, p);
    }
    fprintf(to, "}");
}

void paints_json(FILE *to, const model *m, int view)
{
    const picture *list[2 * INK_MAX];
    const int count = model_pictures(m, list);

    fprintf(to, "\"materials\":[");
    for (int i = 0; i < m->paint_count; i++) {
        fprintf(to, i ? "," : "");
        surface_json(to, m, &m->paints[i]);
        extensions_json(to, &m->paints[i]);
        fprintf(to, "}");
    }
    fprintf(to, "],\n");
    if (!count)
        return;
    fprintf(to, "\"textures\":[");
    for (int i = 0; i < count; i++)
        fprintf(to, "%s{\"source\":%d}", i ? "," : "", i);
    fprintf(to, "],\n\"images\":[");
    for (int i = 0; i < count; i++)
        fprintf(to, "%s\n{\"name\":\"%s\",\"mimeType\":\"image/png\",\"bufferView\":%d}",
                i ? "," : "", list[i]->name, view + i);
    fprintf(to, "],\n");
}
