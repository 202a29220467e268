/* tests/unit/test_bsdf_material.c -- measured layers as materials: against a scalar twin in double,
 * the furnace, samplers, sides. */
#include "core/sampler.h"
#include "materials/material.h"
#include "tests/bsdf_twin.h"
#include "tests/shapes.h"
#include "tests/test.h"

#include <stdlib.h>

static const double pi = 3.14159265358979324;

/* ---- layers ------------------------------------------------------------------------------------
 */

static const bsdf *read_text(arena *a, char *text)
{
    lux_error err = { 0 };
    const bsdf *b = twin_read(a, text, NULL, &err);
    if (!b)
        fail_msg("%s", err.text);
    free(text);
    return b;
}

static const material *layer(arena *a, const bsdf *b, vec3 up, bool front_outside)
{
    const bsdf_desc d = { .data = b, .up = up, .front_outside = front_outside };
    const material *m = material_bsdf(a, &d, NULL);
    assert_non_null(m);
    return m;
}

/* At most 2 * 0.15 * pi = 0.94 of any light; no more reciprocal than noise */
static double noise(int part, int in, int out, const void *with)
{
    (void)with;
    uint32_t h = (uint32_t)(part * 1000003 + in * 1009 + out) * 0x9e3779b9u;
    h          = (h ^ h >> 15) * 0x85ebca6bu;
    h ^= h >> 13;
    return h % 4 == 0 ? 0 : h / 4294967296.0 * 0.15;
}

static double mirror_and_through(int part, int in, int out, const void *with)
{
    return in != out ? 0 : (part < 2 ? 0.6 : 0.3) / twin_area(with, in);
}

/* ---- the twin: what a file means for wo and wi, as vectors of the file's axes ------------------
 */

static void to_square(double x, double y, double out[2])
{
    double r = hypot(x, y), phi = atan2(y, x), a, b;
    if (fabs(x) > fabs(y)) {
        double off = x > 0 ? phi : phi > 0 ? phi - pi : phi + pi;
        a          = x > 0 ? r : -r;
        b          = a * off * 4 / pi;
    } else {
        double off = y > 0 ? pi / 2 - phi : -pi / 2 - phi;
        b          = y > 0 ? r : -r;
        a          = r == 0 ? 0 : b * off * 4 / pi;
    }
    out[0] = 0.5 + 0.5 * a;
    out[1] = 0.5 + 0.5 * b;
}

typedef struct twin_layer {
    int rank; /* 0: noise over a basis */
    const twin_basis *basis;
} twin_layer;

/* From wo to wi, z toward the room; *sure: not at a border between cells. */
static double twin_f(const twin_layer *t, const double wo[3], const double wi[3], bool *sure)
{
    int side = wo[2] > 0, part = wo[2] * wi[2] > 0 ? 2 + side : side;
    if (t->rank == 0) {
        *sure = !twin_at_edge(t->basis, -wo[0], -wo[1], fabs(wo[2])) &&
                !twin_at_edge(t->basis, wi[0], wi[1], fabs(wi[2]));
        int in  = twin_cell(t->basis, -wo[0], -wo[1], fabs(wo[2]));
        int out = twin_cell(t->basis, wi[0], wi[1], fabs(wi[2]));
        return noise(part, in, out, NULL);
    }
    double place[4] = { 0 };
    if (t->rank == 4) {
        to_square(-wo[0], -wo[1], place);
        to_square(wi[0], wi[1], place + 2);
    } else {
        double turn = atan2(-wo[1], -wo[0]);
        place[0]    = 0.5 - 0.5 * hypot(wo[0], wo[1]);
        to_square(wi[0] * cos(turn) + wi[1] * sin(turn), wi[1] * cos(turn) - wi[0] * sin(turn),
                  place + 1);
    }
    double blur = 1e-6 + (t->rank == 3 ? 3e-7 / hypot(wo[0], wo[1]) : 0); /* of the azimuth */
    *sure       = fabs(wo[2]) > 1e-4 && fabs(wi[2]) > 1e-4;
    for (int i = 0; i < t->rank; i++)
        *sure = *sure && fabs(remainder(place[i], 1.0 / 32)) > blur;
    return twin_tree_value(t->rank, part, place);
}

