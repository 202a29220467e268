/* tests/unit/test_packet_math.c -- packet_math.h against double precision, at a sample of floats
 * (long_packet_math.c takes all of them), and where there is no number to compare with. */
#include "tests/math_error.h"
#include "tests/test.h"

TEST(each_function_keeps_its_error)
{
    for (int i = 0; i < MATH_FUNCTIONS; i++) {
        const math_function *f = &math_functions[i];
        math_error e           = math_measure(f, 4099);
        if (!(e.ulps <= f->most_ulps && e.absolute <= f->most_absolute))
            fail_msg("%s is off by %g ulp at %.9g, by %g at %.9g", f->name, e.ulps,
                     (double)e.ulps_at, e.absolute, (double)e.absolute_at);
    }
    assert_true(math_atan2_error(500000) <= ATAN2_MOST_ULPS);
    assert_true(math_pow_error(500000) <= POW_MOST_ERROR);
}

/* Same bits, so that -0 is told from 0; all NaN are the same. */
static bool same(float a, float b)
{
    int32_t bits_a, bits_b;
    memcpy(&bits_a, &a, sizeof bits_a);
    memcpy(&bits_b, &b, sizeof bits_b);
    return bits_a == bits_b || (isnan(a) && isnan(b));
}

#define assert_same(got, want)                                                                     \
    do {                                                                                           \
        vfloat got_ = (got);                                                                       \
        for (int i_ = 0; i_ < LANES; i_++)                                                         \
            if (!same(lane(got_, i_), (want)))                                                     \
                fail_msg("%s is %g, not %s", #got, (double)lane(got_, i_), #want);                 \
    } while (0)

static vfloat v(float a) { return vsplat(a); }

TEST(one_argument_may_be_no_number)
{
    for (int i = 0; i < MATH_FUNCTIONS; i++) {
        assert_same(math_functions[i].packet(v(NAN)), NAN);
        assert_same(math_functions[i].packet(vas_float(vsplat_int(INT32_MAX))), NAN);
        assert_same(math_functions[i].packet(vas_float(vsplat_int(-1))), NAN);
    }
    assert_same(vlog2(v(0.0f)), -INFINITY);
    assert_same(vlog2(v(-0.0f)), -INFINITY);
    assert_same(vlog2(v(INFINITY)), INFINITY);
    assert_same(vlog2(v(-1e-45f)), NAN);
    assert_same(vlog2(v(-INFINITY)), NAN);
    assert_same(vlog2(v(1.0f)), 0.0f);
    assert_same(vlog2(v(1e-45f)), -149.0f);
    assert_same(vexp2(v(128.0f)), INFINITY);
    assert_same(vexp2(v(INFINITY)), INFINITY);
    assert_same(vexp2(v(-150.5f)), 0.0f);
    assert_same(vexp2(v(-INFINITY)), 0.0f);
    assert_same(vexp2(v(-149.0f)), 0x1p-149f);
    assert_same(vexp2(v(0.0f)), 1.0f);
    assert_same(vsin(v(INFINITY)), NAN);
    assert_same(vcos(v(-INFINITY)), NAN);
    assert_same(vcos(v(0.0f)), 1.0f);
    assert_same(vacos(v(1.0f)), 0.0f);
    assert_same(vacos(v(-1.0f)), 3.14159265f);
    assert_same(vacos(v(1.0000001f)), NAN);
    assert_same(vacos(v(-INFINITY)), NAN);
    assert_same(vasin(v(-0.0f)), -0.0f);
    assert_same(vasin(v(1e-45f)), 1e-45f);
    assert_same(vasin(v(-1.0000001f)), NAN);
}

TEST(two_arguments_may_be_no_numbers)
{
    static const float odd[] = { 0.0f,  -0.0f,  1e-45f,   -1e-45f,   1.0f, -1.0f,
                                 3e38f, -3e38f, INFINITY, -INFINITY, NAN };
    enum { ODD = sizeof odd / sizeof *odd };
    for (int i = 0; i < ODD; i++)
        for (int j = 0; j < ODD; j++) {
            float want = (float)atan2((double)odd[i], (double)odd[j]);
            float got  = lane(vatan2(v(odd[i]), v(odd[j])), 0);
            assert_true(same(got, want) || fabsf(got - want) <= 3e-7f);
            assert_int_equal(signbit(got) && !isnan(got), signbit(want) && !isnan(want));
        }
    assert_same(vpow(v(0.0f), v(2.0f)), 0.0f);
    assert_same(vpow(v(0.0f), v(-2.0f)), INFINITY);
    assert_same(vpow(v(0.0f), v(0.0f)), 1.0f);
    assert_same(vpow(v(NAN), v(0.0f)), 1.0f);
    assert_same(vpow(v(2.0f), v(NAN)), NAN);
    assert_same(vpow(v(-2.0f), v(2.0f)), NAN);
    assert_same(vpow(v(1.0f), v(INFINITY)), NAN);
    assert_same(vpow(v(INFINITY), v(0.5f)), INFINITY);
    assert_same(vpow(v(2.0f), v(10.0f)), 1024.0f);
    assert_same(vpow(v(1e30f), v(1e30f)), INFINITY);
    assert_same(vpow(v(1e-30f), v(1e30f)), 0.0f);
}

/* Floats of every exponent and both signs, among them infinities and NaN. */
TEST(every_width_gives_the_same_bits)
{
    for (uint32_t n = 0; n < 400000; n += LANES) {
        vuint bits = (vunsigned(vlane_index()) + n) * 0x9e3779b9;
        vfloat a = vas_float(vsigned(bits)), b = vas_float(vsigned(bits * 0x7feb352d + 1));
        vfloat log = vlog2(a), exp = vexp2(a), power = vpow(vabs(a), b), angle = vatan2(a, b);
        vfloat c = vto_float(vsigned(bits) >> 7), u = c * 0x1p-24f, r = c * 0x1p-14f;
        vfloat s = vsin(r), k = vcos(r), as = vasin(u), ac = vacos(u);
        for (int i = 0; i < LANES; i++) {
            float x = lane(a, i), y = lane(b, i);
            assert_true(same(lane(log, i), one_lane_log2(x)));
            assert_true(same(lane(exp, i), one_lane_exp2(x)));
            assert_true(same(lane(power, i), one_lane_pow(fabsf(x), y)));
            assert_true(same(lane(angle, i), one_lane_atan2(x, y)));
            assert_true(same(lane(s, i), one_lane_sin(lane(r, i))));
            assert_true(same(lane(k, i), one_lane_cos(lane(r, i))));
            assert_true(same(lane(as, i), one_lane_asin(lane(u, i))));
            assert_true(same(lane(ac, i), one_lane_acos(lane(u, i))));
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_function_keeps_its_error),
        cmocka_unit_test(one_argument_may_be_no_number),
        cmocka_unit_test(two_arguments_may_be_no_numbers),
        cmocka_unit_test(every_width_gives_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
