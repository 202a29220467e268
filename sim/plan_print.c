/* sim/plan_print.c -- a plan as people read it, and as JSON. */
#include "sim/command.h"
#include "sim/plan.h"

static const char *transport_name(transport t) { return t == TRANSPORT_MAPS ? "maps" : "path"; }

static void print_bound(const plan_effect *e)
{
    if (e->on)
        printf(" %9s", "");
    else if (e->missed)
        printf(" %9s", "not known");
    else
        printf(" %9.2g", 100.0 * e->bound);
}

void plan_print(const plan *p)
{
    printf("%-16s %-3s %9s  %s\n", "effect", "", "bound/%", "why");
    for (int i = 0; i < EFFECTS; i++) {
        const plan_effect *e = &p->effects[i];
        printf("%-16s %-3s", effect_name((effect)i), e->on ? "on" : "off");
        print_bound(e);
        printf("  %s%s\n", e->why, e->missed ? ": results change" : "");
    }
    printf("bounds: all that is off changes results by at most %.2g %%; %.2g %% is allowed, a "
           "fifth of "
           "the accuracy asked for (%g %%)\n",
           100.0 * p->bound, 20.0 * p->accuracy, 100.0 * p->accuracy);
    printf("transport: %s: %s\n", transport_name(p->transport), p->transport_why);
    for (int i = 0; i < p->weak_count; i++)
        printf("interval not valid: %s\n", p->weak[i]);
}

void plan_print_views(const plan *p)
{
    const plan_effect *e = &p->effects[EFFECT_ANTIALIASING];
    printf("antialiasing of views: %s: %s\n", e->on ? "on" : "off", e->why);
    printf("transport of views: %s: %s\n", transport_name(p->transport), p->transport_why);
}

void plan_print_json(const plan *p)
{
    fputs("{\"effects\":[", stdout);
    for (int i = 0; i < EFFECTS; i++) {
        const plan_effect *e = &p->effects[i];
        printf("%s{\"name\":\"%s\",\"on\":%s", i ? "," : "", effect_name((effect)i),
               e->on ? "true" : "false");
        json_field_text("why", e->why);
        json_field("bound_percent", e->missed ? (double)NAN : 100.0 * e->bound);
        printf(",\"forced\":%s,\"missed\":%s}", e->forced ? "true" : "false",
               e->missed ? "true" : "false");
    }
    putchar(']');
    json_field("bound_percent", 100.0 * p->bound);
    json_field("accuracy_percent", 100.0 * p->accuracy);
    json_field_text("transport", transport_name(p->transport));
    json_field_text("transport_why", p->transport_why);
    fputs(",\"weak\":[", stdout);
    for (int i = 0; i < p->weak_count; i++) {
        fputs(i ? "," : "", stdout);
        json_string(stdout, p->weak[i]);
    }
    puts("]}");
}