typedef struct setting { /* a surface, in double: the file's axes */
    dvec3 x, y, room;
} setting;

static dvec3 unit(dvec3 a) { return d3_scale(a, 1 / d3_length(a)); }

static void in_axes(const setting *s, dvec3 w, double out[3])
{
    out[0] = d3_dot(w, s->x);
    out[1] = d3_dot(w, s->y);
    out[2] = d3_dot(w, s->room);
}

/* A random place of a layer, another in each lane: a third of the ways near the surface or near its
 * normal */
static void random_place(uint32_t *seed, vec3 n, vshading *s, vvec3 *wi)
{
    float wo_at[3][LANES], wi_at[3][LANES], n_at[3][LANES];
    int32_t front[LANES];
    for (int i = 0; i < LANES; i++) {
        vec3 ways[2];
        for (int k = 0; k < 2; k++) {
            vec3 w = random_direction(seed);
            w      = v3_scale(w, 1 / v3_length(w));
            if (random_unit(seed) < 0.33f) /* near the surface, or near the normal */
                w = random_unit(seed) < 0.5f ? v3_scale(n, 1.0f)
                                             : (vec3){ w.x - 0.995f * v3_dot(w, n) * n.x,
                                                       w.y - 0.995f * v3_dot(w, n) * n.y,
                                                       w.z - 0.995f * v3_dot(w, n) * n.z };
            w       = (vec3){ w.x + 0.02f * random_unit(seed), w.y, w.z };
            ways[k] = v3_scale(w, 1 / v3_length(w));
        }
        float side  = v3_dot(ways[0], n) > 0 ? 1.0f : -1.0f;
        front[i]    = side > 0 ? -1 : 0;
        wo_at[0][i] = ways[0].x, wo_at[1][i] = ways[0].y, wo_at[2][i] = ways[0].z;
        wi_at[0][i] = ways[1].x, wi_at[1][i] = ways[1].y, wi_at[2][i] = ways[1].z;
        n_at[0][i] = side * n.x, n_at[1][i] = side * n.y, n_at[2][i] = side * n.z;
    }
    *s      = (vshading){ .wo       = { vload(wo_at[0]), vload(wo_at[1]), vload(wo_at[2]) },
                          .n        = { vload(n_at[0]), vload(n_at[1]), vload(n_at[2]) },
                          .front    = vload_int(front),
                          .distance = vsplat(1.0f) };
    s->flat = s->n;
    *wi     = (vvec3){ vload(wi_at[0]), vload(wi_at[1]), vload(wi_at[2]) };
}

static dvec3 lane3(vvec3 a, int i)
{
    return (dvec3){ (double)lane(a.x, i), (double)lane(a.y, i), (double)lane(a.z, i) };
}

static setting setting_of(vec3 n, vec3 up, bool outside)
{
    setting s;
    s.room  = d3_scale(unit(d3_from(n)), outside ? -1 : 1);
    dvec3 u = d3_from(up);
    s.y     = unit(d3_add(u, d3_scale(s.room, -d3_dot(u, s.room))));
    s.x     = d3_cross(s.y, s.room);
    return s;
}

