/* tests/bench/plain_lights.c -- see plain_lights.h; built twice, with and without PLAIN_387. */
#include "tests/bench/plain_lights.h"

#ifdef PLAIN_387
#define plain_sum_lights plain_sum_lights_387
#else
#define PLAIN_SSE
#endif

static const float PI = 3.14159265f;

static vec3 sub(vec3 a, vec3 b) { return (vec3){ a.x - b.x, a.y - b.y, a.z - b.z }; }
static vec3 add(vec3 a, vec3 b) { return (vec3){ a.x + b.x, a.y + b.y, a.z + b.z }; }
static float clamp(float a, float low, float high) { return a < low ? low : a > high ? high : a; }

/* Toward the light, and all it gives for its strength */
static bool lit_from_place(const plain_light *l, vec3 to, float share, plain_sample *out)
{
    float dist2 = v3_dot(to, to);
    if (!(dist2 > 0.0f))
        return false;
    float dist = sqrtf(dist2);
    *out       = (plain_sample){ .wi   = v3_scale(to, 1.0f / dist),
                                 .dist = dist,
                                 .e    = v3_scale(l->strength, share / dist2),
                                 .pdf  = INFINITY };
    return true;
}

static bool sample_point(const plain_light *l, vec3 p, float s, float t, plain_sample *out)
{
    (void)s, (void)t;
    return lit_from_place(l, sub(l->position, p), 1.0f, out);
}

static bool sample_cone(const plain_light *l, vec3 p, float s, float t, plain_sample *out)
{
    (void)s, (void)t;
    vec3 to     = sub(l->position, p);
    float cos_a = -v3_dot(to, l->axis) / v3_length(to);
    float ramp  = (cos_a - l->cos_outer) / (l->cos_inner - l->cos_outer);
    if (!(ramp > 0.0f))
        return false;
    return lit_from_place(l, to, ramp < 1.0f ? ramp * ramp : 1.0f, out);
}

static bool sample_parallel(const plain_light *l, vec3 p, float s, float t, plain_sample *out)
{
    (void)p, (void)s, (void)t;
    *out = (plain_sample){ v3_scale(l->axis, -1.0f), INFINITY, l->strength, INFINITY };
    return true;
}

static bool sample_cosine(const plain_light *l, vec3 p, float s, float t, plain_sample *out)
{
    (void)s, (void)t;
    vec3 to     = sub(l->position, p);
    float cos_a = -v3_dot(to, l->axis) / v3_length(to);
    return cos_a > 0.0f && lit_from_place(l, to, powf(cos_a, l->exponent), out);
}

static bool sample_linear(const plain_light *l, vec3 p, float s, float t, plain_sample *out)
{
    (void)t;
    vec3 start  = sub(l->position, p);
    float u0    = v3_dot(start, l->axis);
    float u1    = u0 + l->length;
    vec3 foot   = sub(start, v3_scale(l->axis, u0));
    float h     = v3_length(foot);
    float width = atan2f(l->length * h, h * h + u0 * u1);
    if (!(h > 0.0f && width > 0.0f))
        return false;
    float u    = clamp(h * tanf(atan2f(u0, h) + s * width), u0, u1);
    vec3 to    = add(foot, v3_scale(l->axis, u));
    float dist = v3_length(to);
    *out       = (plain_sample){ .wi   = v3_scale(to, 1.0f / dist),
                                 .dist = dist,
                                 .e    = v3_scale(l->strength, width / dist),
                                 .pdf  = INFINITY };
    return true;
}

/* (s, t) to the unit disk (Shirley & Chiu 1997) */
static void square_to_disk(float s, float t, float *x, float *y)
{
    float a = 2.0f * s - 1.0f, b = 2.0f * t - 1.0f, r, phi;
    if (fabsf(a) > fabsf(b)) {
        r   = a;
        phi = 0.25f * PI * (b / a);
    } else {
        r   = b;
        phi = 0.5f * PI - (b != 0.0f ? 0.25f * PI * (a / b) : 0.0f);
    }
    *x = r * cosf(phi);
    *y = r * sinf(phi);
}

