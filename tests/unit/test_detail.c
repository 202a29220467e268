/* tests/unit/test_detail.c -- texture coordinates and smooth normals, beside double precision. */
#include "core/world.h"
#include "tests/shapes.h"
#include "tests/test.h"

#include <stdlib.h>
#include <string.h>

enum { TRIANGLES = 200, HITS = 1 << 13 };

static const transform places[] = {
    { { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } } },                   /* as it is */
    { { { 2.5, 0, 0, 3 }, { 0, 2.5, 0, -1 }, { 0, 0, 2.5, 0.5 } } },          /* larger */
    { { { 0, -1, 0, 0 }, { 0.6, 0, -0.8, 1 }, { 0.8, 0, 0.6, 0 } } },         /* turned */
    { { { -1, 0, 0, 0.5 }, { 0, 1, 0, 0.1 }, { 0, 0, 1, 0.2 } } },            /* mirrored */
    { { { 0.3, 0.4, 0, -0.5 }, { 0, 0.5, 0.1, 0.3 }, { 0.2, 0, 0.6, 0 } } },  /* sheared */
    { { { 0, 0.02, 0, 7000 }, { 0.03, 0, 0, 0.4 }, { 0, 0, 0.01, -5000 } } }, /* small, far off */
};
enum { PLACES = sizeof places / sizeof *places };

/* Triangles of a metre or so in all places, with what they say of themselves. */
typedef struct fixture {
    arena a;
    shape s;
    float texcoord[2][6 * TRIANGLES];
    vec3 normals[3 * TRIANGLES];
    world *w;
} fixture;

static world *make(arena *a, const mesh *m, const transform *place, int count)
{
    world_instance in[PLACES] = { 0 };
    lux_error err             = { 0 };
    for (int i = 0; i < count; i++)
        in[i].place = place[i];
    world *w =
        world_new(a, &(world_desc){ m, 1, in, (uint32_t)count, TRIANGLE_WATERTIGHT, 1 }, &err);
    if (!w)
        fail_msg("%s", err.text);
    return w;
}

static dvec3 unit(dvec3 a) { return d3_scale(a, 1.0 / d3_length(a)); }

static dvec3 corner(const fixture *f, int triangle, int k)
{
    return d3_from(f->s.positions[f->s.corners[3 * triangle + k]]);
}

/* Of the mesh, on the front side; its length is the sine of the angle at corner 0. */
static dvec3 front(const fixture *f, int triangle)
{
    dvec3 o = corner(f, triangle, 0);
    return d3_cross(unit(d3_sub(corner(f, triangle, 1), o)),
                    unit(d3_sub(corner(f, triangle, 2), o)));
}

static void set_up(fixture *f, uint32_t seed)
{
    memset(f, 0, sizeof *f);
    shape_soup(&f->s, TRIANGLES, 0.8f, seed);
    for (int i = 0; i < 6 * TRIANGLES; i++) {
        f->texcoord[0][i] = random_unit(&seed);
        f->texcoord[1][i] = 40.0f * random_unit(&seed) - 20.0f;
    }
    for (int t = 0; t < TRIANGLES; t++)
        for (int k = 0; k < 3; k++) {
            dvec3 off             = d3_scale(d3_from(random_direction(&seed)), 0.8);
            f->normals[3 * t + k] = d3_to_float(unit(d3_add(unit(front(f, t)), off)));
        }
    mesh m        = shape_mesh(&f->s);
    m.texcoord[0] = f->texcoord[0];
    m.texcoord[1] = f->texcoord[1];
    m.normals     = f->normals;
    f->w          = make(&f->a, &m, places, PLACES);
}

static void tear_down(fixture *f)
{
    arena_clear(&f->a);
    shape_clear(&f->s);
}

/* Hits anywhere on any triangle in any place, one in nine none. */
static vhit random_hit(uint32_t *seed)
{
    float t[LANES], u[LANES], v[LANES];
    int32_t instance[LANES], triangle[LANES];
    for (int i = 0; i < LANES; i++) {
        float root  = sqrtf(random_unit(seed));
        bool none   = random_unit(seed) < 0.11f;
        u[i]        = none ? 0.0f : root * random_unit(seed);
        v[i]        = none ? 0.0f : root - u[i];
        t[i]        = none ? INFINITY : 1.0f;
        instance[i] = none ? -1 : (int32_t)(random_unit(seed) * (float)PLACES);
        triangle[i] = none ? -1 : (int32_t)(random_unit(seed) * (float)TRIANGLES);
    }
    return (vhit){ vload(t), vload_int(instance), vload_int(triangle), vload(u), vload(v) };
}

/* ---- the same in double precision ----------------------------------------------------------- */