static void agrees(const twin_layer *t, const bsdf *b, arena *a, int rounds)
{
    uint32_t seed = 7;
    int sure      = 0;
    for (int round = 0; round < rounds; round++) {
        vec3 n = random_direction(&seed), up = random_direction(&seed);
        n                  = v3_scale(n, 1 / v3_length(n));
        const bool outside = round % 2;
        const material *m  = layer(a, b, up, outside);
        const setting at   = setting_of(n, up, outside);
        for (int k = 0; k < 64; k += LANES) {
            vshading s;
            vvec3 wi;
            vfloat pdf;
            random_place(&seed, n, &s, &wi);
            vrgb f = m->type->reflect(m, &s, &wi, ALL_LANES, &pdf);
            for (int i = 0; i < LANES; i++) {
                double from[3], to[3];
                bool good;
                in_axes(&at, lane3(s.wo, i), from);
                in_axes(&at, lane3(wi, i), to);
                double want = twin_f(t, from, to, &good) * fabs(to[2]);
                if (!good)
                    continue;
                sure++;
                if (fabs((double)lane(f.y, i) - want) > 1e-6) /* of cosines of floats, times 0.15 */
                    fail_msg("%g, not %g: %g %g %g to %g %g %g", (double)lane(f.y, i), want,
                             from[0], from[1], from[2], to[0], to[1], to[2]);
                assert_true(lane(f.x, i) == lane(f.y, i) && lane(f.z, i) == lane(f.y, i));
                assert_true(lane(pdf, i) >= 0 && (lane(f.x, i) == 0 || lane(pdf, i) > 0));
            }
        }
    }
    assert_true(sure > rounds * 64 * 8 / 10);
}

TEST(matrices_agree_with_the_twin)
{
    const twin_basis *const bases[] = { &twin_full, &twin_half, &twin_quarter };
    for (int i = 0; i < 3; i++) {
        arena a       = { 0 };
        const bsdf *b = read_text(&a, twin_text(bases[i], 15, i == 1, noise, NULL));
        agrees(&(twin_layer){ 0, bases[i] }, b, &a, 3200);
        arena_clear(&a);
    }
}

TEST(trees_agree_with_the_twin)
{
    for (int rank = 3; rank <= 4; rank++) {
        arena a       = { 0 };
        const bsdf *b = read_text(&a, twin_tree_text(rank, 15));
        agrees(&(twin_layer){ rank, NULL }, b, &a, 3200);
        arena_clear(&a);
    }
}

/* ---- a layer in the plane z = 0, whose front is up and the room's; file axes are those of space
 */

static vshading facing(double theta_deg, double phi_deg, bool below)
{
    double t = theta_deg * pi / 180, p = phi_deg * pi / 180, side = below ? -1 : 1;
    vshading s = { .wo       = vspread((vec3){ (float)(sin(t) * cos(p)), (float)(sin(t) * sin(p)),
                                               (float)(side * cos(t)) }),
                   .n        = vspread((vec3){ 0, 0, (float)side }),
                   .front    = below ? (vmask){ 0 } : ALL_LANES,
                   .distance = vsplat(1.0f) };
    s.flat     = s.n;
    return s;
}

static const vec3 y_up = { 0, 1, 0 };

/* Of f |cos| over a hemisphere: midpoints that fall on no border of cells, and so exact. Klems: 4
 * places in each ring, 480 around (twice 240, which all counts divide); trees: of the square turned
 * by wo's azimuth, 32 x 32 */
static void hemispheres(const material *m, const vshading *s, const twin_basis *basis, double turn,
                        double *back, double *through)
{
    double sum[2] = { 0, 0 }, pdf_sum = 0;
    int rings = basis ? basis->rings : 8;
    for (int i = 0; i < rings * 4; i++)
        for (int j = 0; j < (basis ? 480 : 32); j++)
            for (int side = 0; side < 2; side++) {
                float x, y;
                double area;
                if (basis) {
                    double low  = cos(basis->edge[i / 4] * pi / 180);
                    double high = cos(basis->edge[i / 4 + 1] * pi / 180);
                    double zz   = low * low + (high * high - low * low) * ((i % 4 + 0.5) / 4);
                    double phi  = 2 * pi * (j + 0.5) / 480;
                    x           = (float)(sqrt(1 - zz) * cos(phi));
                    y           = (float)(sqrt(1 - zz) * sin(phi));
                    area        = pi * (low * low - high * high) / 4 / 480;
                } else {
                    float p[2];
                    one_lane_square_to_disk(((float)i + 0.5f) / 32, ((float)j + 0.5f) / 32, p);
                    x    = (float)((double)p[0] * cos(turn) - (double)p[1] * sin(turn));
                    y    = (float)((double)p[1] * cos(turn) + (double)p[0] * sin(turn));
                    area = pi / 1024;
                }
                float z  = sqrtf(1 - x * x - y * y) * (side ? -1.0f : 1.0f) * lane(s->n.z, 0);
                vvec3 wi = vspread((vec3){ x, y, z });
                vfloat pdf;
                vrgb f = m->type->reflect(m, s, &wi, ALL_LANES, &pdf);
                sum[side] += area * (double)lane(f.x, 0) / fabs((double)z);
                pdf_sum += area * (double)lane(pdf, 0) / fabs((double)z);
            }
    *back    = sum[0];
    *through = sum[1];
    assert_near(pdf_sum, 1, 1e-4); /* of sums of floats */
}

