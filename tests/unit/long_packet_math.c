/* tests/unit/long_packet_math.c -- packet_math.h against double precision over every float of
 * each range, and over 10^9 pairs. Prints the errors that packet_math.h states. */
#include "tests/math_error.h"
#include "tests/test.h"

#include <stdio.h>

TEST(every_float_keeps_its_error)
{
    for (int i = 0; i < MATH_FUNCTIONS; i++) {
        const math_function *f = &math_functions[i];
        math_error e           = math_measure(f, 1);
        printf("%-5s %.3f ulp at %.9g, %.3g absolute at %.9g\n", f->name, e.ulps, (double)e.ulps_at,
               e.absolute, (double)e.absolute_at);
        assert_true(e.ulps <= f->most_ulps);
        assert_true(e.absolute <= f->most_absolute);
    }
}

TEST(a_billion_pairs_keep_their_error)
{
    double angle = math_atan2_error(1000000000), power = math_pow_error(1000000000);
    printf("atan2 %.3f ulp\npow   %.3g (1 + |log2(x^y)|), relative\n", angle, power);
    assert_true(angle <= ATAN2_MOST_ULPS);
    assert_true(power <= POW_MOST_ERROR);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_float_keeps_its_error),
        cmocka_unit_test(a_billion_pairs_keep_their_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