typedef struct twin {
    double w[3];       /* weights of the corners */
    dvec3 a, b, flat;  /* edges in the world; unit, where the matrix takes the front */
    double sine;       /* between the edges, in the world or in the mesh: the smaller */
    const float *t[2]; /* texture coordinates */
    double across[2];  /* twice the area in the picture */
    double least[2];   /* the picture's sine, likewise */
    const transform *place;
} twin;

static dvec3 turned(const transform *place, dvec3 n)
{
    transform r = transform_inverse(place);
    return unit((dvec3){ r.m[0][0] * n.x + r.m[1][0] * n.y + r.m[2][0] * n.z,
                         r.m[0][1] * n.x + r.m[1][1] * n.y + r.m[2][1] * n.z,
                         r.m[0][2] * n.x + r.m[1][2] * n.y + r.m[2][2] * n.z });
}

static twin twin_of(const fixture *f, const vhit *h, int i)
{
    int triangle = lane(h->triangle, i);
    double u = (double)lane(h->u, i), v = (double)lane(h->v, i);
    twin t  = { .w = { 1.0 - u - v, u, v }, .place = &places[lane(h->instance, i)] };
    dvec3 o = corner(f, triangle, 0);
    t.a     = transform_vector(t.place, d3_sub(corner(f, triangle, 1), o));
    t.b     = transform_vector(t.place, d3_sub(corner(f, triangle, 2), o));
    t.flat  = turned(t.place, front(f, triangle));
    t.sine  = fmin(d3_length(d3_cross(unit(t.a), unit(t.b))), d3_length(front(f, triangle)));
    for (int set = 0; set < 2; set++) {
        const float *c = t.t[set] = f->texcoord[set] + 6 * triangle;
        double u1 = (double)c[2] - (double)c[0], v1 = (double)c[3] - (double)c[1];
        double u2 = (double)c[4] - (double)c[0], v2 = (double)c[5] - (double)c[1];
        t.across[set] = u1 * v2 - u2 * v1;
        t.least[set]  = fabs(t.across[set]) / (hypot(u1, v1) * hypot(u2, v2));
    }
    return t;
}

/* How u (0) or v (1) of a set changes along d, in the plane, per metre. */
static double slope(const twin *t, int set, int which, dvec3 d)
{
    double aa = d3_dot(t->a, t->a), ab = d3_dot(t->a, t->b), bb = d3_dot(t->b, t->b);
    double da = d3_dot(d, t->a), db = d3_dot(d, t->b), all = aa * bb - ab * ab;
    double s = (da * bb - db * ab) / all, r = (db * aa - da * ab) / all;
    const float *c = t->t[set] + which;
    return s * ((double)c[2] - (double)c[0]) + r * ((double)c[4] - (double)c[0]);
}

static dvec3 one_of(const vvec3 *a, int i)
{
    return (dvec3){ (double)lane(a->x, i), (double)lane(a->y, i), (double)lane(a->z, i) };
}

typedef void check_fn(const fixture *f, const twin *t, const vdetail *d, int i, int triangle);

static void check_all(check_fn *check)
{
    static fixture f;
    uint32_t seed = 8;
    set_up(&f, 3);
    for (int n = 0; n < HITS; n += LANES) {
        vhit h = random_hit(&seed);
        vdetail d;
        world_detail(f.w, &h, ALL_LANES, &d);
        for (int i = 0; i < LANES; i++)
            if (lane(h.instance, i) >= 0) {
                twin t = twin_of(&f, &h, i);
                check(&f, &t, &d, i, lane(h.triangle, i));
            }
    }
    tear_down(&f);
}

/* ---- texture coordinates -------------------------------------------------------------------- */

/* Three products, two sums, a weight of two roundings: 7 in all, of the largest corner. */
static void check_coordinates(const fixture *f, const twin *t, const vdetail *d, int i, int number)
{
    (void)f, (void)number;
    for (int set = 0; set < 2; set++)
        for (int k = 0; k < 2; k++) {
            const float *c = t->t[set] + k;
            double got     = (double)lane(k ? d->v[set] : d->u[set], i);
            double want = t->w[0] * (double)c[0] + t->w[1] * (double)c[2] + t->w[2] * (double)c[4];
            double size = (double)fmaxf(fabsf(c[0]), fmaxf(fabsf(c[2]), fabsf(c[4])));
            assert_true(fabs(got - want) <= 7 * 0x1p-24 * size);
        }
}
TEST(coordinates_lie_between_those_of_the_corners) { check_all(check_coordinates); }

/* An area is some 8 roundings of edges off, over the sine between them. */
static void check_scale(const fixture *f, const twin *t, const vdetail *d, int i, int number)
{
    (void)f, (void)number;
    for (int set = 0; set < 2; set++) {
        double want = sqrt(fabs(t->across[set]) / d3_length(d3_cross(t->a, t->b)));
        assert_near(lane(d->scale[set], i), want,
                    8 * 0x1p-24 * (1.0 / t->sine + 1.0 / t->least[set]));
    }
}
TEST(scale_is_the_root_of_picture_over_surface) { check_all(check_scale); }