static void furnace(const bsdf *b, arena *a, const twin_basis *basis)
{
    static const double angles[] = { 0, 30, 60, 80, 89, 89.99 };
    const material *m            = layer(a, b, y_up, false);
    for (int i = 0; i < 12; i++) {
        double back, through, phi = 100 + 31 * i;
        vshading s   = facing(angles[i % 6], phi, i >= 6);
        vrgb albedo  = m->type->albedo(m, &s, ALL_LANES);
        double to_in = basis ? 0 : (phi + 180) * pi / 180; /* light's way from wo */
        hemispheres(m, &s, basis, bsdf_figure(b)->basis[0] == 't' ? to_in : 0, &back, &through);
        assert_near(lane(albedo.x, 0), back, 1e-4);
        assert_true(back + through <= 1 + 1e-6 && back > 0 && through > 0);
    }
}

TEST(the_furnace_gives_what_the_albedo_says)
{
    arena a = { 0 };
    furnace(read_text(&a, twin_text(&twin_full, 15, false, noise, NULL)), &a, &twin_full);
    furnace(read_text(&a, twin_text(&twin_quarter, 15, false, mirror_and_through, &twin_quarter)),
            &a, &twin_quarter);
    furnace(read_text(&a, twin_tree_text(3, 15)), &a, NULL);
    arena_clear(&a);
}

TEST(the_furnace_gives_what_the_albedo_of_rank_4_says)
{
    arena a                      = { 0 };
    static const double angles[] = { 0, 30, 60, 80, 89, 89.99 };
    const bsdf *b                = read_text(&a, twin_tree_text(4, 15));
    const material *m            = layer(&a, b, y_up, false);
    for (int i = 0; i < 12; i++) {
        double back, through;
        vshading s  = facing(angles[i % 6], 100 + 31 * i, i >= 6);
        vrgb albedo = m->type->albedo(m, &s, ALL_LANES);
        hemispheres(m, &s, NULL, 0, &back, &through);
        assert_near(lane(albedo.x, 0), back, 1e-4);
        assert_true(back + through <= 1 && back > 0 && through > 0);
    }
    arena_clear(&a);
}

static double twice(int part, int in, int out, const void *with)
{
    return 4 * noise(part, in, out, with);
}

TEST(what_gains_energy_gives_back_no_more_than_all)
{
    arena a       = { 0 };
    const bsdf *b = read_text(&a, twin_text(&twin_full, 15, false, twice, NULL));
    assert_true(bsdf_figure(b)->scale < 1);
    furnace(b, &a, &twin_full);
    arena_clear(&a);
}

/* ---- samplers ----------------------------------------------------------------------------------
 */

enum { CELLS = 145, DRAWS = 1 << 18 };

static vfloat even_of(vuint index) /* [0, 1) */
{
    return vto_float(vsigned(vhash(index) >> 8)) * 0x1p-24f;
}

