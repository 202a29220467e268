/* data/glass/glassware.c -- see glass.h: turned vessels, whose profiles run up the outside and
 * down the inside. */
#include "data/glass/glass.h"

enum { ROUND = 40 };

static shape turned(const char *name, int ink, const double (*rz)[2], int count)
{
    shape s = shape_new(name, 1.0);
    s.ink   = ink;
    add_turned(&s, &(lathe){ rz, count, ROUND, false }, 2);
    return s;
}

shape wine_glass(void)
{
    static const double rz[][2] = {
        { 0, 0.001 },       { 0.033, 0.001 },  { 0.0345, 0.001 }, { 0.0350, 0.0022 },
        { 0.030, 0.0036 },  { 0.012, 0.0065 }, { 0.0045, 0.014 }, { 0.0036, 0.040 },
        { 0.0036, 0.070 },  { 0.0060, 0.083 }, { 0.022, 0.094 },  { 0.037, 0.115 },
        { 0.0415, 0.140 },  { 0.038, 0.170 },  { 0.0335, 0.198 }, { 0.0328, 0.2025 },
        { 0.0318, 0.2025 }, { 0.0320, 0.197 }, { 0.0362, 0.170 }, { 0.0395, 0.141 },
        { 0.0350, 0.117 },  { 0.020, 0.0975 }, { 0.006, 0.0900 }, { 0, 0.0895 },
    };
    return turned("Wine glass", CLEAR, rz, COUNT(rz));
}

shape carafe(void)
{
    static const double rz[][2] = {
        { 0, 0.001 },      { 0.058, 0.001 },  { 0.068, 0.004 },  { 0.074, 0.018 },
        { 0.072, 0.060 },  { 0.058, 0.110 },  { 0.034, 0.160 },  { 0.024, 0.200 },
        { 0.026, 0.235 },  { 0.036, 0.268 },  { 0.040, 0.277 },  { 0.037, 0.279 },
        { 0.032, 0.268 },  { 0.0225, 0.235 }, { 0.0205, 0.200 }, { 0.030, 0.160 },
        { 0.054, 0.109 },  { 0.0675, 0.062 }, { 0.068, 0.024 },  { 0.058, 0.010 },
        { 0.030, 0.0085 }, { 0, 0.0085 },
    };
    return turned("Carafe", BLUE, rz, COUNT(rz));
}

shape vase(void)
{
    static const double rz[][2] = {
        { 0, 0.001 },     { 0.045, 0.001 }, { 0.052, 0.006 }, { 0.048, 0.020 }, { 0.036, 0.035 },
        { 0.048, 0.080 }, { 0.068, 0.140 }, { 0.066, 0.200 }, { 0.046, 0.250 }, { 0.044, 0.280 },
        { 0.062, 0.318 }, { 0.064, 0.324 }, { 0.060, 0.324 }, { 0.054, 0.313 }, { 0.038, 0.281 },
        { 0.040, 0.248 }, { 0.060, 0.198 }, { 0.062, 0.140 }, { 0.042, 0.082 }, { 0.026, 0.052 },
        { 0, 0.046 },
    };
    return turned("Vase", GREEN, rz, COUNT(rz));
}

shape glass_ball(void)
{
    shape s = shape_new("Glass ball", 1.0);
    s.ink   = CLEAR;
    add_cushion(&s, &(cushion){ .centre     = { 0, 0, 0.061 },
                                .half       = { 0.06, 0.06, 0.06 },
                                .squareness = 1.0,
                                .edge       = 1.0,
                                .segments   = 48,
                                .rings      = 24 });
    return s;
}

/* Its edges are ground round. */
shape glass_block(void)
{
    shape s = shape_new("Glass block", 1.0);
    s.ink   = AMBER;
    add_cushion(&s, &(cushion){ .centre     = { 0, 0, 0.041 },
                                .half       = { 0.055, 0.040, 0.040 },
                                .squareness = 0.2,
                                .edge       = 0.2,
                                .segments   = 32,
                                .rings      = 24 });
    return s;
}

shape fruit_bowl(void)
{
    static const double rz[][2] = {
        { 0, 0.001 },     { 0.050, 0.001 }, { 0.056, 0.003 }, { 0.054, 0.014 }, { 0.085, 0.032 },
        { 0.125, 0.065 }, { 0.142, 0.098 }, { 0.144, 0.102 }, { 0.141, 0.102 }, { 0.120, 0.066 },
        { 0.080, 0.036 }, { 0.040, 0.020 }, { 0, 0.018 },
    };
    return turned("Bowl", CHINA, rz, COUNT(rz));
}

shape plate_of_china(void)
{
    static const double rz[][2] = {
        { 0, 0.001 },     { 0.070, 0.001 }, { 0.074, 0.004 }, { 0.110, 0.018 }, { 0.128, 0.022 },
        { 0.129, 0.024 }, { 0.126, 0.025 }, { 0.108, 0.022 }, { 0.080, 0.008 }, { 0, 0.006 },
    };
    return turned("Plate", CHINA, rz, COUNT(rz));
}