/* A step of along_u changes u alone, and grows it; one of normal x along_u grows v if mirrored. */
static void check_axes(const fixture *f, const twin *t, const vdetail *d, int i, int number)
{
    (void)f, (void)number;
    for (int set = 0; set < 2; set++) {
        dvec3 along   = one_of(&d->along_u[set], i);
        dvec3 up      = d3_cross(t->flat, along);
        double across = slope(t, set, 1, up), off = slope(t, set, 1, along);
        bool mirrored = vbits(d->mirrored[set]) >> i & 1;
        assert_near(d3_length(along), 1, 4 * 0x1p-24);
        assert_true(fabs(d3_dot(along, t->flat)) < 3e-6); /* as far as the normal may be off */
        assert_true(slope(t, set, 0, along) > 0.0);
        assert_true(mirrored == (across > 0.0));

        /* Along u by the angle that roundings of edges turn it, over both sines */
        double turn = atan2(fabs(off), fabs(across));
        assert_true(turn < 16 * 0x1p-24 / (t->sine * t->least[set]));
    }
}
TEST(along_u_is_where_u_grows_and_v_does_not) { check_all(check_axes); }

static vhit hit_at(int instance, int triangle, float u, float v)
{
    return (vhit){ vsplat(1.0f), vsplat_int(instance), vsplat_int(triangle), vsplat(u), vsplat(v) };
}

/* Two metres wide and high, seen from +z: a picture of three by three, upright. */
TEST(an_upright_picture_is_not_mirrored_until_its_place_is)
{
    static const vec3 at[]          = { { -1, 1, 0 }, { -1, -1, 0 }, { 1, -1, 0 } };
    static const uint32_t corners[] = { 0, 1, 2 };
    static const float uv[]         = { 0, 0, 0, 3, 3, 3 };
    const transform mirrors[]       = { TRANSFORM_IDENTITY,
                                        { { { -2, 0, 0, 0 }, { 0, 2, 0, 0 }, { 0, 0, 2, 5 } } },
                                        { { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, -1, 0 } } } };
    const struct {
        float scale, along, front;
        bool mirrored;
    } want[] = { { 1.5f, 1, 1, false }, { 0.75f, -1, 1, true }, { 1.5f, 1, -1, true } };
    mesh m   = { at, corners, NULL, 3, 1, { NULL, uv }, NULL };
    arena a  = { 0 };
    world *w = make(&a, &m, mirrors, 3);
    for (int k = 0; k < 3; k++) {
        vhit h = hit_at(k, 0, 0.25f, 0.5f);
        vdetail d;
        world_detail(w, &h, ALL_LANES, &d);
        assert_true(vall(d.u[1] == 1.5f) && vall(d.v[1] == 2.25f));
        assert_true(vall(vabs(d.scale[1] - want[k].scale) < 1e-6f));
        assert_true(vall(d.along_u[1].x == want[k].along) && vall(d.normal.z == want[k].front));
        assert_true(want[k].mirrored ? vall(d.mirrored[1]) : !vany(d.mirrored[1]));

        /* The set that it has not, and normals that it has not */
        assert_true(vall(d.u[0] == 0.0f) && vall(d.v[0] == 0.0f) && vall(d.scale[0] == 0.0f));
        assert_true(vall(d.along_u[0].x == 0.0f) && !vany(d.mirrored[0]));
    }
    arena_clear(&a);
}

/* ---- normals --------------------------------------------------------------------------------- */

/* Of corners no more than 54 degrees from the front the sum is 0.6 long at least: a dozen roundings
 * of it, more where the place is flatter one way than another (at most 3 times in `places`). */
static void check_normal(const fixture *f, const twin *t, const vdetail *d, int i, int number)
{
    dvec3 sum = { 0, 0, 0 }, got = one_of(&d->normal, i);
    for (int k = 0; k < 3; k++)
        sum = d3_add(sum, d3_scale(d3_from(f->normals[3 * number + k]), t->w[k]));
    dvec3 want = turned(t->place, sum);
    assert_true(d3_dot(got, t->flat) > 0.0);
    if (d3_dot(want, t->flat) > 1e-5)
        assert_true(d3_length(d3_sub(got, want)) < 12 * 3 * 0x1p-24 / 0.6);
    else if (d3_dot(want, t->flat) < -1e-5)
        assert_true(d3_length(d3_sub(got, t->flat)) < 3e-6);
}
TEST(normals_lie_between_those_of_the_corners) { check_all(check_normal); }

/* Between normals of corners that lie on a sphere about 0 lies just the normal there, since these
 * are the corners; likewise on its image, which the transposed inverse says. */