/* Each cell in four: its halves in azimuth and in cos^2 */
static int quarter_of(const twin_basis *b, double x, double y, double z)
{
    int cell = twin_cell(b, x, y, fabs(z)), left = cell, ring = 0;
    for (; left >= b->count[ring]; ring++)
        left -= b->count[ring];
    double low = cos(b->edge[ring] * pi / 180), high = cos(b->edge[ring + 1] * pi / 180);
    double off = remainder(atan2(y, x) - 2 * pi * left / b->count[ring], 2 * pi);
    return 4 * cell + 2 * (off > 0) + (z * z < (low * low + high * high) / 2);
}

static void drawn_as_told(const material *m, const vshading *s, const twin_basis *b)
{
    static int count[2 * 4 * CELLS];
    static double expected[2 * 4 * CELLS];
    memset(count, 0, sizeof count);
    int drawn = 0;
    for (uint32_t i = 0; i < DRAWS; i += LANES) {
        vuint index = vunsigned(vlane_index()) + i;
        vfloat u = even_of(index), v = even_of(index + 777777777u);
        vfloat pick = even_of(index ^ vsplat_uint(0x5bd1e995u));
        vscatter out;
        vfloat pdf;
        vmask goes = m->type->scatter(m, s, u, v, pick, ALL_LANES, &out);
        vrgb f     = m->type->reflect(m, s, &out.wi, goes, &pdf);
        for (int k = 0; k < LANES; k++) {
            if (!(vbits(goes) >> k & 1))
                continue;
            double z = (double)lane(out.wi.z, k), p = (double)lane(out.pdf, k);
            bool through = z * (double)lane(s->n.z, k) < 0;
            count[(through ? 4 * CELLS : 0) +
                  quarter_of(b, (double)lane(out.wi.x, k), (double)lane(out.wi.y, k), z)]++;
            assert_true(lane(pdf, k) == lane(out.pdf, k));
            assert_near((double)lane(out.weight.x, k) * p, (double)lane(f.x, k), 1e-6);
            drawn++;
        }
        assert_true(!vany(out.straight | out.bent));
    }
    assert_true(drawn > DRAWS - 20); /* at a border a float may fall into a dark cell */
    for (int side = 0; side < 2; side++)
        for (int cell = 0; cell < b->cells; cell++) {
            double d[3];
            twin_middle(b, cell, d);
            vvec3 wi = vspread((vec3){ (float)d[0], (float)d[1],
                                       (float)d[2] * (side ? -1.0f : 1.0f) * lane(s->n.z, 0) });
            vfloat pdf;
            m->type->reflect(m, s, &wi, ALL_LANES, &pdf);
            for (int i = 0; i < 4; i++)
                expected[(side ? 4 * CELLS : 0) + 4 * cell + i] =
                    drawn * (double)lane(pdf, 0) / d[2] * twin_area(b, cell) / 4;
        }
    assert_true(chi_square_test(expected, count, 2 * 4 * CELLS) > 1e-3);
}

TEST(draws_from_matrices_follow_their_density)
{
    arena a           = { 0 };
    const bsdf *b     = read_text(&a, twin_text(&twin_full, 15, false, noise, NULL));
    const material *m = layer(&a, b, y_up, false);
    for (int i = 0; i < 3; i++) {
        vshading s = facing(i == 2 ? 89.9 : 40 * i, 77, i == 1);
        drawn_as_told(m, &s, &twin_full);
    }
    arena_clear(&a);
}