/* The ellipse of lights/disk.c */
static bool sample_disk(const plain_light *l, vec3 p, float s, float t, plain_sample *out)
{
    vec3 from = sub(p, l->position);
    float px = v3_dot(from, l->u), py = v3_dot(from, l->v), z = v3_dot(from, l->axis);
    if (!(z > 0.0f))
        return false;
    float radius = l->length, d = sqrtf(px * px + py * py);
    float out_x = d > 0.0f ? px / d : 1.0f, out_y = d > 0.0f ? py / d : 0.0f;
    float r1 = sqrtf(z * z + (d - radius) * (d - radius));
    float r2 = sqrtf(z * z + (d + radius) * (d + radius));
    float k = (radius - d) * (radius + d) - z * z, root_s = r1 * r2;
    float large = root_s + fabsf(k), small = 4.0f * radius * radius * z * z / large;
    float plus = k < 0.0f ? small : large, minus = k < 0.0f ? large : small;

    float sin_a = 2.0f * radius / (r1 + r2), cos2_a = 2.0f * minus / ((r1 + r2) * (r1 + r2));
    float sin_b = sqrtf(0.5f * plus / root_s), cos2_b = 0.5f * minus / root_s;
    float cos_a = sqrtf(cos2_a), root = 1.0f / sqrtf(root_s);
    float ca2 = 0.5f + 0.5f * cos_a, cb2 = 0.5f + 0.5f * sqrtf(cos2_b);
    float flat = d * cos_a * root, steep = z / cos_a * root;

    float x, y;
    square_to_disk(s, t, &x, &y);
    float both   = fmaxf(cb2 * x * x + ca2 * y * y, 1e-30f);
    float cos2_v = cb2 * x * x / both, sin2_v = 1.0f - cos2_v;
    float c     = sqrtf(cos2_a * cos2_v + cos2_b * sin2_v);
    float x_rim = sin_a * x * sqrtf(cb2 / both), y_rim = sin_b * y * sqrtf(ca2 / both);
    float share = (x * x + y * y) / (1.0f + c);
    float drop  = share * (x_rim * x_rim + y_rim * y_rim);
    float scale = sqrtf(share * (2.0f - drop)), middle = 1.0f - drop;
    float wx = scale * x_rim, wy = scale * y_rim, ahead = wy * steep - middle * flat;
    vec3 way = { ahead * out_x - wx * out_y, ahead * out_y + wx * out_x,
                 -wy * flat - middle * steep };
    if (!(way.z < 0.0f))
        return false;

    float sr =
        2.0f * PI * sin_a * sin_b * (ca2 * cos2_v + cb2 * sin2_v) / (sqrtf(ca2 * cb2) * (1.0f + c));
    vec3 wi = add(v3_scale(l->u, way.x), add(v3_scale(l->v, way.y), v3_scale(l->axis, way.z)));
    *out    = (plain_sample){ wi, z / -way.z, v3_scale(l->strength, sr), 1.0f / sr };
    return true;
}

/* The arcs of lights/rect.c; its area is not tiny here */
static bool sample_rect(const plain_light *l, vec3 p, float s, float t, plain_sample *out)
{
    vec3 from = sub(p, l->position);
    float px = v3_dot(from, l->u), py = v3_dot(from, l->v), h = v3_dot(from, l->axis);
    if (!(h > 0.0f))
        return false;
    float x0 = -0.5f * l->width - px, x1 = 0.5f * l->width - px;
    float y0 = -0.5f * l->length - py, y1 = 0.5f * l->length - py, h2 = h * h;
    float r00 = sqrtf(x0 * x0 + y0 * y0 + h2), r01 = sqrtf(x0 * x0 + y1 * y1 + h2);
    float r10 = sqrtf(x1 * x1 + y0 * y0 + h2), r11 = sqrtf(x1 * x1 + y1 * y1 + h2);

    /* Its solid angle, by two triangles */
    float cross  = r00 * r11 + x0 * x1 + y0 * y1 + h2;
    float low    = r10 * cross + (x0 * x1 + y0 * y0 + h2) * r11 + (x1 * x1 + y0 * y1 + h2) * r00;
    float high   = r01 * cross + (x0 * x1 + y1 * y1 + h2) * r00 + (x0 * x0 + y0 * y1 + h2) * r11;
    float volume = h * l->width * l->length;
    float angle  = 2.0f * atan2f(volume * (low + high), low * high - volume * volume);

    /* x, then y, by solid angle */
    float w0 = 1.0f / sqrtf(y0 * y0 + h2), w1 = 1.0f / sqrtf(y1 * y1 + h2);
    float ss = y0 * w0 * y1 * w1, ee = h * w0 * h * w1;
    float unit  = w0 * w1 / (x0 * x0 + h2);
    float sin_0 = x0 * h * (y1 * r00 - y0 * r01) * unit;
    float cos_0 = (h2 * (r00 * r01) + x0 * x0 * (y0 * y1)) * unit;
    float sin_s = sinf(s * angle), cos_s = cosf(s * angle);
    float sin_a = sin_0 * cos_s + cos_0 * sin_s, cos_a = cos_0 * cos_s - sin_0 * sin_s;
    float root2 = (cos_a - ss - ee) * (cos_a - ss + ee);
    float x     = clamp(h * sin_a / sqrtf(fmaxf(root2, 1e-38f)), x0, x1);
    float d2    = x * x + h2;
    float s0 = y0 / sqrtf(y0 * y0 + d2), s1 = y1 / sqrtf(y1 * y1 + d2), sy = s0 + t * (s1 - s0);
    float y = clamp(sy * sqrtf(d2 / fmaxf(1.0f - sy * sy, 1e-38f)), y0, y1);

    float r = sqrtf(x * x + y * y + h2);
    vec3 to = add(v3_scale(l->u, x), add(v3_scale(l->v, y), v3_scale(l->axis, -h)));
    *out = (plain_sample){ v3_scale(to, 1.0f / r), r, v3_scale(l->strength, angle), 1.0f / angle };
    return true;
}