TEST(a_ball_of_triangles_is_as_smooth_as_the_ball)
{
    shape s = { 0 };
    arena a = { 0 };
    shape_sphere(&s, (vec3){ 0, 0, 0 }, 1.0f, 8);
    vec3 *normals = malloc(3 * s.triangle_count * sizeof *normals);
    assert_non_null(normals);
    for (uint32_t k = 0; k < 3 * s.triangle_count; k++)
        normals[k] = s.positions[s.corners[k]];
    mesh m    = shape_mesh(&s);
    m.normals = normals;
    world *w  = make(&a, &m, places, PLACES - 1);
    free(normals);

    double facets = 0.0;
    uint32_t seed = 4;
    for (int n = 0; n < 4000; n++) {
        const transform *place = &places[n % (PLACES - 1)];
        float u                = 0.05f + 0.85f * random_unit(&seed); /* off edges: places there */
        float v                = 0.05f + (0.9f - u) * random_unit(&seed); /* are moved inward */
        uint32_t triangle      = (uint32_t)(random_unit(&seed) * (float)s.triangle_count);
        vhit h                 = hit_at(n % (PLACES - 1), (int)triangle, u, v);
        vdetail d;
        vsurface at;
        world_detail(w, &h, ALL_LANES, &d);
        world_surface(w, &h, ALL_LANES, &at);

        transform back = transform_inverse(place);
        dvec3 want     = turned(place, transform_point(&back, one_of(&at.position, 0)));
        dvec3 got      = one_of(&d.normal, 0);
        assert_true(d3_length(d3_sub(got, want)) < 3e-6); /* a dozen roundings, places' tripled */
        facets = fmax(facets, d3_length(d3_sub(got, one_of(&at.normal, 0))));
    }
    assert_true(facets > 0.1); /* which the triangles themselves are not */
    arena_clear(&a);
    shape_clear(&s);
}

/* ---- lanes, and what is kept ----------------------------------------------------------------- */

/* Each lane alone, bit by bit as in company, and nothing in those that are dead or missed. */
TEST(no_lane_depends_on_those_beside_it)
{
    static fixture f;
    uint32_t seed = 12;
    set_up(&f, 13);
    for (int n = 0; n < 2000; n++) {
        vhit h       = random_hit(&seed);
        vmask active = vlane_index() != vsplat_int(n % (LANES + 1));
        vdetail d, one;
        vsurface s, other;
        world_detail(f.w, &h, active, &d);
        world_surface(f.w, &h, active, &s);
        for (int i = 0; i < LANES; i++) {
            const vmask alone = vlane_index() == vsplat_int(i);
            world_detail(f.w, &h, active & alone, &one);
            world_surface(f.w, &h, active & alone, &other);
            bool dead        = n % (LANES + 1) == i || lane(h.instance, i) < 0;
            const char *x[4] = { (char *)&d, (char *)&one, (char *)&s, (char *)&other };
            for (size_t k = (size_t)i; 4 * k < sizeof d; k += LANES) {
                static const int32_t zero;
                assert_memory_equal(x[0] + 4 * k, x[1] + 4 * k, 4);
                if (dead)
                    assert_memory_equal(x[0] + 4 * k, &zero, 4);
                if (4 * k < sizeof s)
                    assert_memory_equal(x[2] + 4 * k, x[3] + 4 * k, 4);
            }
        }
    }
    tear_down(&f);
}

TEST(a_world_keeps_what_it_needs_and_says_how_much)
{
    shape s = { 0 };
    uint64_t bytes[2];
    shape_soup(&s, 10, 0.5f, 1);
    float uv[60];
    vec3 normals[30];
    memset(uv, 0, sizeof uv);
    memset(normals, 0, sizeof normals);
    for (int k = 0; k < 2; k++) {
        arena a = { 0 };
        mesh m  = shape_mesh(&s);
        if (k == 1)
            m.texcoord[1] = uv, m.normals = normals;
        bytes[k] = world_statistics(make(&a, &m, places, 1)).bytes;
        arena_clear(&a);
    }
    assert_int_equal(bytes[1] - bytes[0], sizeof uv + sizeof normals);
    shape_clear(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(coordinates_lie_between_those_of_the_corners),
        cmocka_unit_test(scale_is_the_root_of_picture_over_surface),
        cmocka_unit_test(along_u_is_where_u_grows_and_v_does_not),
        cmocka_unit_test(an_upright_picture_is_not_mirrored_until_its_place_is),
        cmocka_unit_test(normals_lie_between_those_of_the_corners),
        cmocka_unit_test(a_ball_of_triangles_is_as_smooth_as_the_ball),
        cmocka_unit_test(no_lane_depends_on_those_beside_it),
        cmocka_unit_test(a_world_keeps_what_it_needs_and_says_how_much),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