/* In 16 x 16 squares on each side, each of which lies in one cell: the finest are 1/16 wide */
static void drawn_in_squares(const material *m, const vshading *s, double turn)
{
    enum { ACROSS = 16, ALL = ACROSS * ACROSS };
    static int count[2 * ALL];
    static double expected[2 * ALL];
    memset(count, 0, sizeof count);
    int drawn = 0;
    double c = cos(turn), d = sin(turn);
    for (uint32_t i = 0; i < DRAWS; i += LANES) {
        vuint index = vunsigned(vlane_index()) + i;
        vscatter out;
        vmask goes = m->type->scatter(m, s, even_of(index), even_of(index + 777777777u),
                                      even_of(index ^ vsplat_uint(0x5bd1e995u)), ALL_LANES, &out);
        for (int k = 0; k < LANES; k++) {
            if (!(vbits(goes) >> k & 1))
                continue;
            double x = (double)lane(out.wi.x, k), y = (double)lane(out.wi.y, k), at[2];
            to_square(x * c + y * d, y * c - x * d, at);
            int through = lane(out.wi.z, k) * lane(s->n.z, k) < 0;
            int row     = (int)fmin(at[0] * ACROSS, ACROSS - 1),
                column  = (int)fmin(at[1] * ACROSS, ACROSS - 1);
            count[through * ALL + row * ACROSS + column]++;
            drawn++;
        }
    }
    assert_true(drawn > DRAWS - 20);
    for (int i = 0; i < 2 * ALL; i++) {
        float p[2];
        one_lane_square_to_disk(((float)(i % ALL / ACROSS) + 0.5f) / ACROSS,
                                ((float)(i % ACROSS) + 0.5f) / ACROSS, p);
        double z = sqrt(1 - (double)(p[0] * p[0]) - (double)(p[1] * p[1]));
        vvec3 wi = vspread((vec3){ (float)((double)p[0] * c - (double)p[1] * d),
                                   (float)((double)p[1] * c + (double)p[0] * d),
                                   (float)(i < ALL ? z : -z) * lane(s->n.z, 0) });
        vfloat pdf;
        m->type->reflect(m, s, &wi, ALL_LANES, &pdf);
        expected[i] = drawn * (double)lane(pdf, 0) / z * pi / ALL;
    }
    assert_true(chi_square_test(expected, count, 2 * ALL) > 1e-3);
}

TEST(draws_from_trees_follow_their_density)
{
    for (int rank = 3; rank <= 4; rank++) {
        arena a           = { 0 };
        const bsdf *b     = read_text(&a, twin_tree_text(rank, 15));
        const material *m = layer(&a, b, y_up, false);
        for (int i = 0; i < 3; i++) {
            vshading s = facing(i == 2 ? 89.9 : 40 * i + 3, 77, i == 1);
            drawn_in_squares(m, &s, rank == 3 ? (77 + 180) * pi / 180 : 0);
        }
        arena_clear(&a);
    }
}

/* ---- sides and directions ----------------------------------------------------------------------
 */

static double seen(const material *m, vshading s, vec3 wi)
{
    vvec3 w = vspread(v3_scale(wi, 1 / v3_length(wi)));
    return (double)lane(m->type->reflect(m, &s, &w, ALL_LANES, NULL).y, 0) /
           fabs((double)lane(w.z, 0));
}

TEST(a_pane_shows_what_is_straight_behind_it_and_mirrored_before_it)
{
    arena a       = { 0 };
    const bsdf *b = read_text(&a, twin_text(&twin_full, 15, false, mirror_and_through, &twin_full));
    const material *m = layer(&a, b, y_up, false);
    for (int below = 0; below < 2; below++) {
        vshading s = facing(40, 60, below);
        vec3 wo    = { lane(s.wo.x, 0), lane(s.wo.y, 0), lane(s.wo.z, 0) };
        vec3 ahead = { -wo.x, -wo.y, -wo.z }, mirror = { -wo.x, -wo.y, wo.z };
        double area =
            twin_area(&twin_full, twin_cell(&twin_full, (double)wo.x, (double)wo.y, 0.766));
        assert_near(seen(m, s, ahead), 0.6 / area, 1e-6);
        assert_near(seen(m, s, mirror), 0.3 / area, 1e-6);
        assert_true(seen(m, s, wo) == 0 && seen(m, s, (vec3){ wo.x, wo.y, -wo.z }) == 0);
    }
    arena_clear(&a);
}

/* From outside, from above, into the room: thrown to the ceiling; all else black. "in" and "out"
 * are ways of light: y < 0 is down. The way back is that of Transmission Back. */