/* The last of `cells` places at or before x, from where it would be if all were even */
static int cell_of(const float *at, int cells, float density, float x)
{
    int i = (int)((x - at[0]) * density);
    i     = i < 0 ? 0 : i > cells - 1 ? cells - 1 : i;
    if (i + 1 < cells && at[i + 1] <= x)
        i++;
    else if (i > 0 && at[i] > x)
        i--;
    return i;
}

static bool sample_luminaire(const plain_light *l, vec3 p, float s, float t, plain_sample *out)
{
    (void)s, (void)t;
    vec3 to = sub(l->position, p), w = v3_scale(to, -1.0f / v3_length(to));
    float x = v3_dot(w, l->u), y = v3_dot(w, l->v);
    float gamma = atan2f(sqrtf(x * x + y * y), v3_dot(w, l->axis));
    if (!(gamma >= l->gamma[0] && gamma <= l->gamma[l->gammas - 1]))
        return false;
    float plane = atan2f(y, x);
    plane += plane < 0.0f ? 2.0f * PI : 0.0f;

    int i     = cell_of(l->plane, l->planes, l->plane_density, plane);
    int j     = cell_of(l->gamma, l->gammas - 1, l->gamma_density, gamma);
    int i1    = i + 1 < l->planes ? i + 1 : 0;
    float end = i1 ? l->plane[i1] : l->plane[0] + 2.0f * PI;
    float a   = (plane - l->plane[i]) / (end - l->plane[i]);
    float b   = (gamma - l->gamma[j]) / (l->gamma[j + 1] - l->gamma[j]);

    const float *low = l->candela + i * l->gammas + j, *high = l->candela + i1 * l->gammas + j;
    float cd = (1 - a) * ((1 - b) * low[0] + b * low[1]) + a * ((1 - b) * high[0] + b * high[1]);
    return cd > 0.0f && lit_from_place(l, to, cd, out);
}

static bool (*const samplers[PLAIN_KINDS])(const plain_light *, vec3, float, float,
                                           plain_sample *) = {
    sample_point,  sample_cone, sample_parallel, sample_cosine,
    sample_linear, sample_disk, sample_rect,     sample_luminaire,
};

#ifdef PLAIN_SSE
bool plain_sample_light(const plain_light *l, vec3 p, float s, float t, plain_sample *out)
{
    *out = (plain_sample){ 0 };
    return samplers[l->kind](l, p, s, t, out);
}
#endif

vec3 plain_sum_lights(const plain_light *l, const vec3 *p, const vec3 *n, const float *s,
                      const float *t, int count)
{
    vec3 sum = { 0 };
    for (int i = 0; i < count; i++) {
        plain_sample at;
        if (!samplers[l->kind](l, p[i], s[i], t[i], &at))
            continue;
        float cos_n = v3_dot(n[i], at.wi);
        if (cos_n > 0.0f)
            sum = add(sum, v3_scale(at.e, cos_n));
    }
    return sum;
}
