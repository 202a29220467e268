/* materials/material.c -- packets of several materials: those lanes that agree go together. */
#include "materials/material.h"

static vrgb join(vrgb a, vrgb b) { return vadd(a, b); } /* of disjoint lanes, zero elsewhere */

vmask materials_scatter(const material *const *all, vint index, const vvec3 *wo, const vvec3 *n,
                        vfloat s, vfloat t, vmask active, vscatter *out)
{
    *out       = (vscatter){ 0 };
    vmask goes = { 0 };
    while (vany(active)) {
        int m;
        vmask same = vtake_same(index, &active, &m);
        vscatter part;
        goes        = goes | all[m]->type->scatter(all[m], wo, n, s, t, same, &part);
        out->wi     = join(out->wi, part.wi);
        out->weight = join(out->weight, part.weight);
    }
    return goes;
}

vrgb materials_reflect(const material *const *all, vint index, const vvec3 *wo, const vvec3 *wi,
                       const vvec3 *n, vmask active)
{
    vrgb sum = { 0 };
    while (vany(active)) {
        int m;
        vmask same = vtake_same(index, &active, &m);
        sum        = join(sum, all[m]->type->reflect(all[m], wo, wi, n, same));
    }
    return sum;
}

vfloat materials_pdf(const material *const *all, vint index, const vvec3 *wo, const vvec3 *wi,
                     const vvec3 *n, vmask active)
{
    vfloat sum = { 0 };
    while (vany(active)) {
        int m;
        vmask same = vtake_same(index, &active, &m);
        sum        = sum + all[m]->type->pdf(all[m], wo, wi, n, same);
    }
    return sum;
}

vrgb materials_emission(const material *const *all, vint index, vmask active)
{
    vrgb sum = { 0 };
    while (vany(active)) {
        int m;
        vmask same = vtake_same(index, &active, &m);
        sum        = join(sum, vkeep3(same, vspread(all[m]->emission)));
    }
    return sum;
}

vrgb materials_albedo(const material *const *all, vint index, vmask active)
{
    vrgb sum = { 0 };
    while (vany(active)) {
        int m;
        vmask same = vtake_same(index, &active, &m);
        sum        = join(sum, vkeep3(same, vspread(all[m]->type->albedo(all[m]))));
    }
    return sum;
}