static double thrown_up(int part, int in, int out, const void *with)
{
    double i[3], o[3];
    twin_middle(with, in, i);
    twin_middle(with, out, o);
    if (part == 0)
        return i[1] < -0.3 && o[1] > 0.3 ? 0.2 : 0;
    return part == 1 && i[1] < -0.3 && o[1] > 0.3 ? 0.2 : 0; /* reversed: from o to i, y as well */
}

TEST(light_from_above_is_thrown_where_the_file_says)
{
    arena a             = { 0 };
    const bsdf *b       = read_text(&a, twin_text(&twin_full, 3, false, thrown_up, &twin_full));
    const material *in  = layer(&a, b, y_up, false);
    const material *out = layer(&a, b, y_up, true);
    vshading s          = facing(50, 90, false); /* from above within the room, below the sky's */
    vec3 sky = { 0, 1, -1 }, ground = { 0, -1, -1 };
    assert_near(seen(in, s, sky), 0.2, 1e-6);
    assert_true(seen(in, s, ground) == 0);
    s = facing(50, -90, false); /* from below, light thrown up is not seen */
    assert_true(seen(in, s, sky) == 0 && seen(in, s, ground) == 0);

    /* The room behind the triangles: what is before them is the outside */
    s = facing(50, 90, true);
    assert_near(seen(out, s, (vec3){ 0, 1, 1 }), 0.2, 1e-6);
    assert_true(seen(out, s, (vec3){ 0, -1, 1 }) == 0);
    arena_clear(&a);
}

static double one_sided(int part, int in, int out, const void *with)
{
    static const double share[4] = { 0.25, 0.25, 0.1, 0.6 };
    (void)in, (void)out, (void)with;
    return share[part] / pi;
}

TEST(the_room_is_on_the_front_unless_the_front_is_outside)
{
    arena a             = { 0 };
    const bsdf *b       = read_text(&a, twin_text(&twin_quarter, 15, false, one_sided, NULL));
    const material *in  = layer(&a, b, y_up, false);
    const material *out = layer(&a, b, y_up, true);
    vshading front = facing(30, 0, false), behind = facing(30, 0, true);
    assert_near(lane(in->type->albedo(in, &front, ALL_LANES).x, 0), 0.6, 1e-6);
    assert_near(lane(in->type->albedo(in, &behind, ALL_LANES).x, 0), 0.1, 1e-6);
    assert_near(lane(out->type->albedo(out, &front, ALL_LANES).x, 0), 0.1, 1e-6);
    assert_near(lane(out->type->albedo(out, &behind, ALL_LANES).x, 0), 0.6, 1e-6);
    assert_near(in->reflectance.x, 0.6, 1e-6);
    assert_near(out->reflectance.y, 0.1, 1e-6);
    assert_near(out->transmittance.z, 0.25, 1e-6);
    assert_true(in->two_sided && !in->matt && !in->solid && !in->type->through);
    arena_clear(&a);
}

TEST(up_is_laid_into_the_surface)
{
    arena a       = { 0 };
    const bsdf *b = read_text(&a, twin_text(&twin_full, 3, false, thrown_up, &twin_full));
    vshading s    = facing(50, 90, false);
    vec3 sky      = { 0, 1, -1 };
    assert_near(seen(layer(&a, b, (vec3){ 0, 2, 5 }, false), s, sky), 0.2, 1e-6);
    assert_true(seen(layer(&a, b, (vec3){ 0, -1, 0 }, false), s, sky) == 0);
    s = facing(50, 0, false); /* x is up where the direction is square to the surface */
    assert_near(seen(layer(&a, b, (vec3){ 0, 0, 1 }, false), s, (vec3){ 1, 0, -1 }), 0.2, 1e-6);
    assert_true(seen(layer(&a, b, (vec3){ 0, 0, 1 }, false), s, (vec3){ -1, 0, -1 }) == 0);
    arena_clear(&a);
}

