/* sim/light_maps.c -- see light_maps.h. */
#include "sim/light_maps.h"

#include "core/color.h"
#include "sim/accuracy.h"

/* Light that is left out, W as luminance, of so much in all. */
static void leave_out(light_maps *m, double watts, double all)
{
    m->left_out_lm += LUMENS_PER_WATT * watts;
    m->matters |= watts > SHARE_THAT_MATTERS * all;
}

static double luminance_of(vec3 watts) { return (double)rgb_luminance(watts); }

/* Of focused light: it is a part of all. */
static const double least_accuracy = 0.25;

static const double share_of_time = 0.5; /* of what is left, that maps may take */

static map_options options_of(const run_options *o, map_light which, double accuracy)
{
    double left = o->deadline - clock_seconds();
    return (map_options){ .light    = which,
                          .seed     = o->seed,
                          .threads  = o->threads,
                          .accuracy = accuracy,
                          .deadline = o->deadline < HUGE_VAL
                                          ? clock_seconds() + share_of_time * fmax(left, 0.0)
                                          : HUGE_VAL,
                          .progress = o->progress };
}

bool light_maps_indirect(arena *a, const scene *s, const run_options *o, double accuracy,
                         const illumination_map **out, notices *n, lux_error *err)
{
    map_options of  = options_of(o, MAP_INDIRECT, accuracy);
    lux_error wrong = { 0 };
    *out            = NULL;
    if (o->maps) {
        const char *why = NULL;
        *out            = illumination_map_read(a, o->maps, s, &of, &why, &wrong);
        if (*out)
            return true;
        if (wrong.text[0]) /* wrong input, where one that cannot be written is a failure */
            return failed(err, wrong.code == ERR_IO ? ERR_ARGUMENT : wrong.code, "%s", wrong.text);
        if (why)
            notice_add(n, "%s: its maps are of other %s: they are made anew", o->maps, why);
    }
    *out = illumination_map_new(a, s, &of, err);
    return *out && (!o->maps || illumination_map_write(o->maps, *out, err));
}

bool light_maps_focused(arena *a, const scene *s, const run_options *o, double accuracy,
                        const map_sensors *sensors, int64_t particles, light_maps *out,
                        lux_error *err)
{
    double share   = fmax(s->by_lamps.focused, s->by_suns.focused);
    map_options of = options_of(o, MAP_FOCUSED, fmin(accuracy / share, least_accuracy));
    of.sensors     = sensors;
    of.particles   = particles;
    out->focused   = illumination_map_new(a, s, &of, err);
    if (!out->focused)
        return false;
    map_figures f    = illumination_map_figures(out->focused);
    out->left_out_lm = 0.0;
    leave_out(out, luminance_of(f.unplaced), luminance_of(f.sources));
    out->rays += f.rays;
    return true;
}

bool light_maps_make(arena *a, const scene *s, const run_options *o, double accuracy,
                     const map_sensors *sensors, light_maps *out, lux_error *err)
{
    *out = (light_maps){ 0 };
    if (o->direct_only || !s->reflects)
        return true;
    if (scene_focuses(s) && !o->pilot &&
        !light_maps_focused(a, s, o, accuracy, sensors, 0, out, err))
        return false;
    if (o->transport != TRANSPORT_MAPS || o->bounded)
        return true;
    out->indirect = o->indirect;
    if (!out->indirect && !light_maps_indirect(a, s, o, accuracy, &out->indirect, NULL, err))
        return false;
    map_figures f = illumination_map_figures(out->indirect);
    leave_out(out, s->glow_watts, s->glow_watts + luminance_of(f.emitted));
    out->rays += o->indirect ? 0 : f.rays;
    return true;
}
