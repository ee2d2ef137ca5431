// SPDX-License-Identifier: MIT
// Describes the traits of a scene (host/accel/traits.c) and the reasons for the choice of kernels.
#include "cli/scene_parts.h"

#include <stdarg.h>
#include <stdio.h>

__attribute__((format(printf, 3, 4))) static ScenePart part(const char *name, bool is_needed,
                                                            const char *format, ...)
{
    ScenePart made = {.name = name, .is_needed = is_needed};
    va_list values;
    va_start(values, format);
    vsnprintf(made.reason, sizeof made.reason, format, values);
    va_end(values);
    return made;
}

static ScenePart tree_part(const Run *run, bool is_needed)
{
    const uint32_t triangles = run->flat.triangle_count, stored = run->flat.node_count;
    if (is_needed)
        return part("tree", true, "%u node%s over the triangles, uploaded as %u %s node%s",
                    run->report.bvh_nodes, run->report.bvh_nodes == 1 ? "" : "s", stored,
                    kernel_nodes_name(run->flat.layout), stored == 1 ? "" : "s");
    if (triangles == 0)
        return part("tree", false, "there are no triangles to find");
    if (!run->options->uses_bvh)
        return part("tree", false, "--no-bvh: every triangle is tested");
    return part("tree", false, "%u triangles are tested sooner than found", triangles);
}

void scene_parts_list(const Run *run, ScenePart parts[SCENE_PARTS])
{
    const FlatScene *flat = &run->flat;
    const SceneTraits needed = traits_of(flat, run->options->statistics);
    const bool is_special = run->renderer.is_special;
    parts[PART_SPHERES] = needed.spheres ? part("spheres", true, "%u of them", flat->sphere_count)
                                         : part("spheres", false, "there are none");
    parts[PART_TRIANGLES] = needed.triangles
                                ? part("triangles", true, "%u of them", flat->triangle_count)
                                : part("triangles", false, "there are none");
    parts[PART_TREE] = tree_part(run, needed.bvh);
    parts[PART_LIGHTS] =
        needed.shaded
            ? part("lights", true, "%u of them on materials that they shade", flat->light_count)
            : part("lights", false, "all materials in use are silhouettes: no shadow rays");
    parts[PART_MIRRORS] =
        needed.mirrors
            ? part("mirrors", true, "a material in use reflects")
            : part("mirrors", false, "no material in use reflects: no ray is followed on");
    parts[PART_STATISTICS] = needed.statistics
                                 ? part("statistics", true, "--stats counts rays and tests")
                                 : part("statistics", false, "not requested: no --stats");
    for (int i = 0; i < SCENE_PARTS; i++)
        parts[i].is_compiled = parts[i].is_needed || (!is_special && i != PART_STATISTICS);
}

const char *scene_family_reason(const Run *run)
{
    const KernelRequest *request = &run->options->kernel;
    if (request->precision == PRECISION_FP64)
        return "--precision fp64 traces rays one by one";
    if (request->family > 0)
        return "--kernel requests it";
    if (request->nodes == 1 + NODES_PAIR)
        return "--nodes pair has no other";
    if (run->async_device.is_quick)
        return "packets are not compiled and a picture of this size does not repay that";
    if (kernel_suits_packets(&run->async_device.device))
        return "it suits CPUs";
    return run->async_device.device.is_cpu ? "it suits this OpenCL implementation"
                                           : "it suits GPUs";
}

const char *scene_program_reason(const Run *run)
{
    const bool is_special = run->renderer.is_special;
    if (run->options->specialization != SPECIALIZE_AUTO)
        return is_special ? "--specialize always" : "--specialize never";
    return is_special ? "it is compiled already, or saves more than compiling costs"
                      : "a special one is not compiled, and would save less than compiling costs";
}