TEST(a_black_layer_sends_nothing_on)
{
    arena a           = { 0 };
    const bsdf *b     = read_text(&a, twin_text(&twin_full, 3, false, thrown_up, &twin_full));
    const material *m = layer(&a, b, y_up, false);
    vshading s        = facing(50, -90, false);
    vscatter out;
    assert_false(
        vany(m->type->scatter(m, &s, vsplat(0.5f), vsplat(0.5f), vsplat(0.5f), ALL_LANES, &out)));
    assert_true(lane(out.pdf, 0) == 0 && lane(out.weight.x, 0) == 0 && lane(out.wi.z, 0) == 0);
    arena_clear(&a);
}

TEST(dead_lanes_are_zero)
{
    arena a = { 0 };
    for (int kind = 0; kind < 2; kind++) {
        const bsdf *b     = read_text(&a, kind ? twin_tree_text(4, 15)
                                               : twin_text(&twin_full, 15, false, noise, NULL));
        const material *m = layer(&a, b, y_up, false);
        vmask one         = vlane_index() < 1;
        vshading s        = facing(30, 20, false);
        vvec3 nan         = vspread((vec3){ NAN, NAN, NAN });
        s.wo              = vselect3(one, s.wo, nan);
        s.n               = vselect3(one, s.n, nan);
        vvec3 wi          = vselect3(one, vspread((vec3){ 0.6f, 0, 0.8f }), nan);
        vfloat pdf;
        vscatter out;
        vrgb f      = m->type->reflect(m, &s, &wi, one, &pdf);
        vrgb albedo = m->type->albedo(m, &s, one);
        vmask goes  = m->type->scatter(m, &s, vsplat(0.3f), vsplat(0.6f), vsplat(0.7f), one, &out);
        assert_int_equal(vbits(goes), 1);
        for (int i = 1; i < LANES; i++) {
            assert_true(lane(f.x, i) == 0 && lane(pdf, i) == 0 && lane(albedo.y, i) == 0);
            assert_true(lane(out.pdf, i) == 0 && lane(out.wi.x, i) == 0);
            assert_true(lane(out.weight.z, i) == 0);
        }
    }
    arena_clear(&a);
}

TEST(what_makes_no_sense_is_refused)
{
    arena a       = { 0 };
    lux_error err = { 0 };
    const bsdf *b = read_text(&a, twin_text(&twin_quarter, 15, false, one_sided, NULL));
    bsdf_desc d   = { .data = b, .up = { 0, 0, 0 } };
    assert_null(material_bsdf(&a, &d, &err));
    assert_int_equal(err.code, ERR_ARGUMENT);
    d.up = (vec3){ NAN, 0, 0 };
    assert_null(material_bsdf(&a, &d, &err));
    d.up             = y_up;
    d.extra.openness = 2;
    assert_null(material_bsdf(&a, &d, &err));
    d.extra.openness = 0;
    memory_is_out    = true;
    arena none       = { 0 };
    err.code         = ERR_NONE;
    assert_null(material_bsdf(&none, &d, &err));
    memory_is_out = false;
    assert_int_equal(err.code, ERR_MEMORY);
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(matrices_agree_with_the_twin),
        cmocka_unit_test(trees_agree_with_the_twin),
        cmocka_unit_test(the_furnace_gives_what_the_albedo_says),
        cmocka_unit_test(the_furnace_gives_what_the_albedo_of_rank_4_says),
        cmocka_unit_test(what_gains_energy_gives_back_no_more_than_all),
        cmocka_unit_test(draws_from_matrices_follow_their_density),
        cmocka_unit_test(draws_from_trees_follow_their_density),
        cmocka_unit_test(a_pane_shows_what_is_straight_behind_it_and_mirrored_before_it),
        cmocka_unit_test(light_from_above_is_thrown_where_the_file_says),
        cmocka_unit_test(the_room_is_on_the_front_unless_the_front_is_outside),
        cmocka_unit_test(up_is_laid_into_the_surface),
        cmocka_unit_test(a_black_layer_sends_nothing_on),
        cmocka_unit_test(dead_lanes_are_zero),
        cmocka_unit_test(what_makes_no_sense_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
